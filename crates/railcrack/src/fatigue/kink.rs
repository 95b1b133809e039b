//! Stress intensity factors of virtual kinks.

use crate::fracture::Sif;
use std::f64::consts::PI;

/// Stress intensity factors of a virtual kink at the tip, MPa √mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkSif {
    /// k1 (opening mode).
    pub k1: f64,
    /// k2 (shear mode).
    pub k2: f64,
}

/// The four functions of the kink angle in k1 = F11 K_I + F12 K_II, k2 = F21 K_I + F22 K_II.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkFunctions {
    /// F11, even in the angle.
    pub f11: f64,
    /// F12, odd.
    pub f12: f64,
    /// F21, odd.
    pub f21: f64,
    /// F22, even.
    pub f22: f64,
}

const PI2: f64 = PI * PI;
const PI3: f64 = PI2 * PI;
const PI4: f64 = PI2 * PI2;
const PI5: f64 = PI4 * PI;
const PI6: f64 = PI3 * PI3;

// Coefficients of m⁰, m², … m²⁰ (F11, F22) and m, m³, … m¹⁹ (F12, F21): Amestoy & Leblond 1992,
// appendix.
const F11: [f64; 11] = [
    1.0,
    -3.0 * PI2 / 8.0,
    PI2 - 5.0 * PI4 / 128.0,
    PI2 / 9.0 - 11.0 * PI4 / 72.0 + 119.0 * PI6 / 15360.0,
    5.07790,
    -2.88312,
    -0.0925,
    2.996,
    -4.059,
    1.63,
    4.1,
];
const F12: [f64; 10] = [
    -3.0 * PI / 2.0,
    10.0 * PI / 3.0 + PI3 / 16.0,
    -2.0 * PI - 133.0 * PI3 / 180.0 + 59.0 * PI5 / 1280.0,
    12.313906,
    -7.32433,
    1.5793,
    4.0216,
    -6.915,
    4.21,
    4.56,
];
const F21: [f64; 10] = [
    PI / 2.0,
    -(4.0 * PI / 3.0 + PI3 / 48.0),
    -2.0 * PI / 3.0 + 13.0 * PI3 / 30.0 - 59.0 * PI5 / 3840.0,
    -6.176023,
    4.44112,
    -1.5340,
    -2.0700,
    4.684,
    -3.95,
    -1.32,
];
const F22: [f64; 11] = [
    1.0,
    -(4.0 + 3.0 * PI2 / 8.0),
    8.0 / 3.0 + 29.0 * PI2 / 18.0 - 5.0 * PI4 / 128.0,
    -32.0 / 15.0 - 4.0 * PI2 / 9.0 - 1159.0 * PI4 / 7200.0 + 119.0 * PI6 / 15360.0,
    10.58254,
    -4.78511,
    -1.8804,
    7.280,
    -7.591,
    0.25,
    12.5,
];

impl KinkFunctions {
    /// The functions at the kink `angle` (radians, counter-clockwise positive from straight ahead).
    ///
    /// Series in m = angle/π to m²⁰ for an infinitesimal kink. Largest error of any of the four,
    /// measured against the kinked crack solved by conformal mapping: 1e-10 at 45°, 3e-8 at 70°,
    /// 5e-6 at 90°, 3e-4 at 110°.
    ///
    /// Source: Amestoy & Leblond 1992, Int. J. Solids Struct. 29, 465–501; Leblond 1999, Int. J.
    /// Solids Struct. 36, 79–103.
    #[must_use]
    pub fn at(angle: f64) -> Self {
        let m = angle / PI;
        let m2 = m * m;
        let series = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * m2 + c);
        Self { f11: series(&F11), f12: m * series(&F12), f21: m * series(&F21), f22: series(&F22) }
    }

    /// k1 and k2 of the virtual kink for K_I and K_II of the actual `tip`, in the same units.
    #[must_use]
    pub fn kinked(&self, tip: Sif) -> KinkSif {
        KinkSif { k1: self.f11 * tip.ki + self.f12 * tip.kii, k2: self.f21 * tip.ki + self.f22 * tip.kii }
    }
}

#[cfg(test)]
#[path = "kink_tests.rs"]
mod tests;
