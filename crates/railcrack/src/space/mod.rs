//! Planar cracks with curved fronts in the half-space.

mod body;
mod cell;
mod duffy;
mod galerkin;
mod grid;
mod image_table;
#[rustfmt::skip]
mod mindlin_image;
mod nuclei;
mod patch;
mod plane;
mod shape;

pub use body::{FrontPoint, FrontSif, SpaceBody, SpaceError};
pub use grid::SpaceResolution;
pub use nuclei::{Symmetric, image_stress, kelvin_stress, moment, traction};
pub use plane::{PlaneFrame, Surroundings};
pub use shape::{Extent, ShapeError, SpaceCrack};
