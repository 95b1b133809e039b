//! The section of the case file that only a study has.

use crate::declare::{choice, key, now};
use crate::table::{Kind, Presence, Preset, Section, SectionPresence};
use Preset::{Groups, Text};

/// `[study]`: how the lists of a study are combined.
pub const STUDY: Section = Section {
    name: "study",
    doc: "Only in a study, a case file with lists in place of values: how the lists are combined.",
    presence: SectionPresence::Defaulted,
    keys: &[
        choice(
            "combine",
            &[
                now("product", "every value of a list with every value of the others"),
                now("zip", "the first values of all lists together, then the second ones, and so on"),
            ],
            "product",
            "How the lists are combined.",
        ),
        key(
            "together",
            Kind::Groups,
            Presence::Optional(Groups(&[&["contact.peak_pressure_mpa", "contact.half_width_mm"]])),
            "In a product, keys whose lists are taken element by element, as one.",
        ),
        key(
            "colour_by",
            Kind::Text,
            Presence::Optional(Text("contact.friction")),
            "Key whose values have the colours of the overlay plots; without it, that of the first list.",
        ),
    ],
    forms: &[],
};
