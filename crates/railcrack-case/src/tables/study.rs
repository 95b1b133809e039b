//! `[study]`: how the lists of a study are combined, and how distributions are drawn from.

use crate::schema::{Choice, Word, choice, groups, integer, read_by_word, section, text};

section! {
    STUDY "study", Defaulted,
        "Only in a study, a case file with lists or distributions: how these are combined and sampled.";
    COMBINE: Combine = choice("combine", "How the lists are combined.");
    TOGETHER: Vec<Vec<String>> = groups("together", &[&["contact.peak_pressure_mpa", "contact.half_width_mm"]],
        "[\"contact.peak_pressure_mpa\", \"contact.half_width_mm\"]",
        "Groups of keys whose lists are combined element by element in a product.").optional();
    COLOUR_BY: String = text("colour_by", "contact.friction",
        "Key shown by colour in the overlay plots; by default that of the first list.").optional();
    SAMPLES: usize = integer("samples", (1, 10_000), 100, "Number of samples, each combined with every choice from the lists; by default 100.").optional();
    SAMPLING: Sampling = choice("sampling", "Sampling method.");
    SEED: usize = integer("seed", (0, 4_294_967_295), 1, "Seed of the samples.");
}

read_by_word!(Combine);
read_by_word!(Sampling);

/// Number of samples if the file does not give one.
pub(crate) const SAMPLES_BY_DEFAULT: usize = 100;

/// Sampling methods.
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
        (Self::Sobol, Word::now("sobol", "Sobol's sequence; a power of two samples is best")),
        (
            Self::LatinHypercube,
            Word::now("latin-hypercube", "evenly spread in each key, for any number of keys"),
        ),
        (Self::Random, Word::now("random", "independent random numbers")),
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
        (Self::Product, Word::now("product", "every value with every value of the other lists")),
        (Self::Zip, Word::now("zip", "the first values of all lists, then the second, and so on")),
    ];
}
