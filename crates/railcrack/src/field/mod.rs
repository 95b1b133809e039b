//! Stress fields of the uncracked rail: fixed fields, and those of wheels that move along it.

mod carter;
mod depth_profile;
#[cfg(test)]
mod field_checks;
mod front_spread;
mod hertz_displacement;
mod hertz_half_plane;
mod patch_directions;
mod patch_table;
#[cfg(test)]
mod patch_tests;
mod patch_wheel;
mod table;
mod table_potential;
mod wheel;
mod wheel_under;

pub use carter::CarterWheel;
pub(crate) use carter::FlatPunch;
pub use depth_profile::{DepthProfile, ProfileError};
pub use front_spread::{CrackLine, PlaceOnCrack, StressesByPosition, StressesOnCracks};
pub(crate) use hertz_displacement::HertzDisplacement;
pub use hertz_half_plane::HertzField;
pub use patch_directions::{PatchLoad, Spread, StripTraction};
pub use patch_wheel::PatchWheel;
pub use table::TableWheel;
pub(crate) use table::{SegmentEnd, SegmentStress};
pub use wheel::{
    BendingWheel, EndField, EndsError, HertzWheel, PlacedWheel, RailEnds, StressesUnderWheel, Wheel, Wheels,
    WheelsError,
};
pub use wheel_under::{on_track, wheel_under};

use crate::math::{Stress, Vec2};
use std::sync::Arc;

/// A stress field of the uncracked rail that does not depend on the wheel; fields add.
pub trait StressField: Send + Sync {
    /// The stress (MPa) at `point` (mm).
    fn stress(&self, point: Vec2) -> Stress;
}

/// A field shared by several loads.
impl<T: StressField + ?Sized> StressField for Arc<T> {
    fn stress(&self, point: Vec2) -> Stress {
        self.as_ref().stress(point)
    }
}

/// The sum of fields.
pub struct Sum(pub Vec<Box<dyn StressField>>);

impl StressField for Sum {
    fn stress(&self, point: Vec2) -> Stress {
        self.0.iter().fold(Stress::ZERO, |sum, field| sum + field.stress(point))
    }
}

/// The same stress everywhere: remote tension, for instance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uniform(pub Stress);

impl Uniform {
    /// σ_xx = `xx` (MPa) alone: remote tension along the rail, or the stress of a rail below its
    /// neutral temperature ([`crate::load::Temperature::stress`]).
    pub fn along_rail(xx: f64) -> Self {
        Self(Stress { xx, ..Stress::ZERO })
    }
}

impl StressField for Uniform {
    fn stress(&self, _: Vec2) -> Stress {
        self.0
    }
}
