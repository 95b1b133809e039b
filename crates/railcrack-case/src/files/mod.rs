//! Files that a case names.

mod campaigns;
mod columns;
mod companion;
mod contact_mat;
mod contact_table;
mod crack_table;
mod csv_rows;
mod detection;
mod detection_table;
mod field;
mod point_lines;
mod point_profile;
mod profile;
mod rates;
mod simpack;
mod size_class;
mod toughness;
mod units_row;
mod wheel_table;

pub use campaigns::{CampaignCrack, CampaignSize, Campaigns};
pub use columns::{Column, Columned, Columns};
pub use companion::{
    CaseFile, Companion, ContactFile, DetectionFile, FieldFile, ProfileFile, RatesFile, ToughnessFile,
};
pub use crack_table::{CrackTableFile, InspectedCrack, InspectedSize};
pub use detection_table::DetectionTable;

pub(crate) use columns::of_another_kind;
pub(crate) use contact_table::{ContactReading, read_contact_table};
pub(crate) use crack_table::{CrackKeys, read_crack_table};
pub(crate) use csv_rows::csv_rows;
pub(crate) use detection::read_detection;
pub(crate) use field::read_field;
pub(crate) use point_lines::Profiled;
pub use point_profile::PointFile;
pub(crate) use point_profile::{ProfileAxes, ProfileReading, read_points};
pub(crate) use profile::read_profile;
pub(crate) use rates::read_rates;
pub(crate) use toughness::read_toughness;
pub use wheel_table::{TablePatch, TableWheel, WheelTableFile};
pub(crate) use wheel_table::{WheelReading, read_wheel_table};
