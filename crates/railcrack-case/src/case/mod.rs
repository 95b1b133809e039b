//! The case: reading and checking.

mod build;
mod by_geometry;
#[expect(clippy::module_inception, reason = "the type gives its file the name")]
mod case;
mod coarse_crack;
mod coarse_front;
mod coupled;
mod cracks;
mod discretisation;
mod finite_section;
mod fitted;
mod front_shape;
mod in_page;
mod limits;
mod mix;
mod overrides;
mod read;
mod read_wheel;
mod representatives;
mod rolling_patch;
mod row_scatter;
mod setting;
mod space;
mod space_case;
mod wheel_table;
mod wheels_of_table;

pub use by_geometry::ByGeometry;
pub use case::Case;
pub use coarse_front::CoarseFront;
pub use fitted::{Coefficient, NoCoefficient, NoNumber};
pub use in_page::NotInPage;
pub use mix::MixedWheel;
pub use overrides::Overrides;
pub use representatives::open_crack;
pub use space_case::SpaceCase;
pub use wheel_table::{TabledWheel, WheelTable};

pub(crate) use build::build;
pub(crate) use setting::place_of;
