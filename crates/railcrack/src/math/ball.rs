//! Exact orientation of points, and smallest enclosing balls.

use super::Vec2;

/// A ball in N dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ball<const N: usize> {
    /// Centre.
    pub centre: [f64; N],
    /// Radius.
    pub radius: f64,
}

/// Points that lie outside by less than this, relative to the radius squared, count as inside:
/// round-off of a circumscribed ball.
const INSIDE: f64 = 1e-13;
/// Flatter simplices (squared height over squared edges) have no usable circumscribed ball.
const FLAT: f64 = 1e-14;
/// Limit of the number of pivots. Every pivot enlarges the ball, so the loop terminates without it
/// unless a coordinate is NaN.
const PIVOTS: usize = 1000;

/// The smallest ball that contains all `points`; radius 0 at the origin for none.
///
/// The farthest point is added repeatedly to a short list of points, whose smallest ball Welzl's
/// recursion finds exactly.
///
/// Source: Welzl 1991, Smallest enclosing disks; Gärtner 1999, Fast and robust smallest enclosing
/// balls (pivoting).
pub(crate) fn smallest_ball<const N: usize>(points: &[[f64; N]]) -> Ball<N> {
    let Some(&first) = points.first() else { return Ball { centre: [0.0; N], radius: 0.0 } };
    let mut pivots = vec![first];
    let mut ball = Ball { centre: first, radius: 0.0 };
    for _ in 0..PIVOTS {
        let (mut farthest, mut largest) = (first, 0.0);
        for &point in points {
            let distance = squared(difference(point, ball.centre));
            if distance > largest {
                (farthest, largest) = (point, distance);
            }
        }
        if largest <= ball.radius * ball.radius * (1.0 + INSIDE) {
            break;
        }
        pivots.insert(0, farthest);
        let larger = ball_with(&pivots, &mut Vec::with_capacity(N + 1));
        if larger.radius <= ball.radius {
            break;
        }
        ball = larger;
    }
    ball
}

/// The smallest ball around `points` that has all of `boundary` on its surface (Welzl).
fn ball_with<const N: usize>(points: &[[f64; N]], boundary: &mut Vec<[f64; N]>) -> Ball<N> {
    let mut ball = circumscribed(boundary);
    if boundary.len() == N + 1 {
        return ball;
    }
    for (i, &point) in points.iter().enumerate() {
        let inside = ball.radius >= 0.0
            && squared(difference(point, ball.centre)) <= ball.radius * ball.radius * (1.0 + INSIDE);
        if !inside {
            boundary.push(point);
            ball = ball_with(&points[..i], boundary);
            boundary.pop();
        }
    }
    ball
}

/// The smallest ball with up to N + 1 points on its surface; radius −1 for none. A point that lies
/// in the plane of the others to working precision is left out.
///
/// centre = p0 + Σ λ_i q_i in the orthogonalised edges q_i, from
/// (c − p0)·(p_i − p0) = |p_i − p0|²/2.
fn circumscribed<const N: usize>(boundary: &[[f64; N]]) -> Ball<N> {
    let Some((&origin, others)) = boundary.split_first() else {
        return Ball { centre: [0.0; N], radius: -1.0 };
    };
    let mut offset = [0.0; N];
    let mut axes: Vec<[f64; N]> = Vec::with_capacity(N);
    for &point in others {
        let edge = difference(point, origin);
        let axis = axes.iter().fold(edge, |rest, q| added(rest, *q, -dot(rest, *q) / squared(*q)));
        let height = squared(axis);
        if height > FLAT * squared(edge) {
            let missing = 0.5 * squared(edge) - dot(offset, edge);
            offset = added(offset, axis, missing / height);
            axes.push(axis);
        }
    }
    Ball { centre: added(origin, offset, 1.0), radius: squared(offset).sqrt() }
}

fn difference<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    added(a, b, -1.0)
}

fn added<const N: usize>(a: [f64; N], b: [f64; N], times: f64) -> [f64; N] {
    std::array::from_fn(|c| a[c] + times * b[c])
}

fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    (0..N).map(|c| a[c] * b[c]).sum()
}

fn squared<const N: usize>(a: [f64; N]) -> f64 {
    dot(a, a)
}

/// The side of a directed line on which a point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Orientation {
    /// To the left, counter-clockwise.
    Left,
    /// To the right, clockwise.
    Right,
    /// Exactly on the line.
    On,
}

/// The side of the line a → b on which c lies, decided exactly (Shewchuk's adaptive predicate).
pub(crate) fn orientation(a: Vec2, b: Vec2, c: Vec2) -> Orientation {
    let coord = |p: Vec2| robust::Coord { x: p.x, y: p.y };
    let side = robust::orient2d(coord(a), coord(b), coord(c));
    if side > 0.0 {
        Orientation::Left
    } else if side < 0.0 {
        Orientation::Right
    } else {
        Orientation::On
    }
}

/// Whether the closed segments a–b and c–d have a point in common; exact.
pub(crate) fn segments_touch(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    let within = |p: Vec2, q: Vec2, r: Vec2| {
        r.x >= p.x.min(q.x) && r.x <= p.x.max(q.x) && r.y >= p.y.min(q.y) && r.y <= p.y.max(q.y)
    };
    let (c_side, d_side) = (orientation(a, b, c), orientation(a, b, d));
    let (a_side, b_side) = (orientation(c, d, a), orientation(c, d, b));
    if c_side != d_side && a_side != b_side {
        let on = Orientation::On;
        if c_side != on && d_side != on && a_side != on && b_side != on {
            return true;
        }
    }
    (c_side == Orientation::On && within(a, b, c))
        || (d_side == Orientation::On && within(a, b, d))
        || (a_side == Orientation::On && within(c, d, a))
        || (b_side == Orientation::On && within(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Round-off of a circumscribed ball of well-shaped points.
    const ROUNDING: f64 = 1e-12;

    fn assert_ball(points: &[[f64; 3]], centre: [f64; 3], radius: f64) {
        let ball = smallest_ball(points);
        assert!((ball.radius - radius).abs() < ROUNDING, "{ball:?}");
        assert!(squared(difference(ball.centre, centre)).sqrt() < ROUNDING, "{ball:?}");
    }

    #[test]
    fn known_balls() {
        assert_ball(&[], [0.0; 3], 0.0);
        assert_ball(&[[1.0, 2.0, 3.0]; 4], [1.0, 2.0, 3.0], 0.0);
        assert_ball(&[[0.0; 3], [2.0, 0.0, 0.0], [1.0, 0.5, 0.0]], [1.0, 0.0, 0.0], 1.0);
        let h = 3_f64.sqrt();
        let triangle = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, h, 0.0], [0.1, 0.2, 0.3]];
        assert_ball(&triangle, [0.0, 1.0 / h, 0.0], 2.0 / h);
        let tetrahedron =
            [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0], [0.1; 3]];
        assert_ball(&tetrahedron, [0.0; 3], h);
        let cube: Vec<[f64; 3]> = (0..8).map(|i| [0, 1, 2].map(|k| f64::from((i >> k) & 1))).collect();
        assert_ball(&cube, [0.5; 3], 0.5 * h);
    }

    #[test]
    fn smallest_by_its_optimality() {
        // The centre of the smallest ball is a convex combination of the points on its surface: no
        // direction brings all of them nearer. Pseudo-random points, some repeated, some collinear.
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        for round in 0..200 {
            let flat = f64::from(u8::from(round % 3 != 0));
            let mut points: Vec<[f64; 3]> = (0..60).map(|_| [next(), 3.0 * next(), flat * next()]).collect();
            points.extend_from_within(..10);
            let ball = smallest_ball(&points);
            let on: Vec<[f64; 3]> = points
                .iter()
                .map(|p| difference(*p, ball.centre))
                .filter(|p| (squared(*p).sqrt() / ball.radius - 1.0).abs() < 1e-9)
                .collect();
            assert!(
                points
                    .iter()
                    .all(|p| squared(difference(*p, ball.centre)).sqrt() <= ball.radius * (1.0 + 1e-12))
            );
            for _ in 0..500 {
                let direction = [next(), next(), next()];
                let nearest = on.iter().map(|p| dot(*p, direction)).fold(f64::INFINITY, f64::min);
                assert!(nearest <= 1e-9, "round {round}: {nearest:e}");
            }
        }
    }

    #[test]
    fn segments_that_cross_touch_or_miss() {
        let p = Vec2::new;
        assert!(segments_touch(p(0., 0.), p(2., 2.), p(0., 2.), p(2., 0.)), "crossing");
        assert!(segments_touch(p(0., 0.), p(2., 0.), p(1., 0.), p(1., 3.)), "T");
        assert!(segments_touch(p(0., 0.), p(2., 0.), p(1., 0.), p(3., 0.)), "overlapping on one line");
        assert!(!segments_touch(p(0., 0.), p(1., 0.), p(2., 0.), p(3., 0.)), "one line, apart");
        assert!(!segments_touch(p(0., 0.), p(2., 2.), p(0., 1.), p(1., 2.)), "parallel");
        assert!(!segments_touch(p(0., 0.), p(1., 1.), p(2., 0.), p(1.5, 3.)), "line crossed outside");
    }
}
