//! Direction of growth under non-proportional loading.

use super::hull::convex_hull;
use super::kink_ranges::{KinkLoad, KinkRanges, tangential, vector_range};
use super::maxima::{Maximum, SAME_ANGLE, local_maxima, preferred};
use super::{DirectionCriterion, GrowthLaw, KINK_ANGLES};
use crate::fracture::{Sif, SifHistory};

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

#[cfg(test)]
#[path = "hourlier_pineau_tests.rs"]
mod tests;
