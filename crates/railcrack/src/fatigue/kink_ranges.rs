//! Ranges of the stress intensity factors of virtual kinks.

use super::{KinkFunctions, KinkSif, LoadRange};
use crate::fracture::Sif;

/// Loading of a virtual kink by one wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct KinkLoad<'a> {
    /// K of the tip: where the faces of the kink are frictionless, the corners of the convex hull
    /// of the samples, which are the extremes of all linear functions of them; otherwise all
    /// samples in their order.
    pub samples: &'a [Sif],
    /// Friction coefficient of the faces of the kink.
    pub friction: f64,
}

impl KinkLoad<'_> {
    /// k1 and k2 of the kink at `angle`, with k2 as far as friction lets the faces slip: closed
    /// faces (k1 < 0) bear a shear of up to μ|k1|, so that k2 follows a play operator of that
    /// half-width. The passage is followed twice, so that the result is that of repeated passages.
    fn kinked(&self, angle: f64) -> impl Iterator<Item = KinkSif> + '_ {
        let functions = KinkFunctions::at(angle);
        let all = self.samples.iter().map(move |&tip| functions.kinked(tip));
        let friction = self.friction;
        let slip = move |slipped: f64, k: KinkSif| {
            let play = friction * (-k.k1).max(0.0);
            slipped.clamp(k.k2 - play, k.k2 + play)
        };
        let before = if friction > 0.0 { all.clone().fold(0.0, slip) } else { 0.0 };
        all.scan(before, move |slipped, k| {
            *slipped = slip(*slipped, k);
            Some(KinkSif { k1: k.k1, k2: *slipped })
        })
    }
}

/// Ranges of k1 and k2 at one angle over the passage.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct KinkRanges {
    pub k1_max: f64,
    pub delta_k1: f64,
    pub delta_k1_unclipped: f64,
    pub delta_k2: f64,
}

impl KinkRanges {
    pub(crate) fn of(load: KinkLoad<'_>, angle: f64) -> Self {
        let (mut k1_low, mut k1_top) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut k2_low, mut k2_high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in load.kinked(angle) {
            (k1_low, k1_top) = (k1_low.min(k.k1), k1_top.max(k.k1));
            (k2_low, k2_high) = (k2_low.min(k.k2), k2_high.max(k.k2));
        }
        if load.samples.is_empty() {
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
pub(super) fn vector_range(load: KinkLoad<'_>, angle: f64) -> f64 {
    let values: Vec<(f64, f64)> = load.kinked(angle).map(|k| (k.k1.max(0.0), k.k2)).collect();
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
        let samples = [tip(-100.0, 0.0), tip(3.0, 4.0), tip(0.0, -2.0)];
        let range = vector_range(KinkLoad { samples: &samples, friction: 0.0 }, 0.0);
        assert!((range - 45f64.sqrt()).abs() < ROUNDING, "{range}");
    }

    /// Reversed mode II of amplitude 1: at 30°, Δk1² + 0.772 Δk2² falls from 2.495 to 1.993 with a
    /// friction of 0.3; straight ahead the faces bear no pressure, and at −76° there is no k2.
    #[test]
    fn friction_holds_back_a_closed_kink() {
        let tip = |kii: f64| Sif { ki: 0.0, kii };
        let samples = [tip(0.0), tip(1.0), tip(-1.0), tip(0.0)];
        let drive = |degrees: f64, friction: f64| {
            let ranges = KinkRanges::of(KinkLoad { samples: &samples, friction }, degrees.to_radians());
            ranges.delta_k1.powi(2) + 0.772 * ranges.delta_k2.powi(2)
        };
        assert!((drive(30.0, 0.0) - 2.495).abs() < 1e-3, "{}", drive(30.0, 0.0));
        assert!((drive(30.0, 0.3) - 1.993).abs() < 1e-3, "{}", drive(30.0, 0.3));
        assert_eq!(drive(0.0, 0.3), drive(0.0, 0.0));
        assert!((drive(-76.0, 0.3) - drive(-76.0, 0.0)).abs() < 2e-3);
        // A strong friction lets the kink slip only while it is open.
        let stuck = KinkRanges::of(KinkLoad { samples: &samples, friction: 1e6 }, 0.5);
        let open = KinkFunctions::at(0.5).kinked(tip(-1.0));
        assert!((stuck.delta_k2 - open.k2.abs()).abs() < ROUNDING, "{stuck:?}");
    }
}
