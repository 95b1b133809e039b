//! Growth of a front by the rates along it.
//!
//! The motion of a front that stays an ellipse is described by the speeds of its ends: down the dip
//! and to both sides, and up the dip where it is buried; that of a free front by the speeds of its
//! nodes. Of all motions without a retreating end or node, the one whose normal speed is closest to
//! the local rates in the mean square along the front is taken. The sides of the strip of a folded
//! crack move with the ends of its branch.

use super::body::FrontPoint;
use super::division::strip_side;
use super::free_front;
use crate::growth::{FrontMotion, FrontShape, Mover};
use crate::math::nonnegative;
use std::f64::consts::PI;

/// The speeds of the motions of a front (mm per cycle), or their increments (mm).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FrontSpeeds {
    motions: Vec<(FrontMotion, f64)>,
}

fn motions(shape: &FrontShape) -> Vec<FrontMotion> {
    const ALL: [FrontMotion; 4] = [FrontMotion::Down, FrontMotion::Plus, FrontMotion::Minus, FrontMotion::Up];
    if let Some(deviation) = &shape.deviation {
        return (0..free_front::moving_nodes(shape, deviation)).map(FrontMotion::Node).collect();
    }
    if shape.buried.is_some() { ALL.to_vec() } else { ALL[..3].to_vec() }
}

/// The normal speed of the front at φ under a unit speed of `motion`.
fn normal_speed(shape: &FrontShape, motion: FrontMotion, point: &FrontPoint) -> f64 {
    let [down, along] = point.normal;
    // The sides of a strip move as the ends of the branch.
    let phi = match strip_side(point.phi) {
        (side, _) if shape.is_on_strip(point.phi) => 0.5 * PI * (1.0 - side),
        _ => point.phi,
    };
    let (sin, cos) = phi.sin_cos();
    match motion {
        // The mouth of a surface-breaking crack stays where it is.
        FrontMotion::Down if shape.buried.is_none() => down * sin,
        FrontMotion::Down => 0.5 * down * (sin + 1.0),
        FrontMotion::Up => 0.5 * down * (sin - 1.0),
        FrontMotion::Plus => 0.5 * along * (cos + 1.0),
        FrontMotion::Minus => 0.5 * along * (cos - 1.0),
        FrontMotion::Node(node) => shape.deviation.as_ref().map_or(0.0, |deviation| {
            let outwards = shape.length * down * sin + shape.half_length * along * cos;
            let reach = free_front::normal_reach(shape, deviation, node);
            free_front::weight(shape, deviation, node, phi) * outwards / reach
        }),
    }
}

impl FrontSpeeds {
    /// The motion of `shape` nearest to `rates` (mm per cycle) at the points of its `front` that
    /// count.
    pub fn nearest(shape: &FrontShape, front: &[FrontPoint], rates: &[f64]) -> Self {
        let motions = motions(shape);
        let weights = arc_lengths(shape, front);
        let order = motions.len();
        let (mut normal, mut right) = (vec![vec![0.0; order]; order], vec![0.0; order]);
        let counted = front.iter().zip(rates).zip(weights).filter(|((point, _), _)| point.counts);
        for ((point, rate), weight) in counted {
            let speeds: Vec<f64> = motions.iter().map(|&motion| normal_speed(shape, motion, point)).collect();
            for (i, speed) in speeds.iter().enumerate() {
                crate::math::axpy(weight * speed, &speeds, &mut normal[i]);
                right[i] += weight * speed * rate;
            }
        }
        let speeds = nonnegative::minimum(&normal, &right);
        Self { motions: motions.into_iter().zip(speeds).collect() }
    }

    /// The speeds of `crack` (from 0) among `movers`, whose indices are the numbers of the motions.
    pub fn of_movers(shape: &FrontShape, crack: usize, movers: &[Mover]) -> Self {
        let speed = |index: usize| {
            movers.iter().find(|mover| (mover.crack, mover.index) == (crack, index)).map_or(0.0, |m| m.rate)
        };
        let motions = motions(shape).into_iter().enumerate();
        Self { motions: motions.map(|(index, motion)| (motion, speed(index))).collect() }
    }

    /// The speeds as movers of `crack` (from 0) of `length` (mm).
    pub fn movers(&self, crack: usize, length: f64) -> impl Iterator<Item = Mover> + '_ {
        let all = self.motions.iter().enumerate();
        all.map(move |(index, (_, rate))| Mover { crack, index, rate: *rate, length })
    }

    /// The same with every speed replaced by a function of the number of its motion and the speed.
    #[must_use]
    pub fn map(&self, of: impl Fn(usize, f64) -> f64) -> Self {
        let all = self.motions.iter().enumerate();
        Self { motions: all.map(|(index, (motion, speed))| (*motion, of(index, *speed))).collect() }
    }

    /// The fastest motion and its speed.
    pub fn fastest(&self) -> Option<(FrontMotion, f64)> {
        let moving = self.motions.iter().copied().filter(|(_, speed)| *speed > 0.0);
        moving.reduce(|a, b| if b.1 > a.1 { b } else { a })
    }

    /// The speed of `motion`.
    pub fn of(&self, motion: FrontMotion) -> f64 {
        self.motions.iter().find(|(other, _)| *other == motion).map_or(0.0, |(_, speed)| *speed)
    }

    /// The normal speed at a point of the front.
    pub fn at(&self, shape: &FrontShape, point: &FrontPoint) -> f64 {
        self.motions.iter().map(|(motion, speed)| speed * normal_speed(shape, *motion, point)).sum()
    }

    /// `shape` after these increments.
    pub fn moved(&self, shape: &FrontShape) -> FrontShape {
        if let Some(deviation) = &shape.deviation {
            let increments: Vec<f64> = self.motions.iter().map(|(_, increment)| *increment).collect();
            return free_front::moved(shape, deviation, &increments);
        }
        let by = |motion| self.of(motion);
        let (left, right) = (by(FrontMotion::Plus), by(FrontMotion::Minus));
        let (down, up) = (by(FrontMotion::Down), by(FrontMotion::Up));
        let [x, lateral, _] = shape.frame().position(0.0, 0.5 * (left - right));
        FrontShape {
            length: shape.length + if shape.buried.is_some() { 0.5 * (down + up) } else { down },
            half_length: shape.half_length + 0.5 * (left + right),
            middle: [shape.middle[0] + x, shape.middle[1] + lateral],
            buried: shape.buried.map(|centre| centre + 0.5 * (down - up)),
            ..*shape
        }
    }
}

/// The turn (radians, positive as a kink) of a crack of `shape` about the direction of its mouth
/// that is closest to the best kinks of its `front`, in the mean square over the area that grows
/// there, and the root mean square of what it leaves out. Points are given with their rates and
/// kinks; a turn by α kinks the front where its normal points down the crack, and twists it where
/// the normal points along the mouth. None where nothing grows.
pub(super) fn common_turn(
    shape: &FrontShape,
    front: &[FrontPoint],
    rates_and_kinks: &[(f64, Option<f64>)],
) -> Option<(f64, f64)> {
    let weights = arc_lengths(shape, front);
    let (mut own, mut with_kink, mut kinks, mut total) = (0.0, 0.0, 0.0, 0.0);
    for ((point, (rate, kink)), length) in front.iter().zip(rates_and_kinks).zip(weights) {
        let Some(kink) = kink.filter(|_| point.counts && !shape.is_on_strip(point.phi)) else { continue };
        let (weight, [down, _]) = (rate * length, point.normal);
        own += weight * down * down;
        with_kink += weight * down * kink;
        kinks += weight * kink * kink;
        total += weight;
    }
    (own > 0.0).then(|| (with_kink / own, ((kinks - with_kink * with_kink / own).max(0.0) / total).sqrt()))
}

/// The length of front that each point represents, mm.
fn arc_lengths(shape: &FrontShape, front: &[FrontPoint]) -> Vec<f64> {
    let distance = |a: &FrontPoint, b: &FrontPoint| {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|i| a.position[i] - b.position[i]);
        x.hypot(y).hypot(z)
    };
    let count = front.len();
    let neighbour = |from: usize, to: Option<usize>| to.map_or(0.0, |to| distance(&front[from], &front[to]));
    let is_closed = shape.buried.is_some();
    (0..count)
        .map(|i| {
            let before = if i > 0 { Some(i - 1) } else { is_closed.then_some(count - 1) };
            let after = if i + 1 < count { Some(i + 1) } else { is_closed.then_some(0) };
            0.5 * (neighbour(i, before) + neighbour(i, after))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::division::{VERTEX_LAYER, counts_on_strip, is_outside, phi_on_strip};

    fn shape(buried: Option<f64>) -> FrontShape {
        FrontShape {
            dip: 0.5,
            strike: 0.0,
            length: 3.0,
            half_length: 5.0,
            middle: [0.0, 1.0],
            buried,
            strip: None,
            turns: None,
            deviation: None,
        }
    }

    fn front(shape: &FrontShape, count: usize) -> Vec<FrontPoint> {
        let last = if shape.buried.is_some() { 2.0 * PI } else { PI };
        let step = last / if shape.buried.is_some() { count as f64 } else { count as f64 - 1.0 };
        let point = |i: usize| {
            let phi = step * i as f64;
            let (sin, cos) = phi.sin_cos();
            let normal = [sin / shape.length, cos / shape.half_length];
            let size = normal[0].hypot(normal[1]);
            FrontPoint {
                crack: 0,
                phi,
                position: [0.0, shape.half_length * cos, shape.length * sin],
                normal: normal.map(|n| n / size),
                counts: shape.buried.is_some() || is_outside(VERTEX_LAYER, phi),
            }
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn an_ellipse_that_grows_as_one_is_found() {
        for buried in [None, Some(10.0)] {
            let shape = shape(buried);
            let front = front(&shape, 17);
            let wanted =
                FrontSpeeds { motions: motions(&shape).into_iter().zip([1e-6, 3e-6, 2e-6, 5e-7]).collect() };
            let rates: Vec<f64> = front.iter().map(|point| wanted.at(&shape, point)).collect();
            let found = FrontSpeeds::nearest(&shape, &front, &rates);
            for &(motion, speed) in &wanted.motions {
                assert!((found.of(motion) - speed).abs() < 1e-16, "{motion:?} {found:?}");
            }
            assert_eq!(found.fastest().unwrap().0, FrontMotion::Plus);
            // Each end moves at its own speed.
            let increments = found.map(|_, speed| 1e6 * speed);
            let grown = increments.moved(&shape);
            let ends = |of: &FrontShape| {
                [
                    of.middle[1] + of.half_length,
                    of.middle[1] - of.half_length,
                    of.buried.unwrap_or(0.0) + of.length,
                ]
            };
            let by: Vec<f64> = ends(&grown).iter().zip(ends(&shape)).map(|(a, b)| a - b).collect();
            let turned = increments.moved(&FrontShape { strike: 0.5 * PI, ..shape });
            let [x, lateral] = [0, 1].map(|c| turned.middle[c] - shape.middle[c]);
            assert!((x + 0.5).abs() < 1e-9 && lateral.abs() < 1e-9, "ends move along the trace: {turned:?}");
            assert!((by[0] - 3.0).abs() < 1e-9 && (by[1] + 2.0).abs() < 1e-9 && (by[2] - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn the_sides_of_a_strip_move_with_the_ends_of_the_branch() {
        let shape = FrontShape { strip: Some(2.0), ..shape(None) };
        let side = |from_fold: f64| {
            let [plus, minus] = phi_on_strip(from_fold);
            let at = |phi: f64, zeta: f64| FrontPoint {
                crack: 0,
                phi,
                position: [0.0, zeta, -2.0 * from_fold],
                normal: [0.0, zeta.signum()],
                counts: counts_on_strip(phi),
            };
            [at(plus, 5.0), at(minus, -5.0)]
        };
        let sides: Vec<[FrontPoint; 2]> = (1..=10).map(|k| side(0.1 * f64::from(k))).collect();
        let before = sides.iter().rev().map(|pair| pair[0]);
        let all: Vec<FrontPoint> =
            before.chain(front(&shape, 17)).chain(sides.iter().map(|pair| pair[1])).collect();
        // The layers at the mouth and at the fold do not count.
        let counted: Vec<f64> =
            sides.iter().filter(|pair| pair[0].counts).map(|pair| pair[0].position[2]).collect();
        assert!(counted.len() == 5 && counted.iter().all(|z| *z < -0.5 && *z > -1.5), "{counted:?}");
        let wanted = FrontSpeeds { motions: motions(&shape).into_iter().zip([1e-6, 3e-6, 2e-6]).collect() };
        let rates: Vec<f64> = all.iter().map(|point| wanted.at(&shape, point)).collect();
        assert!((rates[0] - 3e-6).abs() < 1e-18 && (rates[all.len() - 1] - 2e-6).abs() < 1e-18);
        let found = FrontSpeeds::nearest(&shape, &all, &rates);
        for &(motion, speed) in &wanted.motions {
            assert!((found.of(motion) - speed).abs() < 1e-16, "{motion:?} {found:?}");
        }
        let grown = found.map(|_, speed| 1e6 * speed).moved(&shape);
        assert!((grown.path_length() - shape.path_length() - 1.0).abs() < 1e-9 && grown.strip == Some(2.0));
        // A fast side alone draws its end.
        let rates: Vec<f64> = all.iter().map(|point| if point.phi < 0.0 { 1e-6 } else { 0.0 }).collect();
        let found = FrontSpeeds::nearest(&shape, &all, &rates);
        let ends = [FrontMotion::Plus, FrontMotion::Minus].map(|motion| found.of(motion));
        assert!(ends[0] > 1e-7 && ends[1] < 0.2 * ends[0], "{found:?}");
    }

    #[test]
    fn no_end_retreats_and_the_layer_at_the_surface_does_not_count() {
        let shape = shape(None);
        let front = front(&shape, 33);
        let at = |rate: fn(f64) -> f64| front.iter().map(|point| rate(point.phi)).collect::<Vec<f64>>();
        // Fast on one side only.
        let found = FrontSpeeds::nearest(&shape, &front, &at(|phi| if phi < 0.5 * PI { 1e-6 } else { 0.0 }));
        assert!(found.motions.iter().all(|(_, speed)| *speed >= 0.0), "{found:?}");
        assert!(found.of(FrontMotion::Plus) > 1e-7 && found.of(FrontMotion::Minus) == 0.0, "{found:?}");
        let found = FrontSpeeds::nearest(&shape, &front, &at(|phi| if phi < 0.2 { 1.0 } else { 0.0 }));
        assert_eq!(found.fastest(), None);
    }
}
