//! Growth of rolling-contact-fatigue cracks in rails.
//!
//! The modules carry the names of the field: [`crack`] and [`load`] say what is computed, [`field`] gives the
//! stress of the uncracked rail, [`body`] the cracked body as two matrices, [`contact`] closes the crack faces,
//! [`fatigue`] and [`growth`] turn stress intensity factors into a path and a number of cycles.
//!
//! The reference case of Trollé et al. (2014), Table 1, from the wheel to the direction of growth:
//!
//! ```
//! use railcrack::contact::{FaceProblem, Newton, StepControl};
//! use railcrack::crack::Crack;
//! use railcrack::dislocation::{DislocationBody, FaceResolution};
//! use railcrack::fatigue::{DirectionCriterion, HourlierPineau, ParisLaw, SifRanges};
//! use railcrack::growth::{PassageSettings, RailLoad, Unobserved, stabilised_passage};
//! use railcrack::load::{HertzianContact, Passage};
//! use railcrack::material::IsotropicElastic;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let steel = IsotropicElastic::new(210e3, 0.3)?; // E in MPa
//! let crack = Crack::surface_breaking(0.0, 6.0, 15f64.to_radians())?; // mouth, length in mm
//! let wheel = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
//! let body = DislocationBody::new(&crack.into(), &steel, FaceResolution::default())?; // C and S
//! let faces = FaceProblem::new(&body, &[0.5]); // friction of the crack
//! let load = RailLoad { contact: wheel, poisson: steel.poisson(), residual: None };
//! let settings = PassageSettings {
//!     passage: Passage { from: -40.5, to: 40.5, positions: 241 },
//!     max_passages: 5,
//!     passage_tolerance: 1e-3,
//!     step_tolerance: 2e-3,
//!     step_control: StepControl::Adaptive,
//! };
//! let passage = stabilised_passage(&faces, &Newton::default(), load, &settings, &Unobserved)?;
//! let history = &passage.histories[0]; // of the only tip
//! let law = ParisLaw::RAIL_STEEL;
//! let kink = HourlierPineau { law, criterion: DirectionCriterion::MaxRate }.kink(history);
//!
//! // An independent code gives a range of 9.665 MPa √m, on a plateau that is 0.5 % low.
//! let range = SifRanges::of(history).delta_kii / 1000f64.sqrt();
//! assert!((range / 9.665 - 1.0).abs() < 0.005, "{range}");
//! // The crack goes straight on, in shear.
//! assert!(kink.is_some_and(|kink| kink.angle.abs() < 1f64.to_radians()));
//! # Ok(())
//! # }
//! ```
//!
//! Units everywhere inside: mm, N, MPa, radians; stress intensity factors in MPa √mm. Plane strain.

pub mod body;
pub mod bulk;
pub mod contact;
pub mod crack;
pub mod dislocation;
pub mod fatigue;
pub mod field;
pub mod fracture;
pub mod growth;
pub mod linear;
pub mod load;
pub mod material;
pub mod math;
pub mod mesh;
pub mod residual;
pub mod shakedown;
pub mod space;
pub mod xfem;
