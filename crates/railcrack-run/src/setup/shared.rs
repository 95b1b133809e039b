//! Meshes and factors that several runs of a study share.

use super::carried::{CarriedStress, CarriedStressError, plastic_field};
use super::engine::finite_elements;
use railcrack::body::{BodyEngine, BodyError};
use railcrack::xfem::{XfemEngine, XfemError};
use railcrack_case::{Case, Engine, PlaneEngine, PlasticSource};
use std::fmt::{self, Debug, Formatter};
use thiserror::Error;

/// Mesh, factor and columns of a rail for several runs whose cracks begin the same.
#[derive(Clone)]
pub struct SharedRail {
    engine: XfemEngine,
    /// The residual stress that it carries, where one of the runs has computed it for all.
    carried: Option<CarriedStress>,
}

impl Debug for SharedRail {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("SharedRail").field("engine", &self.engine).finish_non_exhaustive()
    }
}

/// A rail that cannot be built.
#[derive(Debug, Error)]
pub enum SharedRailError {
    /// The plastic stress that its mesh is to resolve.
    #[error(transparent)]
    Stress(#[from] CarriedStressError),
    /// The mesh.
    #[error(transparent)]
    Mesh(#[from] XfemError),
    /// The cracks.
    #[error(transparent)]
    Body(#[from] BodyError),
}

impl SharedRail {
    /// Mesh, factor and columns of `case` after its first growth step, or after the balance of its
    /// plastic stress where another engine computes the cracks. None where there are none, or where
    /// they are not known before the run ([`RailKey::of_case`]).
    ///
    /// Errors: the rail cannot be built.
    pub fn build(case: &Case) -> Result<Option<Self>, SharedRailError> {
        let Some(mut engine) = shareable_elements(case)? else { return Ok(None) };
        match case.engine() {
            Engine::Plane(PlaneEngine::Xfem) => drop(engine.body(&case.cracks)?),
            _ => drop(engine.background(&case.cracks)?.clone()),
        }
        Ok(Some(Self { engine, carried: None }))
    }

    /// The rail that `engine` meshes, with the stress that it has `carried` already.
    pub(super) fn carrying(engine: XfemEngine, carried: CarriedStress) -> Self {
        Self { engine, carried: Some(carried) }
    }

    /// The stress that it carries, where that has been computed.
    pub(crate) fn carried(&self) -> Option<&CarriedStress> {
        self.carried.as_ref()
    }

    /// The engine that meshes it.
    pub(super) fn engine(&self) -> &XfemEngine {
        &self.engine
    }

    /// Passes them to `engine`, which would compute the same.
    pub(super) fn give_to(&self, engine: &mut XfemEngine) {
        engine.take_over(&self.engine);
    }
}

/// Mesh, supports and elasticity of a rail, bit for bit: equal where rails can be shared.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct RailKey(String);

impl RailKey {
    /// The rail of `case`: cases with equal keys can share a [`SharedRail`]. None where the run
    /// needs no mesh, or where its mesh depends on a plastic state that the run itself computes.
    #[must_use]
    pub fn of_case(case: &Case) -> Option<Self> {
        // Errors of its plastic stress are reported by the run.
        let engine = shareable_elements(case).ok().flatten()?;
        Some(Self(engine.rail_in_words()))
    }
}

fn shareable_elements(case: &Case) -> Result<Option<XfemEngine>, CarriedStressError> {
    let Some(plane) = case.plane() else { return Ok(None) };
    match (&plane.plastic_stress, plane.engine) {
        (Some(PlasticSource::Rolled), _) | (None, PlaneEngine::Dislocation) => Ok(None),
        _ => Ok(Some(finite_elements(case, plane, plastic_field(case, None)?.as_ref()))),
    }
}
