//! Direction of growth under non-proportional loading, by Hourlier and Pineau.

use super::GrowthLaw;
use super::kink::{KinkLoad, KinkRanges, convex_hull, tangential, vector_range};
use crate::fracture::{Sif, SifHistory};
use crate::math::{Ties, golden_section};
use crate::words::{Choice, Word};
use std::ops::RangeInclusive;

/// The criterion of Hourlier & Pineau: the crack kinks by the angle β that maximises the growth
/// rate of the virtual kink over the passage, from the ranges of k1(β, t), clipped at zero (a
/// closed kink does not open negatively), and k2(β, t). The other criteria maximise other
/// quantities by the same procedure.
///
/// Source: Hourlier & Pineau 1982, Fatigue Eng. Mater. Struct. 5, 287–302; Trollé et al. 2014,
/// section 4.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HourlierPineau {
    /// The growth law that weights the two modes.
    pub law: GrowthLaw,
    /// The quantity that is maximised.
    pub criterion: DirectionCriterion,
    /// Friction coefficient of the faces of the virtual kink.
    pub kink_friction: f64,
}

/// The chosen virtual kink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// β, radians, counter-clockwise positive from straight ahead.
    pub angle: f64,
    /// Growth rate of the virtual kink, mm per cycle; the mean over the axles of a mix.
    pub rate: f64,
    /// Δk1 of the virtual kink, k1 clipped at zero, MPa √mm; in a mix, of the wheel that
    /// contributes most to the rate.
    pub delta_k1: f64,
    /// Δk2 of the virtual kink, MPa √mm; in a mix, of the same wheel.
    pub delta_k2: f64,
    /// The largest secondary maximum, if any.
    pub secondary: Option<SecondaryMaximum>,
}

/// A secondary maximum of the criterion, at least 15° from the chosen one. An end of the searched
/// range does not count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondaryMaximum {
    /// β, radians.
    pub angle: f64,
    /// Its value over the largest one: of the growth rate (under one wheel without threshold) for
    /// [`DirectionCriterion::MaxRate`], of the quantity itself for the others.
    pub ratio: f64,
}

/// The history of a tip under one wheel of a mix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WheelHistory<'a> {
    /// Share of the axles.
    pub share: f64,
    /// K through the stabilised passage of this wheel.
    pub history: &'a SifHistory,
}

/// Smallest distance of a secondary maximum from the chosen direction, radians.
pub(crate) const SECONDARY_DISTANCE: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Relative difference below which two maxima are tied, so that round-off of the history does not
/// decide between them.
const TIE: f64 = 1e-9;

/// The shares of the axles and the samples of each wheel that decide: the corners of its history,
/// or with friction all of it.
type SamplesByWheel = [(f64, Vec<Sif>)];

impl HourlierPineau {
    /// The kink for one passage of `history`. None if nothing drives a kink: for no samples,
    /// samples that are all zero or not finite, or, with a criterion on k1, a kink that never opens
    /// in any direction.
    ///
    /// β is searched in [`KINK_ANGLES`] on a grid of 1°; every local maximum is refined by golden
    /// section, and an end of the range can be chosen. Ties go to the smaller |β|, then to the
    /// positive (counter-clockwise) one; apart from this last rule, a history with K_II reversed
    /// gives exactly the opposite angle.
    #[must_use]
    pub fn kink(&self, history: &SifHistory) -> Option<Kink> {
        self.kink_of_mix(&[WheelHistory { share: 1.0, history }])
    }

    /// The kink under a mix of wheels: the direction maximises Σ s_i r_i(β), the sum of the rates
    /// under each wheel by its share of the axles, each with its own threshold. If no direction has
    /// a rate above zero, the search is repeated without thresholds. Ranges of k1 and of the
    /// displacement add like rates; for the largest k1 and the largest tangential stress, the
    /// maximum over all wheels counts.
    ///
    /// A single wheel is [`HourlierPineau::kink`].
    #[must_use]
    pub(crate) fn kink_of_mix(&self, wheels: &[WheelHistory]) -> Option<Kink> {
        let samples = || wheels.iter().flat_map(|wheel| &wheel.history.samples);
        if !samples().all(|k| k.ki.is_finite() && k.kii.is_finite()) {
            return None;
        }
        let loads: Vec<(f64, Vec<Sif>)> =
            wheels.iter().map(|wheel| (wheel.share, self.deciding(&wheel.history.samples))).collect();
        let (maxima, quantity) = match &loads[..] {
            [_] => (self.maxima(&loads, Quantity::Drive), Quantity::Drive),
            _ => {
                let with_thresholds = self.maxima(&loads, Quantity::Rate);
                if with_thresholds.iter().any(|m| m.value > 0.0) {
                    (with_thresholds, Quantity::Rate)
                } else {
                    (self.maxima(&loads, Quantity::Drive), Quantity::Drive)
                }
            }
        };
        let top = maxima.iter().fold(0.0_f64, |top, m| top.max(m.value));
        if top <= 0.0 {
            return None;
        }
        let best = maxima.iter().filter(|m| m.value >= top * (1.0 - TIE)).copied().reduce(preferred)?;
        let secondary = maxima
            .iter()
            .filter(|m| (m.angle - best.angle).abs() >= SECONDARY_DISTANCE && m.value > 0.0)
            .filter(|m| m.angle.abs() < KINK_ANGLES.end() - SAME_ANGLE)
            .copied()
            .reduce(|a, b| if b.value > a.value * (1.0 + TIE) { b } else { a })
            .map(|m| SecondaryMaximum { angle: m.angle, ratio: self.ratio(quantity, m.value, best.value) });
        let of = |(share, samples): &(f64, Vec<Sif>)| {
            let ranges = KinkRanges::of(self.load(samples), best.angle);
            (share * self.law.rate(ranges.clipped()), ranges)
        };
        let each: Vec<(f64, KinkRanges)> = loads.iter().map(of).collect();
        let (_, most) = each.iter().copied().reduce(|a, b| if b.0 > a.0 { b } else { a })?;
        Some(Kink {
            angle: best.angle,
            rate: each.iter().map(|(rate, _)| rate).sum(),
            delta_k1: most.delta_k1,
            delta_k2: most.delta_k2,
            secondary,
        })
    }

    /// The samples on which ranges at a kink depend.
    fn deciding(&self, samples: &[Sif]) -> Vec<Sif> {
        if self.kink_friction > 0.0 { samples.to_vec() } else { convex_hull(samples) }
    }

    fn load<'a>(&self, samples: &'a [Sif]) -> KinkLoad<'a> {
        KinkLoad { samples, friction: self.kink_friction }
    }

    fn maxima(&self, loads: &SamplesByWheel, quantity: Quantity) -> Vec<Maximum> {
        if self.criterion == DirectionCriterion::Coplanar {
            return vec![Maximum { angle: 0.0, value: self.value(loads, Quantity::Drive, 0.0) }];
        }
        local_maxima(|angle| self.value(loads, quantity, angle))
    }

    /// The criterion at `angle`. Under one wheel the rate is represented by ΔK_eq, which increases
    /// with the rate and is not flattened by a threshold.
    fn value(&self, loads: &SamplesByWheel, quantity: Quantity, angle: f64) -> f64 {
        let sum = |of: &dyn Fn(&[Sif]) -> f64| match loads {
            [(_, only)] => of(only),
            _ => loads.iter().map(|(share, extremes)| share * of(extremes)).sum(),
        };
        let largest = |of: &dyn Fn(&[Sif]) -> f64| loads.iter().map(|(_, e)| of(e)).fold(0.0, f64::max);
        let driven = |range| match quantity {
            Quantity::Drive => self.law.drive(range),
            Quantity::Rate => self.law.rate(range),
        };
        match self.criterion {
            DirectionCriterion::MaxRate | DirectionCriterion::Coplanar => {
                sum(&|extremes| driven(KinkRanges::of(self.load(extremes), angle).clipped()))
            }
            DirectionCriterion::MaxRateUnclipped => {
                sum(&|extremes| driven(KinkRanges::of(self.load(extremes), angle).unclipped()))
            }
            DirectionCriterion::MaxDeltaK1 => {
                sum(&|extremes| KinkRanges::of(self.load(extremes), angle).delta_k1)
            }
            DirectionCriterion::MaxK1 => {
                largest(&|extremes| KinkRanges::of(self.load(extremes), angle).k1_max)
            }
            DirectionCriterion::MaxTangentialStress => largest(&|extremes| tangential(extremes, angle)),
            DirectionCriterion::MaxDeltaCtd => sum(&|extremes| vector_range(self.load(extremes), angle)),
        }
    }

    fn ratio(&self, quantity: Quantity, value: f64, best: f64) -> f64 {
        match (self.criterion, quantity) {
            (DirectionCriterion::MaxRate | DirectionCriterion::MaxRateUnclipped, Quantity::Drive) => {
                self.law.rate.ratio(value, best)
            }
            _ if value.is_finite() => value / best,
            _ => 1.0,
        }
    }
}

/// The quantity that represents a rate in the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    /// ΔK_eq, which no threshold flattens.
    Drive,
    /// The rate itself, because the rates under several wheels are added.
    Rate,
}

/// A local maximum.
#[derive(Debug, Clone, Copy)]
pub(super) struct Maximum {
    /// β, radians.
    pub angle: f64,
    pub value: f64,
}

/// Step of the coarse search, radians: the kink functions change by 2 % over it.
const GRID_STEP: f64 = std::f64::consts::PI / 180.0;
/// Golden sections of two steps: 2° · 0.618^36 = 1e-9 rad, below which the top of a smooth maximum
/// is flat in double precision.
const SECTIONS: usize = 36;
/// Difference (radians) below which two angles are equally far from straight ahead; the resolution
/// of a maximum in double precision.
pub(super) const SAME_ANGLE: f64 = 1e-6;

/// All local maxima of `value` in [`KINK_ANGLES`], ends included: found on a grid of 1° and refined
/// by golden section.
pub(super) fn local_maxima(value: impl Fn(f64) -> f64) -> Vec<Maximum> {
    let half = (KINK_ANGLES.end() / GRID_STEP).round() as i32;
    let angle = |i: i32| f64::from(i) * GRID_STEP;
    let values: Vec<f64> = (-half..=half).map(|i| value(angle(i))).collect();
    let last = values.len() - 1;
    let mut maxima = Vec::new();
    for (i, here) in (-half..=half).enumerate() {
        let not_below = |j: usize| values[i] >= values[j];
        if (i > 0 && !not_below(i - 1)) || (i < last && !not_below(i + 1)) {
            continue;
        }
        let (from, to) = (angle((here - 1).max(-half)), angle((here + 1).min(half)));
        let refined = golden_section([from, to], SECTIONS, Ties::Middle, &value);
        let refined = vertex(Maximum { angle: refined, value: value(refined) }, (from, to), &value);
        // At an end of the range the grid point itself may be the maximum, as on a plateau.
        let on_grid = Maximum { angle: angle(here), value: values[i] };
        maxima.push(if refined.value > on_grid.value { refined } else { on_grid });
    }
    maxima
}

/// The preferred one of two tied maxima.
pub(super) fn preferred(a: Maximum, b: Maximum) -> Maximum {
    let difference = a.angle.abs() - b.angle.abs();
    if difference.abs() > SAME_ANGLE {
        return if difference < 0.0 { a } else { b };
    }
    if a.angle > b.angle { a } else { b }
}

/// The maximum at `rough`, refined where the function is smooth there: the vertex of the parabola
/// through three points. Comparing values leaves an angle uncertain by the square root of
/// round-off, about 1e-8; the parabola by about 1e-11, so that histories that differ by round-off
/// give angles that differ by little more.
fn vertex(rough: Maximum, (from, to): (f64, f64), value: impl Fn(f64) -> f64) -> Maximum {
    const SPACING: f64 = 2e-4;
    let at = |step: f64| value(rough.angle + step * SPACING);
    let curvature = |left: f64, middle: f64, right: f64| left - 2.0 * middle + right;
    let [far_left, left, middle, right, far_right] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(at);
    let (near, wide) = (curvature(left, middle, right), 0.25 * curvature(far_left, middle, far_right));
    // At a corner of the function the second difference is the jump of the slope: it halves with
    // twice the spacing.
    let smooth = near < 0.0 && (wide - near).abs() < 0.2 * near.abs();
    let angle = rough.angle + 0.5 * SPACING * (left - right) / near;
    if !smooth || (angle - rough.angle).abs() > SPACING || angle < from || angle > to {
        return rough;
    }
    Maximum { angle, value: value(angle).max(rough.value) }
}

/// The quantity that the direction of growth maximises over the kink angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DirectionCriterion {
    /// The growth rate of the virtual kink, from the ranges of k1 and k2 (Hourlier & Pineau).
    #[default]
    MaxRate,
    /// The same with negative k1 counted as if a closed kink opened negatively: for comparison,
    /// since not every description of the criterion states that k1 is clipped.
    MaxRateUnclipped,
    /// The range of k1.
    MaxDeltaK1,
    /// The largest k1.
    MaxK1,
    /// No quantity: the crack grows straight ahead.
    Coplanar,
    /// The largest tangential stress ahead of the actual tip over the passage. Source: Erdogan &
    /// Sih 1963, J. Basic Eng. 85, 519–525.
    MaxTangentialStress,
    /// The range of the displacement vector of the faces at the tip of the virtual kink: the
    /// largest
    /// distance between two of its values (k1, k2) through the passage, k1 clipped at zero. After
    /// Li
    /// 1989, Fatigue Fract. Eng. Mater. Struct. 12, 59–65, and Salahi Nezhad et al. 2024, with the
    /// elastic displacement of a kink.
    MaxDeltaCtd,
}

impl Choice for DirectionCriterion {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::MaxRate, Word::now("max-rate", "the largest growth rate of the kink (Hourlier-Pineau)")),
        (
            Self::MaxRateUnclipped,
            Word::now("max-rate-unclipped", "the same, with negative k1 kept where max-rate takes zero"),
        ),
        (Self::MaxDeltaK1, Word::now("max-delta-k1", "the largest range of k1")),
        (Self::MaxK1, Word::now("max-k1", "the largest k1")),
        (Self::Coplanar, Word::now("coplanar", "straight ahead")),
        (Self::MaxTangentialStress, Word::now("mts", "the largest tangential stress ahead of the tip")),
        (
            Self::MaxDeltaCtd,
            Word::now("max-delta-ctd", "the largest range of the displacement vector at the tip of the kink"),
        ),
    ];
}

/// Range of kink angles that is searched, radians: the kink functions are accurate to about ±110°.
pub const KINK_ANGLES: RangeInclusive<f64> =
    -110.0 * std::f64::consts::PI / 180.0..=110.0 * std::f64::consts::PI / 180.0;

#[cfg(test)]
#[path = "hourlier_pineau_tests.rs"]
mod tests;
