//! `[rail]`: elasticity, extent and boundary of the rail.

use super::track::{RAIL_SECTION, SectionName};
use crate::schema::{
    Choice, NumberRange, Report, SectionValues, Word, choice, closed, number, read_by_word, section, within,
};
use railcrack::bulk::{BottomSupport, Boundary, SideSupport};
use railcrack::crack::CrackNetwork;
use railcrack::load::NamedSection;
use railcrack::material::IsotropicElastic;
use railcrack::math::RailBox;
use railcrack::section::{SectionEngine, SectionLayers};

/// An incompressible rail has no displacement elements: towards 1/2 they lock.
const POISSON_RATIOS: NumberRange = NumberRange::closed(0.0, 0.499);

/// Largest width, mm.
const WIDEST: f64 = 1e5;
/// Width (mm) that is enough for a crack and its growth.
const USUAL_WIDTH: f64 = 300.0;

const NO_SUPPORTS: &str = "a half-plane has no supports";
const NO_SECTION: &str = "a block has a depth of its own";

section! {
    RAIL "rail", Defaulted,
        "The rail: linear elastic steel in plane strain below the running surface y = 0.";
    YOUNG_MODULUS: f64 =
        number("young_modulus_mpa", "MPa", closed(1.0, 1e7), 210e3, "Young's modulus of rail and wheel.");
    POISSON_RATIO: f64 =
        number("poisson_ratio", "", POISSON_RATIOS, 0.3, "Poisson's ratio of rail and wheel.");
    WIDTH: f64 = number("width_mm", "mm", closed(0.01, WIDEST), USUAL_WIDTH,
        "Length of the rail along x; cracks must stay within it. By default 300; a half-plane without centre_mm reaches 150 mm beyond cracks that need more.").optional();
    DEPTH: f64 = number("depth_mm", "mm", closed(0.01, 1e5), 172.0, "Depth of the rail; cracks must stay above it.");
    CENTRE: f64 = number("centre_mm", "mm", within(1e6), 0.0,
        "x of the middle of the rail; by default the middle of the crack mouths.").optional();
    BOUNDARY: BoundaryKind = choice("boundary", "Boundary of the rail.");
    BOTTOM: BottomSupport = choice("bottom", "Support of the bottom of a block.")
        .only_with(BOUNDARY, BLOCK.name, NO_SUPPORTS);
    SIDES: SideSupport = choice("sides", "Support of the sides of a block.")
        .only_with(BOUNDARY, BLOCK.name, NO_SUPPORTS);
    CRACKED_SECTION: CrackedSection = choice("section", "Section of the cracked rail, on the foundation of [track]; cracks must stay in its head. By default a half-plane, too stiff for cracks deeper than 5 mm.")
        .optional()
        .only_with(BOUNDARY, HALF_PLANE.name, NO_SECTION);
}

read_by_word!(BoundaryKind, BottomSupport, SideSupport, CrackedSection);

/// The section of a cracked rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CrackedSection {
    Named(SectionName),
    /// That of the track.
    OfTrack,
}

const NAMES: &[(SectionName, Word)] = SectionName::WORDS;

impl Choice for CrackedSection {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Named(NAMES[0].0), NAMES[0].1),
        (Self::Named(NAMES[1].0), NAMES[1].1),
        (Self::Named(NAMES[2].0), NAMES[2].1),
        (Self::Named(NAMES[3].0), NAMES[3].1),
        (Self::Named(NAMES[4].0), NAMES[4].1),
        (Self::Named(NAMES[5].0), NAMES[5].1),
        (Self::OfTrack, Word::now("track", "the named section of [track]")),
    ];
}

/// The two kinds of [`Boundary`], without their supports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoundaryKind {
    HalfPlane,
    Block,
}

const HALF_PLANE: Word = Word::now("half-plane", "bounded by the running surface only");
const BLOCK: Word =
    Word::now("block", "a supported block of width_mm by depth_mm; finite-element engine only");

impl Choice for BoundaryKind {
    const WORDS: &'static [(Self, Word)] = &[(Self::HalfPlane, HALF_PLANE), (Self::Block, BLOCK)];
}

/// Extent, boundary and section of the rail.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rail {
    /// Cracks stay within it.
    pub extent: RailBox,
    /// Half-plane, or a block with its supports.
    pub boundary: Boundary,
    /// The section that makes the cracked rail more compliant than the half-plane.
    pub section: Option<&'static NamedSection>,
}

impl Rail {
    /// The rail of the cracks `network` on the `track`.
    pub(crate) fn read(
        section: &SectionValues,
        track: Option<&SectionValues>,
        network: Option<&CrackNetwork>,
    ) -> Option<Self> {
        if section.is_refused(CENTRE) || section.is_refused(WIDTH) {
            return None;
        }
        let middle = network.map(|network| 0.5 * (network.leftmost_mouth() + network.rightmost_mouth()));
        let centre = section.get(CENTRE).or(middle)?;
        let boundary = match section.get(BOUNDARY)? {
            BoundaryKind::HalfPlane => Boundary::HalfPlane,
            BoundaryKind::Block => {
                Boundary::Block { bottom: section.get(BOTTOM)?, sides: section.get(SIDES)? }
            }
        };
        let width = match (section.get(WIDTH), boundary, network) {
            (Some(given), ..) => given,
            (None, Boundary::HalfPlane, Some(network)) if !section.is_given(CENTRE) => {
                reaching(network, centre)
            }
            // The width of a block belongs to its supports.
            (None, ..) => USUAL_WIDTH,
        };
        let named = section.get(CRACKED_SECTION).and_then(|given| match given {
            CrackedSection::Named(name) => NamedSection::of(name.word()),
            CrackedSection::OfTrack => NamedSection::of(track?.get(RAIL_SECTION)?.word()),
        });
        let head = named.and_then(SectionLayers::of).map_or(f64::INFINITY, |layers| layers.head.height);
        let depth = section.get(DEPTH)?.min(SectionEngine::DEEPEST * head);
        Some(Self { extent: RailBox { width, depth, centre }, boundary, section: named })
    }
}

/// The usual width (mm) where all cracks of `network` are within it, else that which leaves half of
/// it on either side of them.
fn reaching(network: &CrackNetwork, centre: f64) -> f64 {
    let points = network.cracks().iter().flat_map(|crack| crack.points());
    let farthest = points.map(|point| (point.x - centre).abs()).fold(0.0, f64::max);
    let is_within = farthest < 0.5 * USUAL_WIDTH;
    if is_within { USUAL_WIDTH } else { (2.0 * farthest + USUAL_WIDTH).min(WIDEST) }
}

/// The steel of rail and wheel.
pub(crate) fn read_steel(section: &SectionValues, report: &mut Report) -> Option<IsotropicElastic> {
    let (young, poisson) = (section.get(YOUNG_MODULUS)?, section.get(POISSON_RATIO)?);
    IsotropicElastic::new(young, poisson).map_err(|error| report.add(section.fault_of_all(error))).ok()
}
