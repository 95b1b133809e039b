//! What runs of a study have in common.

use super::carried::CarriedStressError;
use super::case::Case;
use crate::tables::{Engine, PlasticSource};
use railcrack::body::{BodyEngine, BodyError};
use railcrack::xfem::{XfemEngine, XfemError};
use thiserror::Error;

/// Mesh, factor and columns of a rail for several runs whose cracks begin the same.
#[derive(Debug, Clone)]
pub struct SharedRail {
    engine: XfemEngine,
}

/// A rail that cannot be made.
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
    /// What the finite elements of `case` keep after its first step, or after the balance of its plastic stress where another engine
    /// computes the cracks. None where nothing is kept, or where it is not known before the run ([`Case::rail_key`]).
    ///
    /// Errors: the rail cannot be made.
    pub fn of(case: &Case) -> Result<Option<Self>, SharedRailError> {
        let Some(mut engine) = case.shareable_elements()? else { return Ok(None) };
        match case.engine {
            Engine::Xfem => drop(engine.body(&case.cracks)?),
            Engine::Dislocation => drop(engine.background(&case.cracks)?.clone()),
        }
        Ok(Some(Self { engine }))
    }

    /// Gives to `engine` what it would make itself.
    pub(crate) fn give_to(&self, engine: &mut XfemEngine) {
        engine.take_over(&self.engine);
    }
}

/// What tells rails apart: mesh, supports and elasticity, bit for bit.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct RailKey(String);

impl Case {
    /// The rail that a [`SharedRail`] of this case is of: cases with the same one share it. None where the run needs no mesh, or where its mesh
    /// depends on a plastic state that the run itself computes.
    pub fn rail_key(&self) -> Option<RailKey> {
        // What is wrong with its plastic stress, the run says itself.
        let engine = self.shareable_elements().ok().flatten()?;
        Some(RailKey(engine.rail_in_words()))
    }

    fn shareable_elements(&self) -> Result<Option<XfemEngine>, CarriedStressError> {
        match (&self.plastic_stress, self.engine) {
            (Some(PlasticSource::Rolled), _) | (None, Engine::Dislocation) => Ok(None),
            _ => Ok(Some(self.finite_elements(self.plastic_field(None)?.as_ref()))),
        }
    }
}
