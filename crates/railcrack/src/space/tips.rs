//! Growth rates along fronts: ranges of K in three modes, and the kink that the direction criterion
//! would choose.

use super::body::{FrontPoint, SpaceBody};
use crate::crack::{CrackTip, End};
use crate::fatigue::{HourlierPineau, LargestK1, LoadRange, SifRanges, WheelHistory};
use crate::growth::{
    FrontShape, FrontTip, GrowthSettings, MixedTip, StabilisedPassage, TipGeometry, TipRecord, WheelDemand,
    WheelOfRail,
};
use crate::math::Vec2;

/// Settings that turn K along fronts into growth.
pub(super) struct FrontLaw<'a> {
    pub growth: &'a GrowthSettings,
    pub poisson: f64,
    pub mode_3_weight: Option<f64>,
}

impl FrontLaw<'_> {
    /// State and loading of every front point of `body`, whose cracks have the shapes `shapes`,
    /// under the passages of all `wheels`.
    pub fn tips(
        &self,
        shapes: &[FrontShape],
        body: &SpaceBody,
        wheels: &[WheelOfRail],
        passages: &[StabilisedPassage],
    ) -> Vec<TipRecord> {
        let of = |(q, point): (usize, &FrontPoint)| {
            let first = body.cracks()[point.crack].front.start;
            let tip = CrackTip { crack: point.crack, tip: q - first, end: End::Last };
            self.tip(&shapes[point.crack], tip, (body, q), wheels, passages)
        };
        body.front().iter().enumerate().map(of).collect()
    }

    /// The record of point `q` of all fronts.
    fn tip(
        &self,
        shape: &FrontShape,
        tip: CrackTip,
        (body, q): (&SpaceBody, usize),
        wheels: &[WheelOfRail],
        passages: &[StabilisedPassage],
    ) -> TipRecord {
        let point = &body.front()[q];
        let demands: Vec<WheelDemand> = passages.iter().map(|passage| self.demand(passage, q)).collect();
        let under = MixedTip::of(&demands, wheels);
        let histories: Vec<WheelHistory> = passages
            .iter()
            .zip(wheels)
            .map(|(passage, wheel)| WheelHistory { share: wheel.share, history: &passage.histories[q] })
            .collect();
        let direction = HourlierPineau {
            law: self.growth.law.clone(),
            criterion: self.growth.criterion,
            kink_friction: self.growth.kink_friction,
        };
        let kink = direction.kink_of_mix(&histories);
        let straight = |(demand, wheel): (&WheelDemand, &WheelOfRail)| {
            let rate = self.growth.law.rate(demand.ranges.load());
            if demands.len() == 1 { rate } else { wheel.share * rate }
        };
        let ahead: f64 = demands.iter().zip(wheels).map(straight).sum();
        let [x, lateral, depth] = point.position;
        let front = FrontTip {
            phi: point.phi,
            lateral,
            half_length: shape.half_length,
            strip: shape.strip,
            deviation: shape.deviation.map(|own| {
                if shape.is_on_strip(point.phi) { 0.0 } else { own.radius_factor(point.phi) - 1.0 }
            }),
            delta_kiii: passages[under.grown_by].delta_kiii[q],
            wanted_kink: kink.map(|kink| kink.angle),
            wanted_ratio: kink.filter(|_| ahead > 0.0).map(|kink| kink.rate / ahead),
            counts: point.counts,
            turn: None,
            down: body.cracks()[point.crack].coordinates(point.position)[0],
            followed: None,
        };
        let at = Vec2::new(x, -depth);
        TipRecord {
            // The rate is that straight ahead.
            kink: (under.delta_keq > 0.0).then_some(0.0),
            mouth_sine: shape.mouth_sine(),
            ..under.record(tip, at, shape.path_length(), TipGeometry::Space(front))
        }
    }

    /// The loading of point `q` of all fronts in the passage of one wheel.
    fn demand(&self, passage: &StabilisedPassage, q: usize) -> WheelDemand {
        let law = &self.growth.law;
        let ranges = SifRanges::of(&passage.histories[q]);
        let modes = [ranges.delta_ki, ranges.delta_kii, passage.delta_kiii[q]];
        let of_all = law.equivalent.of_three(modes, self.poisson, self.mode_3_weight);
        let load = LoadRange { delta_kii: modes[1].hypot(modes[2]), ..ranges.load() };
        WheelDemand {
            ranges,
            delta_keq: law.driving_range(of_all, load),
            rate: law.rate_of(of_all, load),
            largest_k1: LargestK1::of(&passage.histories[q]),
        }
    }
}
