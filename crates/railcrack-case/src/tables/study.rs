//! `[study]`: how the lists of a study are combined.

use crate::schema::{Choice, Word, choice, groups, read_by_word, section, text};

section! {
    STUDY "study", Defaulted,
        "Only in a study, a case file with lists in place of values: how the lists are combined.";
    COMBINE: Combine = choice("combine", "Combination of the lists.");
    TOGETHER: Vec<Vec<String>> = groups("together", &[&["contact.peak_pressure_mpa", "contact.half_width_mm"]],
        "[\"contact.peak_pressure_mpa\", \"contact.half_width_mm\"]",
        "In a product, keys whose lists are taken element by element, as one.").optional();
    COLOUR_BY: String = text("colour_by", "contact.friction",
        "Key whose values have the colours of the overlay plots; without it, that of the first list.").optional();
}

read_by_word!(Combine);

/// Combinations of the axes of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combine {
    /// Every value with every value of the others.
    Product,
    /// Element by element.
    Zip,
}

impl Choice for Combine {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Product, Word::now("product", "every value of a list with every value of the others")),
        (
            Self::Zip,
            Word::now("zip", "the first values of all lists together, then the second ones, and so on"),
        ),
    ];
}
