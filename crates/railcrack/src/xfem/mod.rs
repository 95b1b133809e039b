//! Extended finite-element engine: a background mesh independent of the cracks, and enrichment
//! functions that represent them.

mod arrangement;
mod basis;
mod body;
mod border;
mod columns;
mod condense;
mod cuts;
mod domain;
mod engine;
mod enriched;
mod error;
mod field;
mod field_grid;
mod interface;
mod junctions;
mod path;
mod quadrature;
mod refined_region;
mod settings;
mod sif;
mod size;
mod space;
mod trace;

pub use body::{cracked_body, cracked_body_with};
pub use columns::ColumnStore;
pub use engine::{RailEnd, XfemEngine};
pub use error::XfemError;
pub use refined_region::{
    MOST_MESH_UNKNOWNS, MeshSettings, RefinedRegion, ResolvedLayers, default_element_sizes,
};
pub use settings::{EnrichmentRadius, XfemSettings};
pub use size::XfemSize;

#[cfg(test)]
mod patch_tests;
#[cfg(test)]
mod plastic_tests;
