//! Words: the enumerations of results as tables and JSON files name them.

use railcrack::bulk::{BottomSupport, Boundary, SideSupport};
use railcrack::contact::FaceStatus;
use railcrack::crack::End;
use railcrack::growth::{PieceKind, RunStop, TipStop};
use railcrack::shakedown::{Method, RailState};
use railcrack_case::{ContactSolver, Engine};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

/// A choice, each of which has a word of its own in files.
pub trait Word: Copy + 'static {
    /// Every choice.
    const ALL: &'static [Self];

    /// Its word.
    fn word(self) -> &'static str;

    /// The choice that `word` names; none where it names none.
    fn of_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|choice| choice.word() == word)
    }

    /// All words, for messages: `open, stick or slip`.
    fn accepted() -> String {
        let words: Vec<&str> = Self::ALL.iter().map(|choice| choice.word()).collect();
        match words.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => words.concat(),
        }
    }
}

macro_rules! words {
    ($($choice:ident: $($variant:expr),+;)+) => {$(
        impl Word for $choice {
            const ALL: &'static [Self] = &[$($variant),+];

            fn word(self) -> &'static str {
                self.name()
            }
        }
    )+};
}

words! {
    Engine: Self::Xfem, Self::Dislocation;
    ContactSolver: Self::Newton, Self::Latin;
    TipStop: Self::Arrest, Self::BreakOut, Self::Coalescence, Self::LeavesRail, Self::Fracture;
    RunStop: Self::StepsDone, Self::Cycles, Self::CriticalLength, Self::Detached, Self::Fracture,
        Self::NoTipGrows(TipStop::Arrest), Self::NoTipGrows(TipStop::BreakOut),
        Self::NoTipGrows(TipStop::Coalescence), Self::NoTipGrows(TipStop::LeavesRail);
    PieceKind: Self::Spall, Self::Detached;
    RailState: Self::Elastic, Self::ElasticShakedown, Self::PlasticShakedown, Self::NotStabilised;
    Method: Self::PassByPass, Self::Direct;
}

impl Word for FaceStatus {
    const ALL: &'static [Self] = &[Self::Open, Self::Stick, Self::Slip];

    fn word(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Slip => "slip",
        }
    }
}

impl Word for End {
    const ALL: &'static [Self] = &[Self::First, Self::Last];

    fn word(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Last => "last",
        }
    }
}

const fn block(bottom: BottomSupport, sides: SideSupport) -> Boundary {
    Boundary::Block { bottom, sides }
}

impl Word for Boundary {
    const ALL: &'static [Self] = &[
        Self::HalfPlane,
        block(BottomSupport::Clamped, SideSupport::Free),
        block(BottomSupport::Clamped, SideSupport::Rollers),
        block(BottomSupport::Clamped, SideSupport::Clamped),
        block(BottomSupport::Rollers, SideSupport::Free),
        block(BottomSupport::Rollers, SideSupport::Rollers),
        block(BottomSupport::Rollers, SideSupport::Clamped),
    ];

    fn word(self) -> &'static str {
        railcrack_case::boundary_name(self)
    }
}

/// Serializes the word of a choice.
pub(crate) fn serialize<W: Word, S: Serializer>(choice: &W, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(choice.word())
}

/// Reads a choice from its word.
pub(crate) fn deserialize<'de, W: Word, D: Deserializer<'de>>(deserializer: D) -> Result<W, D::Error> {
    let word = String::deserialize(deserializer)?;
    W::of_word(&word).ok_or_else(|| D::Error::custom(format!("\"{word}\" is not {}", W::accepted())))
}

/// The same for a choice that may be null.
pub(crate) mod optional {
    use super::*;

    pub(crate) fn serialize<W: Word, S: Serializer>(
        choice: &Option<W>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match choice {
            Some(choice) => serializer.serialize_some(choice.word()),
            None => serializer.serialize_none(),
        }
    }

    pub(crate) fn deserialize<'de, W: Word, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<W>, D::Error> {
        let Some(word) = Option::<String>::deserialize(deserializer)? else { return Ok(None) };
        W::of_word(&word)
            .map(Some)
            .ok_or_else(|| D::Error::custom(format!("\"{word}\" is not {}", W::accepted())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stop_of_a_tip_reads_back() {
        for stop in TipStop::ALL {
            assert_eq!(TipStop::of_word(stop.word()), Some(*stop));
        }
        assert_eq!(TipStop::of_word("fracture"), Some(TipStop::Fracture));
        assert_eq!(RunStop::of_word("fracture"), Some(RunStop::Fracture));
    }
}
