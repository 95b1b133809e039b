//! Quadrilateral cells of a crack with curved edges.

/// Degree of the polynomials in each direction that describe a cell.
const DEGREE: usize = 4;
const TERMS: usize = DEGREE + 1;

/// A cell: the image of the unit square (u, v) in the plane (s, ζ) by polynomials of degree 4 in
/// each direction, with one bilinear hat at each corner. Corners in the order (0, 0), (1, 0),
/// (1, 1), (0, 1).
#[derive(Debug, Clone)]
pub(super) struct Cell {
    /// Vertices at the corners.
    pub vertices: [usize; 4],
    /// Coefficients of u^i v^j of s and ζ.
    terms: [[[f64; 2]; TERMS]; TERMS],
}

/// A point of a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellPoint {
    /// s and ζ, mm.
    pub position: [f64; 2],
    /// The hats.
    pub hats: [f64; 4],
    /// The gradients of the hats (∂_s, ∂_ζ) times the area per unit square, mm.
    pub gradients: [[f64; 2]; 4],
    /// Area per unit square, mm².
    pub area: f64,
}

pub(super) const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

impl Cell {
    /// The cell whose point (u, v) is `position(u, v)`.
    pub fn new(vertices: [usize; 4], position: impl Fn(f64, f64) -> [f64; 2]) -> Self {
        let at = |k: usize| k as f64 / DEGREE as f64;
        let inverse = monomials();
        let mut terms = [[[0.0; 2]; TERMS]; TERMS];
        for a in 0..TERMS {
            for b in 0..TERMS {
                let value = position(at(a), at(b));
                for i in 0..TERMS {
                    for j in 0..TERMS {
                        for c in 0..2 {
                            terms[i][j][c] += inverse[a][i] * inverse[b][j] * value[c];
                        }
                    }
                }
            }
        }
        Self { vertices, terms }
    }

    /// The derivative of (s, ζ) at (u, v) in the direction `along` of the unit square.
    pub fn slope(&self, u: f64, v: f64, along: [f64; 2]) -> [f64; 2] {
        let (_, pu, pv) = self.map(u, v);
        std::array::from_fn(|c| along[0] * pu[c] + along[1] * pv[c])
    }

    /// Position and its derivatives in u and v.
    fn map(&self, u: f64, v: f64) -> ([f64; 2], [f64; 2], [f64; 2]) {
        let (mut p, mut pu, mut pv) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for row in self.terms.iter().rev() {
            let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
            for term in row.iter().rev() {
                for c in 0..2 {
                    slope[c] = slope[c] * v + value[c];
                    value[c] = value[c] * v + term[c];
                }
            }
            for c in 0..2 {
                pu[c] = pu[c] * u + p[c];
                p[c] = p[c] * u + value[c];
                pv[c] = pv[c] * u + slope[c];
            }
        }
        (p, pu, pv)
    }

    /// The point (u, v).
    pub fn at(&self, u: f64, v: f64) -> CellPoint {
        let (p, pu, pv) = self.map(u, v);
        let determinant = pu[0] * pv[1] - pu[1] * pv[0];
        let sign = determinant.signum();
        let hats = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
        let du = [-(1.0 - v), 1.0 - v, v, -v];
        let dv = [-(1.0 - u), -u, u, 1.0 - u];
        let gradients = std::array::from_fn(|a| {
            [sign * (du[a] * pv[1] - dv[a] * pu[1]), sign * (dv[a] * pu[0] - du[a] * pv[0])]
        });
        CellPoint { position: p, hats, gradients, area: determinant.abs() }
    }
}

/// Row a: the coefficients of the Lagrange polynomial of the point a/4.
fn monomials() -> [[f64; TERMS]; TERMS] {
    std::array::from_fn(|a| {
        let mut coefficients = [0.0; TERMS];
        coefficients[0] = 1.0;
        let mut degree = 0;
        for b in (0..TERMS).filter(|&b| b != a) {
            let (xa, xb) = (a as f64 / DEGREE as f64, b as f64 / DEGREE as f64);
            degree += 1;
            for i in (0..=degree).rev() {
                let lower = if i > 0 { coefficients[i - 1] } else { 0.0 };
                coefficients[i] = (lower - xb * coefficients[i]) / (xa - xb);
            }
        }
        coefficients
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_and_gradients_of_a_curved_cell() {
        let exact = |u: f64, v: f64| [1.0 + u + 0.1 * v * v, 2.0 * v + 0.3 * u * v + 0.05 * u.powi(3)];
        let cell = Cell::new([0, 1, 2, 3], exact);
        let (u, v, h) = (0.3, 0.6, 1e-6);
        let point = cell.at(u, v);
        for c in 0..2 {
            assert!((point.position[c] - exact(u, v)[c]).abs() < 1e-13);
        }
        // ∇N · ∂x/∂u = ∂N/∂u.
        let (e, w) = (exact(u + h, v), exact(u - h, v));
        let du = [(e[0] - w[0]) / (2.0 * h), (e[1] - w[1]) / (2.0 * h)];
        let slope = (point.gradients[2][0] * du[0] + point.gradients[2][1] * du[1]) / point.area;
        assert!((slope - v).abs() < 1e-8, "{slope}");
    }
}
