//! Several runs of one rail.

use super::error::RunError;
use railcrack_case::{Engine, PlaneEngine};
use rayon::prelude::*;

/// The results of `of` for `all` by `engine`: at once, except by finite elements, of which several
/// bodies may not fit into the memory.
pub(super) fn of_each<A: Sync, T: Send>(
    all: &[A],
    engine: Engine,
    of: impl Fn(&A) -> Result<T, RunError> + Sync + Send,
) -> Result<Vec<T>, RunError> {
    match engine {
        Engine::Plane(PlaneEngine::Dislocation) => all.par_iter().map(of).collect(),
        _ => all.iter().map(of).collect(),
    }
}
