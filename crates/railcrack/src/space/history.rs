//! Results of a passage of a wheel over cracks in space.

use super::body::FrontSif;
use super::states::SpaceFaces;
use crate::contact::FluidState;

/// Settings of the load steps of passages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpacePassageSettings {
    /// Largest difference of K between two steps and one of twice the length, MPa √mm.
    pub tolerance: f64,
    /// How often two intervals between positions may be halved, the first time into one step each;
    /// with 0, each interval is one step and nothing is compared.
    pub halvings: usize,
}

/// K along the front and the faces at all wheel positions.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceHistory {
    /// Abscissae of the centre of the contact, mm.
    pub positions: Vec<f64>,
    /// K (MPa √mm): by position, then by front point.
    pub sifs: Vec<Vec<FrontSif>>,
    /// K under the constant stress alone, before the wheel arrives.
    pub before: Vec<FrontSif>,
    /// The faces, by position.
    pub faces: Vec<SpaceFaces>,
    /// The fluid in each crack, by position; empty without fluid.
    pub fluid: Vec<Vec<FluidState>>,
    /// Number of load steps, including those of the step control.
    pub steps: usize,
    /// Newton iterations of all steps.
    pub iterations: usize,
    /// Largest number of iterations of a step.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions.
    pub violation: f64,
    /// Largest difference of K (MPa √mm) that was accepted between two steps and one of twice the
    /// length.
    pub step_error: f64,
}

impl SpaceHistory {
    /// The largest |K|, MPa √mm.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let sizes = |k: &FrontSif| k.ki.abs().max(k.kii.abs()).max(k.kiii.abs());
        self.sifs.iter().flatten().map(sizes).fold(0.0, f64::max)
    }

    /// The largest difference of K from another history at the same positions, MPa √mm.
    #[must_use]
    pub fn difference(&self, other: &Self) -> f64 {
        let pairs = self.sifs.iter().flatten().zip(other.sifs.iter().flatten());
        pairs.map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
    }
}
