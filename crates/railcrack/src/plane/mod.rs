//! Cracks as polylines in the plane of the rail: their passages, kinks and increments.

mod coalescence;
mod crack_fluid;
mod exchange;
mod face_load;
mod felt_field;
mod fields;
#[cfg(test)]
mod fixtures;
mod groups;
mod increments;
mod joining;
mod mouth_pressures;
mod passage;
mod pieces;
mod rail;
mod rail_load;
mod solvers;
mod stabilise;
mod stations;
mod step_state;
mod stops;
mod sweeps;
mod tip_sifs;
mod turn_response;
mod turned;
mod turning_wheel;
mod wheel;
mod worn;

pub use rail::{KnownEnds, PlaneBody, PlaneRail};
pub use rail_load::RailLoad;
pub use stabilise::stabilised_passage;
pub use wheel::PlaneWheel;
