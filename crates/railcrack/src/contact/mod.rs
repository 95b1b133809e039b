//! Unilateral contact with Coulomb friction on the crack faces.

mod condition;
mod forecast;
mod latin;
mod law;
mod newton;
mod problem;
mod response;
mod solver;
mod span;
mod stepping;
mod tableau;

pub use latin::Latin;
pub use law::{FaceState, FaceStatus};
pub use newton::Newton;
pub use problem::{FaceProblem, FaceScale, FaceSolution, PointStatus};
pub use response::FaceResponse;
pub use solver::{ContactSolver, LoadStep, NotConverged, StepSolver};
pub use stepping::{LoadPath, StepControl, Stepper, SteppingCounts, SteppingError};
