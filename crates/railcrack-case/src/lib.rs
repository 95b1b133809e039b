//! The case file: what a user writes, checked and turned into the types of the library.
//!
//! One table ([`SECTIONS`]) declares every section and key once. Reading, range checks, defaults, the JSON Schema,
//! the commented first file, the page of documentation and the case as written back all derive from it.

mod accept;
mod build;
mod carried;
mod chosen;
mod cracks;
mod declare;
mod error;
mod field_file;
mod markdown;
mod overrides;
mod prepared;
mod problem;
mod profile;
mod read;
mod schema;
mod section;
mod sections;
mod settings;
mod shared;
mod size;
mod study;
mod suggest;
mod table;
mod validated;
mod write;

pub use accept::Value;
pub use carried::{CarriedStress, CarriedStressError, Projection, Release};
pub use error::{CaseError, CaseErrors};
pub use field_file::FieldFile;
pub use markdown::markdown;
pub use overrides::Overrides;
pub use prepared::PreparedRun;
pub use profile::ProfileFile;
pub use schema::json_schema;
pub use sections::SECTIONS;
pub use shared::{RailKey, SharedRail, SharedRailError};
pub use size::RunSize;
pub use study::{Axis, Combine, Input, STUDY, Study, StudyRun, Variation, study_schema};
pub use table::{
    Availability, Choice, Form, Key, Kind, NumberRange, OnlyWith, Presence, Preset, RangeEnd, Section,
    SectionPresence,
};
pub use validated::{
    Case, Companion, ContactSolver, Engine, FieldOutput, MeshSettings, PlasticSource, Rail,
    ShakedownSettings, boundary_name,
};
pub use write::init_text;
