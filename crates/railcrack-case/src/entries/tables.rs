//! The tables of keys of an entry.

use super::entry::{Grade, HowRead, QuantityKind};
use crate::schema::{
    Choice, FileSchema, Section, Word, choice, closed, file, file_schema, integer, long_text, number,
    positive, read_by_word, section, text,
};

section! {
    TOP "", Defaulted, "A measured number.";
    ID: String = text("id", "T1", "Its name, unique among the entries of a folder.").required();
    GRADE: Grade = choice("grade", "What it is about; grades are never mixed in a score.");
    QUANTITY: String = long_text("quantity", "growth rate of depth", "What was measured, in words.").required();
    CONDITIONS: String = long_text("conditions", "high rails of curves", "Under which conditions, in words.").required();
    SOURCE: String = long_text("source", "A. Author 2020, Wear 1, 2-3", "Who measured it and where it is published.").required();
    READ: HowRead = choice("read", "How it was read.");
    CERTAINTY: usize = integer("certainty", (1, 3), 2, "3: read and unambiguous; 2: read with a caveat; 1: from memory.");
    QUOTE: String = long_text("quote", "the crack grows", "The words that give it.").optional();
    NOTE: String = long_text("note", "a caveat", "Caveats.").optional();
}

section! {
    VALUE "value", Several, "One of its numbers.",
        forms [[NUMBER], [LOW, HIGH], [TEXT]];
    NAME: String = text("name", "rate_mm_per_mgt", "Name with unit.").required();
    NUMBER: f64 = number("number", "", closed(-1e12, 1e12), 1.0, "The number.").required();
    LOW: f64 = number("low", "", closed(-1e12, 1e12), 1.0, "The lower end of a range.").required();
    HIGH: f64 = number("high", "", closed(-1e12, 1e12), 2.0, "The upper end of a range.").required();
    TEXT: String = text("text", "not given", "A statement instead of a number.").required();
}

section! {
    COMPARE "compare", Optional,
        "How the model is compared with it: the quantity of a run, or of a growth law, in the distribution of conditions that a study gives.";
    KIND: QuantityKind = choice("kind", "The computed quantity.");
    STUDY_FILE: String = file("study", "inputs/conditions.toml", "conditions/network.toml",
        "The conditions with their uncertainty: a study whose samples are computed.").required();
    OVER_STUDY: String = file("over_study", "inputs/conditions.toml", "conditions/heavy.toml",
        "The conditions whose life is the denominator, sample by sample: as many samples, drawn from the same seed.")
        .required().only_with(KIND, "life-ratio", "only a ratio of lives has two sets of conditions");
    IN_SPACE: String = file("study_in_space", "inputs/conditions.toml", "conditions/network-space.toml",
        "The same conditions with an elliptical contact and a curved front: predicted too, and scored apart.")
        .only_with_any(KIND, "depth-rate", &["depth-rate-ratio", "depth-per-cycle"], "only growth in depth has a front").optional();
    MEASURED_LOW: f64 = number("low", "", positive(1e12), 0.05, "Lower end of the measured value, 2.5 %.").required();
    MEASURED_HIGH: f64 = number("high", "", positive(1e12), 0.1, "Upper end of the measured value, 97.5 %.").required();
    PLACE_LOG_STD: f64 = number("place_log_std", "", positive(10.0), 1.0,
        "Standard deviation of ln of the quantity from place to place: with the residuals of the entries it gives the prior of a calibration.").optional();
    FROM: f64 = number("from_mm", "mm", positive(1e3), 0.3, "Depth from which the rate is taken.")
        .required().only_with_any(KIND, "depth-rate", OF_DEPTHS, "a growth law has no depth");
    TO: f64 = number("to_mm", "mm", positive(1e3), 0.8, "Depth up to which the rate is taken.")
        .required().only_with_any(KIND, "depth-rate", OF_DEPTHS, "a growth law has no depth");
    OVER_FROM: f64 = number("over_from_mm", "mm", positive(1e3), 0.3, "The rate from this depth is the denominator.")
        .required().only_with(KIND, "depth-rate-ratio", "only a ratio has a denominator");
    OVER_TO: f64 = number("over_to_mm", "mm", positive(1e3), 0.8, "The rate up to this depth is the denominator.")
        .required().only_with(KIND, "depth-rate-ratio", "only a ratio has a denominator");
    DELTA_K: f64 = number("delta_k_mpa_sqrt_m", "MPa sqrt(m)", positive(1e3), 10.0, "Range of K_I of the test.")
        .required().only_with(KIND, "law-rate", "only the rate of a law has a range");
    RATIO: f64 = number("ratio", "", closed(0.0, 0.99), 0.1, "R of the test.")
        .required().only_with(KIND, "law-rate", "only the rate of a law has a ratio");
}

/// The other kinds with depths.
const OF_DEPTHS: &[&str] = &["depth-rate-ratio", "depth-per-cycle", "life-ratio"];

read_by_word!(Grade, HowRead, QuantityKind);

const SECTIONS: &[Section] = &[TOP, VALUE, COMPARE];

/// The file of an entry.
pub(super) static ENTRY_FILE: FileSchema = FileSchema {
    title: "Measured number",
    sections: SECTIONS,
    beside: &[],
    introduction: "",
    preamble: "",
    start: "the folder validation of the sources has examples",
    list: "an entry has one value for each key",
};

/// The JSON Schema (draft 2020-12) of an entry, for editors.
#[must_use]
pub fn entry_schema() -> serde_json::Value {
    file_schema(&ENTRY_FILE)
}

impl Choice for Grade {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Track, Word::now("track", "rails in service")),
        (Self::Rig, Word::now("rig", "twin discs and full-scale rigs")),
        (Self::Law, Word::now("law", "growth under known K in the laboratory")),
        (Self::Material, Word::now("material", "strength, toughness, sections: not compared")),
        (Self::Inspection, Word::now("inspection", "errors and ranges of inspection: not compared")),
        (Self::Friction, Word::now("friction", "frictions: not compared")),
    ];
}

impl Choice for HowRead {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::FullText, Word::now("full-text", "the source itself, or its data")),
        (Self::Abstract, Word::now("abstract", "its abstract or opening")),
        (Self::Secondary, Word::now("secondary", "another text that quotes it")),
        (Self::Memory, Word::now("memory", "from memory: shown hollow and never scored")),
    ];
}

impl Choice for QuantityKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::DepthRate, Word::now("depth-rate", "mean growth in depth between two depths, mm per MGT")),
        (
            Self::DepthRateRatio,
            Word::now("depth-rate-ratio", "that between two depths over that between two others"),
        ),
        (
            Self::DepthPerCycle,
            Word::now("depth-per-cycle", "mean growth in depth between two depths, mm per load cycle"),
        ),
        (
            Self::LifeRatio,
            Word::now("life-ratio", "load cycles between two depths over those under other conditions"),
        ),
        (Self::LawRate, Word::now("law-rate", "da/dN of the growth law, mm per cycle")),
        (Self::LawExponent, Word::now("law-exponent", "exponent of the growth law")),
    ];
}
