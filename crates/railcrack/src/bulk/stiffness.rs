//! Stiffness matrices of eight-node rectangles.

use crate::material::IsotropicElastic;
use crate::math::{Matrix, Vec2, gauss_legendre};
use crate::mesh::{NODES, shape_functions};

/// Stiffness of 8-node rectangles of any size in plane strain, integrated exactly.
///
/// With the Lamé constants λ, μ, sides h_x, h_y and A = ∫N_ξ N_ξ, B = ∫N_η N_η, C = ∫N_ξ N_η over
/// the reference square: K_xx = (λ + 2μ) (h_y/h_x) A + μ (h_x/h_y) B, K_yy with A and B
/// interchanged, K_xy = λ C + μ Cᵀ.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RectangleStiffness {
    lambda: f64,
    mu: f64,
    along_x: [[f64; NODES]; NODES],
    along_y: [[f64; NODES]; NODES],
    mixed: [[f64; NODES]; NODES],
}

impl RectangleStiffness {
    /// The integrals for elements of `steel`.
    pub(crate) fn new(steel: &IsotropicElastic) -> Self {
        let (lambda, mu) = lame(steel);
        let zero = [[0.0; NODES]; NODES];
        let mut stiffness = Self { lambda, mu, along_x: zero, along_y: zero, mixed: zero };
        // Products of derivatives have degree 4 in each direction.
        let rule = gauss_legendre(3);
        for (&(s, v), &(t, w)) in rule.iter().flat_map(|s| rule.iter().map(move |t| (s, t))) {
            let shapes = shape_functions(2.0 * s - 1.0, 2.0 * t - 1.0);
            let weight = 4.0 * v * w;
            for (i, a) in shapes.iter().enumerate() {
                for (j, b) in shapes.iter().enumerate() {
                    stiffness.along_x[i][j] += weight * a[1] * b[1];
                    stiffness.along_y[i][j] += weight * a[2] * b[2];
                    stiffness.mixed[i][j] += weight * a[1] * b[2];
                }
            }
        }
        stiffness
    }

    /// The stiffness (N/mm per mm of thickness, 16 × 16) of a rectangle of width and height `size`
    /// (mm); unknown 2i is u_x, 2i + 1 u_y of node i.
    pub(crate) fn matrix(&self, size: Vec2) -> Matrix {
        let (wide, high) = (size.x / size.y, size.y / size.x);
        let (lambda, mu) = (self.lambda, self.mu);
        Matrix::from_fn(2 * NODES, 2 * NODES, |row, column| {
            let (i, j) = (row / 2, column / 2);
            let (along_x, along_y) = (high * self.along_x[i][j], wide * self.along_y[i][j]);
            match (row % 2, column % 2) {
                (0, 0) => (lambda + 2.0 * mu) * along_x + mu * along_y,
                (1, 1) => (lambda + 2.0 * mu) * along_y + mu * along_x,
                (0, _) => lambda * self.mixed[i][j] + mu * self.mixed[j][i],
                _ => lambda * self.mixed[j][i] + mu * self.mixed[i][j],
            }
        })
    }
}

/// The Lamé constants λ and μ, MPa.
fn lame(steel: &IsotropicElastic) -> (f64, f64) {
    let (mu, nu) = (steel.shear_modulus(), steel.poisson());
    (2.0 * mu * nu / (1.0 - 2.0 * nu), mu)
}
