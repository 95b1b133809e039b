//! Other runs of the same cracks that a decision needs beside its own.

use super::digest::StepDigest;
use serde::{Deserialize, Serialize};

/// Difference of a companion from its run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum CompanionKind {
    /// The cracks grow faster by this factor against the removal of the surface, and the rail does
    /// not break before the toughest of the samples.
    Speed(f64),
    /// The cracks grow straight ahead.
    Straight,
    /// The cracks follow the limit path.
    Limit,
    /// Friction coefficient between the faces of all cracks.
    Friction(f64),
    /// Something that is seldom known is another.
    Varied(Variation),
    /// None but that only the cracks that other companions of a long row follow are there: what
    /// leaving out the others changes.
    PartOfRow,
}

impl CompanionKind {
    /// Whether the path differs.
    pub fn is_path(&self) -> bool {
        matches!(self, Self::Straight | Self::Limit)
    }

    /// Whether the wheels do the same to a crack of the same length as in the run.
    pub fn keeps_rail(&self) -> bool {
        matches!(self, Self::Speed(_) | Self::Straight)
    }

    /// The quantity that differs, and its value or the change of it.
    pub fn in_words(self) -> (&'static str, String) {
        match self {
            Self::Speed(speed) => ("speed of growth", format!("\u{d7} {speed:.2}")),
            Self::Straight => ("path", "straight ahead".to_owned()),
            Self::Limit => ("path", "limit path".to_owned()),
            Self::Friction(friction) => ("friction between the faces", friction.to_string()),
            Self::Varied(Variation::OtherSign) => {
                ("sign of the wheel friction", "driven instead of braked, or the reverse".to_owned())
            }
            Self::Varied(Variation::Neutral(by)) => ("neutral temperature", format!("{by:+} K")),
            Self::Varied(Variation::Deeper(by)) => ("depth at the start", format!("{by:+} mm")),
            Self::PartOfRow => ("cracks", "those that decide, with their neighbours".to_owned()),
        }
    }
}

/// A quantity of a case that is seldom known, with another value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Variation {
    /// The friction of all wheels has the other sign: driven instead of braked.
    OtherSign,
    /// The neutral temperature is higher by so many K.
    Neutral(f64),
    /// All cracks are deeper at the start by so many mm.
    Deeper(f64),
}

/// A companion of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Companion {
    /// The difference.
    pub kind: CompanionKind,
    /// Its finished steps, with the numbers that its cracks have in the run.
    pub steps: Vec<StepDigest>,
    /// Why there are no more; none where it ended.
    pub reason: Option<String>,
}

impl Companion {
    /// Speed of growth over that of the run, of a companion at another speed that was followed to
    /// its end.
    pub fn at_speed(&self) -> Option<f64> {
        match self.kind {
            CompanionKind::Speed(speed) if self.reason.is_none() => Some(speed),
            _ => None,
        }
    }
}
