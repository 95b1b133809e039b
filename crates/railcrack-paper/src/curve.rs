//! The curves of the figures: a case file of `cases/paper` and what differs from it.

use crate::edit::Edit;
use crate::files::{FIG_13, FIG_22, FIG_24, FIG_27, FIG_29, PaperFile, TABLE_1};

/// One curve of the paper's figures; several figures may show it.
pub struct PaperCurve {
    /// Its name in file names and tables.
    pub name: &'static str,
    /// Its words in the legends of its figures.
    pub legend: &'static str,
    /// Its case file.
    pub(super) file: &'static PaperFile,
    /// Wheel–rail friction with the sign of the paper: positive is braking.
    pub wheel_friction: f64,
    /// Values that differ from the case file's.
    pub(super) variation: Variation,
    /// The figures that show it or need it as a reference.
    pub figures: &'static [u8],
}

/// Difference from the case file, apart from the wheel–rail friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Variation {
    None,
    FaceFriction(f64),
    Angle(f64),
    /// One crack where the file has several: mouth (mm) and angle.
    OnlyCrack {
        mouth: f64,
        angle: f64,
    },
    /// The file's residual stress on Table 1's crack.
    OneOfNetwork,
}

impl PaperCurve {
    pub(super) fn edits(&self) -> Vec<Edit> {
        match self.variation {
            Variation::None => Vec::new(),
            Variation::FaceFriction(friction) => vec![Edit::number("crack", "friction", friction)],
            Variation::Angle(angle) => vec![Edit::number("crack", "angle_deg", angle)],
            Variation::OnlyCrack { mouth, angle } => {
                vec![Edit::number("crack", "mouth_mm", mouth), Edit::number("crack", "angle_deg", angle)]
            }
            Variation::OneOfNetwork => vec![Edit::integer("crack", "count", 1)],
        }
    }
}

const fn curve(
    name: &'static str,
    legend: &'static str,
    wheel_friction: f64,
    variation: Variation,
    figures: &'static [u8],
) -> PaperCurve {
    PaperCurve { name, legend, file: &TABLE_1, wheel_friction, variation, figures }
}

/// Every curve.
pub static CURVES: &[PaperCurve] = &[
    PaperCurve {
        file: &FIG_13,
        ..curve("fig13", "crack-face friction 0.1, wheel–rail friction 0.4", 0.4, Variation::None, &[13])
    },
    curve("reference", "Table 1", 0.025, Variation::None, &[14, 15, 16, 17, 18, 19, 20, 22, 23, 24, 25]),
    curve("wheel+0.1", "wheel–rail friction 0.1", 0.1, Variation::None, &[14, 16, 17, 27, 28, 29, 30]),
    curve("wheel+0.4", "wheel–rail friction 0.4", 0.4, Variation::None, &[14, 16, 17]),
    curve("wheel-0.025", "wheel–rail friction \u{2212}0.025", -0.025, Variation::None, &[15, 16]),
    curve("wheel-0.1", "wheel–rail friction \u{2212}0.1", -0.1, Variation::None, &[15, 16]),
    curve("wheel-0.4", "wheel–rail friction \u{2212}0.4", -0.4, Variation::None, &[15, 16]),
    curve("faces-0.1", "crack-face friction 0.1", 0.025, Variation::FaceFriction(0.1), &[17, 18]),
    curve("faces-0.2", "crack-face friction 0.2", 0.025, Variation::FaceFriction(0.2), &[17, 18]),
    curve("faces-0.8", "crack-face friction 0.8", 0.025, Variation::FaceFriction(0.8), &[17, 18]),
    curve("angle-30", "30\u{b0}", 0.025, Variation::Angle(30.0), &[19, 20]),
    curve("angle-45", "45\u{b0}", 0.025, Variation::Angle(45.0), &[19, 20]),
    curve("angle-60", "60\u{b0}", 0.025, Variation::Angle(60.0), &[19, 20]),
    curve("angle-75", "75\u{b0}", 0.025, Variation::Angle(75.0), &[19, 20]),
    PaperCurve {
        file: &FIG_22,
        ..curve("stress", "with residual stress", 0.025, Variation::None, &[22, 23])
    },
    PaperCurve { file: &FIG_24, ..curve("pair", "two cracks", 0.025, Variation::None, &[24, 25]) },
    curve(
        "crack-2-alone",
        "crack 2 alone",
        0.025,
        Variation::OnlyCrack { mouth: -1.0, angle: 165.0 },
        &[24, 25],
    ),
    PaperCurve { file: &FIG_27, ..curve("nine", "nine cracks", 0.1, Variation::None, &[27, 28, 29, 30]) },
    PaperCurve {
        file: &FIG_29,
        ..curve("nine-stress", "nine cracks with residual stress", 0.1, Variation::None, &[29, 30])
    },
    PaperCurve {
        file: &FIG_29,
        ..curve("one-stress", "one crack with residual stress", 0.1, Variation::OneOfNetwork, &[29])
    },
];
