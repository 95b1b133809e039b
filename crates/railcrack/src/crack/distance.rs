//! Distances between crack segments.

use crate::math::{Vec2, segments_touch};

/// The distance (mm) between the closed segments a–b and c–d; exactly zero when they touch.
pub fn segment_distance(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> f64 {
    if segments_touch(a, b, c, d) {
        return 0.0;
    }
    point_to_segment(a, c, d)
        .min(point_to_segment(b, c, d))
        .min(point_to_segment(c, a, b))
        .min(point_to_segment(d, a, b))
}

/// The distance (mm) of the point p from the closed segment a–b.
pub(crate) fn point_to_segment(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    from_nearest(p, a, b).length()
}

/// The vector (mm) from the nearest point of the closed segment a–b to the point p.
pub(crate) fn from_nearest(p: Vec2, a: Vec2, b: Vec2) -> Vec2 {
    let along = b - a;
    let squared = along.dot(along);
    let t = if squared > 0.0 { ((p - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    p - (a + along * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossing_parallel_and_end_to_side() {
        let p = Vec2::new;
        assert_eq!(segment_distance(p(0., 0.), p(2., 2.), p(0., 2.), p(2., 0.)), 0.0);
        assert_eq!(segment_distance(p(0., 0.), p(4., 0.), p(1., 3.), p(2., 3.)), 3.0);
        assert_eq!(segment_distance(p(0., 0.), p(4., 0.), p(7., 4.), p(9., 9.)), 5.0);
        assert_eq!(segment_distance(p(0., 0.), p(0., 0.), p(-1., 2.), p(1., 2.)), 2.0);
    }
}
