//! Numbers that depend on the geometry of a case alone, each computed once for a study.

use super::case::Case;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Mutex, PoisonError};

/// Values by the part of the case that sizes depend on: thousands of runs of a study often have the
/// same cracks.
#[derive(Debug)]
pub struct ByGeometry<T>(Mutex<HashMap<String, T>>);

impl<T> Default for ByGeometry<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T: Copy> ByGeometry<T> {
    /// The value of `case`, which `compute` gives for the first case of its geometry. It must
    /// depend on steel, rail, cracks, mesh, engine, network, given plastic stress and number of
    /// positions only. The lock is not held while it is computed.
    pub fn value(&self, case: &Case, compute: impl FnOnce() -> T) -> T {
        let key = geometry(case);
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(&key) {
            return *found;
        }
        let computed = compute();
        known().insert(key, computed);
        computed
    }
}

/// Everything that the sizes of a case depend on, bit for bit.
fn geometry(case: &Case) -> String {
    let plastic = case.plastic_stress().map(|source| {
        let mut hasher = DefaultHasher::new();
        source.companion().map(|file| file.text).hash(&mut hasher);
        hasher.finish()
    });
    let plane = case.plane().map(|plane| (plane.engine, plane.boundary, plane.section, plane.mesh));
    let grows = case.outgrows_first_mesh();
    format!(
        "{:?}",
        (
            (plane, case.space(), case.network, case.rail, case.steel),
            (grows, case.positions(case.first_wheel()).len(), &case.cracks, plastic),
        )
    )
}
