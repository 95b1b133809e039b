//! Polyline cracks and networks of them.

mod distance;
mod intersection;
mod junction;
mod network;
mod polyline;
mod walk;

pub use distance::segment_distance;
pub(crate) use distance::{from_nearest, point_to_segment};
pub use junction::{CrackEnd, CrackTip, Junction};
pub(crate) use junction::{EndKind, JunctionPoint, Passing};
pub use network::{CrackNetwork, NetworkError};
pub use polyline::{Crack, CrackError, End};
pub use walk::Walk;
