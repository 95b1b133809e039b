//! Growth of rolling-contact-fatigue cracks in rails.
//!
//! The reference case of Trollé et al. (2014), Table 1, from the wheel to the direction and rate of
//! growth:
//!
//! ```
//! use railcrack::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let steel = IsotropicElastic::new(210e3, 0.3)?; // E in MPa, ν
//! let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
//! let wheel = HertzWheel::new(&contact, &steel)?;
//! let crack = Crack::surface_breaking(0.0, 6.0, 15f64.to_radians())?; // mouth and length in mm
//! let body = DislocationEngine::new(steel).body(&crack.into())?; // C and S
//! let faces = FaceProblem::new(&body, &[0.5])?; // crack-face friction
//! let load = RailLoad { wheel: &wheel, residual: None };
//! let settings = PassageSettings::default();
//! let passage = stabilised_passage(&faces, &Newton::default(), load, &settings, &Unobserved)?;
//! let history = &passage.histories[0]; // K_I and K_II of the only tip
//! let kink = HourlierPineau::default().kink(history).ok_or("the crack does not load")?;
//! println!("{:.1}°, {:.2e} mm per cycle", kink.angle.to_degrees(), kink.rate);
//!
//! // An independent code gives a range of 9.665 MPa √m, on a plateau that is 0.5 % low.
//! let range = SifRanges::of(history).delta_kii / 1000f64.sqrt();
//! assert!((range / 9.665 - 1.0).abs() < 0.005, "{range}");
//! // The crack goes straight on, in shear.
//! assert!(kink.angle.abs() < 1f64.to_radians());
//! # Ok(())
//! # }
//! ```
//!
//! The modules carry the names of the field: [`crack`] and [`load`] say what is computed, [`field`]
//! gives the stress of the uncracked rail, [`body`] the cracked body as two matrices, [`contact`]
//! closes the crack faces, [`fatigue`] and [`growth`] turn stress intensity factors into a path and
//! a number of cycles. [`prelude`] has the names of a whole program. The `examples` show one
//! passage, growth, a network, a user-defined stress field and a user-defined direction criterion.
//!
//! Stable are the names in [`prelude`], the traits [`body::BodyEngine`],
//! [`contact::ContactSolver`], [`field::Wheel`] and [`field::StressField`], and the meaning and
//! unit of every number. Other public items of the engines, of linear algebra and of the meshes
//! serve the other crates of the workspace and the verification tests, and may change in any
//! version. Enums that are expected to grow are non-exhaustive.
//!
//! Units everywhere inside: mm, N, MPa, radians; stress intensity factors in MPa √mm. Plane strain.

pub mod body;
pub mod bulk;
pub mod contact;
pub mod coupling;
pub mod crack;
pub mod dislocation;
pub mod fatigue;
pub mod field;
pub mod fracture;
pub mod growth;
pub mod interruption;
pub mod linear;
pub mod load;
pub mod material;
pub mod math;
pub mod mesh;
pub mod plane;
pub mod prelude;
pub mod profiles;
pub mod residual;
pub mod rolling;
pub mod section;
pub mod shakedown;
pub mod space;
pub mod stopwatch;
pub mod traffic;
pub mod validity;
pub mod words;
pub mod xfem;
