//! Results of a shakedown computation, as its folder shows them.

use railcrack::fatigue::{DangVan, Initiation};
use railcrack::math::RailBox;
use railcrack::shakedown::{DepthBounds, FirstYield, MapPoint, RolledRail, ShakedownLimit, StabilisedRail};

/// Everything that the folder shows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ShakedownResults {
    /// Heading.
    pub title: String,
    /// The rail and its wheel.
    pub rail: RolledRail,
    /// The stabilised state.
    pub stabilised: StabilisedRail,
    /// With the direct method: the state reached passage by passage, for comparison.
    pub pass_by_pass: Option<StabilisedRail>,
    /// The criterion.
    pub dang_van: DangVan,
    /// The criterion at the surface, then in every layer.
    pub initiation: Initiation,
    /// First yield under the contact.
    pub first_yield: FirstYield,
    /// Limit of elastic shakedown under it.
    pub limit: ShakedownLimit,
    /// Shakedown limits by depth.
    pub bounds: Vec<DepthBounds>,
    /// First yield and limit of shakedown over friction.
    pub map: Vec<MapPoint>,
    /// Length and depth of the rail in `plastic.vtu`.
    pub extent: RailBox,
    /// Wall time, s.
    pub wall_s: f64,
    /// Remarks for the reader.
    pub warnings: Vec<String>,
}
