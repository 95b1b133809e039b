//! Stress of a finite-element field at given points, by interpolation between Gauss points.

use super::rail::{BulkError, BulkRail};
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2, lagrange};
use crate::mesh::shape_functions;

/// Stress recovery at fixed points of a mesh from nodal displacements, prepared for many fields.
///
/// The stress is computed at the 2 × 2 Gauss points of the elements, where the stress of 8-node
/// rectangles is superconvergent (Barlow, Int. J. Numer. Meth. Engng 10, 1976). On a grid these
/// points lie on lines, along which cubic polynomials interpolate from the nearest four by four,
/// and extrapolate to the surface.
#[derive(Debug, Clone)]
pub struct StressAtPoints {
    /// Displacement gradients: for each point the contributing nodes, with the weights of ∂/∂x and
    /// ∂/∂y.
    slopes: Vec<Vec<(usize, Vec2)>>,
    steel: IsotropicElastic,
}

impl StressAtPoints {
    /// Prepares `points` (mm) of the mesh of `rail`.
    ///
    /// Errors: a point outside the mesh.
    pub fn new(rail: &BulkRail, points: &[Vec2]) -> Result<Self, BulkError> {
        let mesh = rail.mesh();
        let (along_x, along_y) = (gauss_lines(mesh.x_lines()), gauss_lines(mesh.y_lines()));
        let slopes_at = |point: Vec2| {
            mesh.locate(point).ok_or(BulkError::Point { x: point.x, y: point.y })?;
            let (first_x, weights_x) = lagrange(&along_x, point.x);
            let (first_y, weights_y) = lagrange(&along_y, point.y);
            let mut slopes: Vec<(usize, Vec2)> = Vec::new();
            for (j, wy) in weights_y.iter().enumerate() {
                for (i, wx) in weights_x.iter().enumerate() {
                    let (gx, gy) = (first_x + i, first_y + j);
                    let element = mesh.element((gy / 2) * mesh.columns() + gx / 2);
                    let (xi, eta) = element.reference(Vec2::new(along_x[gx], along_y[gy]));
                    let scale = Vec2::new(2.0 / element.size().x, 2.0 / element.size().y) * (wx * wy);
                    for (node, shape) in element.nodes.into_iter().zip(shape_functions(xi, eta)) {
                        slopes.push((node, Vec2::new(scale.x * shape[1], scale.y * shape[2])));
                    }
                }
            }
            slopes.sort_by_key(|(node, _)| *node);
            slopes.dedup_by(|next, kept| {
                let same = next.0 == kept.0;
                if same {
                    kept.1 = kept.1 + next.1;
                }
                same
            });
            Ok(slopes)
        };
        let slopes = points.iter().map(|&point| slopes_at(point)).collect::<Result<_, BulkError>>()?;
        Ok(Self { slopes, steel: *rail.steel() })
    }

    /// The stress (MPa) of the displacements (mm, node by node), point by point.
    pub fn stress(&self, displacements: &[Vec2]) -> Vec<Stress> {
        let at_point = |slopes: &Vec<(usize, Vec2)>| {
            let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
            for &(node, slope) in slopes {
                let u = displacements[node];
                xx += slope.x * u.x;
                yy += slope.y * u.y;
                xy += slope.y * u.x + slope.x * u.y;
            }
            self.steel.plane_strain_stress(xx, yy, xy)
        };
        self.slopes.iter().map(at_point).collect()
    }
}

/// The two Gauss points of each cell between neighbouring `lines`, increasing.
pub(crate) fn gauss_lines(lines: &[f64]) -> Vec<f64> {
    let at = 1.0 / 3f64.sqrt();
    let pair = |cell: &[f64]| {
        let (middle, half) = (0.5 * (cell[0] + cell[1]), 0.5 * (cell[1] - cell[0]));
        [middle - at * half, middle + at * half]
    };
    lines.windows(2).flat_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_reproduced_inside_and_beyond_the_ends() {
        let at = gauss_lines(&[0.0, 1.0, 1.5, 4.0]);
        let cubic = |x: f64| 1.0 - x + 0.5 * x * x - 0.2 * x * x * x;
        for x in [0.0, 0.1, 0.9, 1.0, 1.7, 3.9, 4.0] {
            let (first, weights) = lagrange(&at, x);
            let got: f64 = weights.iter().enumerate().map(|(k, w)| w * cubic(at[first + k])).sum();
            assert!((got - cubic(x)).abs() < 1e-12, "at {x}"); // round-off of weights of order 10
        }
        assert_eq!(lagrange(&gauss_lines(&[0.0, 1.0]), 0.5).1.len(), 2);
    }
}
