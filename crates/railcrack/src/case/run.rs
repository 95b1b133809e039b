//! A case made into a run.

use super::validated::{Case, ContactSolver, Engine};
use crate::contact::{self, Latin, Newton};
use crate::dislocation::{DislocationEngine, FaceResolution};
use crate::field::StressField;
use crate::growth::{Growth, GrowthProblem, GrowthState, RailBox};

impl Case {
    /// How finely the dislocation engine resolves the faces.
    pub fn face_resolution(&self) -> FaceResolution {
        let cracks = self.cracks.cracks().len();
        self.mesh
            .interface_elements
            .map_or(FaceResolution::for_cracks(cracks), |elements| FaceResolution { elements })
    }

    /// The run of this case: from `state` on, from its beginning where there is none.
    pub fn growth_run(&self, state: Option<GrowthState>) -> Growth {
        let engine = match self.engine {
            Engine::Dislocation => {
                Box::new(DislocationEngine { steel: self.steel, resolution: self.face_resolution() })
            }
        };
        let newton: Box<dyn contact::ContactSolver> = Box::new(Newton::default());
        let latin: Box<dyn contact::ContactSolver> = Box::new(Latin::default());
        let (solver, fallback) = match self.contact_solver {
            ContactSolver::Newton => (newton, latin),
            ContactSolver::Latin => (latin, newton),
        };
        let residual = self.residual_stress.as_ref().map(|file| file.profile().clone());
        let problem = GrowthProblem {
            engine,
            solver,
            fallback,
            crack_friction: self.crack_friction.clone(),
            contact: self.contact,
            poisson: self.steel.poisson(),
            residual: residual.map(|profile| Box::new(profile) as Box<dyn StressField>),
            passages: self.passages,
            growth: self.growth,
            rail: RailBox { width: self.rail.width, depth: self.rail.depth, centre: self.rail.centre },
        };
        let state = state.unwrap_or_else(|| GrowthState::initial(self.cracks.cracks().to_vec()));
        Growth::new(problem, state)
    }
}
