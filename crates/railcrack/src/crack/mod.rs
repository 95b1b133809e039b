//! Polyline cracks and networks of them.

mod curve;
mod distance;
mod intersection;
mod junction;
mod network;
mod polyline;

pub use curve::CrackCurve;
pub use distance::segment_distance;
pub(crate) use distance::{from_nearest, point_to_segment};
pub use junction::{CrackEnd, CrackTip, Junction};
pub(crate) use junction::{EndKind, JunctionPoint, Passing};
pub use network::{CrackNetwork, NetworkError};
pub use polyline::{Crack, CrackError, End};
