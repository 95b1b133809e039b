//! Quadrature on the cells of an element.

use super::cuts::CutElement;
use crate::math::{Orientation, Vec2, gauss_legendre, orientation};

/// A point (mm) with its weight (mm²).
pub(super) type WeightedPoint = (Vec2, f64);

/// Gauss rules by number of points.
#[derive(Debug, Clone)]
pub(super) struct Rules {
    rules: Vec<Vec<(f64, f64)>>,
}

/// Points per direction for products of derivatives of eight-node shape functions: of degree 4
/// together, and 5 with the mapping of a square to a triangle.
const POLYNOMIAL: usize = 3;
/// Points per direction and triangle at the tip, where r = t² makes the integrand smooth.
const AT_TIP: usize = 8;

impl Rules {
    pub(super) fn new() -> Self {
        Self { rules: (0..=12).map(gauss_legendre).collect() }
    }

    /// The quadrature points of a cell. `singular` are the tips whose √r functions act in the
    /// element.
    pub(super) fn on_cell(&self, cut: &CutElement, cell: usize, singular: &[Vec2]) -> Vec<WeightedPoint> {
        let polygon = cut.arrangement.polygon(cell);
        let size = cut.element.size();
        let reach = size.x.max(size.y);
        let nearest = singular
            .iter()
            .map(|&tip| (distance(&polygon, tip) / reach, tip))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let whole = cut.arrangement.cells.len() == 1;
        match nearest {
            Some((ratio, tip)) if ratio < NEAR => self.around(&polygon, tip, AT_TIP, Radial::Squared),
            Some((ratio, tip)) => {
                // Gauss quadrature of r^(−1) at this distance converges like ρ^(−2n).
                let points = if ratio < 1.5 { 7 } else { 5 };
                if whole {
                    self.rectangle(cut, points)
                } else {
                    self.around(&polygon, tip, points, Radial::Linear)
                }
            }
            None if whole => self.rectangle(cut, 3),
            None => self.fan(&polygon, POLYNOMIAL),
        }
    }

    fn rectangle(&self, cut: &CutElement, points: usize) -> Vec<WeightedPoint> {
        let (lower, size) = (cut.element.lower, cut.element.size());
        let rule = &self.rules[points];
        let area = size.x * size.y;
        rule.iter()
            .flat_map(|&(s, v)| {
                rule.iter()
                    .map(move |&(t, w)| (Vec2::new(lower.x + s * size.x, lower.y + t * size.y), v * w * area))
            })
            .collect()
    }

    /// Points in the triangles from the first corner of a convex polygon, each a collapsed square,
    /// for integrands that this rule integrates exactly.
    fn fan(&self, polygon: &[Vec2], points: usize) -> Vec<WeightedPoint> {
        let mut all = Vec::new();
        for i in 1..polygon.len() - 1 {
            self.triangle(polygon[0], polygon[i], polygon[i + 1], points, Radial::Linear, &mut all);
        }
        all
    }

    /// Points in the triangles from the point of the polygon nearest to the tip, which is the tip
    /// itself if it is a corner. Mirrored polygons have mirrored triangles.
    fn around(&self, polygon: &[Vec2], tip: Vec2, points: usize, radial: Radial) -> Vec<WeightedPoint> {
        let apex = nearest_point(polygon, tip);
        let mut all = Vec::new();
        for i in 0..polygon.len() {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            self.triangle(apex, a, b, points, radial, &mut all);
        }
        all
    }

    fn triangle(
        &self,
        apex: Vec2,
        a: Vec2,
        b: Vec2,
        points: usize,
        radial: Radial,
        all: &mut Vec<WeightedPoint>,
    ) {
        let twice_area = (a - apex).cross(b - apex);
        if twice_area <= 0.0 {
            return;
        }
        let rule = &self.rules[points];
        for &(s, v) in rule {
            // The fraction of the distance from the apex, and its weight times that fraction.
            let (share, weight) = match radial {
                Radial::Linear => (s, v * s),
                Radial::Squared => (s * s, 2.0 * v * s * s * s),
            };
            for &(t, w) in rule {
                let point = apex + ((a - apex) * (1.0 - t) + (b - apex) * t) * share;
                all.push((point, weight * w * twice_area));
            }
        }
    }
}

/// Distribution of the points from the apex of a triangle.
#[derive(Clone, Copy)]
enum Radial {
    /// Uniform in the distance.
    Linear,
    /// Proportional to t², for integrands like r^(−1).
    Squared,
}

/// Distance from a tip, over the size of the element, below which a cell is integrated from its
/// point nearest to the tip.
const NEAR: f64 = 0.6;

/// Distance (mm) of a point from a convex polygon, 0 inside.
fn distance(polygon: &[Vec2], point: Vec2) -> f64 {
    (nearest_point(polygon, point) - point).length()
}

fn nearest_point(polygon: &[Vec2], point: Vec2) -> Vec2 {
    if polygon.contains(&point) {
        return point;
    }
    let sides = (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]));
    if sides.clone().all(|(a, b)| orientation(a, b, point) != Orientation::Right) {
        return point;
    }
    sides
        .map(|(a, b)| {
            let along = b - a;
            let squared = along.dot(along);
            let t = if squared > 0.0 { ((point - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
            a + along * t
        })
        .min_by(|p, q| (*p - point).length().total_cmp(&(*q - point).length()))
        .expect("a polygon has sides")
}
