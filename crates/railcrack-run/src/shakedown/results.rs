//! Results of a shakedown computation, as its folder shows them.

use railcrack::fatigue::{DangVan, DepthValue, Initiation};
use railcrack::math::RailBox;
use railcrack::shakedown::space::StabilisedSpace;
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
    /// Under a patch: the state across the rail, of which the others show one plane.
    pub section: Option<SectionResults>,
}

/// The state across the rail.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SectionResults {
    /// b, mm.
    pub lateral_half_width: f64,
    /// Lateral place of the profile, mm.
    pub lateral: f64,
    /// The criterion of Dang Van in each computed row.
    pub by_row: Vec<Initiation>,
    /// The state.
    pub state: StabilisedSpace,
}

impl SectionResults {
    /// The place where a crack starts first: its lateral place (mm) and the value.
    pub fn critical(&self) -> Option<(f64, DepthValue)> {
        let first = self.state.computed_rows().start;
        let of = |(row, own): (usize, &Initiation)| (self.state.laterals[first + row], own.critical());
        let worse = |one: (f64, DepthValue), other: (f64, DepthValue)| {
            if other.1.worst.value > one.1.worst.value { other } else { one }
        };
        self.by_row.iter().enumerate().map(of).reduce(worse)
    }
}
