//! Depth of one tip over traffic.

use crate::log::StepDigest;
use railcrack::growth::{RunStop, TipRecord, TipStop, WheelShares};

/// A tip at the start of a growth step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PathPoint {
    /// Axles so far.
    pub axles: f64,
    /// Length of its crack, mm.
    pub length: f64,
    /// Its depth, mm.
    pub depth: f64,
    /// da/dN, mm per axle.
    pub rate: f64,
    /// ΔK_eq, MPa√m.
    pub delta_keq: f64,
    /// The largest k1 of a virtual kink, MPa√m.
    pub largest_k1: f64,
    /// Sine of the angle of the crack at its mouth; none for a buried crack.
    pub mouth_sine: Option<f64>,
    /// Shares of the wheels of a mix in the rate.
    pub shares: WheelShares,
    /// Removal of the surface so far, mm.
    pub removed: f64,
    /// Growth until the next step, mm.
    pub increment: f64,
    /// The wheel of a mix (from 0) without which it would change its direction most, if by enough.
    pub turned_by: Option<usize>,
}

/// A tip of a run from step to step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrowthPath {
    /// Crack and tip, from 1.
    pub tip: (usize, usize),
    /// At the start of each step.
    pub points: Vec<PathPoint>,
    /// Whether the rail breaks at its end.
    pub breaks: bool,
    /// Whether wear and grinding take the crack away at its end.
    pub is_worn_away: bool,
}

/// The tip of the last of `steps` that has grown most, of equal ones the deepest.
pub(super) fn most_grown(steps: &[StepDigest]) -> Option<&TipRecord> {
    let grown = |tip: &TipRecord| {
        let same = |step: &StepDigest| {
            step.tips.iter().find(|other| other.tip == tip.tip).map_or(0.0, |other| other.increment)
        };
        steps.iter().map(same).sum::<f64>()
    };
    steps.last()?.tips.iter().max_by(|a, b| {
        let deeper = a.depth().total_cmp(&b.depth());
        grown(a).total_cmp(&grown(b)).then(deeper)
    })
}

impl GrowthPath {
    /// The path of the tip `followed` (crack and tip, from 0) or of the one that has grown most, of
    /// equal ones the deepest; none without steps.
    pub(crate) fn of(steps: &[StepDigest], followed: Option<(usize, usize)>) -> Option<Self> {
        let last = steps.last()?;
        let own = last.tips.iter().find(|tip| followed == Some((tip.tip.crack, tip.tip.tip)));
        let followed = own.or_else(|| most_grown(steps))?.tip;
        let point = |step: &StepDigest| {
            let same = |tip: &&TipRecord| (tip.tip.crack, tip.tip.tip) == (followed.crack, followed.tip);
            let tip = step.tips.iter().find(same)?;
            Some(PathPoint {
                axles: step.load_cycles,
                length: tip.length,
                depth: tip.depth(),
                rate: tip.rate,
                delta_keq: tip.delta_keq / railcrack::math::MPA_SQRT_MM,
                largest_k1: tip.compared_k1() / railcrack::math::MPA_SQRT_MM,
                mouth_sine: tip.mouth_sine,
                shares: tip.shares,
                removed: step.removed,
                increment: tip.increment,
                turned_by: tip.plane().and_then(|plane| plane.turned_by),
            })
        };
        Some(Self {
            tip: (followed.crack + 1, followed.tip + 1),
            points: steps.iter().filter_map(point).collect(),
            breaks: last.stop == Some(RunStop::Fracture),
            is_worn_away: last
                .tips
                .iter()
                .any(|tip| (tip.tip.crack, tip.stop) == (followed.crack, Some(TipStop::WornAway))),
        })
    }

    /// Axles of each point.
    pub fn axles(&self) -> Vec<f64> {
        self.points.iter().map(|point| point.axles).collect()
    }

    /// Where `quantity` first reaches `value`, as index and fraction of the distance to the next
    /// point; none if it is not reached on the path.
    pub fn reaches(&self, quantity: impl Fn(&PathPoint) -> f64, value: f64) -> Option<(usize, f64)> {
        if self.points.first().is_some_and(|first| quantity(first) >= value) {
            return Some((0, 0.0));
        }
        let crossed = |pair: &[PathPoint]| quantity(&pair[0]) < value && quantity(&pair[1]) >= value;
        let i = self.points.windows(2).position(crossed)?;
        let (from, to) = (quantity(&self.points[i]), quantity(&self.points[i + 1]));
        Some((i, (value - from) / (to - from)))
    }

    /// The value at a place on the path of `values`, one for each point.
    pub fn at((i, share): (usize, f64), values: &[f64]) -> f64 {
        let next = values.get(i + 1).filter(|_| share > 0.0).unwrap_or(&values[i]);
        values[i] + share * (next - values[i])
    }
}
