//! Ranges of the stress intensity factors of virtual kinks.

use super::{KinkFunctions, LoadRange};
use crate::fracture::Sif;

/// Ranges of k1 and k2 at one angle over the passage. They follow from the extremes of linear
/// functions of (K_I, K_II), so the corners of the convex hull of the samples suffice.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct KinkRanges {
    pub k1_max: f64,
    pub delta_k1: f64,
    pub delta_k1_unclipped: f64,
    pub delta_k2: f64,
}

impl KinkRanges {
    pub(crate) fn of(extremes: &[Sif], angle: f64) -> Self {
        let functions = KinkFunctions::at(angle);
        let (mut k1_low, mut k1_top) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut k2_low, mut k2_high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in extremes.iter().map(|&k| functions.kinked(k)) {
            (k1_low, k1_top) = (k1_low.min(k.k1), k1_top.max(k.k1));
            (k2_low, k2_high) = (k2_low.min(k.k2), k2_high.max(k.k2));
        }
        if extremes.is_empty() {
            return Self::default();
        }
        let k1_high = k1_top.max(0.0);
        Self {
            k1_max: k1_high,
            delta_k1: k1_high - k1_low.max(0.0).min(k1_high),
            delta_k1_unclipped: k1_top - k1_low,
            delta_k2: k2_high - k2_low,
        }
    }

    /// The ranges with negative k1 clipped at zero.
    pub(crate) fn clipped(&self) -> LoadRange {
        LoadRange::new(self.delta_k1, self.delta_k2, self.k1_max)
    }

    /// The ranges with negative k1 included.
    pub(crate) fn unclipped(&self) -> LoadRange {
        LoadRange { delta_ki: self.delta_k1_unclipped, ..self.clipped() }
    }
}

/// The largest distance between two values of (k1, k2) at one angle, k1 clipped at zero.
pub(super) fn vector_range(extremes: &[Sif], angle: f64) -> f64 {
    let functions = KinkFunctions::at(angle);
    let of = |&tip: &Sif| {
        let k = functions.kinked(tip);
        (k.k1.max(0.0), k.k2)
    };
    let values: Vec<(f64, f64)> = extremes.iter().map(of).collect();
    let distances =
        values.iter().enumerate().flat_map(|(i, a)| values[..i].iter().map(|b| (a.0 - b.0).hypot(a.1 - b.1)));
    distances.fold(0.0, f64::max)
}

/// The largest tangential stress √(2πr) σ_θθ at `angle` ahead of the actual tip: cos(θ/2) (K_I
/// cos²(θ/2) − 3/2 K_II sin θ); zero if it is never tensile.
pub(super) fn tangential(extremes: &[Sif], angle: f64) -> f64 {
    let half = (0.5 * angle).cos();
    let of = |k: &Sif| half * (k.ki * half * half - 1.5 * k.kii * angle.sin());
    extremes.iter().map(of).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROUNDING: f64 = 1e-12;

    /// In pure mode II the largest tangential stress is 2/√3 K_II, at cos θ = 1/3.
    #[test]
    fn tangential_stress_of_pure_mode_two() {
        let angle = -(1.0_f64 / 3.0).acos();
        let value = tangential(&[Sif { ki: 0.0, kii: 1.0 }], angle);
        assert!((value - 2.0 / 3f64.sqrt()).abs() < ROUNDING, "{value}");
        assert!(tangential(&[Sif { ki: 0.0, kii: 1.0 }], angle + 0.01) < value);
    }

    /// Straight ahead k1 and k2 are K_I and K_II: a closed tip has only slipped.
    #[test]
    fn vector_ranges_leave_out_closed_faces() {
        let tip = |ki: f64, kii: f64| Sif { ki, kii };
        let range = vector_range(&[tip(-100.0, 0.0), tip(3.0, 4.0), tip(0.0, -2.0)], 0.0);
        assert!((range - 45f64.sqrt()).abs() < ROUNDING, "{range}");
    }
}
