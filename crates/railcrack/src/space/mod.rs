//! Planar cracks with curved fronts in the half-space.

mod body;
mod cell;
mod contact;
mod cross;
mod distance;
mod duffy;
mod front_advance;
mod front_motion;
mod galerkin;
mod grid;
mod image_table;
mod linearised;
mod mindlin_image;
mod mouth_pair;
mod nuclei;
mod passage;
mod patch;
mod plane;
mod rail;
mod records;
mod shape;
mod slip_origin;
mod stabilised;
mod states;
mod tips;
mod wheel;
mod worn;

pub use body::{
    CloseCracks, CrackPart, FrontPoint, FrontSif, LEAST_DISTANCE, SpaceBody, SpaceError, SpaceKernel,
};
pub use contact::{SpaceContact, SpaceContactError, SpaceFaces, StepReport};
pub use front_motion::VERTEX_LAYER;
pub use grid::SpaceResolution;
pub use nuclei::{Symmetric, image_stress, kelvin_stress, moment, traction};
pub use passage::{SpaceHistory, SpaceLoad, SpacePassageSettings, SpacePassages, StressAt, space_passage};
pub use plane::{PlaneFrame, Surroundings};
pub use rail::{CracksInSpace, SpaceRail, SpaceWheel};
pub use shape::{Extent, ShapeError, SpaceCrack};
pub use stabilised::{StabilisedSpace, stabilised_space_passage};
pub use states::SpaceStatus;
pub use wheel::EllipticWheel;
