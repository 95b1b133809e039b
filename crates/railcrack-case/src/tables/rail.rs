//! `[rail]`: elasticity, extent and boundary of the rail.

use crate::schema::{
    Choice, NumberRange, Report, SectionValues, Word, choice, closed, number, positive, read_by_word,
    section, within,
};
use railcrack::bulk::{BottomSupport, Boundary, SideSupport};
use railcrack::material::IsotropicElastic;
use railcrack::math::RailBox;

/// An incompressible rail has no displacement elements: towards 1/2 they lock.
const POISSON_RATIOS: NumberRange = NumberRange::closed(0.0, 0.499);

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
        "x coordinate of the middle of the rail; by default the middle of the crack mouths.").optional();
    BOUNDARY: BoundaryKind = choice("boundary", "Boundary of the rail.");
    BOTTOM: BottomSupport = choice("bottom", "Support of the bottom of a block.")
        .only_with(BOUNDARY, BLOCK.name, NO_SUPPORTS);
    SIDES: SideSupport = choice("sides", "Support of the sides of a block.")
        .only_with(BOUNDARY, BLOCK.name, NO_SUPPORTS);
}

read_by_word!(BoundaryKind, BottomSupport, SideSupport);

/// The two kinds of [`Boundary`], without their supports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoundaryKind {
    HalfPlane,
    Block,
}

const BLOCK: Word =
    Word::now("block", "a supported block of width_mm by depth_mm; finite-element engine only");

impl Choice for BoundaryKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::HalfPlane, Word::now("half-plane", "bounded by the running surface only")),
        (Self::Block, BLOCK),
    ];
}

/// Extent and boundary of the rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rail {
    /// Cracks stay within it.
    pub extent: RailBox,
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
            extent: RailBox {
                width: section.get(WIDTH)?,
                depth: section.get(DEPTH)?,
                centre: section.get(CENTRE).or(middle)?,
            },
            boundary: match section.get(BOUNDARY)? {
                BoundaryKind::HalfPlane => Boundary::HalfPlane,
                BoundaryKind::Block => {
                    Boundary::Block { bottom: section.get(BOTTOM)?, sides: section.get(SIDES)? }
                }
            },
        })
    }
}

/// The steel of rail and wheel.
pub(crate) fn read_steel(section: &SectionValues, report: &mut Report) -> Option<IsotropicElastic> {
    let (young, poisson) = (section.get(YOUNG_MODULUS)?, section.get(POISSON_RATIO)?);
    IsotropicElastic::new(young, poisson).map_err(|error| report.add(section.fault_of_all(error))).ok()
}
