//! Fig. 21: the stress by depth described in the paper, read in two ways, and the residual stress
//! of rolled rails.

use crate::steel::Steel;
use railcrack::field::{DepthProfile, StressField};
use railcrack::math::Vec2;
use railcrack::shakedown::{RailState, StabilisedRail};
/// Depths of the table and the picture, mm.
const DEEPEST: f64 = 16.0;
const SPACING: f64 = 0.1;

/// A profile of Fig. 21.
pub(super) struct StressProfile {
    pub name: String,
    /// σ_xx at every multiple of [`SPACING`] down to [`DEEPEST`], MPa.
    pub sxx: Vec<f64>,
    /// Depth, mm, and plastic shear ε_p,xy of every layer, where it was computed.
    pub plastic_shear: Vec<[f64; 2]>,
    /// The state that repeated passages lead to, where it was computed.
    pub state: Option<RailState>,
}

impl StressProfile {
    /// Depth (mm) and σ_xx (MPa).
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        depths().zip(self.sxx.iter().copied())
    }

    /// Depth (mm) and value (MPa) of the largest |σ_xx|.
    pub(super) fn extreme(&self) -> (f64, f64) {
        let largest = |best: (f64, f64), (i, s): (usize, &f64)| {
            if s.abs() > best.1.abs() { (i as f64 * SPACING, *s) } else { best }
        };
        self.sxx.iter().enumerate().fold((0.0, 0.0), largest)
    }
}

fn depths() -> impl Iterator<Item = f64> {
    (0..=(DEEPEST / SPACING).round() as usize).map(|i| i as f64 * SPACING)
}

/// The table `given` in both readings, then the residual stress of `rolled` rails. A plastic stress
/// along the rail that depends on depth alone is balanced by its opposite in a half-plane.
pub(super) fn profiles(given: &DepthProfile, rolled: &[(Steel, StabilisedRail)]) -> Vec<StressProfile> {
    let readings =
        [("read as balanced stress", 1.0), ("read as plastic stress, balanced in a half-plane", -1.0)];
    let reading = |(name, factor): (&str, f64)| StressProfile {
        name: name.into(),
        sxx: depths().map(|depth| factor * given.stress(Vec2::new(0.0, -depth)).xx).collect(),
        plastic_shear: Vec::new(),
        state: None,
    };
    let kept = |(steel, rail): &(Steel, StabilisedRail)| StressProfile {
        name: steel.words(),
        sxx: depths().map(|depth| rail.residual_stress(depth).xx).collect(),
        plastic_shear: rail.profile.iter().map(|layer| [layer.depth, layer.strain.xy]).collect(),
        state: Some(rail.state),
    };
    readings.map(reading).into_iter().chain(rolled.iter().map(kept)).collect()
}
