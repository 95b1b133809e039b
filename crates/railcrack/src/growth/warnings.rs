//! Warnings of a step that follow from its tips and passages.

use super::{GrowthState, StabilisedPassage, TipGeometry, TipRecord, Warning, WarningKind, WheelOfRail};

/// Estimated error of K in groups, over its peak, above which every step warns.
const LARGE_GROUPS_ERROR: f64 = 0.01;

/// K_I at a closed tip, below zero by this share of the largest |K|, that is worth a warning. At
/// default settings it is at most 0.4 % where K is right to 1 %; a tip for which the engines were
/// 3.9 % apart had −3.9 %.
const OVERLAP: f64 = 0.01;

/// A rival kink whose rate comes this close to the best is a near tie.
pub const NEAR_TIE: f64 = 0.98;

/// The step that is warned of.
pub(super) struct Warnings<'a> {
    pub step: usize,
    /// What resolves K better.
    pub refinement: &'static str,
    pub wheels: &'a [WheelOfRail<'a>],
}

impl Warnings<'_> {
    /// Of `tips`, whose states before the step are in `state`, under the passages of all wheels.
    pub fn of(
        &self,
        state: &GrowthState,
        tips: &[TipRecord],
        passages: &[StabilisedPassage],
    ) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = tips.iter().filter_map(|tip| self.near_tie(state, tip)).collect();
        for (wheel, passage) in passages.iter().enumerate() {
            let own = [self.unrepeated(passage), self.coupled(passage), self.overlap(tips, passage)];
            let named = |warning: Warning| {
                if passages.len() > 1 { warning.under_wheel(wheel) } else { warning }
            };
            warnings.extend(own.into_iter().flatten().map(named));
        }
        warnings
    }

    fn warning(&self, kind: WarningKind, text: String) -> Warning {
        Warning { step: self.step, kind, text }
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
        Some(self.warning(WarningKind::NearTie, text))
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
        (change > tolerance).then(|| self.warning(WarningKind::Passages, text()))
    }

    /// The estimated error of K where contact is followed in groups: of the first step, and of
    /// others where it is large.
    fn coupled(&self, passage: &StabilisedPassage) -> Option<Warning> {
        let (error, allowed) = (passage.coupling?, self.wheels.first()?.passages.network_tolerance);
        let mut text = format!(
            "contact in groups: the estimated error of K is up to {:.3} % of its peak at the tip: {:.3} % by the sweeps, {:.3} % by the \
             interpolation of the neighbours' jumps, {:.3} % by far forces",
            100.0 * error.total(),
            100.0 * error.sweeps,
            100.0 * error.hand_over,
            100.0 * error.far
        );
        if error.sweeps > allowed {
            text += &format!(
                "; the sweep limit was reached before the error of the sweeps fell below network_tolerance = {allowed}"
            );
        } else if self.step > 0 && error.total() <= LARGE_GROUPS_ERROR {
            return None;
        }
        Some(self.warning(WarningKind::Passages, text))
    }

    fn overlap(&self, tips: &[TipRecord], passage: &StabilisedPassage) -> Option<Warning> {
        let (tip, share) = passage.lowest_opening().filter(|(_, share)| *share < -OVERLAP)?;
        let text = format!(
            "{}: K_I falls to {:.1} % of the largest K of the step, as if the faces overlapped ahead of the tip; K is known to that \
             accuracy, and {} resolve it better",
            place(tips.get(tip)?),
            100.0 * share,
            self.refinement
        );
        Some(self.warning(WarningKind::Engine, text))
    }
}

/// Which tip it is.
fn place(tip: &TipRecord) -> String {
    match tip.geometry {
        TipGeometry::Plane(_) => format!("crack {} tip {}", tip.tip.crack + 1, tip.tip.tip + 1),
        TipGeometry::Space(front) => {
            format!("crack {}, front at {:.0} degrees", tip.tip.crack + 1, front.phi.to_degrees())
        }
    }
}
