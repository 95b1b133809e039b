//! Joined cracks: a crack in two pieces equals the whole crack, and a T-junction agrees with the
//! other engine and a finer mesh.

use crate::common::{
    Absolute, Meshed, Of, Rolling, StepControl, TENSION, close, condition, default_elements, joined_body,
    junction, largest, polyline, sifs_of, surface_crack,
};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::math::{Stress, Vec2};

const MIXED: Stress = Stress { xx: 1.0, yy: 0.6, xy: 0.3, zz: 0.0 };

fn in_two_pieces(degrees: f64, share: f64) -> CrackNetwork {
    let along = Vec2::unit(-degrees.to_radians());
    let (at, tip) = (along * (6.0 * share), along * 6.0);
    let pieces = [vec![Vec2::default(), at], vec![at, tip]];
    let cracks = pieces.map(|points| Crack::polyline(points).unwrap()).to_vec();
    CrackNetwork::joined(cracks, vec![junction(1, End::First, 0)]).unwrap()
}

/// K_I and K_II of all tips at all positions of the last passage.
fn histories(body: &CrackedBody, rolling: &Rolling, friction: f64) -> Vec<f64> {
    let cracks = 1 + body.faces.points.iter().map(|point| point.crack).max().unwrap();
    let passages = rolling.on(&FaceProblem::new(body, &vec![friction; cracks]).unwrap(), &Newton::default());
    assert!(passages.counts.complementarity_max < 1e-9, "the law of the faces");
    let passage = &passages.passages[passages.passages.len() - 1];
    passage.sifs.iter().flatten().flat_map(|k| [k.ki, k.kii]).collect()
}

fn difference(k: &[f64], want: &[f64]) -> f64 {
    assert_eq!(k.len(), want.len());
    largest(k.iter().zip(want).map(|(a, b)| a - b)) / largest(want.iter().copied())
}

#[test]
fn a_crack_in_two_pieces_equals_the_whole() {
    for degrees in [15.0, 60.0] {
        let size = Meshed::of_size(0.2);
        let whole = size.body(&[surface_crack(0.0, 6.0, degrees)]);
        let want = sifs_of(&whole, |_| TENSION);
        for share in [0.3, 0.77] {
            let pieces = size.body_of(&in_two_pieces(degrees, share));
            let off = difference(&sifs_of(&pieces, |_| TENSION), &want);
            close(off, 0.0, Absolute(1e-4), "the same functions; other stations on the faces: 3e-5");
            // 13 000 without junction.
            let condition = condition(&pieces.compliance).unwrap();
            assert!(condition < 3e4, "{degrees} degrees, {share}: condition {condition:.1e}");
        }
        let mut rolling = Rolling::over(vec![surface_crack(0.0, 6.0, degrees)], 0.3, 0.2);
        rolling.steps = StepControl { tolerance: 5e-4, ..StepControl::default() };
        let want = histories(&whole, &rolling, 0.3);
        let pieces = size.body_of(&in_two_pieces(degrees, 0.6));
        let off = difference(&histories(&pieces, &rolling, 0.3), &want);
        println!("{degrees} degrees under the wheel: {off:.1e}");
        close(off, 0.0, Absolute(6e-3), "tractions that are constant over half an element each side: 3.4e-3");
    }
}

/// A surface crack that ends on a kinked one below, or on a straight one.
fn t_junction(right: (f64, f64)) -> CrackNetwork {
    let at = (0.7, -4.0);
    let cracks = vec![polyline(&[(1.0, 0.0), (0.4, -2.0), at]), polyline(&[(-2.3, -4.3), at, right])];
    CrackNetwork::joined(cracks, vec![junction(0, End::Last, 1)]).unwrap()
}
const STRAIGHT: (f64, f64) = (3.7, -3.7);
const KINKED: (f64, f64) = (3.0, -3.0);

/// Largest differences from the other engine with twice its elements, relative to the peak: open,
/// with friction and without.
fn from_other_engine(network: &CrackNetwork, sizes: &[f64]) -> Vec<[f64; 3]> {
    let rolling = Rolling::over(vec![network.cracks()[0].clone()], 0.3, 0.1);
    let all = |body: &CrackedBody| {
        [sifs_of(body, |_| MIXED), histories(body, &rolling, 0.3), histories(body, &rolling, 0.0)]
    };
    let want = all(&joined_body(network.cracks(), network.junctions(), 2 * default_elements()));
    let of_size = |&size: &f64| {
        let k = all(&Meshed::of_size(size).body_of(network));
        std::array::from_fn(|i| difference(&k[i], &want[i]))
    };
    sizes.iter().map(of_size).collect()
}

#[test]
fn a_t_junction_agrees_with_the_other_engine() {
    for (name, right, sizes) in [("straight", STRAIGHT, &[0.2][..]), ("kinked", KINKED, &[0.2, 0.1])] {
        let off = from_other_engine(&t_junction(right), sizes);
        println!("{name}: {off:?}");
        for [open, friction, smooth] in &off {
            close(*open, 0.0, Absolute(4e-4), "1.7e-4, the elements of the other engine among them");
            close(*friction, 0.0, Absolute(4e-3), "2.0e-3");
            close(*smooth, 0.0, Absolute(1.2e-3), "6e-4");
        }
        if let [coarse, fine] = off[..] {
            assert!(fine[1] < 0.9 * coarse[1] && fine[2] < 0.7 * coarse[2], "finer elements: {off:?}");
        }
    }
}

/// The nodal forces of a stress sum to its resultant on the joining crack and on each side of the
/// junction.
#[test]
fn tractions_are_conserved() {
    let network = t_junction(KINKED);
    let body = Meshed::of_size(0.2).body_of(&network);
    let stress = Stress { xx: -0.7, yy: 1.0, xy: 0.4, zz: 0.0 };
    let forces = body.faces.nodal_forces(|_| stress);
    for part in [vec![(0, 0), (0, 1)], vec![(1, 0)], vec![(1, 1)]] {
        let own = || {
            let all = body.faces.points.iter().zip(forces.chunks_exact(2));
            all.filter(|(point, _)| part.contains(&(point.crack, point.segment)))
        };
        let sum = own().fold(Vec2::default(), |sum, (point, f)| {
            sum + point.tangent * f[0] + point.tangent.left() * f[1]
        });
        let mut want = Vec2::default();
        for &(index, segment) in &part {
            let crack = &network.cracks()[index];
            let (from, to) = crack.segment(segment);
            // Linear in √r to zero at a tip: a third of the last element is missing.
            let tip = if segment == 0 { from } else { to };
            let last = own().map(|(point, _)| (point.position - tip).length()).fold(f64::INFINITY, f64::min);
            let missing = if index == 1 { last / 3.0 } else { 0.0 };
            let length = (to - from).length();
            want = want + stress.traction((to - from).left()) * ((length - missing) / length);
        }
        close((sum - want).length(), 0.0, Of(1e-4, want.length()), "√r is g up to the square of an element");
    }
}

/// Mirrored joined cracks have the mirrored history, on a mesh that is mirrored to round-off.
#[test]
fn mirrored_junctions() {
    let reflect = |p: &Vec2| Vec2::new(-p.x, p.y);
    let mirrored = |crack: &Crack| Crack::polyline(crack.points().iter().map(reflect).collect()).unwrap();
    let network = t_junction(KINKED);
    let other = network.cracks().iter().map(mirrored).collect();
    let other = CrackNetwork::joined(other, network.junctions().to_vec()).unwrap();
    let rolling = Rolling::over(vec![network.cracks()[0].clone()], 0.3, 0.1);
    let mirror = Rolling { travel: -1.0, ..Rolling::over(vec![other.cracks()[0].clone()], 0.3, -0.1) };
    let size = Meshed::of_size(0.2);
    let k = histories(&size.body_of(&network), &rolling, 0.3);
    let m = histories(&size.body_of(&other), &mirror, 0.3);
    let turned: Vec<f64> = m.iter().enumerate().map(|(i, k)| if i % 2 == 1 { -k } else { *k }).collect();
    let off = difference(&turned, &k);
    println!("mirrored: {off:.1e}");
    close(off, 0.0, Absolute(1e-11), "round-off");
}
