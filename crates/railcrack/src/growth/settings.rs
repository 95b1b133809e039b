//! Settings of passages and growth; the defaults are the reference values of the paper.

use super::{Axles, StressMoves, SurfaceRemoval, TipRecord, Turning, WornSurface};
use crate::contact::StepControl;
use crate::fatigue::{DirectionCriterion, GrowthLaw};
use crate::load::Passage;
use crate::math::OutOfRange;

/// Settings of the passages of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassageSettings {
    /// Output positions.
    pub passage: Passage,
    /// Largest number of passages.
    pub max_passages: usize,
    /// Change of K between two passages, relative to its peak, below which the history counts as
    /// repeated.
    pub passage_tolerance: f64,
    /// Tolerance of the load steps in terms of K, relative to its peak; not used by fixed steps.
    pub step_tolerance: f64,
    /// Control of the load steps; fixed steps lead from one output position to the next.
    pub step_control: StepControl,
    /// Allowed error of K, relative to its peak at the tip, for cracks that are followed in groups.
    pub network_tolerance: f64,
}

/// The defaults of a case file, with the passage of the reference case.
impl Default for PassageSettings {
    fn default() -> Self {
        Self {
            passage: Passage::default(),
            max_passages: 5,
            passage_tolerance: 1e-3,
            step_tolerance: 2e-3,
            step_control: StepControl::Adaptive,
            network_tolerance: 6e-4,
        }
    }
}

impl PassageSettings {
    /// Rejects an empty passage, a limit of zero passages, and tolerances that are not positive.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.passage.check()?;
        let passages = self.max_passages as f64;
        OutOfRange::unless(self.max_passages >= 1, "passages at most", passages, "at least 1")?;
        OutOfRange::unless_positive("tolerance of the passages", self.passage_tolerance)?;
        OutOfRange::unless_positive("tolerance of the load steps", self.step_tolerance)?;
        OutOfRange::unless_positive("tolerance of the groups", self.network_tolerance)
    }
}

/// The question of a run, with whose answer it ends.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Answer {
    /// The depth (mm) of a tip that is a failure; without one, the run ends as any other.
    pub critical_depth: Option<f64>,
}

/// How cracks grow and when a run ends.
#[derive(Debug, Clone, PartialEq)]
pub struct GrowthSettings {
    /// Number of increments; with 0, only the initial cracks are computed.
    pub steps: usize,
    /// The question of a run without a given number of increments; `steps` is then the largest
    /// number of them.
    pub answer: Option<Answer>,
    /// Increment of the fastest tip as a fraction of its crack's current length; with a tolerance,
    /// that of the first step.
    pub increment: f64,
    /// Allowed relative error of the life, for which the increments are chosen; `None` for
    /// increments of one fraction.
    pub tolerance: Option<f64>,
    /// How paths turn towards the best kink.
    pub turning: Turning,
    /// Whether cracks in space turn out of their planes.
    pub turns_in_space: bool,
    /// Depth of a tip (mm) up to which its path goes straight ahead; 0 where it turns from the
    /// beginning.
    pub straight_depth: f64,
    /// Best kink (radians) from which a path kinks at once.
    pub kink_angle: f64,
    /// Friction coefficient of the faces of virtual kinks.
    pub kink_friction: f64,
    /// Growth law, which gives the rate.
    pub law: GrowthLaw,
    /// Rate (mm per cycle) below which a tip is arrested.
    pub arrest_rate: f64,
    /// Criterion of the growth direction.
    pub criterion: DirectionCriterion,
    /// A crack this long (mm) ends the run.
    pub critical_length: Option<f64>,
    /// The run ends after this many load cycles.
    pub stop_after_cycles: Option<f64>,
    /// K_Ic, MPa √mm: the run ends when k1 of a tip reaches it during a passage.
    pub toughness: Option<f64>,
    /// Length (mm) of the kink on which k1 must still reach the toughness for the rail to
    /// fracture; `None` where k1 of a virtual kink decides.
    pub pop_in: Option<f64>,
    /// K_Ic (MPa √mm) that the steel usually has, where `toughness` is not given: kinks that reach
    /// it are tested ([`PopInTest`](super::PopInTest)), without effect on the run.
    pub usual_toughness: Option<f64>,
    /// Wear and grinding of the running surface.
    pub maintenance: Option<SurfaceRemoval<Axles>>,
}

/// Increments after which most runs have their answer.
const USUAL_STEPS: usize = 60;

/// [`GrowthSettings::REFERENCE`].
impl Default for GrowthSettings {
    fn default() -> Self {
        Self::REFERENCE
    }
}

impl GrowthSettings {
    /// The defaults of a case file: the reference values of the paper.
    pub const REFERENCE: Self = Self {
        steps: 25,
        answer: None,
        increment: 0.04,
        tolerance: None,
        turning: Turning::Over(Turning::DEFAULT_LENGTH),
        turns_in_space: false,
        straight_depth: 0.0,
        kink_angle: 30.0 * std::f64::consts::PI / 180.0,
        kink_friction: 0.0,
        law: GrowthLaw::RAIL_STEEL,
        arrest_rate: 1e-9,
        criterion: DirectionCriterion::MaxRate,
        critical_length: None,
        stop_after_cycles: None,
        toughness: None,
        pop_in: None,
        usual_toughness: None,
        maintenance: None,
    };

    /// Increments of a run that ends with its answer, at most.
    pub const MOST_STEPS: usize = 1000;

    /// Increments to expect: where a run ends with its answer, those of most such runs.
    #[must_use]
    pub fn expected_steps(&self) -> usize {
        if self.answer.is_some() { self.steps.min(USUAL_STEPS) } else { self.steps }
    }

    /// Whether all paths go straight ahead, whatever their best kinks.
    #[must_use]
    pub fn all_go_straight(&self) -> bool {
        self.criterion == DirectionCriterion::Coplanar || self.turning == Turning::Over(f64::INFINITY)
    }

    /// Whether a tip at `depth` (mm) goes straight ahead, whatever its best kink.
    pub(crate) fn is_straight_at(&self, depth: f64) -> bool {
        self.all_go_straight() || !self.turning.is_kink() && depth < self.straight_depth
    }

    /// Whether the path of `tip` goes straight ahead, whatever its best kink.
    pub(crate) fn goes_straight(&self, tip: &TipRecord) -> bool {
        !self.turning.is_kink() && tip.depth() < self.straight_depth
    }

    /// Wear and grinding, if they remove anything.
    pub(crate) fn maintained(&self) -> Option<&SurfaceRemoval<Axles>> {
        self.maintenance.as_ref().filter(|removal| removal.mean_rate() > 0.0)
    }

    /// Depth (mm) by which the residual stress has come closer to the `worn` surface.
    pub(crate) fn uncovered(&self, worn: &WornSurface) -> f64 {
        let moves = self.maintenance.as_ref().map(|maintenance| maintenance.stress);
        if moves == Some(StressMoves::WithMetal) { worn.removed } else { 0.0 }
    }

    /// Rejects an increment that is not positive, and limits that are negative or not a number.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let fraction = self.increment > 0.0 && self.increment.is_finite();
        OutOfRange::unless(fraction, "increment over the crack length", self.increment, "positive")?;
        let at_least_zero =
            |quantity, value: f64| OutOfRange::unless(value >= 0.0, quantity, value, "zero or more");
        if let Turning::Over(length) = self.turning {
            at_least_zero("turning length (mm)", length)?;
        }
        at_least_zero("depth of straight paths (mm)", self.straight_depth)?;
        OutOfRange::unless_positive("kink angle (rad)", self.kink_angle)?;
        at_least_zero("friction of virtual kinks", self.kink_friction)?;
        OutOfRange::unless_positive("tolerance of the life", self.tolerance.unwrap_or(1.0))?;
        OutOfRange::unless_positive("length of a pop-in (mm)", self.pop_in.unwrap_or(1.0))?;
        OutOfRange::unless_positive("usual toughness (MPa \u{221a}mm)", self.usual_toughness.unwrap_or(1.0))?;
        at_least_zero("arrest rate (mm per cycle)", self.arrest_rate)?;
        at_least_zero("critical length (mm)", self.critical_length.unwrap_or(0.0))?;
        at_least_zero("cycles to stop after", self.stop_after_cycles.unwrap_or(0.0))?;
        self.maintenance.as_ref().map_or(Ok(()), SurfaceRemoval::check)?;
        OutOfRange::unless_positive("toughness (MPa \u{221a}mm)", self.toughness.unwrap_or(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_can_be_computed() {
        assert!(PassageSettings::default().check().is_ok() && GrowthSettings::default().check().is_ok());
    }

    #[test]
    fn settings_under_which_nothing_can_be_computed_are_refused() {
        let (passages, growth) = (PassageSettings::default(), GrowthSettings::default());
        let none = Passage { positions: 0, ..Passage::default() };
        assert!(PassageSettings { passage: none, ..passages }.check().is_err());
        assert!(PassageSettings { max_passages: 0, ..passages }.check().is_err());
        assert!(PassageSettings { passage_tolerance: 0.0, ..passages }.check().is_err());
        assert!(PassageSettings { step_tolerance: f64::NAN, ..passages }.check().is_err());
        assert!(GrowthSettings { increment: 0.0, ..growth.clone() }.check().is_err());
        assert!(GrowthSettings { critical_length: Some(f64::NAN), ..growth }.check().is_err());
    }
}
