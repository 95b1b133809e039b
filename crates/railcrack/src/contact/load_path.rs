//! Loads as functions of a path coordinate.

/// The load of a path: nodal forces as a function of one coordinate.
pub trait LoadPath: Sync {
    /// Nodal forces (N/mm, 2p) at coordinate `at`.
    fn nodal_forces(&self, at: f64) -> Vec<f64>;

    /// The pressure (MPa) at coordinate `at` over the mouth of each pocket of fluid whose pressure
    /// is an unknown; none where there are none.
    fn over_mouths(&self, _at: f64) -> Vec<f64> {
        Vec::new()
    }

    /// Whether the coordinate is the position (mm) of a wheel that feels the cracks.
    fn is_of_coupled_wheel(&self) -> bool {
        false
    }
}
