//! The finite-element engine.

mod convergence;
mod edge_crack;
mod histories;
mod random_cracks;
mod sif_domain;
mod slant_crack;
