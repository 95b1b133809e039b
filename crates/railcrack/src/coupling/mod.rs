//! The wheel that feels the cracks: nodes of the running surface, their compliance, and the forces
//! of their tractions on the crack faces.

mod compliance;
mod grid;
mod loads;
mod uneven_shear;
mod unfelt_gap;
mod wheel;

pub use unfelt_gap::gap_in_plane;
pub use wheel::{CoupledContact, WheelCoupling};
