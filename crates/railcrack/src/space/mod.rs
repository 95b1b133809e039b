//! Planar cracks with curved fronts in the half-space.

mod body;
mod cell;
mod contact;
mod duffy;
mod galerkin;
mod grid;
mod image_table;
mod mindlin_image;
mod mouth_pair;
mod nuclei;
mod passage;
mod patch;
mod plane;
mod shape;
mod wheel;

pub use body::{FrontPoint, FrontSif, SpaceBody, SpaceError};
pub use contact::{SpaceContact, SpaceContactError, SpaceFaces, SpaceStatus, StepReport};
pub use grid::SpaceResolution;
pub use nuclei::{Symmetric, image_stress, kelvin_stress, moment, traction};
pub use passage::{SpaceHistory, SpaceLoad, SpacePassageSettings, StressAt, space_passage};
pub use plane::{PlaneFrame, Surroundings};
pub use shape::{Extent, ShapeError, SpaceCrack};
pub use wheel::EllipticWheel;
