//! Both engines, crack-face contact and wheel passages against closed forms, independent
//! computations and each other.

#[path = "../common/mod.rs"]
mod common;

mod awkward_places;
mod closed_kink;
mod closed_tip;
mod collinear_cracks;
mod contact_conditions;
mod contact_pressure;
mod coupled_wheel;
mod cycles;
mod edge_crack_in_tension;
mod edge_crack_under_pressure;
mod far_apart;
mod fluid;
mod groups;
mod half_plane_histories;
mod identities;
mod interruption;
mod joined_passage;
mod junctions;
mod kinked_crack;
mod latin_and_newton;
mod loads;
mod maintenance;
mod mirror;
mod mix;
mod page;
mod rolling;
mod section;
mod shakedown;
mod slant_crack;
mod space;
mod step_tolerance;
mod symmetric_cracks;
mod threads;
mod xfem;
