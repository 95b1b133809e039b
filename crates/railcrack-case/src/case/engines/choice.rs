//! The engine that a case chooses.

use super::case_engine::CaseEngine;
use super::dislocation::Dislocations;
use super::space::Space;
use super::xfem::Xfem;
use crate::tables::Engine;

/// The engine of a case.
pub(in crate::case) fn of(engine: Engine) -> &'static dyn CaseEngine {
    match engine {
        Engine::Xfem => &Xfem,
        Engine::Dislocation => &Dislocations,
        Engine::Space => &Space,
    }
}
