//! Polyline cracks and networks of them.

mod network;
mod polyline;

pub use network::{CrackNetwork, NetworkError};
pub use polyline::{Crack, CrackError, End};
