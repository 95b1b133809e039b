//! A case made into a run.

use super::shared::SharedRail;
use super::validated::{Case, ContactSolver, Engine};
use crate::body::BodyEngine;
use crate::bulk::Boundary;
use crate::contact::{self, Latin, Newton};
use crate::dislocation::{DislocationEngine, FaceResolution};
use crate::field::{HertzDisplacement, StressField};
use crate::growth::{FieldSettings, Growth, GrowthProblem, GrowthState, RailBox};
use crate::xfem::{
    EnrichmentRadius, MeshSettings, Outline, RailEnd, XfemEngine, XfemSettings, default_element_size,
};
use std::num::NonZeroUsize;

/// Growth of the length that the window makes room for, at most: a crack that grows on has it enlarged.
const LARGEST_WINDOW: f64 = 3.0;

impl Case {
    /// How finely the dislocation engine resolves the faces.
    pub fn face_resolution(&self) -> FaceResolution {
        let cracks = self.cracks.cracks().len();
        self.mesh
            .interface_elements
            .map_or(FaceResolution::for_cracks(cracks), |elements| FaceResolution { elements })
    }

    /// The finite-element engine, with a mesh for the cracks at the beginning and their growth.
    pub fn xfem_engine(&self) -> XfemEngine {
        let mesh = MeshSettings {
            element_size: self.mesh.element_size.unwrap_or_else(|| default_element_size(&self.cracks)),
            expected_growth: (1.0 + self.growth.increment).powf(self.growth.steps as f64).min(LARGEST_WINDOW),
        };
        let defaults = XfemSettings::default();
        let settings = XfemSettings {
            enrichment: self.mesh.tip_enrichment_radius.map_or(defaults.enrichment, EnrichmentRadius::Fixed),
            interface_spacing: self.mesh.interface_spacing,
            ..defaults
        };
        let end = match self.rail.boundary {
            Boundary::HalfPlane => RailEnd::HalfPlane { centre: self.rail.centre },
            Boundary::Block { bottom, sides } => {
                let passage = self.passages.passage;
                RailEnd::Block {
                    outline: Outline {
                        left: self.rail.centre - 0.5 * self.rail.width,
                        right: self.rail.centre + 0.5 * self.rail.width,
                        depth: self.rail.depth,
                    },
                    bottom,
                    sides,
                    contact: self.contact,
                    positions: passage.from.min(passage.to)..=passage.from.max(passage.to),
                }
            }
        };
        XfemEngine::new(&self.cracks, self.steel, mesh, end, settings)
    }

    /// The fields that this case wants; none where it wants none.
    fn field_settings(&self) -> Option<FieldSettings> {
        let every = NonZeroUsize::new(self.fields.every)?;
        let mouth = self.cracks.cracks().first()?.points()[0].x;
        let positions: Vec<f64> =
            self.fields.over_a.iter().map(|over_a| mouth + over_a * self.contact.half_width).collect();
        let displacement = HertzDisplacement::new(&self.contact, &self.steel);
        (!positions.is_empty()).then_some(FieldSettings { positions, every, displacement })
    }

    /// The run of this case: from `state` on, from its beginning where there is none.
    pub fn growth_run(&self, state: Option<GrowthState>) -> Growth {
        self.growth_run_sharing(state, None)
    }

    /// [`Case::growth_run`], with what another run computed already: the results are the same bits, sooner.
    pub fn growth_run_sharing(&self, state: Option<GrowthState>, shared: Option<&SharedRail>) -> Growth {
        let engine: Box<dyn BodyEngine> = match self.engine {
            Engine::Xfem => {
                Box::new(shared.map_or_else(|| self.xfem_engine(), |shared| shared.engine_of(self)))
            }
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
            fields: self.field_settings(),
            growth: self.growth,
            rail: RailBox { width: self.rail.width, depth: self.rail.depth, centre: self.rail.centre },
        };
        let state = state.unwrap_or_else(|| GrowthState::initial(self.cracks.cracks().to_vec()));
        Growth::new(problem, state)
    }
}
