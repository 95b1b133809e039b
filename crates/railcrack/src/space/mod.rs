//! Cracks with curved fronts in the half-space.

mod bilinear;
mod body;
mod cell;
mod contact;
mod corner_sums;
mod cross;
mod distance;
mod duffy;
mod face_problem;
mod fluid;
mod fold;
mod front_advance;
mod front_motion;
mod galerkin;
mod grid;
mod image_table;
mod linearised;
mod mindlin_image;
mod mirror;
mod mirror_image;
mod mouth_pair;
mod nuclei;
mod passage;
mod patch;
mod plane;
mod rail;
mod records;
mod shape;
mod shapes;
mod slip_origin;
mod stabilised;
mod states;
mod tips;
mod trapped;
mod unfelt_gap;
mod wheel;
mod worn;

pub use bilinear::{BilinearPatch, StripTraction, WheelPatch};
pub use body::{CloseCracks, CrackPart, FrontPoint, FrontSif, SpaceBody, SpaceError, SpaceKernel};
pub use contact::{SpaceContact, SpaceContactError, StepReport};
pub use fluid::SpaceFluid;
pub use fold::{FoldError, FoldedBodyError, FoldedCrack, FoldedResolution};
pub use front_motion::VERTEX_LAYER;
pub use grid::SpaceResolution;
pub use nuclei::{Symmetric, image_stress, kelvin_stress, moment, traction};
pub use passage::{
    SpaceFluidLoad, SpaceHistory, SpaceLoad, SpacePassageSettings, SpacePassages, space_passage,
};
pub use plane::{PlaneFrame, Surroundings};
pub use rail::{CracksInSpace, SpaceRail, SpaceWheel};
pub use shape::{Extent, ShapeError, SpaceCrack};
pub use shapes::{ShapesError, body_of};
pub use states::{SpaceFaces, SpaceStatus};
pub use unfelt_gap::UnfeltWheel;
pub use wheel::EllipticWheel;
pub use worn::LEAST_STRIP;
