//! The rolled rail in space: under contacts whose stress varies across the rail.

mod bounds;
mod choice;
mod eigenstress;
mod grid;
mod outcome;
mod passes;
mod rail;
mod section;
mod section_waves;
mod settings;
mod stabilise;
mod state;
mod wave_pair;

pub use bounds::{PatchBounds, PlaceBound};
pub use choice::SpaceResolution;
pub use rail::{PatchStress, RailInSpace, RolledPatch, Symmetry};
pub use settings::SpaceStabilisation;
pub use stabilise::stabilise_in_space;
pub use state::{SpaceCycle, SpaceLayer, StabilisedSpace};
