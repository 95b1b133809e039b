//! Smooth curves through the points of a front.

/// The ends of a line through points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineEnds {
    /// The last point is followed by the first.
    Joined,
    /// The line ends at the first and the last point.
    Apart,
}

/// Parts of the curve between two points.
const PARTS: usize = 6;

/// Points of a curve through `points`, by cubic splines with the slopes of the neighbours (Catmull
/// and Rom 1974); too few points are left as they are.
pub(crate) fn smooth<const N: usize>(points: &[[f64; N]], ends: LineEnds) -> Vec<[f64; N]> {
    let count = points.len();
    if count < 3 {
        return points.to_vec();
    }
    let spans = if ends == LineEnds::Joined { count } else { count - 1 };
    let at = |place: isize| -> [f64; N] {
        match ends {
            LineEnds::Joined => points[place.rem_euclid(count as isize) as usize],
            // Beyond an end the line goes straight on.
            LineEnds::Apart if place < 0 => mirrored(points[0], points[1]),
            LineEnds::Apart if place >= count as isize => mirrored(points[count - 1], points[count - 2]),
            LineEnds::Apart => points[place as usize],
        }
    };
    let mut curve = Vec::with_capacity(spans * PARTS + 1);
    for span in 0..spans as isize {
        let four = [span - 1, span, span + 1, span + 2].map(at);
        curve.extend((0..PARTS).map(|part| between(four, part as f64 / PARTS as f64)));
    }
    curve.push(at(spans as isize));
    curve
}

/// The point as far beyond `end` as `other` is before it.
fn mirrored<const N: usize>(end: [f64; N], other: [f64; N]) -> [f64; N] {
    std::array::from_fn(|c| 2.0 * end[c] - other[c])
}

/// The curve between the second and the third of four points.
fn between<const N: usize>([a, b, c, d]: [[f64; N]; 4], t: f64) -> [f64; N] {
    std::array::from_fn(|i| {
        let [a, b, c, d] = [a[i], b[i], c[i], d[i]];
        let (square, cube) = (t * t, t * t * t);
        0.5 * (2.0 * b
            + (c - a) * t
            + (2.0 * a - 5.0 * b + 4.0 * c - d) * square
            + (3.0 * b - a - 3.0 * c + d) * cube)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_of_few_points_is_round() {
        let corner = |i: usize| (std::f64::consts::TAU * i as f64 / 12.0).sin_cos();
        let points: Vec<[f64; 2]> = (0..12).map(corner).map(|(y, x)| [x, y]).collect();
        let curve = smooth(&points, LineEnds::Joined);
        assert_eq!(curve.len(), 12 * PARTS + 1);
        assert!(curve.iter().all(|[x, y]| (x.hypot(*y) - 1.0).abs() < 0.005));
        let half = smooth(&points[..7], LineEnds::Apart);
        assert_eq!((half[0], half[6 * PARTS]), (points[0], points[6]));
    }
}
