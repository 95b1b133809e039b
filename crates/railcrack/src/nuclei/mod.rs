//! Nuclei of strain in the half-plane: the interaction of dislocations, and its expansion between
//! cracks that are farther apart than their size. Both engines use the expansion for long rows of
//! cracks; between cracks that are near to each other they share no code.

mod far;
mod kernel;
mod units;

pub(crate) use far::{FarRow, Source, SourceSite};
pub(crate) use kernel::{Interaction, Split, collinear_constant, split_image_interaction, split_interaction};
pub(crate) use units::Units;
