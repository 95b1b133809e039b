//! The case: reading and checking.

mod beside;
mod build;
mod by_geometry;
#[expect(clippy::module_inception, reason = "the type gives its file the name")]
mod case;
mod coupled;
mod crack_rows;
mod cracks;
mod discretisation;
mod finite_section;
mod fitted;
mod front_shape;
mod geometry;
mod in_page;
mod limits;
mod overrides;
mod plane;
mod read;
mod row_scatter;
mod seasons;
mod setting;
mod space;
mod space_case;
mod traffic;
mod traffic_wheel;
mod wheel_table;
mod wheels_of_table;

pub use by_geometry::ByGeometry;
pub use case::Case;
pub use fitted::{Coefficient, NoCoefficient, NoNumber};
pub use geometry::{Geometry, PlaneCase};
pub use in_page::NotInPage;
pub use overrides::Overrides;
pub use space_case::SpaceCase;
pub use traffic_wheel::TrafficWheel;
pub use wheel_table::{TabledWheel, WheelGroups, WheelTable};

pub(crate) use build::build;
pub(crate) use setting::place_of;
