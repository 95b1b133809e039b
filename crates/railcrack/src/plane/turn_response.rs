//! How the best kink and the rate of a tip respond to a turn of its path.

use crate::fatigue::{
    HourlierPineau, Kink, KinkFunctions, SECONDARY_DISTANCE, SifRanges, WheelHistory, convex_hull,
};
use crate::fracture::{Sif, SifHistory};
use crate::growth::{GrowthSettings, Jump, TipCourse, Turning};

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
