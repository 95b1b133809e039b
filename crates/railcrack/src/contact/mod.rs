//! Unilateral contact with Coulomb friction on crack faces.

mod condition;
mod differences;
#[cfg(test)]
mod fixtures;
mod fluid;
mod latin;
mod latin_wheel;
mod loads;
mod newton;
mod parabola;
mod pocket_release;
mod pocket_trace;
mod pressure;
mod probe;
mod problem;
mod response;
mod solver;
mod stepping;
mod tableau;
mod trace;
mod uncracked_path;
mod uneven_path;
mod wheel_surface;

pub use fluid::{
    CrackFluid, FaceFluid, FluidModel, FluidState, Pocket, PocketMouth, PocketState, PocketStatus,
    PressureProfile,
};
pub use latin::Latin;
pub use newton::Newton;
pub(crate) use pressure::{compressed, reach_open};
pub(crate) use problem::FaceScale;
pub use problem::{CrackFrictionError, FaceProblem, FaceSolution, FaceState, FaceStatus, PointStatus};
pub use response::FaceResponse;
pub(crate) use solver::Rescued;
pub use solver::{ContactSolver, LoadPath, LoadStep, NotConverged, StepSolver};
pub(crate) use stepping::{Coupling, FaceHistory};
pub use stepping::{StepControl, Stepper, SteppingCounts, SteppingError};
pub(crate) use wheel_surface::ratio_at;
pub use wheel_surface::{CoupledState, SurfaceNode, SurfaceState, UnevenShear, WheelSurface};
