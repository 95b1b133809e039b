//! Cracks as polylines in the plane of the rail: their passages, kinks and increments.

mod coalescence;
mod crack_fluid;
mod exchange;
mod face_load;
mod fields;
#[cfg(test)]
mod fixtures;
mod increments;
mod joining;
mod known;
mod mouth_pressures;
mod passage;
mod rail;
mod solvers;
mod step_state;
mod sweeps;
mod tip_sifs;
mod tip_under_wheel;
mod turned;

pub use face_load::RailLoad;
pub use known::{KnownBody, KnownCrack, KnownRail, KnownStraight};
pub use rail::{KnownEnds, PlaneBody, PlaneRail};
pub use solvers::{PlaneWheel, stabilised_passage};
