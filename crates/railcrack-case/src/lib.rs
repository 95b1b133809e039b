//! Case files and studies: read with all errors at once, checked, and turned into the types of the
//! mechanics.
//!
//! [`Case::read`] takes the file of a user as well as `case.toml` of a run folder. It computes
//! nothing: the crate of runs makes rails and traffic of a case. `tables` declares every section
//! and key once, and `schema`, which does not depend on rails, derives from it the reader, the
//! defaults, the JSON Schema, the commented first file, the page of documentation and the stored
//! case.

mod case;
mod entries;
mod files;
pub mod normal;
mod plausible;
mod regular_file;
mod schema;
mod study;
mod tables;

pub use case::{
    ByGeometry, Case, Coefficient, Geometry, NoCoefficient, NoNumber, NotInPage, Overrides, PlaneCase,
    SpaceCase, TabledWheel, TrafficWheel, WheelGroups, WheelTable,
};
pub use entries::{Comparison, Entry, EntryValue, Grade, HowRead, Quantity, entry_schema};
pub use files::{
    CampaignCrack, CampaignSize, Campaigns, CaseFile, Column, Columned, Columns, Companion, ContactFile,
    CrackTableFile, DetectionFile, DetectionTable, FieldFile, InspectedCrack, InspectedSize, PointFile,
    ProfileFile, RatesFile, TablePatch, TableWheel, ToughnessFile, WheelTableFile,
};
pub use plausible::{ANY, Implausible, Topic, USUAL, Usual, implausible, json_schema, usual_ranges};
pub use regular_file::open_regular;
pub use schema::{
    CaseError, CaseErrors, Choice, Form, Key, Kind, NumberRange, OnlyWith, Pair, Presence, Preset, RangeEnd,
    Section, SectionPresence, Value, Word,
};
pub use schema::{commands_terminal, read_text_file};
pub use study::{Axis, Distribution, Input, Keeping, SampleTable, Study, StudyRun, Variation, study_schema};
pub use tables::{
    CalibrationPrior, Combine, ContactExtent, ContactOrigin, ContactSolver, Detection, Engine, FieldOutput,
    FileKey, Fracture, GivenContact, GivenWheel, Inspection, InspectionRisk, Kept, MeshSettings, Output,
    PlaneEngine, PlasticSource, ProfileOrigin, RollingWheels, SECTIONS, STUDY, Scatter, ShakedownSettings,
    WheelLoading, file_keys, init_text, markdown,
};
