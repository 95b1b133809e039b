//! Extended finite-element engine: a background mesh independent of the cracks, and enrichment
//! functions that represent them.

mod arrangement;
mod basis;
mod body;
mod border;
mod columns;
mod condense;
mod cuts;
mod engine;
mod error;
mod field;
mod interface;
mod path;
mod refined_region;
mod settings;
mod sif;
mod space;

pub use body::{XfemSize, cracked_body, cracked_body_with};
pub use columns::ColumnStore;
pub use engine::{RailEnd, XfemEngine};
pub use error::XfemError;
pub use refined_region::{
    MOST_MESH_UNKNOWNS, MeshSettings, RefinedRegion, ResolvedLayers, default_element_sizes,
};
pub use settings::{EnrichmentRadius, XfemSettings};

#[cfg(test)]
mod patch_tests;
#[cfg(test)]
mod plastic_tests;
