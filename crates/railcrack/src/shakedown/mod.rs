//! Plasticity under repeated passages: the stabilised state of a rolled rail, and its shakedown
//! limits.

mod bounds;
mod cycle;
mod eigenstress;
mod error;
mod fourier;
mod grid;
mod layers;
mod rail;
mod stabilise;
mod state;
mod steady;
mod strain;
mod streamline;
mod wave;

pub use bounds::{
    ContactBounds, DepthBounds, FirstYield, MapPoint, ShakedownLimit, bounds_by_depth, shakedown_limit_ratio,
    shakedown_map,
};
pub use error::ShakedownError;
pub use grid::Resolution;
pub use layers::Layers;
pub use rail::{RolledRail, Travel};
pub use stabilise::{Stabilisation, check_rail, stabilise, stabilise_unless};
pub use state::{
    Admissibility, Cycle, DepthRange, LayerState, Method, PassRecord, RailState, StabilisedRail,
};
pub use strain::PlasticStrain;
