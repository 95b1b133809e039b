//! The stabilised passage, of all faces together or group by group.

use super::face_load::FaceLoad;
use super::passage::passages_of_all;
use super::rail_load::RailLoad;
use super::sweeps::passages_by_groups;
use crate::contact::{ContactSolver, FaceProblem};
use crate::growth::{Observer, PassageError, PassageSettings, StabilisedPassage};

/// The stabilised passage over fixed cracks. Residual stress is ramped up on virgin faces; then the
/// wheel passes until the histories of K of two consecutive passages agree. Faces without friction
/// have no memory, and one passage is enough. The wheel arrives from infinity and leaves to
/// infinity; in a rail with ends, its load is ramped up at the first position and down at the last.
///
/// Where the wheel bends the rail, the passage and its output positions extend as far as the
/// deflection of the beam.
///
/// In a body built by groups, each crack is followed with its neighbours, in sweeps until K is
/// within `network_tolerance`.
///
/// Errors: inadmissible settings; a wheel that leaves the rail; contact that does not converge; an
/// interruption by `observer`.
pub fn stabilised_passage(
    problem: &FaceProblem,
    solver: &dyn ContactSolver,
    load: RailLoad,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    settings.check()?;
    let ends = problem.body().ends.as_ref().map(|rail| load.at_ends(rail, settings)).transpose()?;
    let face_load = FaceLoad::new(problem, load, ends.as_deref())?;
    passages_under(&face_load, load, solver, settings, observer)
}

/// [`stabilised_passage`] under a known load on the faces.
pub(super) fn passages_under(
    face_load: &FaceLoad,
    load: RailLoad,
    solver: &dyn ContactSolver,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    match &face_load.problem.body().blocks {
        Some(blocks) => passages_by_groups(face_load, blocks, load, solver, settings, observer),
        None => passages_of_all(face_load, load, solver, settings, observer),
    }
}
