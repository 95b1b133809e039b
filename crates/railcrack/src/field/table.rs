//! Fields of the half-plane under a pressure and shear that are linear between rows of a table.

use super::Wheel;
use super::hertz_half_plane::{Lanes, side_by_side};
use super::table_potential::{TablePotential, Transforms};
use crate::load::TableContact;
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
use num_complex::Complex64 as Complex;
use std::f64::consts::PI;

/// A wheel with a contact from a table.
///
/// Φ(z) = (i/2π) ∫ (p + i q)/(z − t) dt and, above the surface, the same with z̄ (Muskhelishvili,
/// § 93): with P and Q the transforms of p and q,
///
/// σ_xx + σ_yy = −(2/π)(Im P + Re Q),  σ_yy = (−Im P + y (Re P′ − Im Q′))/π,
/// σ_xy = (Im Q + y (Im P′ + Re Q′))/π.
///
/// Series replace most of the sums over the rows; they change no stress component by more than 4e-7
/// of the largest pressure.
#[derive(Debug, Clone)]
pub struct TableWheel {
    contact: TableContact,
    potential: TablePotential,
    /// Middle of the table from x_c, mm.
    middle: f64,
    per_half_width: f64,
    steel: IsotropicElastic,
    edges: Vec<f64>,
}

impl TableWheel {
    /// The wheel with `contact` on a rail of `steel`.
    pub fn new(contact: &TableContact, steel: &IsotropicElastic) -> Self {
        let (middle, per_half_width) = (contact.middle(), 1.0 / contact.half_width());
        let rows: Vec<[f64; 3]> = contact
            .rows()
            .iter()
            .map(|row| [(row.u - middle) * per_half_width, row.pressure, row.shear])
            .collect();
        Self {
            contact: contact.clone(),
            potential: TablePotential::new(&rows),
            middle,
            per_half_width,
            steel: *steel,
            edges: contact.edges(),
        }
    }

    #[inline(always)]
    fn place(&self, point: Vec2, xc: f64) -> (f64, f64) {
        ((point.x - (xc + self.middle)) * self.per_half_width, (point.y * self.per_half_width).min(0.0))
    }

    #[inline(always)]
    fn stress_of(&self, at: &Transforms, y: f64) -> Stress {
        const PER_PI: f64 = 1.0 / PI;
        let trace = -2.0 * PER_PI * (at.p.im + at.q.re);
        let yy = PER_PI * (y * (at.p_slope.re - at.q_slope.im) - at.p.im);
        let xy = PER_PI * (y * (at.p_slope.im + at.q_slope.re) + at.q.im);
        Stress { xx: trace - yy, yy, zz: self.steel.poisson() * trace, xy }
    }
}

impl Lanes for TableWheel {
    #[inline(always)]
    fn at(&self, point: Vec2, xc: f64) -> Stress {
        let (x, y) = self.place(point, xc);
        self.stress_of(&self.potential.at(x, y), y)
    }
}

impl Wheel for TableWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        Lanes::at(self, point, xc)
    }

    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        side_by_side(self, points, xc)
    }

    /// 2G (u_x + i u_y) = κ φ(z) + φ(z̄) − (z − z̄) conj Φ(z), φ = ∫ Φ dz, as for
    /// `HertzDisplacement`.
    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let (x, y) = self.place(point, xc);
        let [p, q] = self.potential.integrals(x, y);
        let Transforms { p: p_density, q: q_density, .. } = self.potential.at(x, y);
        let kolosov = 3.0 - 4.0 * self.steel.poisson();
        let (even, odd) = (kolosov + 1.0, kolosov - 1.0);
        // φ = (i/2π)(P + i Q) integrated; φ(z̄) has conj P and conj Q; y (…) is −(z − z̄) conj Φ.
        let ux = -even * q.re - odd * p.im - 2.0 * y * (p_density.re - q_density.im);
        let uy = even * p.re - odd * q.im + 2.0 * y * (p_density.im + q_density.re);
        let scale = 1.0 / (4.0 * PI * self.steel.shear_modulus() * self.per_half_width);
        Vec2::new(ux, uy) * scale
    }

    fn edges(&self) -> &[f64] {
        &self.edges
    }

    fn half_width(&self) -> f64 {
        self.contact.half_width()
    }
}

/// The stress at a point due to tractions on a part of the running surface that are one at one of
/// its ends and fall linearly to zero at the other end; the first of each pair is one at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SegmentStress {
    /// Due to a pressure.
    pub pressure: [Stress; 2],
    /// Due to a shear along +x on the rail.
    pub shear: [Stress; 2],
}

/// A point as seen from an end of a part of the running surface; two parts share an end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SegmentEnd {
    /// z = x + i y from the end, mm.
    z: Complex,
    /// ln z with −π ≤ arg z ≤ 0.
    logarithm: Complex,
    /// 1/z.
    inverse: Complex,
}

impl SegmentEnd {
    /// `point` (mm, below the surface) from the end at the abscissa `x` (mm).
    pub(crate) fn of(point: Vec2, x: f64) -> Self {
        let z = Complex::new(point.x - x, point.y.min(0.0));
        Self { z, logarithm: lower_logarithm(z), inverse: z.inv() }
    }
}

impl SegmentStress {
    /// The stress at a point due to unit tractions (MPa) on the part of the running surface between
    /// two of its ends.
    ///
    /// With z = x + i y from the start, h the length, L = ln z − ln(z − h) and −π ≤ arg ≤ 0, the
    /// transforms ∫ p/(z − t) dt are (1 − z/h) L + 1 and (z/h) L − 1; the stress follows from them
    /// and from their derivatives as in [`super::TableWheel`].
    pub(crate) fn between(from: &SegmentEnd, to: &SegmentEnd) -> Self {
        let (h, y) = (from.z.re - to.z.re, from.z.im);
        let share = from.z / h;
        let logarithm = from.logarithm - to.logarithm;
        let difference = from.inverse - to.inverse;
        let falling = ((1.0 - share) * logarithm + 1.0, (1.0 - share) * difference - logarithm / h);
        let rising = (share * logarithm - 1.0, share * difference + logarithm / h);
        Self {
            pressure: [falling, rising].map(|transform| of_pressure(transform, y)),
            shear: [falling, rising].map(|transform| of_shear(transform, y)),
        }
    }
}

/// ln z with −π ≤ arg z ≤ 0.
fn lower_logarithm(z: Complex) -> Complex {
    let argument = z.im.atan2(z.re);
    Complex::new(0.5 * z.norm_sqr().ln(), if argument > 0.0 { -argument } else { argument })
}

fn of_pressure((p, slope): (Complex, Complex), y: f64) -> Stress {
    let yy = (y * slope.re - p.im) / PI;
    Stress { xx: -2.0 / PI * p.im - yy, yy, zz: 0.0, xy: y * slope.im / PI }
}

fn of_shear((q, slope): (Complex, Complex), y: f64) -> Stress {
    let yy = -y * slope.im / PI;
    Stress { xx: -2.0 / PI * q.re - yy, yy, zz: 0.0, xy: (q.im + y * slope.re) / PI }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{TableWheel, Wheel};
    use crate::load::{ContactRow, TableContact};
    use crate::material::IsotropicElastic;

    #[test]
    fn two_parts_make_a_triangular_load() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        for (pressure, shear) in [(1.0, 0.0), (1.0, 0.4)] {
            let row = |u, share| ContactRow { u, pressure: share * pressure, shear: share * shear };
            let rows = vec![row(-1.5, 0.0), row(0.5, 1.0), row(1.5, 0.0)];
            let table = TableWheel::new(&TableContact::new(rows, None).unwrap(), &steel);
            for (x, y) in [(0.0, -0.01), (0.5, -0.3), (-3.0, -2.0), (20.0, -5.0)] {
                let point = Vec2::new(x, y);
                let [start, middle, end] = [-1.5, 0.5, 1.5].map(|x| SegmentEnd::of(point, x));
                let (rises, falls) =
                    (SegmentStress::between(&start, &middle), SegmentStress::between(&middle, &end));
                let sum = (rises.pressure[1] + falls.pressure[0]) * pressure
                    + (rises.shear[1] + falls.shear[0]) * shear;
                let want = table.stress(point, 0.0);
                for (got, want) in [(sum.xx, want.xx), (sum.yy, want.yy), (sum.xy, want.xy)] {
                    assert!((got - want).abs() < 1e-6, "{point:?}: {got} {want}"); // series of the table
                }
            }
        }
    }
}

#[cfg(test)]
#[path = "table_tests.rs"]
mod table_tests;
