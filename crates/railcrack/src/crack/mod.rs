//! Polyline cracks and networks of them.

mod curve;
mod network;
mod polyline;

pub use curve::CrackCurve;
pub(crate) use network::JunctionPoint;
pub use network::{CrackEnd, CrackNetwork, CrackTip, Junction, NetworkError};
pub use polyline::{Crack, CrackError, End, segment_distance};
pub(crate) use polyline::{from_nearest, point_to_segment};
