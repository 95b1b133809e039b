//! The turn of the path of a tip in a step, and how its best kink responds to a turn.

use super::step_state::TipDrive;
use crate::fatigue::{
    HourlierPineau, Kink, KinkFunctions, SECONDARY_DISTANCE, SifRanges, WheelHistory, convex_hull,
};
use crate::fracture::{Sif, SifHistory};
use crate::growth::{GrowthSettings, Jump, StepStart, TipCourse, Turning};

/// The turn of the path of a tip in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turned {
    /// Radians, counter-clockwise.
    pub angle: f64,
    /// The part of it that follows from this step and the previous one, without what was owed.
    pub predicted: f64,
    /// Why the path kinks, if it does.
    pub jump: Option<Jump>,
    /// The course after the step.
    pub course: TipCourse,
}

/// Largest change of the turn of a step by extrapolation, radians.
const LARGEST_CHANGE: f64 = 0.2;
/// Largest angle between the limit path and the chord of its crack, radians: below a right angle
/// each increment leads away from the other end, so that the path cannot run into itself.
const LARGEST_LEAN: f64 = 88.0 * std::f64::consts::PI / 180.0;
/// Turn (radians) of a step from which the limit path bends at once.
const LEAST_BEND: f64 = 10.0 * std::f64::consts::PI / 180.0;

impl Turned {
    /// The turn of `drive` over `increment` (mm); `None` for a tip without any loading.
    ///
    /// dθ/ds = κ = θ*/ℓ, where κ decays with the turn by λ = `kink_slope`/ℓ and changes along the
    /// path by a drift d: κ' = −λ κ + d. Over an increment h the path turns by h κ φ₁(λh) + h² d
    /// φ₂(λh). d is that of the previous step, which follows from κ at both ends of it; the
    /// difference between the turn of that step with d and the turn that was made is added.
    /// Without decay this is an Adams–Bashforth rule with the correction of the trapezoidal rule;
    /// with it, increments may be longer than ℓ.
    pub fn of(
        drive: &TipDrive,
        increment: f64,
        at: &StepStart<'_>,
        settings: &GrowthSettings,
    ) -> Option<Self> {
        let best = drive.kink?;
        let turning = settings.turning;
        if turning.is_kink() {
            return Some(Self { angle: best, predicted: best, jump: None, course: drive.course });
        }
        if turning.is_limit() {
            return Some(Self::on_limit_path(drive, increment, at, settings));
        }
        let curvature = turning.curvature(best);
        if drive.deferred.is_kinked {
            return Some(Self { angle: 0.0, predicted: 0.0, jump: None, course: drive.course });
        }
        if drive.jump.is_some() && curvature != 0.0 {
            return Some(Self {
                angle: best,
                predicted: best,
                jump: drive.jump,
                course: TipCourse::default(),
            });
        }
        let before = drive.course;
        let decay = if best == 0.0 { 0.0 } else { drive.kink_slope * curvature / best };
        let (drift, owed) = match before.span > 0.0 {
            true => before.corrected(curvature, decay),
            false => (0.0, 0.0),
        };
        // The best kink of the path itself, which the tip lacks by what it has not turned yet.
        let curvature = curvature - decay * owed;
        let z = decay * increment;
        let change = (increment * increment * drift * phi_2(z)).clamp(-LARGEST_CHANGE, LARGEST_CHANGE);
        let predicted = increment * curvature * phi_1(z) + change;
        let angle = predicted + owed;
        let course = TipCourse {
            curvature,
            decay,
            span: increment,
            balance: owed - angle,
            expected: Some(best - drive.kink_slope * angle),
        };
        Some(Self { angle, predicted, jump: None, course })
    }

    /// The turn of the limit path: the given one, or that of the previous step.
    fn on_limit_path(
        drive: &TipDrive,
        increment: f64,
        at: &StepStart<'_>,
        settings: &GrowthSettings,
    ) -> Self {
        let (crack, tip) = (drive.tip.crack, drive.tip.tip);
        let given = at.turns.iter().find(|turn| (turn.crack, turn.tip) == (crack, tip));
        let angle = given.map_or(drive.course.curvature * increment, |turn| turn.angle);
        let (least, most) = (-LARGEST_LEAN - drive.lean, LARGEST_LEAN - drive.lean);
        let angle = angle.clamp(least.min(0.0), most.max(0.0));
        let jump = match angle.abs() {
            angle if angle >= settings.kink_angle => Some(Jump::Kink),
            angle if angle >= LEAST_BEND => Some(Jump::Bend),
            _ => None,
        };
        let curvature = if jump.is_some() { 0.0 } else { angle / increment };
        let course = TipCourse { curvature, span: increment, ..TipCourse::default() };
        Self { angle, predicted: angle, jump, course }
    }
}

impl TipCourse {
    /// The drift of the step, and the turn that it lacks (radians), for the curvature at its end.
    fn corrected(&self, curvature: f64, decay: f64) -> (f64, f64) {
        let (h, z) = (self.span, self.decay * self.span);
        let drift = |end: f64| (end - self.curvature * (-z).exp()) / (h * phi_1(z));
        let lacks = |end: f64| self.balance + h * self.curvature * phi_1(z) + h * h * drift(end) * phi_2(z);
        // The curvature at the end was found at a tip that lacks this turn itself.
        let per_curvature = h * phi_2(z) / phi_1(z);
        let lack = lacks(curvature) / (1.0 + decay * per_curvature);
        (drift(curvature - decay * lack), lack)
    }
}

/// (1 − e^(−z))/z.
fn phi_1(z: f64) -> f64 {
    if z.abs() < 1e-4 { 1.0 - 0.5 * z } else { -(-z).exp_m1() / z }
}

/// (e^(−z) − 1 + z)/z².
fn phi_2(z: f64) -> f64 {
    if z.abs() < 1e-3 { 0.5 - z / 6.0 } else { ((-z).exp_m1() + z) / (z * z) }
}

/// How the best kink and the rate of a tip respond to a turn of its path: by virtual kinks of a
/// small angle.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TurnResponse {
    /// Relative change of the rate per radian of turn, as an absolute value.
    pub sensitivity: f64,
    /// Decrease of the best kink per radian of turn.
    pub kink_slope: f64,
}

/// The small angle, radians: about 1°, the spacing of the grid of kinks.
const TURN: f64 = 0.02;
/// Largest slope that is taken for one: beyond, the best kink jumps to another branch.
const LARGEST_SLOPE: f64 = 2.0;
/// Ratio of rates from which the direction on which the path went on is nearly as good as the best.
const RIVAL: f64 = 0.8;

impl TurnResponse {
    /// The response of a tip under `wheels` with the best kink `best` (radians).
    pub fn of(
        direction: &HourlierPineau,
        wheels: &[WheelHistory<'_>],
        best: Option<f64>,
        growth: &GrowthSettings,
    ) -> Self {
        let follows = matches!(growth.turning, Turning::Over(length) if length > 0.0 && length.is_finite());
        let Some(best) = best.filter(|_| follows) else { return Self::default() };
        let hulls: Vec<Vec<Sif>> = wheels
            .iter()
            .map(|wheel| match direction.kink_friction > 0.0 {
                true => wheel.history.samples.clone(),
                false => convex_hull(&wheel.history.samples),
            })
            .collect();
        let turned = |angle: f64| {
            let functions = KinkFunctions::at(angle);
            let histories: Vec<SifHistory> = hulls
                .iter()
                .map(|hull| SifHistory {
                    samples: hull
                        .iter()
                        .map(|k| functions.kinked(*k))
                        .map(|k| Sif { ki: k.k1, kii: k.k2 })
                        .collect(),
                })
                .collect();
            let under: Vec<WheelHistory<'_>> = wheels
                .iter()
                .zip(&histories)
                .map(|(wheel, history)| WheelHistory { share: wheel.share, history })
                .collect();
            let rate: f64 = under
                .iter()
                .map(|wheel| wheel.share * growth.law.rate(SifRanges::of(wheel.history).load()))
                .sum();
            (direction.kink_of_mix(&under).map_or(best, |kink| kink.angle), rate)
        };
        let ((left, left_rate), (right, right_rate)) = (turned(TURN), turned(-TURN));
        let slope = (right - left) / (2.0 * TURN);
        let mean = 0.5 * (left_rate + right_rate);
        let change = ((left_rate - right_rate) / (2.0 * TURN)).abs();
        Self {
            sensitivity: if mean > 0.0 && mean.is_finite() { change / mean } else { 0.0 },
            kink_slope: if slope.abs() < LARGEST_SLOPE { slope.max(0.0) } else { 0.0 },
        }
    }
}

/// Why a path kinks at a tip with the best kink `kink`, if it does.
pub(super) fn jump(kink: &Kink, course: &TipCourse, growth: &GrowthSettings) -> Option<Jump> {
    let follows = matches!(growth.turning, Turning::Over(length) if length > 0.0 && length.is_finite());
    if !follows {
        return None;
    }
    if kink.angle.abs() >= growth.kink_angle {
        return Some(Jump::Kink);
    }
    // The direction on which the path went on is still there, nearly as good as the best.
    let expected = course.expected?;
    let is_rival = kink.secondary.is_some_and(|other| {
        other.ratio >= RIVAL && (other.angle - expected).abs() < 0.5 * SECONDARY_DISTANCE
    });
    (is_rival && (kink.angle - expected).abs() >= SECONDARY_DISTANCE).then_some(Jump::Rival)
}

/// Directions that differ by less than this (radians) count as equal.
const TURNED: f64 = std::f64::consts::PI / 180.0;

/// The wheel (from 0) whose removal would change the kink from `angle` (radians) most; `None` where
/// no removal changes the direction by a degree.
pub(super) fn turned_by(direction: &HourlierPineau, wheels: &[WheelHistory], angle: f64) -> Option<usize> {
    let without = |i: usize| {
        let others: Vec<WheelHistory> =
            wheels.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, wheel)| *wheel).collect();
        let kink = if others.is_empty() { None } else { direction.kink_of_mix(&others) };
        (i, kink.map_or(0.0, |kink| (kink.angle - angle).abs()))
    };
    let turns = (0..wheels.len()).map(without).filter(|(_, turn)| *turn > TURNED);
    turns.reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(i, _)| i)
}

/// The histories of tip `tip` under each wheel.
pub(super) fn histories_of<'a>(
    tip: usize,
    shares: &[f64],
    histories: &'a [&'a [SifHistory]],
) -> Vec<WheelHistory<'a>> {
    let of = |(&share, all): (&f64, &&'a [SifHistory])| WheelHistory { share, history: &all[tip] };
    shares.iter().zip(histories).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fracture::Sif;
    use crate::growth::{Turning, WornSurface};
    use crate::plane::fixtures::tip;

    /// The direction after `length` mm in steps of `h`, where the best kink at s in direction θ is
    /// `best(s, θ)`, with slope −`slope` in θ.
    fn turned(length: f64, h: f64, turning: f64, slope: f64, best: impl Fn(f64, f64) -> f64) -> f64 {
        let settings = GrowthSettings { turning: Turning::Over(turning), ..GrowthSettings::default() };
        let worn = WornSurface::default();
        let (mut angle, mut course) = (0.0, TipCourse::default());
        let steps = (length / h).round() as usize;
        for i in 0..steps {
            let drive = TipDrive { course, kink_slope: slope, ..tip(0, best(i as f64 * h, angle), 1e-6) };
            let next = Turned::of(&drive, h, &StepStart::standing(&worn), &settings).unwrap();
            (angle, course) = (angle + next.angle, next.course);
        }
        angle
    }

    /// dθ/ds = θ₀/ℓ where the best kink does not change.
    #[test]
    fn a_constant_best_kink_turns_along_an_arc() {
        let angle = turned(1.0, 0.1, 0.5, 0.0, |_, _| -0.05);
        assert!((angle + 0.1).abs() < 1e-12, "{angle}");
    }

    /// Towards a fixed direction ψ: θ = ψ (1 − e^(−s/ℓ)), for steps of any length.
    #[test]
    fn a_fixed_direction_is_approached_exponentially() {
        for h in [0.01, 0.1, 0.5, 2.0] {
            let angle = turned(2.0, h, 0.5, 1.0, |_, angle| 0.2 - angle);
            assert!((angle - 0.2 * (1.0 - (-4.0f64).exp())).abs() < 1e-6, "{h}: {angle}");
        }
    }

    /// A direction that turns itself, ψ = s/5: θ = (s − ℓ (1 − e^(−s/ℓ)))/5.
    #[test]
    fn the_turn_is_of_second_order() {
        let exact = |s: f64| (s - 0.5 * (1.0 - (-2.0 * s).exp())) / 5.0;
        let nonlinear = |s: f64, angle: f64| (0.2 * s - angle).tanh() + 0.02 * (3.0 * s).sin();
        let reference = turned(2.0, 1e-4, 0.5, 1.0, nonlinear);
        let error = |h: f64| turned(2.0, h, 0.5, 1.0, nonlinear) - reference;
        let ratio = error(0.025) / error(0.0125);
        assert!(ratio > 3.0 && error(0.2).abs() < 1e-3, "{ratio} {}", error(0.2));
        let linear = turned(2.0, 0.05, 0.5, 1.0, |s, angle| 0.2 * s - angle);
        assert!((linear - exact(2.0)).abs() < 1e-3, "{linear} {}", exact(2.0));
    }

    #[test]
    fn beyond_the_kink_angle_the_path_kinks_at_once() {
        let settings = GrowthSettings::default();
        let worn = WornSurface::default();
        let drive = TipDrive { jump: Some(Jump::Kink), ..tip(0, -1.2, 1e-6) };
        let next = Turned::of(&drive, 0.1, &StepStart::standing(&worn), &settings).unwrap();
        assert_eq!((next.angle, next.jump), (-1.2, Some(Jump::Kink)));
    }

    #[test]
    fn a_weak_wheel_may_turn_the_crack() {
        let history = |samples: &[(f64, f64)]| SifHistory {
            samples: samples.iter().map(|&(ki, kii)| Sif { ki, kii }).collect(),
        };
        let direction = HourlierPineau::default();
        let (often, seldom) = (history(&[(0.0, 0.0), (100.0, 0.0)]), history(&[(0.0, 0.0), (0.0, 400.0)]));
        let wheels =
            [WheelHistory { share: 0.9, history: &often }, WheelHistory { share: 0.1, history: &seldom }];
        let angle = direction.kink_of_mix(&wheels).unwrap().angle;
        assert!(angle < -0.5, "{angle}");
        assert_eq!(turned_by(&direction, &wheels, angle), Some(1));
    }
}
