//! The finite-element engine.

mod clamped_block;
mod contact_pressure;
mod convergence;
mod edge_crack;
mod engines;
mod histories;
mod junctions;
mod neighbours;
mod networks;
mod random_cracks;
mod random_networks;
mod shifted_mesh;
mod short_increments;
mod sif_domain;
mod slant_crack;
mod symmetry;
mod unlike_lengths;
