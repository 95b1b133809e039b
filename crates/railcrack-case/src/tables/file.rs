//! The case file: all sections, and the texts around them.

use super::calibration::CALIBRATION;
use super::contact::CONTACT;
use super::crack::CRACK;
use super::fluid::FLUID;
use super::fracture::FRACTURE;
use super::growth::GROWTH;
use super::inspection::{INSPECTION, SCATTER};
use super::maintenance::MAINTENANCE;
use super::mesh::MESH;
use super::output::OUTPUT;
use super::passage::PASSAGE;
use super::rail::RAIL;
use super::shakedown::SHAKEDOWN;
use super::solver::SOLVER;
use super::stress::{PLASTIC_STRESS, RESIDUAL_STRESS};
use super::study::STUDY;
use super::title::TOP;
use super::track::{TEMPERATURE, TRACK};
use super::traffic::{TRAFFIC, WHEEL};
use crate::schema::{FileSchema, Kind, Section, file_schema, first_file, page};

/// The sections of a case, in the order in which they are written.
pub const SECTIONS: &[Section] = &[
    TOP,
    RAIL,
    CONTACT,
    TRACK,
    TEMPERATURE,
    WHEEL,
    PASSAGE,
    CRACK,
    RESIDUAL_STRESS,
    PLASTIC_STRESS,
    FLUID,
    SHAKEDOWN,
    GROWTH,
    FRACTURE,
    MESH,
    SOLVER,
    TRAFFIC,
    MAINTENANCE,
    INSPECTION,
    SCATTER,
    CALIBRATION,
    OUTPUT,
];

/// The case file.
pub(crate) static CASE_FILE: FileSchema = FileSchema {
    title: "Case file of railcrack",
    sections: SECTIONS,
    beside: &[STUDY],
    introduction: INTRODUCTION,
    preamble: PREAMBLE,
    start: "`railcrack init` writes a file to start from",
    list: "a list of values makes a study, which `railcrack sweep` computes",
};

/// A key of a case file that names another file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileKey {
    /// The last part of the name of its section, such as `contact` of `wheel.contact`.
    pub section: &'static str,
    /// Its name.
    pub key: &'static str,
    /// Name of the copy beside a stored case, with `/`.
    pub kept_as: &'static str,
}

/// Every key of a case file that names another file, each once.
#[must_use]
pub fn file_keys() -> Vec<FileKey> {
    let sections = SECTIONS.iter().flat_map(|section| std::iter::once(section).chain(section.parts));
    let of = |section: &'static Section| {
        section.keys.iter().filter_map(|key| match key.kind {
            Kind::Path { kept_as } => Some(FileKey { section: section.own_name(), key: key.name, kept_as }),
            _ => None,
        })
    };
    let mut keys: Vec<FileKey> = sections.flat_map(of).collect();
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// The JSON Schema (draft 2020-12) of a case file, without the usual ranges.
#[must_use]
pub fn json_schema() -> serde_json::Value {
    file_schema(&CASE_FILE)
}

/// The page `docs/case-file.md`: every key with its values, default and meaning.
#[must_use]
pub fn markdown() -> String {
    page(&CASE_FILE)
}

/// The first file of a user: the reference case of Table 1 of the paper, with a comment on every
/// key.
#[must_use]
pub fn init_text() -> String {
    first_file(&CASE_FILE)
}

const PREAMBLE: &str = "\
# A case of railcrack. `railcrack check FILE` validates it, `railcrack run FILE` computes it.
# y points up and the rail is y <= 0; lengths in mm, stresses in MPa, angles in degrees.
# Every key has a default except those of [contact] and [[crack]]: the reference case of Trolle et al.
# (2014), Table 1, with a line contact. A wheel on a rail is given by its load and radii instead, as
# `railcrack init --template head-check` does.

";

const INTRODUCTION: &str = "\
# The case file

A case is one TOML file. `railcrack init` writes one with a comment on every key, `railcrack check` validates it and shows
what would be computed, and `railcrack schema` prints its JSON Schema for editors.

* Lengths are in mm, stresses in MPa, angles in degrees. y points up, the rail is y <= 0.
* File names are relative to the folder of the case file.
* All errors are reported at once, with the file, the line, the key, the value and what is accepted; the exit code is 2,
  and nothing is written. Two keys that specify the same quantity are an error.
* A range such as [0.01, 100] mm accepts `6` and `6.0`, infinity only where it includes it; an integer is written without
  a decimal point (`241`).
* A list instead of a value makes the file a [study](studies.md), that is, many cases in one.

This page is generated from the table of keys in the library; a test keeps it up to date.
";
