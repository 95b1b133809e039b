//! Tips that meet cracks, each other, their own faces and the surface, and the pieces that they cut
//! off.

use super::*;
use crate::crack::{CrackEnd, CrackNetwork, CrackTip, End, segment_distance};
use crate::growth::PieceKind;
use crate::plane::fixtures::{self, SETTINGS, advanced, crack};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

const RESOLUTION: f64 = 0.05;
/// Round-off of a few operations.
const ROUNDING: f64 = 1e-13;

/// The tip at `end` of crack `crack`, which kinks by `kink` (radians) and grows at `rate`.
fn drive(crack: usize, end: End, tip: usize, kink: f64, rate: f64) -> TipDrive {
    TipDrive { tip: CrackTip { crack, tip, end }, ..fixtures::tip(crack, kink, rate) }
}

/// The last tip of a surface crack, straight ahead.
fn ahead(crack: usize, rate: f64) -> TipDrive {
    drive(crack, End::Last, 0, 0.0, rate)
}

fn state<'a>(cracks: &'a [Crack], tips: &'a [TipDrive]) -> StepState<'a> {
    StepState { at: fixtures::at(3, 0.0), ..fixtures::state(cracks, tips, RESOLUTION) }
}

fn next(cracks: &[Crack], tips: &[TipDrive]) -> PlaneAdvance {
    let next = advanced(&state(cracks, tips), &SETTINGS);
    CrackNetwork::joined(next.cracks.clone(), next.junctions.clone()).unwrap();
    next
}

/// A vertical crack at `x`, buried between the depths 3 and 7.
fn wall(x: f64) -> Crack {
    crack(&[(x, -3.0), (x, -7.0)])
}

/// 5.5 mm to a tip at (x, −4), the last of them horizontal: increments of 0.04 × length.
fn coming(x: f64) -> Crack {
    crack(&[(x - 2.0, 0.0), (x - 2.0, -4.0), (x, -4.0)])
}

#[test]
fn tip_joins_the_crack_that_its_increment_crosses() {
    let cracks = [coming(0.0), wall(0.2)];
    let still = |tip| TipDrive { stopped: Some(TipStop::Arrest), ..drive(1, End::Last, tip, 0.0, 1e-6) };
    let tips = [
        ahead(0, 1e-6),
        TipDrive { tip: CrackTip { crack: 1, tip: 0, end: End::First }, ..still(0) },
        still(1),
    ];
    let next = next(&cracks, &tips);
    let junction = Junction { joining: CrackEnd { crack: 0, end: End::Last }, onto: 1 };
    assert_eq!((&next.junctions[..], next.stop), (&[junction][..], None));
    assert_eq!(next.tips[0].stop, Some(TipStop::Coalescence));
    assert!((next.tips[0].increment - 0.2).abs() < ROUNDING, "{next:?}");
    let at = next.cracks[0].tip(End::Last);
    assert!((at - Vec2::new(0.2, -4.0)).length() < ROUNDING, "{at:?}");
    assert_eq!(next.cracks[1].vertex_at(at), Some(1));
    assert!(
        (next.progress.cycles / 0.24 * 1e-6 - 1.0).abs() < ROUNDING,
        "the others have the time of a whole increment"
    );
}

#[test]
fn tip_that_comes_close_ends_at_the_nearest_point() {
    // Ends 0.03 mm before the wall.
    let near = next(&[coming(0.0), wall(0.27)], &[ahead(0, 1e-6)]);
    assert!((near.cracks[0].tip(End::Last) - Vec2::new(0.27, -4.0)).length() < ROUNDING, "{near:?}");
    // Passes 0.03 mm below the end of a wall: joins its tip.
    let below = next(&[coming(0.0), crack(&[(0.1, -2.0), (0.1, -3.97)])], &[ahead(0, 1e-6)]);
    assert_eq!(below.cracks[0].tip(End::Last), Vec2::new(0.1, -3.97));
    assert_eq!(below.cracks[1].points().len(), 2);
    // Stays 0.06 mm away.
    let far = next(&[coming(0.0), wall(0.30)], &[ahead(0, 1e-6)]);
    assert_eq!((far.tips[0].stop, far.junctions.len()), (None, 0));
    // Moves away from a crack that is near.
    let leaving = next(&[coming(0.0), wall(0.04)], &[drive(0, End::Last, 0, 2.0, 1e-6)]);
    assert_eq!((leaving.tips[0].stop, leaving.junctions.len()), (None, 0));
}

#[test]
fn no_segment_shorter_than_the_resolution_is_left() {
    // A vertex of the wall 0.03 mm from where the increment crosses it.
    let cracks = [coming(0.0), crack(&[(0.2, -3.0), (0.2, -4.03), (0.25, -7.0)])];
    let snapped = next(&cracks, &[ahead(0, 1e-6)]);
    assert_eq!(snapped.cracks[0].tip(End::Last), Vec2::new(0.2, -4.03));
    assert_eq!(snapped.cracks[1].points().len(), 3);
    // The tip is 0.02 mm before the wall: its end moves there.
    let moved = next(&[coming(0.0), wall(0.02)], &[ahead(0, 1e-6)]);
    assert_eq!(moved.cracks[0].points().len(), 3);
    assert!((moved.cracks[0].tip(End::Last) - Vec2::new(0.02, -4.0)).length() < ROUNDING);
    // A shallow approach turns to the nearest point: no thin wedge.
    let shallow = next(&[coming(0.0), crack(&[(-1.0, -4.11), (1.0, -4.01)])], &[ahead(0, 1e-6)]);
    let at = shallow.cracks[0].tip(End::Last);
    assert!((at.y + 4.048).abs() < 1e-3 && at.x < 0.245, "{at:?}");
    assert_eq!(shallow.junctions.len(), 1);
}

#[test]
fn tips_that_come_together_meet_where_they_are_at_the_same_time() {
    // The tips are 0.3 mm apart; the first grows by 0.24 mm, the second at half the speed. They
    // come within one resolved length after 0.25 mm of combined growth.
    let other = crack(&[(4.0, -9.0), (4.0, -4.0), (0.3, -4.0)]);
    let cracks = [coming(0.0), other];
    let next = next(&cracks, &[ahead(0, 2e-6), TipDrive { rate: 1e-6, ..drive(1, End::Last, 1, 0.0, 1e-6) }]);
    let at = next.cracks[0].tip(End::Last);
    assert_eq!(at, next.cracks[1].tip(End::Last));
    assert!((at - Vec2::new(0.25 * 2.0 / 3.0 + 0.025, -4.0)).length() < 1e-9, "{at:?}");
    assert_eq!(next.junctions, [Junction { joining: CrackEnd { crack: 0, end: End::Last }, onto: 1 }]);
    assert_eq!(next.tips.iter().map(|tip| tip.stop).collect::<Vec<_>>(), [Some(TipStop::Coalescence); 2]);
}

#[test]
fn later_tip_joins_what_the_earlier_one_left_behind() {
    // The second tip rises through (0.06, −4) after 5/6 of its increment; the first one passes
    // there after a quarter.
    let rising = crack(&[(0.06, -10.2), (0.06, -4.2)]);
    let tips = [ahead(0, 1e-6), drive(1, End::Last, 1, 0.0, 1e-6)];
    let next = next(&[coming(0.0), rising], &tips);
    assert_eq!([next.tips[0].stop, next.tips[1].stop], [None, Some(TipStop::Coalescence)]);
    let at = next.cracks[1].tip(End::Last);
    assert!((at - Vec2::new(0.06, -4.0)).length() < ROUNDING, "{at:?}");
    assert_eq!(next.cracks[0].vertex_at(at), Some(3));
    assert!((next.cracks[0].tip(End::Last).x - 0.24).abs() < ROUNDING);
}

#[test]
fn piece_between_two_surface_cracks_is_detached() {
    let cracks = [coming(0.0), crack(&[(0.2, 0.0), (0.2, -6.0)])];
    let stopped = TipDrive { stopped: Some(TipStop::Arrest), ..ahead(1, 1e-6) };
    let end = next(&cracks, &[ahead(0, 1e-6), stopped]);
    assert_eq!((end.stop, end.progress.cycles, &end.cracks[..]), (Some(RunStop::Detached), 0.0, &cracks[..]));
    let [piece] = &end.pieces[..] else { panic!("{:?}", end.pieces) };
    assert_eq!((piece.kind, piece.step, piece.crack), (PieceKind::Detached, 3, 0));
    assert!((piece.area - 2.2 * 4.0).abs() < ROUNDING, "{piece:?}");
    assert_eq!(piece.outline.len(), 5, "mouth, corner, tip, junction, mouth: {piece:?}");
    // The same for tip to tip.
    let both = next(
        &[coming(0.0), crack(&[(2.3, 0.0), (2.3, -4.0), (0.3, -4.0)])],
        &[ahead(0, 1e-6), ahead(1, 1e-6)],
    );
    assert_eq!(both.stop, Some(RunStop::Detached));
    assert!((both.pieces[0].area - 4.3 * 4.0).abs() < 1e-12, "{:?}", both.pieces);
}

#[test]
fn crack_that_comes_back_to_itself_detaches_a_piece() {
    let hook = crack(&[(0.0, 0.0), (0.0, -6.0), (3.0, -6.0), (3.0, -3.0), (0.2, -3.0)]);
    let end = next(&[hook], &[ahead(0, 1e-6)]);
    assert_eq!(end.stop, Some(RunStop::Detached));
    assert!((end.pieces[0].area - 9.0).abs() < ROUNDING, "{:?}", end.pieces);
    // The two tips of a buried crack.
    let ring = crack(&[(-0.1, -3.0), (-2.0, -3.0), (-2.0, -5.0), (2.0, -5.0), (2.0, -3.0), (0.1, -3.0)]);
    let tips = [drive(0, End::First, 0, 0.0, 1e-6), drive(0, End::Last, 1, 0.0, 1e-6)];
    let end = next(&[ring], &tips);
    assert_eq!(end.stop, Some(RunStop::Detached));
    assert!((end.pieces[0].area - 8.0).abs() < ROUNDING, "{:?}", end.pieces);
}

#[test]
fn loop_by_way_of_a_third_crack() {
    // Two surface cracks that stand on a buried one: the second of them closes the loop.
    let floor = crack(&[(-3.0, -5.0), (0.0, -5.0), (3.0, -5.0)]);
    let cracks = [crack(&[(0.0, 0.0), (0.0, -5.0)]), crack(&[(2.0, 0.0), (2.0, -4.9)]), floor];
    let junctions = [Junction { joining: CrackEnd { crack: 0, end: End::Last }, onto: 2 }];
    let tips = [ahead(1, 1e-6)];
    let end = advanced(&StepState { junctions: &junctions, ..state(&cracks, &tips) }, &SETTINGS);
    assert_eq!(end.stop, Some(RunStop::Detached));
    assert!((end.pieces[0].area - 10.0).abs() < 1e-12, "{:?}", end.pieces);
    // Without the first junction nothing is detached.
    let apart = [cracks[0].moved(-6.0), cracks[1].clone(), cracks[2].clone()];
    assert_eq!(next(&apart, &[ahead(1, 1e-6)]).stop, None);
}

#[test]
fn tip_that_breaks_out_leaves_a_spall_and_the_others_go_on() {
    let rising = crack(&[(0.0, 0.0), (1.0, -2.0), (4.0, -0.15)]);
    let cracks = [rising.clone(), coming(20.0)];
    let up = drive(0, End::Last, 0, 0.0, 4e-6);
    let next = next(&cracks, &[up, ahead(1, 1e-6)]);
    assert_eq!((next.tips[0].stop, next.stop), (Some(TipStop::BreakOut), None));
    assert!((next.tips[1].increment - 0.24).abs() < ROUNDING, "the other sets the pace");
    assert_eq!(next.cracks[0], rising);
    let [spall] = &next.pieces[..] else { panic!("{:?}", next.pieces) };
    assert_eq!((spall.kind, spall.crack), (PieceKind::Spall, 0));
    // The ligament ends on the surface directly above the end of the increment.
    let step = 0.04 * rising.length() * rising.ahead(End::Last).x;
    let outline = [(0.0, 0.0), (1.0, -2.0), (4.0, -0.15), (4.0 + step, 0.0)];
    let shoelace: f64 = (0..4)
        .map(|i| {
            let (a, b) = (outline[i], outline[(i + 1) % 4]);
            0.5 * (a.0 * b.1 - b.0 * a.1)
        })
        .sum();
    assert!((spall.area - shoelace.abs()).abs() < ROUNDING, "{spall:?}");
    // A second run from there does not report it again.
    let stopped = [TipDrive { stopped: Some(TipStop::BreakOut), ..up }, ahead(1, 1e-6)];
    let again = StepState { break_outs: &next.break_outs, ..state(&cracks, &stopped) };
    assert_eq!(advanced(&again, &SETTINGS).pieces, []);
}

#[test]
fn buried_crack_makes_a_spall_with_its_second_break_out() {
    let basin = crack(&[(-2.0, -0.2), (-1.0, -2.0), (1.0, -2.0), (2.0, -0.2)]);
    let tips = [drive(0, End::First, 0, 0.0, 1e-6), drive(0, End::Last, 1, 0.0, 1e-6)];
    let first = next(std::slice::from_ref(&basin), &[tips[0], TipDrive { kink: Some(-2.0), ..tips[1] }]);
    assert_eq!(
        (first.tips[0].stop, first.pieces.len(), first.break_outs.len()),
        (Some(TipStop::BreakOut), 0, 1)
    );
    let cracks = [basin];
    let stopped = [TipDrive { stopped: Some(TipStop::BreakOut), ..tips[0] }, tips[1]];
    let second =
        advanced(&StepState { break_outs: &first.break_outs, ..state(&cracks, &stopped) }, &SETTINGS);
    assert_eq!(second.stop, Some(RunStop::NoTipGrows(TipStop::BreakOut)));
    let [spall] = &second.pieces[..] else { panic!("{:?}", second.pieces) };
    assert!(spall.area > 6.1 && spall.area < 6.4 && spall.outline.len() == 6, "{spall:?}");
}

fn any_crack() -> impl Strategy<Value = Crack> {
    let segments = prop::collection::vec((-90.0..90.0f64, 0.3..1.5f64), 1..4);
    (-3.0..3.0f64, 1.0..5.0f64, 0.0..360.0f64, segments).prop_filter_map(
        "not a crack",
        |(x, depth, angle, segments)| {
            let mut points = vec![Vec2::new(x, -depth)];
            let mut angle = angle;
            for (turn, length) in segments {
                angle += turn;
                points.push(points[points.len() - 1] + Vec2::unit(angle.to_radians()) * length);
            }
            Crack::polyline(points).ok()
        },
    )
}

/// The distance between two cracks, mm.
fn gap(one: &Crack, other: &Crack) -> f64 {
    let pairs = one.points().windows(2).flat_map(|p| other.points().windows(2).map(move |q| (p, q)));
    pairs.map(|(p, q)| segment_distance(p[0], p[1], q[0], q[1])).fold(f64::INFINITY, f64::min)
}

fn any_network() -> impl Strategy<Value = (Vec<Crack>, Vec<TipDrive>)> {
    let drives = prop::collection::vec((-1.2..1.2f64, 0.05..1.0f64, 0.0..1.0f64), 6);
    (prop::collection::vec(any_crack(), 2..4), drives).prop_filter_map(
        "cracks that meet",
        |(cracks, drives)| {
            CrackNetwork::new(cracks.clone()).ok()?;
            // Cracks that are resolved at the start of the step.
            let near =
                |(i, one): (usize, &Crack)| cracks[..i].iter().any(|other| gap(one, other) < RESOLUTION);
            if cracks.iter().enumerate().any(near) {
                return None;
            }
            let ends = (0..cracks.len()).flat_map(|c| [(c, End::First, 0), (c, End::Last, 1)]);
            let tips = ends.zip(drives).map(|((c, end, tip), (kink, rate, deferred))| {
                let direction = Vec2::unit(cracks[c].ahead(end).angle() + kink + 0.1);
                let length = deferred * LARGE.increment * cracks[c].length();
                let deferred = if deferred < 0.5 {
                    DeferredGrowth::default()
                } else {
                    DeferredGrowth { length, direction, is_kinked: true }
                };
                TipDrive { deferred, ..drive(c, end, tip, kink, 1e-6 * rate) }
            });
            let tips = tips.collect();
            Some((cracks, tips))
        },
    )
}

fn mirrored(point: Vec2) -> Vec2 {
    Vec2::new(-point.x, point.y)
}

fn mirrored_crack(crack: &Crack) -> Crack {
    Crack::polyline(crack.points().iter().map(|&p| mirrored(p)).collect()).unwrap()
}

/// Increments of a fifth of the length, so that many tips meet something.
const LARGE: GrowthSettings = GrowthSettings { increment: 0.2, ..SETTINGS };

/// For arbitrary cracks, the cracks of the next step form a network; a mirror image and a different
/// order of the cracks give the same result.
#[test]
fn any_step_makes_a_network_and_knows_neither_order_nor_hand() {
    let config = ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() };
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let held = TestRunner::new_with_rng(config, random).run(&any_network(), |(cracks, tips)| {
        let next = advanced(&state(&cracks, &tips), &LARGE);
        prop_assert!(CrackNetwork::joined(next.cracks.clone(), next.junctions.clone()).is_ok());
        let mirror: Vec<Crack> = cracks.iter().map(mirrored_crack).collect();
        let turned = tips.iter().map(|tip| {
            let deferred = DeferredGrowth { direction: mirrored(tip.deferred.direction), ..tip.deferred };
            TipDrive { kink: tip.kink.map(|k| -k), deferred, ..*tip }
        });
        let other = advanced(&state(&mirror, &turned.collect::<Vec<_>>()), &LARGE);
        prop_assert_eq!((other.stop, other.junctions.len()), (next.stop, next.junctions.len()));
        for (one, two) in next.cracks.iter().zip(&other.cracks) {
            prop_assert_eq!(one.points().len(), two.points().len());
            for (p, q) in one.points().iter().zip(two.points()) {
                prop_assert!((*p - mirrored(*q)).length() < 1e-9, "{:?} {:?}", p, q);
            }
        }
        let reversed: Vec<Crack> = cracks.iter().rev().cloned().collect();
        let crack = |tip: CrackTip| cracks.len() - 1 - tip.crack;
        let back = tips
            .chunks(2)
            .rev()
            .flatten()
            .map(|tip| TipDrive { tip: CrackTip { crack: crack(tip.tip), ..tip.tip }, ..*tip });
        let other = advanced(&state(&reversed, &back.collect::<Vec<_>>()), &LARGE);
        prop_assert_eq!(other.stop, next.stop);
        for (one, two) in next.cracks.iter().zip(other.cracks.iter().rev()) {
            prop_assert_eq!(one.points().len(), two.points().len());
            for (p, q) in one.points().iter().zip(two.points()) {
                prop_assert!((*p - *q).length() < 1e-9, "{:?} {:?}", p, q);
            }
        }
        Ok(())
    });
    held.unwrap();
}

/// Cracks that cannot form a network: two that cross, and two joined at both ends around a piece.
#[test]
fn no_network_does_not_grow() {
    let crossing = [crack(&[(-2.0, -4.0), (2.0, -4.0)]), crack(&[(0.0, -2.0), (0.0, -6.0)])];
    let arch =
        [crack(&[(-2.0, -5.0), (0.0, -5.0), (2.0, -5.0)]), crack(&[(0.0, -5.0), (1.0, -4.0), (2.0, -5.0)])];
    let end = |end| Junction { joining: CrackEnd { crack: 1, end }, onto: 0 };
    let loops = [end(End::First), end(End::Last)];
    for (cracks, junctions) in [(&crossing, &[][..]), (&arch, &loops[..])] {
        assert!(CrackNetwork::joined(cracks.to_vec(), junctions.to_vec()).is_err());
        let tips = [drive(0, End::First, 0, 0.0, 1e-6), drive(0, End::Last, 1, 0.0, 1e-6)];
        let next = advanced(&StepState { junctions, ..state(cracks, &tips) }, &SETTINGS);
        assert_eq!(next.cracks, cracks);
        assert_eq!(next.stop, Some(RunStop::NoTipGrows(TipStop::Coalescence)));
    }
}
