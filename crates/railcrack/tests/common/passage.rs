//! Passages of the wheel over cracks, with the default settings of users.

use super::{Meshed, body, steel};
use railcrack::body::CrackedBody;
use railcrack::contact::{self, ContactSolver, FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::FaceResolution;
use railcrack::field::{HertzWheel, StressField};
use railcrack::growth::{PassageSettings, StabilisedPassage, Unobserved};
use railcrack::load::{HertzianContact, Passage};
use railcrack::plane::{RailLoad, stabilised_passage};
use std::fmt;

/// Output positions per half-width, and the tolerance of the load steps.
#[derive(Debug, Clone, Copy)]
pub struct StepControl {
    pub positions: usize,
    pub tolerance: f64,
    pub control: contact::StepControl,
}

impl Default for StepControl {
    fn default() -> Self {
        Self { positions: 241, tolerance: 2e-3, control: contact::StepControl::Adaptive }
    }
}

/// The engine of the cracked rail.
#[derive(Debug, Clone)]
pub enum RollingEngine {
    /// Dislocations, [`Rolling::elements`] along each crack.
    Dislocation,
    /// Finite elements.
    Xfem(Meshed),
}

/// Cracks under the wheel of the reference case: 845 MPa, a = 6.75 mm, from −6 a to 6 a.
#[derive(Clone)]
pub struct Rolling<'a> {
    pub cracks: Vec<Crack>,
    pub crack_friction: f64,
    /// Signed: positive drags the rail along +x.
    pub wheel_friction: f64,
    pub residual: Option<&'a dyn StressField>,
    pub elements: usize,
    pub engine: RollingEngine,
    pub steps: StepControl,
    /// +1 towards +x, −1 towards −x.
    pub travel: f64,
}

impl fmt::Debug for Rolling<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "{:?}, faces {}, wheel {}, travel {}",
            self.cracks, self.crack_friction, self.wheel_friction, self.travel
        )
    }
}

impl Rolling<'_> {
    /// Half-width of the wheel contact, mm.
    pub const HALF_WIDTH: f64 = 6.75;

    pub fn over(cracks: Vec<Crack>, crack_friction: f64, wheel_friction: f64) -> Self {
        let elements = FaceResolution::for_cracks(cracks.len()).elements;
        let steps = StepControl::default();
        let engine = RollingEngine::Dislocation;
        Self { cracks, crack_friction, wheel_friction, residual: None, elements, engine, steps, travel: 1.0 }
    }

    /// [`Rolling::over`] with finite elements at their defaults.
    pub fn meshed(cracks: Vec<Crack>, crack_friction: f64, wheel_friction: f64) -> Self {
        let engine = RollingEngine::Xfem(Meshed::default());
        Self { engine, ..Self::over(cracks, crack_friction, wheel_friction) }
    }

    /// The wheel.
    pub fn contact(&self) -> HertzianContact {
        HertzianContact { peak_pressure: 845.0, half_width: Self::HALF_WIDTH, friction: self.wheel_friction }
    }

    /// The cracked rail.
    pub fn body(&self) -> CrackedBody {
        match &self.engine {
            RollingEngine::Dislocation => body(&self.cracks, self.elements),
            RollingEngine::Xfem(meshed) => meshed.body(&self.cracks),
        }
    }

    /// The passage by the default solver.
    pub fn solve(&self) -> StabilisedPassage {
        self.solve_by(&Newton::default())
    }

    pub fn solve_by(&self, solver: &dyn ContactSolver) -> StabilisedPassage {
        let body = self.body();
        let problem = FaceProblem::new(&body, &vec![self.crack_friction; self.cracks.len()]).unwrap();
        self.on(&problem, solver)
    }

    /// The passage over faces that exist already.
    pub fn on(&self, problem: &FaceProblem, solver: &dyn ContactSolver) -> StabilisedPassage {
        let network = CrackNetwork::new(self.cracks.clone()).unwrap();
        let reach = 6.0 * Self::HALF_WIDTH;
        let (left, right) = (network.leftmost_mouth() - reach, network.rightmost_mouth() + reach);
        let (from, to) = if self.travel > 0.0 { (left, right) } else { (right, left) };
        let settings = PassageSettings {
            passage: Passage { from, to, positions: self.steps.positions },
            step_tolerance: self.steps.tolerance,
            step_control: self.steps.control,
            ..PassageSettings::default()
        };
        let load =
            RailLoad { wheel: &HertzWheel::new(&self.contact(), &steel()).unwrap(), residual: self.residual };
        stabilised_passage(problem, solver, load, &settings, &Unobserved).unwrap()
    }
}
