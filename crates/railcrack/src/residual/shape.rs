//! Shape functions of plane cells.

use crate::math::Vec2;
use crate::mesh::{CORNERS, shape_functions};

/// A plane cell: corners in order, then the midpoints of the sides, the first between the first and
/// the second corner, then the centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlaneShape {
    /// 3 corners.
    Triangle,
    /// 4 corners.
    Quad,
    /// Corners and midpoints of the sides.
    QuadraticTriangle,
    /// Corners and midpoints of the sides (serendipity).
    QuadraticQuad,
    /// Corners, midpoints of the sides and centre (Lagrange).
    BiquadraticQuad,
}

/// Largest number of nodes of a cell.
pub(super) const MOST_NODES: usize = 9;

/// Values, ∂/∂ξ and ∂/∂η of the shape functions of a cell; only as many entries as it has nodes
/// count.
pub(super) type Shapes = [[f64; 3]; MOST_NODES];

impl PlaneShape {
    /// Number of corners.
    pub(super) fn corners(self) -> usize {
        if self.is_triangle() { 3 } else { 4 }
    }

    pub(super) fn is_triangle(self) -> bool {
        matches!(self, Self::Triangle | Self::QuadraticTriangle)
    }

    /// Reference coordinates of the centre.
    pub(super) fn centre(self) -> Vec2 {
        if self.is_triangle() { Vec2::new(1.0 / 3.0, 1.0 / 3.0) } else { Vec2::default() }
    }

    /// Integration points and weights of the reference cell, exact for polynomials of the third
    /// degree.
    pub(super) fn rule(self) -> Vec<(Vec2, f64)> {
        if self.is_triangle() {
            // Strang & Fix: six points, exact to the fourth degree.
            let (a, b) = (0.445_948_490_915_965, 0.091_576_213_509_771);
            let (wa, wb) = (0.5 * 0.223_381_589_678_011, 0.5 * 0.109_951_743_655_322);
            let three = |p: f64| [Vec2::new(p, p), Vec2::new(1.0 - 2.0 * p, p), Vec2::new(p, 1.0 - 2.0 * p)];
            return three(a).map(|p| (p, wa)).into_iter().chain(three(b).map(|p| (p, wb))).collect();
        }
        let at = 1.0 / 3f64.sqrt();
        CORNERS.iter().map(|[x, y]| (Vec2::new(at * x, at * y), 1.0)).collect()
    }

    /// The shape functions at `at`: (ξ, η) in the triangle 0 ≤ ξ, η, ξ + η ≤ 1 or in the square
    /// [−1, 1]².
    ///
    /// Source: Zienkiewicz & Taylor, The Finite Element Method, standard isoparametric families.
    pub(super) fn functions(self, at: Vec2) -> Shapes {
        let (x, y) = (at.x, at.y);
        let mut shapes = [[0.0; 3]; MOST_NODES];
        let barycentric = [[1.0 - x - y, -1.0, -1.0], [x, 1.0, 0.0], [y, 0.0, 1.0]];
        match self {
            Self::Triangle => shapes[..3].copy_from_slice(&barycentric),
            Self::QuadraticTriangle => {
                for (i, [l, lx, ly]) in barycentric.into_iter().enumerate() {
                    shapes[i] = [l * (2.0 * l - 1.0), (4.0 * l - 1.0) * lx, (4.0 * l - 1.0) * ly];
                    let [m, mx, my] = barycentric[(i + 1) % 3];
                    shapes[3 + i] = [4.0 * l * m, 4.0 * (lx * m + l * mx), 4.0 * (ly * m + l * my)];
                }
            }
            Self::Quad => {
                for (shape, [a, b]) in shapes.iter_mut().zip(CORNERS) {
                    let (p, q) = (1.0 + a * x, 1.0 + b * y);
                    *shape = [0.25 * p * q, 0.25 * a * q, 0.25 * b * p];
                }
            }
            Self::QuadraticQuad => {
                shapes[..8].copy_from_slice(&shape_functions(x, y));
            }
            Self::BiquadraticQuad => {
                let line = |t: f64, place: f64| {
                    if place == 0.0 {
                        [1.0 - t * t, -2.0 * t]
                    } else {
                        [0.5 * t * (t + place), t + 0.5 * place]
                    }
                };
                let middles = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 0.0]];
                for (shape, [a, b]) in shapes.iter_mut().zip(CORNERS.into_iter().chain(middles)) {
                    let ([p, dp], [q, dq]) = (line(x, a), line(y, b));
                    *shape = [p * q, dp * q, p * dq];
                }
            }
        }
        shapes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [PlaneShape; 5] = [
        PlaneShape::Triangle,
        PlaneShape::Quad,
        PlaneShape::QuadraticTriangle,
        PlaneShape::QuadraticQuad,
        PlaneShape::BiquadraticQuad,
    ];

    fn count(shape: PlaneShape) -> usize {
        match shape {
            PlaneShape::Triangle => 3,
            PlaneShape::Quad => 4,
            PlaneShape::QuadraticTriangle => 6,
            PlaneShape::QuadraticQuad => 8,
            PlaneShape::BiquadraticQuad => 9,
        }
    }

    /// Reference coordinates of the nodes.
    fn nodes(shape: PlaneShape) -> Vec<Vec2> {
        let corners: Vec<Vec2> = if shape.is_triangle() {
            vec![Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)]
        } else {
            CORNERS.iter().map(|[x, y]| Vec2::new(*x, *y)).collect()
        };
        let sides = corners.len();
        let middles = (0..sides).map(|i| (corners[i] + corners[(i + 1) % sides]) * 0.5);
        let all = corners.iter().copied().chain(middles).chain([shape.centre()]);
        all.take(count(shape)).collect()
    }

    #[test]
    fn functions_are_one_at_their_own_node_and_derivatives_are_consistent() {
        for shape in SHAPES {
            for (i, node) in nodes(shape).into_iter().enumerate() {
                for (j, value) in shape.functions(node)[..count(shape)].iter().enumerate() {
                    assert!((value[0] - f64::from(i == j)).abs() < 1e-14, "{shape:?} {i} {j}");
                }
            }
            let (at, step) = (Vec2::new(0.21, 0.17), 1e-6);
            let (here, right, up) = (
                shape.functions(at),
                shape.functions(at + Vec2::new(step, 0.0)),
                shape.functions(at + Vec2::new(0.0, step)),
            );
            for i in 0..count(shape) {
                assert!(((right[i][0] - here[i][0]) / step - here[i][1]).abs() < 1e-5, "{shape:?} {i}");
                assert!(((up[i][0] - here[i][0]) / step - here[i][2]).abs() < 1e-5, "{shape:?} {i}");
            }
        }
    }

    #[test]
    fn rules_integrate_cubics() {
        for shape in SHAPES {
            let integral = |f: &dyn Fn(Vec2) -> f64| -> f64 {
                shape.rule().iter().map(|(at, weight)| weight * f(*at)).sum()
            };
            // ∫ ξ²η over the triangle is 2!·1!/5!, over the square 0; ∫ ξ² is 2!/4! and 4/3.
            let (cubic, square) =
                if shape.is_triangle() { (1.0 / 60.0, 1.0 / 12.0) } else { (0.0, 4.0 / 3.0) };
            assert!((integral(&|p| p.x * p.x * p.y) - cubic).abs() < 1e-14, "{shape:?}");
            assert!((integral(&|p| p.x * p.x) - square).abs() < 1e-14, "{shape:?}");
        }
    }
}
