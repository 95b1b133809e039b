//! Parts of `summary.json`: tips, cracks, pieces of the rail, fracture, times.

use crate::disk::words;
use railcrack::crack::End;
use railcrack::growth::{PieceCause, PieceKind, TipStop, Warning, WarningKind};
use serde::{Deserialize, Serialize};

/// Wall time by phase, of the run and its resumptions, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PhaseSeconds {
    /// The residual stress: the plastic state of the rolled rail if required, projection and
    /// balance.
    pub residual: f64,
    /// The cracked body.
    pub body: f64,
    /// Part of it spent on the mesh without cracks and its factor.
    pub body_mesh: f64,
    /// Part of it spent on cutting elements and choosing functions and face points.
    pub body_enrichment: f64,
    /// Part of it spent on the stiffness of the enriched functions.
    pub body_border: f64,
    /// Part of it spent on stress intensity factors as functionals.
    pub body_sif: f64,
    /// Part of it spent on eliminating the unknowns behind the faces.
    pub body_condensation: f64,
    /// Loads on the faces and contact.
    pub contact: f64,
    /// Direction, rate, increments.
    pub growth: f64,
    /// Tables, checkpoints, plots.
    pub output: f64,
}

/// A warning to the reader of the results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WarningSummary {
    /// The growth step to which its numbers belong: the worst of those concerned.
    pub step: usize,
    /// Number of growth steps concerned; null where it follows from the case.
    #[serde(default)]
    pub steps: Option<usize>,
    /// Its kind.
    pub kind: WarningKind,
    /// One sentence with its numbers.
    pub text: String,
}

impl WarningSummary {
    /// A warning that follows from the case, before any step.
    pub(crate) fn of_case(warning: Warning) -> Self {
        Self { step: warning.step, steps: None, kind: warning.kind, text: warning.text }
    }

    /// A warning that arose in one step.
    pub(crate) fn of_step(warning: Warning) -> Self {
        Self { steps: Some(1), ..Self::of_case(warning) }
    }

    /// Its step in words: `step 3`, `step 3, the worst of 12`.
    #[must_use]
    pub fn place(&self) -> String {
        match self.steps {
            Some(steps) if steps > 1 => format!("step {}, the worst of {steps}", self.step),
            _ => format!("step {}", self.step),
        }
    }
}

/// A tip in the last finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TipSummary {
    /// Number of its crack, from 1.
    pub crack: usize,
    /// Number of the tip within its crack, from 1.
    pub tip: usize,
    /// Abscissa, mm.
    pub x_mm: f64,
    /// Ordinate, mm.
    pub y_mm: f64,
    /// Length of its crack, with the deferred growth at its tips, mm.
    pub length_mm: f64,
    /// Its deferred growth, mm.
    pub waiting_mm: f64,
    /// da/dN in the last finished step, mm per cycle.
    pub rate_mm_per_cycle: f64,
    /// Why it stopped, where it did.
    #[serde(with = "words::optional")]
    pub stop: Option<TipStop>,
}

/// The path of a crack: points (x, y) in mm from the first to the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrackSummary {
    /// In step 0.
    pub initial_points_mm: Vec<[f64; 2]>,
    /// In the last finished step.
    pub points_mm: Vec<[f64; 2]>,
    /// The whole path with what wear and grinding have removed of it, in the coordinates of the
    /// initial surface; left out where nothing is removed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path_mm: Option<Vec<[f64; 2]>>,
}

/// A crack in space in the first and in the last finished step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontSummary {
    /// Semi-axis down the dip in step 0, of a folded crack the length over the fold, mm.
    pub initial_length_mm: f64,
    /// Semi-axis along the surface in step 0, mm.
    pub initial_surface_half_length_mm: f64,
    /// The same in the last step, mm.
    pub length_mm: f64,
    /// Semi-axis along the surface, mm.
    pub surface_half_length_mm: f64,
    /// Distance of the fold of a folded crack from the mouth, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fold_mm: Option<f64>,
    /// Depth of the deepest point of the front, mm.
    pub depth_mm: f64,
    /// Lateral positions of its ends, mm.
    pub z_mm: [f64; 2],
    /// Of a free front, the largest distance of a point from the ellipse with these semi-axes,
    /// relative to that of the ellipse from the middle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub front_deviation: Option<f64>,
}

/// A piece of the rail that cracks, or cracks and the running surface, enclose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PieceSummary {
    /// How it came to be.
    #[serde(with = "words")]
    pub kind: PieceKind,
    /// The step in which a tip closed the outline.
    pub step: usize,
    /// Number of the crack of that tip, from 1.
    pub crack: usize,
    /// Area, mm².
    pub area_mm2: f64,
    /// Its greatest depth below the running surface, mm.
    #[serde(default)]
    pub thickness_mm: f64,
    /// Its cause: growth, wear or a grinding.
    #[serde(default)]
    pub cause: PieceCause,
    /// Corners (x, y) in order, mm; the last is joined to the first.
    pub outline_mm: Vec<[f64; 2]>,
}

/// A crack that has joined another one by the last finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JunctionSummary {
    /// Number of the joining crack, from 1.
    pub crack: usize,
    /// The end of the crack that has joined.
    #[serde(with = "words")]
    pub end: End,
    /// Number of the crack that it has joined, from 1.
    pub onto: usize,
    /// Abscissa, mm.
    pub x_mm: f64,
    /// Ordinate, mm.
    pub y_mm: f64,
}

/// Margin against brittle fracture: the k1 of its stabilised passages, over all kink angles, that
/// is largest in relation to the toughness.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FractureSummary {
    /// k1, MPa √m.
    pub largest_k1_mpa_sqrt_m: f64,
    /// The step in which it is reached.
    pub step: usize,
    /// Number of the crack, from 1.
    pub crack: usize,
    /// Number of the tip within its crack, from 1.
    pub tip: usize,
    /// Abscissa of the tip, mm.
    pub x_mm: f64,
    /// Ordinate of the tip, mm.
    pub y_mm: f64,
    /// x_c of the output position at which it is largest, mm; null where it is between two
    /// passages.
    pub xc_mm: Option<f64>,
    /// Angle of the kink from straight ahead, degrees, counter-clockwise positive.
    pub kink_deg: f64,
    /// K_Ic of `[fracture]` at the temperature under the wheel that causes it, MPa √m; null where
    /// the case has none.
    pub toughness_mpa_sqrt_m: Option<f64>,
    /// k1 over K_Ic; at 1 the rail breaks.
    pub of_toughness: Option<f64>,
}
