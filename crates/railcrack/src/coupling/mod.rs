//! The wheel that feels the cracks: nodes of the running surface, their compliance, and the forces
//! of their tractions on the crack faces.

mod compliance;
mod grid;
mod wheel;

pub use wheel::{CoupledContact, WheelCoupling, gap_in_plane};
