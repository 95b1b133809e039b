//! Names needed by a whole program, from the wheel to the path of the cracks.

pub use crate::body::{BodyEngine, CrackedBody};
pub use crate::contact::{ContactSolver, FaceProblem, Latin, Newton, StepControl};
pub use crate::crack::{Crack, CrackNetwork, End};
pub use crate::dislocation::{DislocationEngine, FaceResolution};
pub use crate::fatigue::{
    DirectionCriterion, EquivalentRange, GrowthLaw, HourlierPineau, Kink, KinkFunctions, Paris, RateLaw,
    SifRanges,
};
pub use crate::field::{
    BendingWheel, CarterWheel, DepthProfile, HertzWheel, StressField, TableWheel, Uniform, Wheel, Wheels,
};
pub use crate::fracture::{Sif, SifHistory};
pub use crate::growth::{
    Growth, GrowthSettings, GrowthState, Observer, PassageSettings, RunStop, TipStop, Unobserved,
};
pub use crate::load::{
    Axle, CarterContact, HertzEllipse, HertzianContact, NamedSection, Passage, RailSection, TableContact,
    Temperature, Track, Travel, WheelOnRail,
};
pub use crate::material::IsotropicElastic;
pub use crate::math::{RailBox, Stress, Vec2};
pub use crate::plane::{PlaneRail, RailLoad, stabilised_passage};
pub use crate::xfem::{MeshSettings, RailEnd, XfemEngine, XfemSettings};
