//! Both engines, the contact of the faces and passages of the wheel against closed forms, against
//! independent computations and against themselves.

#[path = "../common/mod.rs"]
mod common;

mod closed_kink;
mod closed_tip;
mod collinear_cracks;
mod contact_pressure;
mod edge_crack_in_tension;
mod edge_crack_under_pressure;
mod engine_paths;
mod far_apart;
mod half_plane_histories;
mod interruption;
mod joined_passage;
mod junction_run;
mod junctions;
mod kinked_crack;
mod latin_and_newton;
mod law_of_the_faces;
mod mirror;
mod page;
mod plastic_stress;
mod slant_crack;
mod slow_tips;
mod step_tolerance;
mod symmetric_cracks;
mod threads;
mod xfem;
