//! Meshes, factors and stresses that the runs of a study, or of a decision, share.

use super::carried::{CarriedStress, CarriedStressError, plastic_field};
use super::engine::finite_elements;
use railcrack::body::{BodyEngine, BodyError};
use railcrack::xfem::{XfemEngine, XfemError};
use railcrack_case::{Case, Engine, PlaneEngine, PlasticSource};
use std::fmt::{self, Debug, Formatter};
use thiserror::Error;

/// A rail for several runs.
#[derive(Clone)]
pub enum SharedRail {
    /// Mesh, factor and columns, for runs whose cracks begin the same.
    Meshed(Box<XfemEngine>),
    /// The residual stress that it carries, for runs by dislocations.
    Carrying(CarriedStress),
}

impl Debug for SharedRail {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Meshed(_) => "Meshed",
            Self::Carrying(_) => "Carrying",
        })
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
        Ok(Some(Self::Meshed(Box::new(engine))))
    }

    /// The stress that it carries, where that has been computed.
    pub(crate) fn carried(&self) -> Option<&CarriedStress> {
        match self {
            Self::Carrying(carried) => Some(carried),
            Self::Meshed(_) => None,
        }
    }

    /// Passes mesh, factor and columns to `engine`, which would compute the same.
    pub(super) fn give_to(&self, engine: &mut XfemEngine) {
        if let Self::Meshed(own) = self {
            engine.take_over(own);
        }
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
