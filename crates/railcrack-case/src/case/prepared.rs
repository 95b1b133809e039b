//! Engine, contact solver and residual stress of a run, built from its case.

use super::carried::{CarriedStress, CarriedStressError};
use super::case::Case;
use super::engines;
use super::mix::MixedWheel;
use super::shared::SharedRail;
use crate::tables::{ContactSolver, GivenWheel};
use railcrack::body::BodyEngine;
use railcrack::bulk::Boundary;
use railcrack::contact::{self, Latin, Newton};
use railcrack::dislocation::FaceResolution;
use railcrack::fatigue::RailSteel;
use railcrack::field::{StressField, Sum};
use railcrack::growth::{
    CrackedRail, FieldSettings, Growth, GrowthSettings, GrowthState, StepSource, TipJudge,
};
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::{CrackFluid, PlaneRail, PlaneWheel};
use railcrack::residual::PlasticField;
use railcrack::section::{SectionEngine, SectionLayers};
use railcrack::space::{SpaceFluid, SpaceRail, SpaceWheel};
use railcrack::xfem::{
    EnrichmentRadius, MOST_MESH_UNKNOWNS, RailEnd, RefinedRegion, ResolvedLayers, XfemEngine, XfemSettings,
    default_element_sizes,
};
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Growth of the length for which the refined regions of a run make room, one after the other: the
/// last one is enlarged for a crack that grows further. They do not depend on the number of steps,
/// so that a step is the same in a short run and in a long one.
const WINDOWS: [f64; 3] = [1.25, 1.75, 3.0];

/// Elements over the depth of the plastic stress, at least.
const LAYERS_PER_PLASTIC_DEPTH: f64 = 40.0;

impl Case {
    /// Resolution of the crack faces in the dislocation engine.
    #[must_use]
    pub fn face_resolution(&self) -> FaceResolution {
        let cracks = self.cracks.cracks().len();
        self.mesh
            .interface_elements
            .map_or(FaceResolution::for_cracks(cracks), |elements| FaceResolution { elements })
    }

    /// Size (mm) of the finite elements at each crack.
    pub(super) fn element_sizes(&self) -> Vec<f64> {
        match self.mesh.element_size {
            Some(size) => vec![size; self.cracks.cracks().len()],
            None => default_element_sizes(&self.cracks),
        }
    }

    /// Displacement unknowns of the mesh of the finite-element engine, computed without generating
    /// it, or a larger number that is acceptable; those of layers of a given plastic stress
    /// included.
    pub(super) fn wanted_mesh_unknowns(&self) -> f64 {
        let engine = self.finite_elements(self.given_plastic().as_ref());
        let most = engine.most_mesh_unknowns();
        if most <= MOST_MESH_UNKNOWNS { most } else { engine.mesh_unknowns() }
    }

    /// The finite-element engine, with a mesh for the cracks at the beginning and their growth.
    #[must_use]
    pub fn xfem_engine(&self) -> XfemEngine {
        let sizes = self.element_sizes();
        let [first, further @ ..] =
            WINDOWS.map(|growth| RefinedRegion::with_sizes(&self.cracks, &sizes, growth));
        let defaults = XfemSettings::default();
        let settings = XfemSettings {
            enrichment: self.mesh.tip_enrichment_radius.map_or(defaults.enrichment, EnrichmentRadius::Fixed),
            interface_spacing: self.mesh.interface_spacing,
            ..defaults
        };
        let end = match self.rail.boundary {
            Boundary::HalfPlane => RailEnd::HalfPlane { centre: self.rail.extent.centre },
            Boundary::Block { bottom, sides } => RailEnd::Block { extent: self.rail.extent, bottom, sides },
        };
        XfemEngine::with_region(first, self.steel, end, settings).followed_by(further.into())
    }

    /// Whether the steps are expected to make the cracks outgrow the first mesh.
    pub(super) fn outgrows_first_mesh(&self) -> bool {
        (1.0 + self.growth.increment).powf(self.growth.steps as f64) > WINDOWS[0]
    }

    /// The fields to be computed; none if none are requested.
    fn field_settings(&self) -> Option<FieldSettings> {
        let every = NonZeroUsize::new(self.fields.every).filter(|_| self.rail.section.is_none())?;
        let mouth = self.cracks.cracks().first()?.points()[0].x;
        let positions: Vec<f64> =
            self.fields.over_a.iter().map(|over_a| mouth + over_a * self.half_width()).collect();
        (!positions.is_empty()).then_some(FieldSettings { positions, every })
    }

    /// The finite-element engine, with a mesh that also resolves `plastic` stress.
    pub(crate) fn finite_elements(&self, plastic: Option<&PlasticField>) -> XfemEngine {
        let engine = self.xfem_engine();
        match plastic.and_then(|field| field.plastic_depth()) {
            Some(depth) => {
                engine.resolving(ResolvedLayers { depth, height: depth / LAYERS_PER_PLASTIC_DEPTH })
            }
            None => engine,
        }
    }

    /// The engine that builds bodies from the cracks of this case, without a plastic stress; none
    /// where they are in space.
    #[must_use]
    pub fn body_engine(&self) -> Option<Box<dyn BodyEngine + Send>> {
        self.in_section(engines::of(self.engine).body_engine(self, self.xfem_engine()))
    }

    /// `engine` for the section of the rail, where one is given, on the foundation of the first
    /// wheel with a track.
    fn in_section(&self, engine: Option<Box<dyn BodyEngine + Send>>) -> Option<Box<dyn BodyEngine + Send>> {
        let Some(layers) = self.rail.section.and_then(SectionLayers::of) else { return engine };
        let mut wheels = std::iter::once(&self.wheel).chain(self.mix.iter().map(|mixed| &mixed.wheel));
        let foundation = wheels.find_map(|wheel| Some(wheel.load.track.as_ref()?.foundation));
        let in_section = SectionEngine::new(engine?, self.steel, layers, foundation.unwrap_or(0.0));
        in_section.ok().map(|engine| Box::new(engine) as Box<dyn BodyEngine + Send>)
    }

    /// Everything that is made once for the run of this case. `rolled` is the plastic stress of the
    /// stabilised state, for a case that requires it
    /// ([`PlasticSource::Rolled`](crate::PlasticSource)).
    ///
    /// Errors: the residual stress cannot be computed.
    pub fn prepare(&self, rolled: Option<&PlasticField>) -> Result<PreparedRun<'_>, CarriedStressError> {
        self.prepare_sharing(rolled, None)
    }

    /// [`Case::prepare`] with mesh, factor and columns of another run: the same bits, sooner.
    pub fn prepare_sharing(
        &self,
        rolled: Option<&PlasticField>,
        shared: Option<&SharedRail>,
    ) -> Result<PreparedRun<'_>, CarriedStressError> {
        let plastic = self.plastic_field(rolled)?;
        let mut finite_elements = self.finite_elements(plastic.as_ref());
        if let Some(shared) = shared {
            shared.give_to(&mut finite_elements);
        }
        let residual = self.carried_stress(plastic.as_ref(), &mut finite_elements)?;
        let engine = self.in_section(engines::of(self.engine).body_engine(self, finite_elements));
        let engine = engine.map(|engine| engine as Box<dyn BodyEngine>);
        Ok(PreparedRun { case: self, engine, residual })
    }
}

/// The stress that stays between passages of `wheel`: `residual` and that of temperature.
pub(super) fn with_temperature(
    case: &Case,
    wheel: &GivenWheel,
    residual: Option<&Arc<dyn StressField>>,
) -> Option<Box<dyn StressField>> {
    let residual = residual.map(|field| Box::new(Arc::clone(field)) as Box<dyn StressField>);
    match (residual, wheel.thermal_stress(&case.steel)) {
        (residual, None) => residual,
        (None, Some(thermal)) => Some(Box::new(thermal)),
        (Some(residual), Some(thermal)) => Some(Box::new(Sum(vec![residual, Box::new(thermal)]))),
    }
}

/// A wheel of a mix other than the first one, in the plane.
fn other_wheel(case: &Case, other: &MixedWheel, residual: Option<&Arc<dyn StressField>>) -> PlaneWheel {
    PlaneWheel {
        share: other.share,
        fluid: other.fluid.clone(),
        coupling: other.wheel.coupling.clone(),
        residual: with_temperature(case, &other.wheel, residual),
        passages: other.passages,
        toughness: toughness_under(case, &other.wheel),
        ..PlaneWheel::new(other.wheel.field(&case.steel).expect("the case is checked"))
    }
}

/// K_Ic (MPa √mm) at the temperature of the rail under `wheel`; none where the rail does not break.
/// Where that under the first wheel differs from the one that the case gives, that under the others
/// differs by as much.
fn toughness_under(case: &Case, wheel: &GivenWheel) -> Option<f64> {
    let rail =
        |wheel: &GivenWheel| wheel.load.temperature.map_or(ROOM_TEMPERATURE, |temperature| temperature.rail);
    let fracture = case.fracture.as_ref()?;
    let at = |rail: f64| MPA_SQRT_MM * fracture.toughness.at(rail);
    let raised = case.growth.toughness.map_or(0.0, |toughness| toughness - MPA_SQRT_MM * fracture.at_rail);
    Some(at(rail(wheel)) + raised)
}

/// Temperature (°C) of a rail if none is given.
const ROOM_TEMPERATURE: f64 = 20.0;

/// A run before its first step.
pub struct PreparedRun<'a> {
    case: &'a Case,
    /// None for a run in space.
    engine: Option<Box<dyn BodyEngine>>,
    residual: CarriedStress,
}

impl PreparedRun<'_> {
    /// The residual stress that the rail carries.
    #[must_use]
    pub fn residual(&self) -> &CarriedStress {
        &self.residual
    }

    /// The field of that residual stress; none where the rail carries nothing.
    pub(super) fn into_residual(self) -> Option<Box<dyn StressField>> {
        self.residual.field
    }

    /// The growth loop from `state` on, or from the beginning where there is none.
    #[must_use]
    pub fn growth(self, state: Option<GrowthState>) -> Box<dyn StepSource> {
        self.growth_judged(state, None)
    }

    /// [`PreparedRun::growth`] with a `judge` that gives direction and rate of every tip; in space
    /// the rate of every front point.
    #[must_use]
    pub fn growth_judged(
        self,
        state: Option<GrowthState>,
        judge: Option<Arc<dyn TipJudge>>,
    ) -> Box<dyn StepSource> {
        let Self { case, engine, residual } = self;
        let shared: Option<Arc<dyn StressField>> = residual.field.map(Arc::from);
        match engine {
            Some(engine) => case.plane_growth(engine, shared.as_ref(), state, judge),
            None => case.space_growth(shared.as_ref(), state, judge).expect("the case is checked"),
        }
    }
}

/// The growth of `rail` from `state` on, with directions and rates from `judge` if there is one.
fn boxed<R: CrackedRail + 'static>(
    rail: R,
    state: GrowthState,
    judge: Option<Arc<dyn TipJudge>>,
) -> Box<dyn StepSource> {
    let growth = Growth::new(rail, state);
    Box::new(match judge {
        Some(judge) => growth.judged_by(judge),
        None => growth,
    })
}

impl Case {
    /// The growth of cracks in the plane from `state` on, or from the beginning.
    fn plane_growth(
        &self,
        engine: Box<dyn BodyEngine>,
        residual: Option<&Arc<dyn StressField>>,
        state: Option<GrowthState>,
        judge: Option<Arc<dyn TipJudge>>,
    ) -> Box<dyn StepSource> {
        let case = self;
        let newton: Box<dyn contact::ContactSolver> = Box::new(Newton::default());
        let latin: Box<dyn contact::ContactSolver> = Box::new(Latin::default());
        let (solver, fallback) = match case.contact_solver {
            ContactSolver::Newton => (newton, latin),
            ContactSolver::Latin => (latin, newton),
        };
        let first = PlaneWheel {
            share: case.mix.first().map_or(1.0, |first| first.share),
            fluid: case.fluid.clone(),
            coupling: case.wheel.coupling.clone(),
            residual: with_temperature(case, &case.wheel, residual),
            passages: case.passages,
            ..PlaneWheel::new(case.wheel.field(&case.steel).expect("the case is checked"))
        };
        let others = case.mix.iter().skip(1).map(|other| other_wheel(case, other, residual));
        let wheels = std::iter::once(first).chain(others).collect();
        let usual = MPA_SQRT_MM * case.growth_steel.unwrap_or(RailSteel::USUAL).mean_toughness;
        let rail = PlaneRail {
            solver,
            fallback,
            network: case.network,
            fields: case.field_settings(),
            growth: GrowthSettings { usual_toughness: Some(usual), ..case.growth.clone() },
            rail: case.rail.extent,
            ..PlaneRail::under(engine, wheels, case.crack_friction.clone())
        };
        let state = state.unwrap_or_else(|| GrowthState::initial(&case.cracks));
        boxed(rail, state, judge)
    }

    /// The growth of the cracks in space from `state` on, or from the beginning; none of a case for
    /// another engine.
    fn space_growth(
        &self,
        residual: Option<&Arc<dyn StressField>>,
        state: Option<GrowthState>,
        judge: Option<Arc<dyn TipJudge>>,
    ) -> Option<Box<dyn StepSource>> {
        let rail = self.space_rail(residual)?;
        let state = match state {
            Some(state) => state,
            None => GrowthState::initial_in_space(self.space.as_ref()?.shapes.clone()).ok()?,
        };
        Some(boxed(rail, state, judge))
    }

    /// The rail and its wheels in space; none of a case for another engine.
    pub(super) fn space_rail(&self, residual: Option<&Arc<dyn StressField>>) -> Option<SpaceRail> {
        let space = self.space.as_ref().filter(|_| self.engine.is_in_space())?;
        let first = SpaceWheel {
            wheel: space.wheels.first()?.clone(),
            share: self.mix.first().map_or(1.0, |first| first.share),
            bending: self.wheel.bending(&self.steel),
            residual: with_temperature(self, &self.wheel, residual),
            fluid: self.fluid.as_ref().map(in_space),
            passages: self.passages,
            toughness: self.growth.toughness,
        };
        let others = self.mix.iter().zip(&space.wheels).skip(1).map(|(mixed, wheel)| SpaceWheel {
            wheel: wheel.clone(),
            share: mixed.share,
            bending: mixed.wheel.bending(&self.steel),
            residual: with_temperature(self, &mixed.wheel, residual),
            fluid: mixed.fluid.as_ref().map(in_space),
            passages: mixed.passages,
            toughness: toughness_under(self, &mixed.wheel),
        });
        Some(SpaceRail {
            network: self.network,
            steel: self.steel,
            wheels: std::iter::once(first).chain(others).collect(),
            friction: self.crack_friction.clone(),
            resolution: self.mesh.space,
            growth: self.growth.clone(),
            mode_3_weight: space.mode_3_weight,
            fields: self.field_settings(),
            rail: self.rail.extent,
            kernel: None,
        })
    }
}

/// The same fluid in cracks in space.
fn in_space(fluid: &CrackFluid) -> SpaceFluid {
    SpaceFluid { model: fluid.model, profile: fluid.profile, cracks: fluid.cracks.clone() }
}
