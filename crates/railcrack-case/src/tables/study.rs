//! `[study]`: how the lists of a study are combined, and how distributions are drawn from.

use crate::schema::{Choice, Word, choice, groups, integer, read_by_word, section, text};

section! {
    STUDY "study", Defaulted,
        "Only in a study, a case file with lists or distributions in place of values: how the lists are combined, and how many samples of the distributions are drawn.";
    COMBINE: Combine = choice("combine", "Combination of the lists.");
    TOGETHER: Vec<Vec<String>> = groups("together", &[&["contact.peak_pressure_mpa", "contact.half_width_mm"]],
        "[\"contact.peak_pressure_mpa\", \"contact.half_width_mm\"]",
        "In a product, keys whose lists are taken element by element, as one.").optional();
    COLOUR_BY: String = text("colour_by", "contact.friction",
        "Key whose values have the colours of the overlay plots; without it, that of the first list.").optional();
    SAMPLES: usize = integer("samples", (1, 10_000), 100, "Samples of the distributions, each with every choice of the lists.").optional();
    SAMPLING: Sampling = choice("sampling", "How the samples are chosen.");
    SEED: usize = integer("seed", (0, 4_294_967_295), 1, "The same seed gives the same samples.");
}

read_by_word!(Combine);
read_by_word!(Sampling);

/// Samples where the file does not say how many.
pub(crate) const SAMPLES_BY_DEFAULT: usize = 100;

/// Ways of choosing samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// Sobol's sequence, shifted by the seed.
    Sobol,
    /// One sample in each of as many equal parts, for every key.
    LatinHypercube,
    /// Independent ones.
    Random,
}

impl Choice for Sampling {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Sobol, Word::now("sobol", "evenly, by Sobol's sequence, best with a power of two")),
        (
            Self::LatinHypercube,
            Word::now("latin-hypercube", "evenly in every key by itself, any number of keys"),
        ),
        (Self::Random, Word::now("random", "independently")),
    ];
}

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
