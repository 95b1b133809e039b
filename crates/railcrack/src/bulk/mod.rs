//! Finite elements of the uncracked rail: supports, stiffness and its factor, and the effect of the
//! ends on the stress under the wheel.

mod boundary;
mod correction;
mod gauss_stress;
mod rail;

pub use boundary::{BottomSupport, Boundary, SideSupport};
pub use correction::{BlockCorrection, CorrectionAtPoints, ElasticField, WheelAt};
pub use gauss_stress::StressAtPoints;
pub(crate) use gauss_stress::gauss_lines;
#[cfg(test)]
pub(crate) use rail::RectangleStiffness;
pub use rail::{BulkError, BulkRail, RailStiffness};

#[cfg(test)]
mod correction_tests;
#[cfg(test)]
mod patch_tests;
