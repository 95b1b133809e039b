//! Exact orientation and intersection predicates.

use super::Vec2;

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
