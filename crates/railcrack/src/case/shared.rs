//! What runs of a study have in common.

use super::validated::{Case, Engine};
use crate::body::{BodyEngine, BodyError};
use crate::xfem::XfemEngine;

/// Mesh, factor and columns of a rail for several runs whose cracks begin the same.
#[derive(Debug, Clone)]
pub struct SharedRail {
    engine: XfemEngine,
}

impl SharedRail {
    /// What the finite-element engine keeps after the first step of `case`; none with an engine that keeps nothing.
    ///
    /// Errors: the engine cannot represent the cracks.
    pub fn of(case: &Case) -> Result<Option<Self>, BodyError> {
        match case.engine {
            Engine::Dislocation => Ok(None),
            Engine::Xfem => {
                let mut engine = case.xfem_engine();
                engine.body(&case.cracks)?;
                Ok(Some(Self { engine }))
            }
        }
    }

    /// The engine of `case`, with what it can take over of this.
    pub(super) fn engine_of(&self, case: &Case) -> XfemEngine {
        let mut engine = case.xfem_engine();
        engine.take_over(&self.engine);
        engine
    }
}

/// What tells rails apart: mesh, supports and elasticity, bit for bit.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct RailKey(String);

impl Case {
    /// The rail that a [`SharedRail`] of this case is of: cases with the same one share it. None with an engine that keeps nothing.
    pub fn rail_key(&self) -> Option<RailKey> {
        match self.engine {
            Engine::Dislocation => None,
            Engine::Xfem => Some(RailKey(self.xfem_engine().rail_in_words())),
        }
    }
}
