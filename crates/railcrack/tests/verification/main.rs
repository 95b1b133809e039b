//! The dislocation engine, the contact of the faces and passages of the wheel against closed forms, against independent
//! computations and against themselves.

#[path = "../common/mod.rs"]
mod common;

mod collinear_cracks;
mod edge_crack_in_tension;
mod edge_crack_under_pressure;
mod far_apart;
mod kinked_crack;
mod slant_crack;
mod symmetric_cracks;
