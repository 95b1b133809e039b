//! Meshes and factors that several runs of a study share.

use super::carried::CarriedStressError;
use super::case::Case;
use crate::tables::{EngineDomain, PlasticSource};
use railcrack::body::{BodyEngine, BodyError};
use railcrack::xfem::{XfemEngine, XfemError};
use thiserror::Error;

/// Mesh, factor and columns of a rail for several runs whose cracks begin the same.
#[derive(Debug, Clone)]
pub struct SharedRail {
    engine: XfemEngine,
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
    /// they are not known before the run ([`Case::rail_key`]).
    ///
    /// Errors: the rail cannot be built.
    pub fn of(case: &Case) -> Result<Option<Self>, SharedRailError> {
        let Some(mut engine) = case.shareable_elements()? else { return Ok(None) };
        match case.engine.domain() {
            EngineDomain::Rail => drop(engine.body(&case.cracks)?),
            EngineDomain::HalfPlane | EngineDomain::HalfSpace => {
                drop(engine.background(&case.cracks)?.clone())
            }
        }
        Ok(Some(Self { engine }))
    }

    /// Passes them to `engine`, which would compute the same.
    pub(crate) fn give_to(&self, engine: &mut XfemEngine) {
        engine.take_over(&self.engine);
    }
}

/// Mesh, supports and elasticity of a rail, bit for bit: equal where rails can be shared.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct RailKey(String);

impl Case {
    /// The rail of this case: cases with equal keys can share a [`SharedRail`]. None where the run
    /// needs no mesh, or where its mesh depends on a plastic state that the run itself computes.
    #[must_use]
    pub fn rail_key(&self) -> Option<RailKey> {
        // Errors of its plastic stress are reported by the run.
        let engine = self.shareable_elements().ok().flatten()?;
        Some(RailKey(engine.rail_in_words()))
    }

    fn shareable_elements(&self) -> Result<Option<XfemEngine>, CarriedStressError> {
        match (&self.plastic_stress, self.engine) {
            (Some(PlasticSource::Rolled), _) => Ok(None),
            (None, engine) if engine.domain() != EngineDomain::Rail => Ok(None),
            _ => Ok(Some(self.finite_elements(self.plastic_field(None)?.as_ref()))),
        }
    }
}
