//! Facts of the case that stand in the files of a run.

use railcrack::bulk::Boundary;
use railcrack::growth::Warning;
use railcrack_case::{ContactSolver, Engine};

/// Facts of the case that stand in the files of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunInfo {
    /// Title of the case.
    pub title: String,
    /// Engine.
    pub engine: Engine,
    /// Contact solver.
    pub contact: ContactSolver,
    /// Boundary of the rail.
    pub boundary: Boundary,
    /// Half-width a of the wheel contact, mm: the unit of `xc_over_a`.
    pub half_width: f64,
    /// First and last position of `[passage]`, mm: a rail that bends has output positions beyond.
    pub passage: [f64; 2],
    /// Whether the rail bends on its track.
    pub bends: bool,
    /// K_Ic, MPa √m, where the case gives it.
    pub toughness: Option<f64>,
    /// Axle load in tonnes, for million gross tonnes.
    pub axle_load: Option<f64>,
    /// Warnings that follow from the case, before any step.
    pub warnings: Vec<Warning>,
}
