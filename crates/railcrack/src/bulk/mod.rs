//! Finite elements of the uncracked rail: supports, stiffness and its factor, and the effect of the
//! ends on the stress under the wheel.

mod boundary;
mod cancel;
mod correction;
mod gauss_stress;
mod grid;
mod rail;
mod stiffness;

pub use boundary::{BottomSupport, Boundary, SideSupport};
pub use cancel::ElasticField;
pub use correction::{BlockCorrection, CorrectionAtPoints, WheelAt};
pub use gauss_stress::StressAtPoints;
pub(crate) use grid::gauss_lines;
pub use rail::{BulkError, BulkRail, RailStiffness};
#[cfg(test)]
pub(crate) use stiffness::RectangleStiffness;

#[cfg(test)]
mod correction_tests;
#[cfg(test)]
mod patch_tests;
