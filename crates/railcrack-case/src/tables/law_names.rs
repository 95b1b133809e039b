//! Names of growth laws, equivalent ranges and steels.

use crate::schema::{Choice, Word, read_by_word};

/// Names of growth laws: a row for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LawName {
    Paris,
    ParisThreshold,
    Bold,
    Walker,
    Forman,
    Nasgro,
    Table,
}

impl Choice for LawName {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Paris, Word::now("paris", "C dKeq^m above the threshold")),
        (Self::ParisThreshold, Word::now("paris-threshold", "C (dKeq^m - dKth^m)")),
        (Self::Bold, Word::now("bold", "C (dKeq^3.74 - 4^3.74), Bold, Brown and Allen 1991")),
        (Self::Walker, Word::now("walker", "C [dKeq / (1-R)^(1-gamma)]^m above the threshold")),
        (Self::Forman, Word::now("forman", "C dKeq^m / ((1-R) Kc - dKeq) above the threshold")),
        (Self::Nasgro, Word::now("nasgro", "with closure, threshold and toughness")),
        (Self::Table, Word::now("table", "measured rates")),
    ];
}

/// Names of equivalent ranges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EquivalentName {
    HourlierPineau,
    Tanaka,
    Richard,
}

impl Choice for EquivalentName {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::HourlierPineau, Word::now("hourlier-pineau", "sqrt(dKI^2 + w dKII^2)")),
        (Self::Tanaka, Word::now("tanaka", "(dKI^4 + 8 dKII^4)^(1/4)")),
        (Self::Richard, Word::now("richard", "dKI/2 + sqrt(dKI^2 + 4 (1.155 dKII)^2)/2")),
    ];
}

/// The steels that have a growth law of their name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SteelName {
    R260,
    R350Ht,
}

impl Choice for SteelName {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::R260, Word::now("R260", "the fastest growth that EN 13674-1 accepts")),
        (Self::R350Ht, Word::now("R350HT", "the same")),
    ];
}

read_by_word!(LawName, EquivalentName, SteelName);
