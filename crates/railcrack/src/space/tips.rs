//! Rates along fronts: ranges of K in three modes, and what the direction criterion would like.

use super::body::{FrontPoint, FrontSif, SpaceBody};
use super::front_motion::counts;
use super::stabilised::StabilisedSpace;
use crate::crack::{CrackTip, End};
use crate::fatigue::{HourlierPineau, LargestK1, RUNAWAY, SifRanges};
use crate::fracture::{Sif, SifHistory};
use crate::growth::{
    DeferredGrowth, FrontShape, FrontTip, GrowthSettings, TipJudge, TipRecord, TipStop, WheelShares,
};
use crate::math::MPA_SQRT_MM;

/// How K along fronts becomes growth.
pub(super) struct FrontLaw<'a> {
    pub growth: &'a GrowthSettings,
    pub poisson: f64,
    pub mode_3_weight: Option<f64>,
    pub judge: Option<&'a dyn TipJudge>,
}

/// Fronts under their stabilised passage.
pub(super) struct FrontDrive {
    /// Their points.
    pub tips: Vec<TipRecord>,
    /// The rate of each, zero where it is slower than the arrest rate, mm per cycle.
    pub growing: Vec<f64>,
    /// Whether the rail breaks.
    pub breaks: bool,
}

impl FrontDrive {
    /// Of the cracks of `body` with these `shapes`, some of which have `stopped`.
    pub fn new(
        law: &FrontLaw,
        shapes: &[FrontShape],
        stopped: &[Option<TipStop>],
        body: &SpaceBody,
        passage: &StabilisedSpace,
    ) -> Self {
        let of = |(q, point): (usize, &FrontPoint)| {
            let first = body.cracks()[point.crack].front.start;
            let tip = CrackTip { crack: point.crack, tip: q - first, end: End::Last };
            law.tip(&shapes[point.crack], tip, point, |sifs| sifs[q], passage)
        };
        let tips: Vec<TipRecord> = body.front().iter().enumerate().map(of).collect();
        let stopped = |tip: &TipRecord| stopped[tip.tip.crack];
        let growing = tips
            .iter()
            .map(|tip| if tip.rate >= law.growth.arrest_rate { tip.rate.min(RUNAWAY) } else { 0.0 })
            .collect();
        // A front behind a spent ligament, or that has met another one, is no front any more.
        let is_front = |tip: &&TipRecord| {
            !matches!(stopped(tip), Some(TipStop::BreakOut | TipStop::Coalescence))
                && tip.front.is_some_and(|front| front.counts)
        };
        let breaks = tips.iter().filter(is_front).any(|tip| {
            let k1 = tip.largest_k1.map_or(0.0, |largest| largest.k1);
            tip.rate >= RUNAWAY || law.growth.toughness.is_some_and(|toughness| k1 >= toughness)
        });
        Self { tips, growing, breaks }
    }
}

impl FrontLaw<'_> {
    fn tip(
        &self,
        shape: &FrontShape,
        tip: CrackTip,
        point: &FrontPoint,
        of: impl Fn(&[FrontSif]) -> FrontSif,
        passage: &StabilisedSpace,
    ) -> TipRecord {
        let last = passage.passages.last();
        let samples = || {
            let output = last.into_iter().flat_map(|history| history.sifs.iter().map(|sifs| of(sifs)));
            // With the wheel away, before it comes and after it.
            last.map(|history| of(&history.before)).into_iter().chain([of(&passage.between)]).chain(output)
        };
        let history = SifHistory { samples: samples().map(|k| Sif { ki: k.ki, kii: k.kii }).collect() };
        let ranges = SifRanges::of(&history);
        let (low, high) = samples()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), k| (low.min(k.kiii), high.max(k.kiii)));
        let delta_kiii = (high - low).max(0.0);
        let modes = [ranges.delta_ki, ranges.delta_kii, delta_kiii];
        let delta_keq = self.growth.law.equivalent.of_three(modes, self.poisson, self.mode_3_weight);
        let rate = self.growth.law.rate.rate(delta_keq / MPA_SQRT_MM, ranges.load().ratio).min(RUNAWAY);
        let direction = HourlierPineau { law: self.growth.law.clone(), criterion: self.growth.criterion };
        let kink = direction.kink(&history);
        let ahead = self.growth.law.rate(ranges.load());
        let [x, lateral, depth] = point.position;
        let mut tip = TipRecord {
            tip,
            x,
            y: -depth,
            length: shape.depth,
            deferred: DeferredGrowth::default(),
            ki_max: ranges.ki_max,
            delta_ki: ranges.delta_ki,
            delta_kii: ranges.delta_kii,
            delta_keq,
            largest_k1: LargestK1::of(&history),
            // Growth is straight ahead.
            kink: (delta_keq > 0.0).then_some(0.0),
            secondary: None,
            secondary_ratio: None,
            increment: 0.0,
            rate,
            stop: None,
            shares: WheelShares::default(),
            turned_by: None,
            opened_by: 0,
            mouth_sine: shape.buried.is_none().then(|| shape.dip.sin()),
            front: Some(FrontTip {
                phi: point.phi,
                lateral,
                half_length: shape.half_length,
                delta_kiii,
                wanted_kink: kink.map(|kink| kink.angle),
                wanted_ratio: kink.filter(|_| ahead > 0.0).map(|kink| kink.rate / ahead),
                counts: counts(shape, point.phi),
                followed: None,
            }),
        };
        if let Some(judge) = self.judge {
            judge.judge(&history, &mut tip);
        }
        tip
    }
}
