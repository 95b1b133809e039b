//! A mix of wheels: their passages over one body and their shares of the growth.

use super::{GrowthError, Observer, TipGeometry, TipRecord, Warning, WheelOfRail, WheelShares};
use crate::crack::CrackTip;
use crate::fatigue::{LargestK1, RUNAWAY, SifRanges};
use crate::math::Vec2;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Loading of a tip by one wheel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WheelDemand {
    pub ranges: SifRanges,
    /// ΔK_eq, MPa √mm.
    pub delta_keq: f64,
    /// da/dN of a passage of this wheel, mm.
    pub rate: f64,
    pub largest_k1: Option<LargestK1>,
}

/// A tip under all wheels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MixedTip {
    /// Ranges under the wheel that contributes most to the growth; the largest K_I is that of all
    /// wheels.
    pub ranges: SifRanges,
    /// ΔK_eq under that wheel, MPa √mm.
    pub delta_keq: f64,
    /// The wheel that contributes most to the growth, from 0.
    pub grown_by: usize,
    /// Σ s_i r_i, mm per axle.
    pub rate: f64,
    pub shares: WheelShares,
    /// The k1 that is largest relative to the toughness, and the wheel (from 0) that causes it.
    pub largest_k1: Option<LargestK1>,
    pub opened_by: usize,
    /// K_Ic under that wheel over K_Ic under the first one; 1 where fracture is not considered.
    pub toughness_ratio: f64,
}

impl MixedTip {
    /// The tip under the loading by each of `wheels`.
    pub fn of(demands: &[WheelDemand], wheels: &[WheelOfRail<'_>]) -> Self {
        let rate = |(demand, wheel): (&WheelDemand, &WheelOfRail)| {
            let rate = demand.rate.min(RUNAWAY);
            if demands.len() == 1 || rate >= RUNAWAY { rate } else { wheel.share * rate }
        };
        let rates: Vec<f64> = demands.iter().zip(wheels).map(rate).collect();
        let driven = |i: usize| (rates[i], demands[i].delta_keq);
        let most = (0..demands.len()).reduce(|a, b| if driven(b) > driven(a) { b } else { a }).unwrap_or(0);
        let opened = demands.iter().enumerate().filter_map(|(i, demand)| Some((i, demand.largest_k1?)));
        let danger = |(i, largest): &(usize, LargestK1)| {
            largest.k1 / wheels.get(*i).and_then(|wheel| wheel.toughness).unwrap_or(1.0)
        };
        let opened = opened.reduce(|a, b| if danger(&b) > danger(&a) { b } else { a });
        let opened_by = opened.map_or(0, |(wheel, _)| wheel);
        let toughness = |wheel: usize| wheels.get(wheel).and_then(|wheel| wheel.toughness);
        let both = toughness(opened_by).zip(toughness(0)).filter(|_| opened_by > 0);
        let ki_max = demands.iter().map(|demand| demand.ranges.ki_max).fold(f64::NEG_INFINITY, f64::max);
        Self {
            ranges: SifRanges { ki_max, ..demands[most].ranges },
            delta_keq: demands[most].delta_keq,
            grown_by: most,
            rate: rates.iter().sum::<f64>().min(RUNAWAY),
            shares: if demands.len() > 1 { WheelShares::of(&rates) } else { WheelShares::default() },
            largest_k1: opened.map(|(_, largest)| largest),
            opened_by,
            toughness_ratio: both.map_or(1.0, |(own, first)| own / first),
        }
    }

    /// The record of this tip at `at` (mm), of a crack of `length` (mm), without a direction and an
    /// increment.
    pub fn record(&self, tip: CrackTip, at: Vec2, length: f64, geometry: TipGeometry) -> TipRecord {
        let SifRanges { ki_max, delta_ki, delta_kii, .. } = self.ranges;
        TipRecord {
            tip,
            x: at.x,
            y: at.y,
            length,
            ki_max,
            delta_ki,
            delta_kii,
            delta_keq: self.delta_keq,
            largest_k1: self.largest_k1,
            kink: None,
            increment: 0.0,
            rate: self.rate,
            stop: None,
            shares: self.shares,
            opened_by: self.opened_by,
            toughness_ratio: self.toughness_ratio,
            mouth_sine: None,
            geometry,
        }
    }
}

/// An observer that passes on interruptions but no progress: the progress of the first wheel
/// represents all of them.
pub(crate) struct WithoutProgress<'a>(pub &'a dyn Observer);

impl Observer for WithoutProgress<'_> {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

/// The passages of `count` wheels over the same body, one after the other or in parallel: the
/// wheels are independent of each other. `passage` takes the index of a wheel, from 0.
///
/// Errors: those of `passage`; if several wheels fail, that of the first one.
pub(crate) fn under_each_wheel<P: Send>(
    count: usize,
    observer: &dyn Observer,
    warnings: &mut Vec<Warning>,
    passage: impl Fn(usize, &dyn Observer, &mut Vec<Warning>) -> Result<P, GrowthError> + Sync,
) -> Result<Vec<P>, GrowthError> {
    if count == 1 {
        return Ok(vec![passage(0, observer, warnings)?]);
    }
    let quiet = WithoutProgress(observer);
    let of_wheel = |wheel: usize| {
        let mut own = Vec::new();
        let observer = if wheel == 0 { observer } else { &quiet };
        let passage = passage(wheel, observer, &mut own);
        (passage, own.into_iter().map(|warning| warning.under_wheel(wheel)).collect::<Vec<_>>())
    };
    let all: Vec<_> = (0..count).into_par_iter().map(of_wheel).collect();
    let mut passages = Vec::with_capacity(all.len());
    for (passage, own) in all {
        warnings.extend(own);
        passages.push(passage?);
    }
    Ok(passages)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fatigue::GrowthLaw;
    use crate::fracture::{Sif, SifHistory};
    use crate::growth::PassageSettings;

    fn demand(law: &GrowthLaw, samples: &[(f64, f64)]) -> WheelDemand {
        let history = SifHistory { samples: samples.iter().map(|&(ki, kii)| Sif { ki, kii }).collect() };
        let ranges = SifRanges::of(&history);
        WheelDemand {
            ranges,
            delta_keq: law.driven_by(ranges.load()),
            rate: law.rate(ranges.load()),
            largest_k1: LargestK1::of(&history),
        }
    }

    #[test]
    fn rates_add_by_share_and_a_cold_rail_breaks_first() {
        let law = GrowthLaw::RAIL_STEEL;
        let demands = [demand(&law, &[(0.0, 0.0), (100.0, 0.0)]), demand(&law, &[(0.0, 0.0), (0.0, 400.0)])];
        let passages = PassageSettings::default();
        let wheel = |share, toughness| WheelOfRail { share, toughness, passages: &passages };
        let tip = MixedTip::of(&demands, &[wheel(0.9, None), wheel(0.1, None)]);
        let want = [0.9 * demands[0].rate, 0.1 * demands[1].rate];
        assert_eq!(tip.rate, want[0] + want[1]);
        assert_eq!(tip.shares.values(), [want[0] / tip.rate, want[1] / tip.rate]);
        assert!(tip.shares.values()[1] > 0.8 && tip.grown_by == 1);
        assert!(tip.ranges.delta_kii == 400.0 && tip.ranges.ki_max == 100.0);
        // A cold rail fractures first under the wheel that passes at the low temperature.
        let cold = MixedTip::of(&demands, &[wheel(0.9, Some(100.0)), wheel(0.1, Some(1000.0))]);
        assert_eq!((cold.opened_by, cold.largest_k1.unwrap().k1), (0, 100.0));
        let warm = MixedTip::of(&demands, &[wheel(0.9, Some(1000.0)), wheel(0.1, Some(200.0))]);
        assert_eq!((warm.opened_by, warm.toughness_ratio), (1, 0.2));
    }
}
