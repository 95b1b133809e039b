//! Growth of rolling-contact-fatigue cracks in rails.
//!
//! The modules carry the names of the field: [`crack`] and [`load`] say what is computed, [`field`] gives the
//! stress of the uncracked rail, [`body`] the cracked body as two matrices, [`contact`] closes the crack faces,
//! [`fatigue`] and [`growth`] turn stress intensity factors into a path and a number of cycles.
//!
//! Units everywhere inside: mm, N, MPa, radians; stress intensity factors in MPa √mm. Plane strain.

pub mod body;
pub mod case;
pub mod contact;
pub mod crack;
pub mod dislocation;
pub mod fatigue;
pub mod field;
pub mod fracture;
pub mod growth;
pub mod linear;
pub mod load;
pub mod material;
pub mod math;
pub mod output;
pub mod shakedown;
