//! Plasticity under repeated passages: the stabilised state of a rolled rail, and its shakedown
//! limits.

mod antiplane;
mod bounds;
mod complex;
mod eigenstress;
mod fourier;
mod in_plane;
mod layer_factors;
mod passages;
mod plane_strain;
mod rail;
pub mod space;
mod stabilise;
mod state;
mod streamline;
mod wave;

pub use bounds::{
    ContactBounds, DepthBounds, FirstYield, MapPoint, ShakedownLimit, bounds_by_depth, shakedown_limit_ratio,
    shakedown_map,
};
pub use fourier::{Layers, Resolution};
pub use rail::{PlasticStrain, RolledRail, ShakedownError, Travel};
pub use stabilise::{Stabilisation, check_rail, stabilise, stabilise_unless};
pub use state::{
    Admissibility, Cycle, DepthRange, LayerState, Method, PassRecord, RailState, StabilisedRail,
};
