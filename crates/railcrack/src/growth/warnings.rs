//! Warnings of a step, derived from its tips and passages.

use super::{
    GrowthSettings, GrowthState, Overlap, StabilisedPassage, TipGeometry, TipRecord, Warning, WarningKind,
    WheelOfRail,
};
use crate::math::MPA_SQRT_MM;

/// Estimated error of K in groups, relative to its peak, above which every step issues a warning.
const LARGE_GROUPS_ERROR: f64 = 0.01;

/// Ratio of a rival kink's rate to the best rate above which the two count as a near tie.
pub const NEAR_TIE: f64 = 0.98;

/// The step to which the warnings apply.
pub(super) struct Warnings<'a> {
    pub step: usize,
    /// The engine settings that would resolve K better.
    pub refinement: &'static str,
    pub wheels: &'a [WheelOfRail<'a>],
    pub growth: &'a GrowthSettings,
}

impl Warnings<'_> {
    /// The warnings on `tips`, whose states before the step are in `state`, under the passages of
    /// all wheels.
    pub fn of(
        &self,
        state: &GrowthState,
        tips: &[TipRecord],
        passages: &[StabilisedPassage],
    ) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = tips.iter().filter_map(|tip| self.near_tie(state, tip)).collect();
        warnings.extend(tips.iter().filter_map(|tip| self.may_branch(state, tip)));
        for (wheel, passage) in passages.iter().enumerate() {
            let [overlap, of_own] = self.overlaps(tips, passage);
            let own = [self.unrepeated(passage), self.coupled(passage), overlap, of_own];
            let named = |warning: Warning| {
                if passages.len() > 1 { warning.under_wheel(wheel) } else { warning }
            };
            warnings.extend(own.into_iter().flatten().map(named));
        }
        warnings
    }

    fn warning(&self, kind: WarningKind, severity: f64, text: String) -> Warning {
        Warning { step: self.step, kind, text, severity: Some(severity) }
    }

    fn near_tie(&self, state: &GrowthState, tip: &TipRecord) -> Option<Warning> {
        let (kink, plane) = (tip.kink?, tip.plane()?);
        let (secondary, ratio) = (plane.secondary?, plane.secondary_ratio?);
        if ratio <= NEAR_TIE || state.geometry.has_stopped(tip.tip) {
            return None;
        }
        let text = format!(
            "{}: kinks of {:.1} and {:.1} degrees are nearly as good, ratio {ratio:.4}; the path is sensitive to this choice",
            place(tip),
            kink.to_degrees(),
            secondary.to_degrees()
        );
        Some(self.warning(WarningKind::NearTie, ratio, text))
    }

    /// A tip that the threshold of ΔK_II holds may branch: its kinks open.
    fn may_branch(&self, state: &GrowthState, tip: &TipRecord) -> Option<Warning> {
        let law = &self.growth.law;
        let least = self.growth.arrest_rate.max(f64::MIN_POSITIVE);
        let threshold = law.rate.threshold().unwrap_or(0.0);
        let largest = tip.largest_k1.filter(|largest| largest.k1_mpa_sqrt_m() > threshold)?;
        let all = law.equivalent_range(tip.delta_ki, tip.delta_kii).max(tip.delta_keq);
        let is_held =
            law.threshold_2 > 0.0 && tip.rate < least && law.rate.rate(all / MPA_SQRT_MM, 0.0) >= least;
        let text = || {
            format!(
                "{}: the threshold of \u{394}K_II holds it, but a kink of {:.0} degrees opens with k1 = {:.1} MPa\u{221a}m: it may \
                 branch there, which the run leaves out",
                place(tip),
                largest.angle.to_degrees(),
                largest.k1_mpa_sqrt_m()
            )
        };
        (is_held && !state.geometry.has_stopped(tip.tip))
            .then(|| self.warning(WarningKind::Validity, largest.k1, text()))
    }

    fn unrepeated(&self, passage: &StabilisedPassage) -> Option<Warning> {
        let change = passage.last_change?;
        let tolerance = self.wheels.first()?.passages.passage_tolerance;
        let text = || {
            format!(
                "K still changes by {change:.2e} of its peak after {} passages, tolerance {tolerance:.1e}",
                passage.counts.passages
            )
        };
        (change > tolerance).then(|| self.warning(WarningKind::Passages, change, text()))
    }

    /// A warning with the estimated error of K where contact is followed in groups: in the first
    /// step, and in others if the error is large.
    fn coupled(&self, passage: &StabilisedPassage) -> Option<Warning> {
        let (error, allowed) = (passage.coupling?, self.wheels.first()?.passages.network_tolerance);
        let mut text = format!(
            "contact in groups: the estimated error of K is up to {:.3} % of its peak at the tip: {:.3} % by the sweeps, {:.3} % by the \
             interpolation of the neighbours' jumps, {:.3} % by far forces",
            100.0 * error.total(),
            100.0 * error.sweeps,
            100.0 * error.interpolation,
            100.0 * error.far
        );
        if error.sweeps > allowed {
            text += &format!(
                "; the sweep limit was reached before the error of the sweeps fell below network_tolerance = {allowed}"
            );
        } else if self.step > 0 && error.total() <= LARGE_GROUPS_ERROR {
            return None;
        }
        Some(self.warning(WarningKind::Groups, error.total(), text))
    }

    /// The warnings on the accuracy of K, and of K_I alone, at the tip where it is lowest.
    fn overlaps(&self, tips: &[TipRecord], passage: &StabilisedPassage) -> [Option<Warning>; 2] {
        let all = passage.overlaps(|tip| tips.get(tip).map_or(0, |tip| tip.tip.crack));
        let tip = |overlap: &Overlap| tips.get(overlap.tip);
        // No cell resolves K where a front meets the surface.
        let counts =
            all.iter().filter(|one| tip(one).is_some_and(|tip| tip.front().is_none_or(|front| front.counts)));
        let least = |a: &&Overlap, b: &&Overlap| a.of_crack().total_cmp(&b.of_crack());
        let of_crack = counts.min_by(least).filter(|one| one.is_large()).and_then(|one| {
            let text = format!(
                "{}: K_I falls to {:.1} % of the largest K of its crack, as if the faces overlapped ahead of the tip; K is known to that \
                 accuracy, and {} resolve it better",
                place(tip(one)?),
                100.0 * one.of_crack(),
                self.refinement
            );
            Some(self.warning(WarningKind::Engine, -one.of_crack(), text))
        });
        let opens = all.iter().filter(|one| tip(one).is_some_and(|tip| tip.plane().is_some()));
        let least = |a: &&Overlap, b: &&Overlap| a.of_own().total_cmp(&b.of_own());
        let of_own = opens.min_by(least).filter(|one| one.is_large_of_own()).and_then(|one| {
            let text = format!(
                "{}: K_I falls to {:.0} % of its own largest value: it is known to that accuracy, the direction depends on it, and {} \
                 resolve it better",
                place(tip(one)?),
                100.0 * one.of_own(),
                self.refinement
            );
            Some(self.warning(WarningKind::Engine, -one.of_own(), text))
        });
        [of_crack, of_own]
    }
}

/// The designation of a tip in a warning.
fn place(tip: &TipRecord) -> String {
    match tip.geometry {
        TipGeometry::Plane(_) => format!("crack {} tip {}", tip.tip.crack + 1, tip.tip.tip + 1),
        TipGeometry::Space(front) => {
            format!("crack {}, front at {:.0} degrees", tip.tip.crack + 1, front.phi.to_degrees())
        }
    }
}
