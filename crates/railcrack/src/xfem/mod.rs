//! The finite-element engine: a background mesh that does not know the cracks, and functions that do.

mod arrangement;
mod background;
mod basis;
mod body;
mod border;
mod cuts;
mod interface;
mod path;
mod quadrature;
mod sif;
mod space;
mod trace;
mod window;

pub use background::{Background, BottomSupport, SideSupport, Supports};
pub use body::{TipRadii, XfemBody, XfemError};
pub use sif::SifDomain;
pub use window::{MeshSettings, Outline, Window};
