//! `[rail]`: elasticity, extent and boundary of the rail.

use crate::schema::{
    Choice, NumberRange, RangeEnd, Report, SectionValues, Word, choice, closed, number, positive, section,
    within,
};
use railcrack::bulk::{BottomSupport, Boundary, SideSupport};
use railcrack::material::IsotropicElastic;

/// \[0, 1/2).
const POISSON_RATIOS: NumberRange = NumberRange { min: RangeEnd::Closed(0.0), max: RangeEnd::Open(0.5) };

const NO_SUPPORTS: &str = "a half-plane has no supports";

section! {
    RAIL "rail", Defaulted,
        "The rail: linear elastic steel in plane strain below the running surface y = 0.";
    YOUNG_MODULUS: f64 =
        number("young_modulus_mpa", "MPa", closed(1.0, 1e7), 210e3, "Young's modulus of rail and wheel.");
    POISSON_RATIO: f64 =
        number("poisson_ratio", "", POISSON_RATIOS, 0.3, "Poisson's ratio of rail and wheel.");
    WIDTH: f64 = number("width_mm", "mm", positive(1e5), 300.0,
        "Length of the rail along x; cracks must stay within it.");
    DEPTH: f64 = number("depth_mm", "mm", positive(1e5), 172.0, "Depth of the rail; cracks must stay above it.");
    CENTRE: f64 = number("centre_mm", "mm", within(1e6), 0.0,
        "Middle of that length; without it, the middle of the crack mouths.").optional();
    BOUNDARY: BoundaryKind = choice("boundary", "Boundary of the rail.");
    BOTTOM: BottomSupport = choice("bottom", "Support of the bottom of a block.")
        .only_with(BOUNDARY, BLOCK.name, NO_SUPPORTS);
    SIDES: SideSupport = choice("sides", "Support of the sides of a block.")
        .only_with(BOUNDARY, BLOCK.name, NO_SUPPORTS);
}

/// The two kinds of [`Boundary`], without their supports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoundaryKind {
    HalfPlane,
    Block,
}

const BLOCK: Word =
    Word::now("block", "a block of width_mm times depth_mm on supports; finite-element engine only");

impl Choice for BoundaryKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::HalfPlane, Word::now("half-plane", "no boundary but the running surface")),
        (Self::Block, BLOCK),
    ];
}

impl Choice for BottomSupport {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Clamped, Word::now("clamped", "no displacement")),
        (Self::Rollers, Word::now("rollers", "no vertical displacement, one point held along x")),
    ];
}

impl Choice for SideSupport {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Free, Word::now("free", "no traction")),
        (Self::Rollers, Word::now("rollers", "no horizontal displacement")),
        (Self::Clamped, Word::now("clamped", "no displacement")),
    ];
}

/// Extent of the rail: cracks stay in `centre` ± `width` / 2 and above −`depth`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rail {
    /// Length along x, mm.
    pub width: f64,
    /// Depth, mm.
    pub depth: f64,
    /// Abscissa of the middle, mm.
    pub centre: f64,
    /// Half-plane, or a block with its supports.
    pub boundary: Boundary,
}

impl Rail {
    /// The rail; `middle` (mm) is that of the crack mouths.
    pub(crate) fn read(section: &SectionValues, middle: Option<f64>) -> Option<Self> {
        if section.is_refused(CENTRE) {
            return None;
        }
        Some(Self {
            width: section.get(WIDTH)?,
            depth: section.get(DEPTH)?,
            centre: section.get(CENTRE).or(middle)?,
            boundary: match section.get(BOUNDARY)? {
                BoundaryKind::HalfPlane => Boundary::HalfPlane,
                BoundaryKind::Block => {
                    Boundary::Block { bottom: section.get(BOTTOM)?, sides: section.get(SIDES)? }
                }
            },
        })
    }

    /// Abscissae of the two ends, mm.
    #[must_use]
    pub fn ends(&self) -> (f64, f64) {
        (self.centre - 0.5 * self.width, self.centre + 0.5 * self.width)
    }
}

/// A boundary in the words of case files: `half-plane`, `block, bottom clamped, sides free`.
#[must_use]
pub fn boundary_name(boundary: Boundary) -> &'static str {
    use {BottomSupport as Bottom, SideSupport as Sides};
    match boundary {
        Boundary::HalfPlane => "half-plane",
        Boundary::Block { bottom, sides } => match (bottom, sides) {
            (Bottom::Clamped, Sides::Free) => "block, bottom clamped, sides free",
            (Bottom::Clamped, Sides::Rollers) => "block, bottom clamped, sides rollers",
            (Bottom::Clamped, Sides::Clamped) => "block, bottom clamped, sides clamped",
            (Bottom::Rollers, Sides::Free) => "block, bottom rollers, sides free",
            (Bottom::Rollers, Sides::Rollers) => "block, bottom rollers, sides rollers",
            (Bottom::Rollers, Sides::Clamped) => "block, bottom rollers, sides clamped",
        },
    }
}

/// The steel of rail and wheel.
pub(crate) fn read_steel(section: &SectionValues, report: &mut Report) -> Option<IsotropicElastic> {
    let (young, poisson) = (section.get(YOUNG_MODULUS)?, section.get(POISSON_RATIO)?);
    IsotropicElastic::new(young, poisson).map_err(|error| report.add(section.fault_of_all(error))).ok()
}
