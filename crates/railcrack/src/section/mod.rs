//! A cracked rail with head, web and foot: the half-plane's body, made more compliant by what the
//! section of the rail lacks of a half-plane.
//!
//! The rail is a strip of layers, each as thick across the rail as head, web or foot are wide:
//! generalised plane strain, bonded, over the whole width. A crack in the head feels the stress
//! field of the half-plane plus the reflection from what is below the head. This reflection is a
//! smooth field, a sum of waves along the rail whose amplitudes are linear in the jumps; its
//! kernel is symmetric. So A loses a matrix that is made of nodal forces of smooth fields, whatever
//! the engine, and the load, contact and growth stay as they are.

mod engine;
mod layers;
mod modes;

pub use engine::{SectionEngine, SectionError};
pub use layers::{Layer, SectionLayers};
