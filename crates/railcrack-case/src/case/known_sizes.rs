//! Sizes of the cases of a study, each computed once.

use super::case::Case;
use super::engines;
use super::size::RunSize;
use crate::tables::{EngineDomain, PlasticSource};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Mutex, PoisonError};

/// Size that a case requires, before anything is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WantedSize {
    /// Displacement unknowns of the mesh.
    pub unknowns: f64,
    /// Face points.
    pub points: f64,
}

/// Sizes by the part of the case that they depend on: thousands of runs of a study often have the
/// same cracks.
#[derive(Debug, Default)]
pub struct KnownSizes {
    wanted: Mutex<HashMap<String, WantedSize>>,
    sizes: Mutex<HashMap<String, RunSize>>,
}

impl KnownSizes {
    /// The size of the run of `case`, [`Case::size`].
    pub fn size(&self, case: &Case) -> RunSize {
        of(&self.sizes, geometry(case), || case.size())
    }

    pub(super) fn wanted(&self, case: &Case) -> WantedSize {
        of(&self.wanted, geometry(case), || WantedSize {
            // The rail of the finite elements also carries the residual stress of the other engine.
            unknowns: match case.engine.domain() == EngineDomain::Rail || case.plastic_stress.is_some() {
                true => case.wanted_mesh_unknowns(),
                false => 0.0,
            },
            points: engines::of(case.engine).wanted_face_points(case),
        })
    }
}

/// The value of `key`, computed without holding the lock.
fn of<T: Copy>(known: &Mutex<HashMap<String, T>>, key: String, compute: impl FnOnce() -> T) -> T {
    let known = || known.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = known().get(&key) {
        return *found;
    }
    let computed = compute();
    known().insert(key, computed);
    computed
}

/// Everything that the sizes of a case depend on, bit for bit.
fn geometry(case: &Case) -> String {
    let text = |text: &str| {
        let mut hasher = DefaultHasher::new();
        text.hash(&mut hasher);
        hasher.finish()
    };
    let plastic = match &case.plastic_stress {
        Some(PlasticSource::Field(file)) => Some(text(file.text())),
        Some(PlasticSource::Profile(file)) => Some(text(file.text())),
        Some(PlasticSource::Rolled) => Some(0),
        None => None,
    };
    let fronts = case.space.as_ref().map(|space| &space.shapes);
    let grows = case.outgrows_first_mesh();
    format!(
        "{:?}",
        (
            (case.engine, case.network, &case.mesh, &case.rail, case.steel),
            (grows, case.positions().len(), &case.cracks, fronts, plastic),
        )
    )
}
