//! Fields of the half-plane under a pressure and shear that are linear between rows of a table.

use super::Wheel;
use super::hertz_half_plane::{Lanes, side_by_side};
use super::table_potential::{TablePotential, Transforms};
use crate::load::TableContact;
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
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

#[cfg(test)]
#[path = "table_tests.rs"]
mod tests;
