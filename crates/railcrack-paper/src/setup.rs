//! Inputs that the paper does not specify: boundary, travel, load steps, criterion, readings.

use crate::curve::PaperCurve;
use crate::edit::Edit;
use crate::steel::{STEELS, Steel};

/// Direction of travel with respect to the cracks of 15°, which lean towards +x as they go
/// down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Travel {
    /// The cracks lean along the travel: the wheel meets the mouth first, then passes over the tip.
    Along,
    /// They lean against it: the wheel passes over the tip first. Crack 9 of a network is met
    /// first.
    Against,
}

/// Extent of the runs of a set-up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Initial cracks and growth.
    Growth,
    /// Initial cracks, and growth of the reference case.
    ReferenceGrowth,
    /// Initial cracks.
    Initial,
}

/// One choice of the inputs that the paper does not specify.
pub struct Setup {
    /// Its name in files and tables.
    pub name: &'static str,
    /// Its description.
    pub words: &'static str,
    /// Extent of its runs.
    pub extent: Extent,
    /// The figures that it is computed for.
    pub figures: &'static [u8],
    /// The set-up that it is a variation of, by name.
    pub varies: Option<&'static str>,
    pub(super) travel: Travel,
    /// +1: positive friction drags the rail along the travel; −1: against it.
    pub(super) drag: f64,
    pub(super) body: Body,
    pub(super) twist: Twist,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Body {
    /// Half-plane by dislocations.
    HalfPlane,
    /// Half-plane by finite elements.
    HalfPlaneXfem,
    Block {
        bottom: &'static str,
        sides: &'static str,
    },
}

/// A further difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Twist {
    None,
    /// Load steps of 12 a over this number, without control.
    FixedSteps(usize),
    /// Direction of growth by another criterion.
    Direction(&'static str),
    FaceFriction(f64),
    /// Fig. 21 read as the plastic stress, which is still to be balanced.
    PlasticStress,
    /// The residual stress of a rail rolled in this steel instead of Fig. 21.
    Rolled(&'static Steel),
    Young(f64),
}

/// Extent of one run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    Initial,
    Growth,
}

/// The figures with results; 26 is a drawing.
const ALL: &[u8] = &[13, 14, 15, 16, 17, 18, 19, 20, 22, 23, 24, 25, 27, 28, 29, 30];
/// K of the single crack, and the paths with that of the reference case among them.
const FEW: &[u8] = &[13, 17, 19, 20, 22];
/// Those of the single crack.
/// Without the paths of Fig. 20: under a thin ligament a fixed step costs thousands of iterations.
const SINGLE: &[u8] = &[13, 14, 15, 16, 17, 18, 19, 22, 23];
/// Paths of the single crack. With the stress of Fig. 21 and negative k1 counted the crack turns
/// back under a ligament so thin that its contact takes hours.
const GROWN: &[u8] = &[16, 18, 20];
/// Those that friction of the wheel drives, and K for the inclination.
const DRAGGED: &[u8] = &[14, 15, 16, 17, 18, 19];

impl Setup {
    /// The text of the case of `curve` in this set-up.
    pub(super) fn text(&self, curve: &PaperCurve, stage: Stage) -> String {
        let mut edits = curve.edits();
        let sign = if self.travel == Travel::Along { self.drag } else { -self.drag };
        edits.push(Edit::number("contact", "friction", sign * curve.wheel_friction));
        if self.travel == Travel::Against {
            edits.push(Edit::number("passage", "to_over_a", -6.0));
            edits.push(Edit::number("passage", "from_over_a", 6.0));
        }
        match self.body {
            Body::HalfPlane => edits.push(Edit::text("solver", "engine", "dislocation")),
            Body::HalfPlaneXfem => edits.push(Edit::text("solver", "engine", "xfem")),
            Body::Block { bottom, sides } => {
                edits.push(Edit::text("solver", "engine", "xfem"));
                edits.push(Edit::text("rail", "sides", sides));
                edits.push(Edit::text("rail", "bottom", bottom));
                edits.push(Edit::text("rail", "boundary", "block"));
            }
        }
        match self.twist {
            Twist::None | Twist::PlasticStress => {}
            Twist::FixedSteps(steps) => {
                edits.push(Edit::integer("passage", "positions", steps + 1));
                edits.push(Edit::text("passage", "step_control", "fixed"));
            }
            Twist::Direction(criterion) => edits.push(Edit::text("growth", "direction", criterion)),
            Twist::FaceFriction(friction) => edits.push(Edit::number("crack", "friction", friction)),
            Twist::Rolled(steel) => {
                edits.push(Edit::text("residual_stress", "profile", &steel.profile_file()))
            }
            Twist::Young(modulus) => edits.push(Edit::number("rail", "young_modulus_mpa", modulus)),
        }
        if stage == Stage::Initial {
            edits.push(Edit::integer("growth", "steps", 0));
        }
        // No figure shows fields, and one costs as much as a growth step.
        edits.push(Edit::integer("output", "fields_every", 0));
        let text = match self.twist {
            Twist::PlasticStress => curve.file.text.replace("[residual_stress]", "[plastic_stress]"),
            _ => curve.file.text.to_owned(),
        };
        edits.iter().fold(text, |text, edit| edit.apply(&text))
    }

    /// Whether its load steps are fixed.
    pub(super) fn has_fixed_steps(&self) -> bool {
        matches!(self.twist, Twist::FixedSteps(_))
    }

    /// Whether it changes K of an initial crack without stress.
    pub(super) fn changes_k(&self) -> bool {
        !matches!(self.twist, Twist::Direction(_) | Twist::PlasticStress | Twist::Rolled(_))
    }

    /// Whether the cracks of `curve` grow in this set-up.
    pub(super) fn grows(&self, curve: &PaperCurve) -> bool {
        let block = matches!(self.body, Body::Block { .. });
        match (self.extent, self.twist) {
            // A pair with low friction takes as long there as the nine cracks of all set-ups.
            (_, Twist::FaceFriction(_)) if block => false,
            // The single cracks are needed for K only.
            (Extent::Growth, Twist::FaceFriction(_)) => matches!(curve.name, "pair" | "nine"),
            (Extent::Growth, _) => true,
            (Extent::ReferenceGrowth, _) => curve.name == "reference",
            (Extent::Initial, _) => false,
        }
    }

    /// Whether `curve` is another case here than in the set-up that this one varies.
    pub(super) fn concerns(&self, curve: &PaperCurve) -> bool {
        match self.twist {
            Twist::PlasticStress | Twist::Rolled(_) => {
                matches!(curve.name, "stress" | "nine-stress" | "one-stress" | "reference")
            }
            _ => true,
        }
    }
}

macro_rules! both_ways {
    ($(($stem:literal, $words:literal, $extent:ident, $figures:expr, $varies:expr, $drag:expr, $body:expr, $twist:expr)),* $(,)?) => {
        &[$(
            Setup {
                name: concat!($stem, ", along"),
                words: concat!($words, "; cracks lean along the travel"),
                extent: Extent::$extent,
                figures: $figures,
                varies: match $varies { Some(Main::HalfPlane) => Some("half-plane, along"), Some(Main::Block) => Some("block, along"), None => None },
                travel: Travel::Along,
                drag: $drag,
                body: $body,
                twist: $twist,
            },
            Setup {
                name: concat!($stem, ", against"),
                words: concat!($words, "; cracks lean against the travel"),
                extent: Extent::$extent,
                figures: $figures,
                varies: match $varies { Some(Main::HalfPlane) => Some("half-plane, against"), Some(Main::Block) => Some("block, against"), None => None },
                travel: Travel::Against,
                drag: $drag,
                body: $body,
                twist: $twist,
            },
        )*]
    };
}

/// A main set-up, both ways of travel.
enum Main {
    HalfPlane,
    Block,
}

const BLOCK: Body = Body::Block { bottom: "clamped", sides: "free" };

/// Every set-up; the first four are the main ones.
#[rustfmt::skip]
pub static SETUPS: &[Setup] = both_ways![
    ("half-plane", "half-plane, dislocations", Growth, ALL, None, 1.0, Body::HalfPlane, Twist::None),
    ("block", "block, bottom clamped, sides free, finite elements", Growth, ALL, None, 1.0, BLOCK, Twist::None),
    ("half-plane xfem", "half-plane, finite elements", ReferenceGrowth, FEW, Some(Main::HalfPlane), 1.0, Body::HalfPlaneXfem, Twist::None),
    ("sides on rollers", "block, bottom clamped, sides on rollers", Initial, FEW, Some(Main::Block), 1.0, Body::Block { bottom: "clamped", sides: "rollers" }, Twist::None),
    ("sides clamped", "block, bottom and sides clamped", Initial, FEW, Some(Main::Block), 1.0, Body::Block { bottom: "clamped", sides: "clamped" }, Twist::None),
    ("bottom on rollers", "block, bottom on rollers, sides free", Initial, FEW, Some(Main::Block), 1.0, Body::Block { bottom: "rollers", sides: "free" }, Twist::None),
    ("all on rollers", "block, bottom and sides on rollers", Initial, FEW, Some(Main::Block), 1.0, Body::Block { bottom: "rollers", sides: "rollers" }, Twist::None),
    ("drag reversed", "half-plane, positive friction drags the rail against the travel", Growth, DRAGGED, Some(Main::HalfPlane), -1.0, Body::HalfPlane, Twist::None),
    ("block, drag reversed", "block, positive friction drags the rail against the travel", Growth, &[14, 15, 16], Some(Main::Block), -1.0, BLOCK, Twist::None),
    ("steps 0.1 a", "half-plane, fixed load steps of 0.1 a", Growth, SINGLE, Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::FixedSteps(120)),
    ("steps 0.05 a", "half-plane, fixed load steps of 0.05 a", Growth, SINGLE, Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::FixedSteps(240)),
    ("unclipped", "half-plane, negative k1 counted in the direction", Growth, GROWN, Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::Direction("max-rate-unclipped")),
    ("block, unclipped", "block, negative k1 counted in the direction", Growth, &[18], Some(Main::Block), 1.0, BLOCK, Twist::Direction("max-rate-unclipped")),
    ("Fig. 21 plastic", "half-plane, Fig. 21 read as the plastic stress, which is then balanced", Growth, &[22, 23], Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::PlasticStress),
    ("block, Fig. 21 plastic", "block, Fig. 21 read as the plastic stress, which is then balanced", Growth, &[22, 23], Some(Main::Block), 1.0, BLOCK, Twist::PlasticStress),
    ("rolled 430 MPa", "half-plane, residual stress of a rail rolled at a yield stress of 430 MPa and C = 20 GPa instead of Fig. 21", Growth, &[22, 23], Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::Rolled(&STEELS[1])),
    ("rolled 380 MPa", "half-plane, residual stress of a rail rolled at a yield stress of 380 MPa and C = 20 GPa instead of Fig. 21", Growth, &[22, 23], Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::Rolled(&STEELS[2])),
    ("faces 0.01", "half-plane, crack-face friction 0.01 as in the captions of Figs 24 and 25", Growth, &[24, 25, 27, 28], Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::FaceFriction(0.01)),
    ("block, faces 0.01", "block, crack-face friction 0.01 as in the captions of Figs 24 and 25", Growth, &[24, 25, 27], Some(Main::Block), 1.0, BLOCK, Twist::FaceFriction(0.01)),
    ("faces 0.2", "half-plane, crack-face friction 0.2", Initial, &[24, 27], Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::FaceFriction(0.2)),
    ("E 70 GPa", "half-plane, a third of Young's modulus", Initial, &[13, 19, 24], Some(Main::HalfPlane), 1.0, Body::HalfPlane, Twist::Young(70e3)),
];
