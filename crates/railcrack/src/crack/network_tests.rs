//! Networks whose cracks meet at their junctions, and only there.

use super::*;
use crate::math::Vec2;

fn crack(points: &[(f64, f64)]) -> Crack {
    Crack::polyline(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).unwrap()
}

fn junction(crack: usize, end: End, onto: usize) -> Junction {
    Junction { joining: CrackEnd { crack, end }, onto }
}

/// A buried crack with a vertex at (0.3, −5).
fn receiving() -> Crack {
    crack(&[(-3.0, -5.0), (0.3, -5.0), (2.0, -5.0)])
}

#[test]
fn t_junction_takes_a_tip_and_leaves_the_others() {
    let cracks = vec![crack(&[(1.0, 0.0), (0.3, -5.0)]), receiving()];
    assert_eq!(CrackNetwork::new(cracks.clone()), Err(NetworkError::Meeting { first: 1, second: 2 }));
    let network = CrackNetwork::joined(cracks, vec![junction(0, End::Last, 1)]).unwrap();
    let tips = [(0, End::First), (1, End::Last)].map(|(tip, end)| CrackTip { crack: 1, tip, end });
    assert_eq!(network.tips(), tips);
    let kind = |crack, end| network.end_kind(CrackEnd { crack, end });
    assert_eq!([kind(0, End::First), kind(0, End::Last)], [EndKind::Mouth, EndKind::Junction]);
    let point = &network.junction_points()[0];
    assert_eq!((point.position, point.ends.len()), (Vec2::new(0.3, -5.0), 1));
    let passing = point.through.unwrap();
    assert_eq!((passing.crack, passing.vertex), (1, 1));
    assert!((passing.s - 3.3).abs() < 1e-15);
}

#[test]
fn growth_of_the_first_end_moves_the_arc_length_and_not_the_junction() {
    let longer = receiving().extended(End::First, 0.5, 0.1).unwrap();
    let cracks = vec![crack(&[(1.0, 0.0), (0.3, -5.0)]), longer];
    let network = CrackNetwork::joined(cracks, vec![junction(0, End::Last, 1)]).unwrap();
    let passing = network.junction_points()[0].through.unwrap();
    assert_eq!(passing.vertex, 2);
    assert!((passing.s - 3.8).abs() < 1e-15, "{passing:?}");
}

#[test]
fn tip_to_tip_and_a_third_crack_at_the_same_point() {
    let at = (0.0, -4.0);
    let cracks =
        vec![crack(&[(-4.0, -4.0), at]), crack(&[(4.0, -5.0), at]), crack(&[at, (0.0, -9.0), (1.0, -9.0)])];
    let junctions = vec![junction(0, End::Last, 1), junction(2, End::First, 0)];
    let network = CrackNetwork::joined(cracks, junctions).unwrap();
    let point = &network.junction_points()[0];
    assert_eq!(network.junction_points().len(), 1);
    let ends = [(0, End::Last), (1, End::Last), (2, End::First)].map(|(crack, end)| CrackEnd { crack, end });
    assert_eq!((&point.ends[..], point.through), (&ends[..], None));
    assert_eq!(network.tips_of(0), [End::First]);
    assert_eq!(network.tips_of(2), [End::Last]);
}

#[test]
fn junctions_that_cannot_be() {
    let joining = crack(&[(1.0, 0.0), (0.3, -5.0)]);
    let of = |cracks: &[&Crack], junctions: &[Junction]| {
        CrackNetwork::joined(cracks.iter().map(|&c| c.clone()).collect(), junctions.to_vec()).unwrap_err()
    };
    let refused = |junctions: &[Junction]| {
        let error = of(&[&joining, &receiving()], junctions);
        assert!(matches!(error, NetworkError::Junction { .. }), "{error:?}");
    };
    refused(&[junction(0, End::First, 1)]); // a mouth
    refused(&[junction(2, End::Last, 1)]);
    refused(&[junction(0, End::Last, 2)]);
    refused(&[junction(0, End::Last, 0)]);
    refused(&[junction(0, End::Last, 1), junction(0, End::Last, 1)]);
    let without = crack(&[(-3.0, -5.0), (2.0, -5.0)]);
    let no_vertex = of(&[&joining, &without], &[junction(0, End::Last, 1)]);
    assert_eq!(no_vertex, NetworkError::NoVertex { number: 1, onto: 2, x: 0.3, y: -5.0 });
    // The cracks meet again at a point that is not declared as a junction.
    let twice = crack(&[(-1.0, -1.0), (-1.0, -6.0), (0.3, -6.0), (0.3, -5.0)]);
    let meeting = of(&[&twice, &receiving()], &[junction(0, End::Last, 1)]);
    assert_eq!(meeting, NetworkError::Meeting { first: 1, second: 2 });
    // The crack leaves the junction along the other crack.
    let along = crack(&[(-1.0, -5.0), (0.3, -5.0)]);
    let meeting = of(&[&along, &receiving()], &[junction(0, End::Last, 1)]);
    assert_eq!(meeting, NetworkError::Meeting { first: 1, second: 2 });
}

#[test]
fn no_piece_is_cut_off() {
    let mouth = crack(&[(1.0, 0.0), (0.3, -5.0)]);
    let from_the_surface = crack(&[(-6.0, 0.0), (-3.0, -5.0), (0.3, -5.0), (2.0, -5.0)]);
    let error = CrackNetwork::joined(vec![mouth, from_the_surface], vec![junction(0, End::Last, 1)]);
    assert_eq!(error, Err(NetworkError::Detached { number: 1 }));
    let straight = crack(&[(-3.0, -5.0), (-1.0, -5.0), (1.0, -5.0), (2.0, -5.0)]);
    let bridge = crack(&[(-1.0, -5.0), (0.0, -7.0), (1.0, -5.0)]);
    let both = vec![junction(0, End::First, 1), junction(0, End::Last, 1)];
    let error = CrackNetwork::joined(vec![bridge, straight], both);
    assert_eq!(error, Err(NetworkError::Detached { number: 2 }));
}
