//! Convex hulls of SIF histories.

use crate::fracture::Sif;
use crate::math::{Orientation, Vec2, orientation};

/// The corners of the convex hull of `samples` in the (K_I, K_II) plane, counter-clockwise: a
/// linear function of K attains its extremes at corners. Fewer than three samples, or collinear
/// ones, yield their end points.
///
/// Andrew's monotone chain with an exact orientation test; all samples finite.
pub(crate) fn convex_hull(samples: &[Sif]) -> Vec<Sif> {
    // Adding zero turns −0 into +0, which are equal and must not be sorted apart.
    let mut points: Vec<Vec2> = samples.iter().map(|k| Vec2::new(k.ki + 0.0, k.kii + 0.0)).collect();
    points.sort_unstable_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    points.dedup();
    let to_sif = |p: &Vec2| Sif { ki: p.x, kii: p.y };
    if points.len() < 3 {
        return points.iter().map(to_sif).collect();
    }
    let mut corners = half_hull(points.iter().copied());
    corners.extend(half_hull(points.iter().rev().copied()));
    corners.iter().map(to_sif).collect()
}

/// The corners from the first point up to, but excluding, the last one, with all other points to
/// the left.
fn half_hull(points: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut chain: Vec<Vec2> = Vec::new();
    for point in points {
        while let [.., before, last] = chain[..] {
            if orientation(before, last, point) == Orientation::Left {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn k(ki: f64, kii: f64) -> Sif {
        Sif { ki, kii }
    }

    #[test]
    fn corners_of_a_square_with_points_inside_and_on_its_sides() {
        let samples =
            [k(0., 0.), k(1., 1.), k(2., 0.), k(1., 0.), k(2., 2.), k(0., 2.), k(0., 1.), k(2., 2.)];
        assert_eq!(convex_hull(&samples), [k(0., 0.), k(2., 0.), k(2., 2.), k(0., 2.)]);
    }

    #[test]
    fn a_line_has_two_ends_and_a_point_one() {
        let line: Vec<Sif> = (0..9).map(|i| k(f64::from(i), -2.0 * f64::from(i))).collect();
        assert_eq!(convex_hull(&line), [k(0., 0.), k(8., -16.)]);
        assert_eq!(convex_hull(&[k(0., 0.), k(-0.0, 0.)]), [k(0., 0.)]);
        assert!(convex_hull(&[]).is_empty());
        let zeros_of_both_signs = [k(-0.0, 3.), k(0., 1.), k(0., 7.), k(1., 0.)];
        assert_eq!(convex_hull(&zeros_of_both_signs), [k(0., 1.), k(1., 0.), k(0., 7.)]);
    }
}
