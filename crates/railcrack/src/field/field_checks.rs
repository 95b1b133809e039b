//! Numerical checks of the fields of wheels.

use super::Wheel;
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};

/// The largest component.
pub(super) fn largest(s: Stress) -> f64 {
    s.xx.abs().max(s.yy.abs()).max(s.zz.abs()).max(s.xy.abs())
}

/// |div σ| (MPa/mm) at `point` with the wheel at 0, by central differences of `step` (mm).
pub(super) fn equilibrium(wheel: &dyn Wheel, point: Vec2, step: f64) -> f64 {
    let at = |dx: f64, dy: f64| wheel.stress(point + Vec2::new(dx, dy), 0.0);
    let dx = (at(step, 0.0) - at(-step, 0.0)) * (0.5 / step);
    let dy = (at(0.0, step) - at(0.0, -step)) * (0.5 / step);
    (dx.xx + dy.xy).hypot(dx.xy + dy.yy)
}

/// Difference (MPa) between the stress at `point` and that of the strains of the displacement
/// there, by central differences of `step` (mm).
pub(super) fn strains(wheel: &dyn Wheel, steel: &IsotropicElastic, point: Vec2, step: f64) -> f64 {
    let at = |dx: f64, dy: f64| wheel.displacement(point + Vec2::new(dx, dy), 0.0);
    let dx = (at(step, 0.0) - at(-step, 0.0)) * (0.5 / step);
    let dy = (at(0.0, step) - at(0.0, -step)) * (0.5 / step);
    largest(steel.plane_strain_stress(dx.x, dy.y, dx.y + dy.x) - wheel.stress(point, 0.0))
}
