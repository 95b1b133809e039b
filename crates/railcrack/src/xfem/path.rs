//! Crack paths and tip frames of the enrichment, and face points near junctions.
//!
//! The jumps of the arms of a junction are coupled there, since the displacement around it is
//! single-valued: n arms have n contact conditions but n − 1 free jumps. So no face point lies at
//! the junction itself. On the last element of each arm jumps and tractions are constant at their
//! values at its other end: no part of the tractions is lost or counted twice.

use crate::body::{FaceElement, FaceMesh};
use crate::crack::{Crack, CrackCurve, CrackNetwork, End, point_to_segment};
use crate::math::{Orientation, Vec2, orientation};

/// Distance of a point from the line between its neighbours, relative to the length of the crack,
/// below which it is left out. Increments straight ahead leave points that are collinear up to
/// round-off, and two cutting lines that differ by round-off cannot be ordered.
pub(super) const STRAIGHT: f64 = 1e-9;

/// The path of a crack without the points at which it does not kink.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CutPath {
    pub points: Vec<Vec2>,
    /// Arc length (mm) at each point.
    pub s: Vec<f64>,
}

impl CutPath {
    pub(super) fn new(crack: &Crack) -> Self {
        let all = crack.points();
        let tolerance = STRAIGHT * crack.length();
        let mut kept = vec![0];
        while *kept.last().expect("never empty") + 1 < all.len() {
            let from = kept[kept.len() - 1];
            let straight =
                |to: usize| (from + 1..to).all(|i| point_to_segment(all[i], all[from], all[to]) <= tolerance);
            let mut to = from + 1;
            while to + 1 < all.len() && straight(to + 1) {
                to += 1;
            }
            kept.push(to);
        }
        let points: Vec<Vec2> = kept.iter().map(|&i| all[i]).collect();
        let mut s = vec![0.0];
        let mut length = 0.0;
        for i in 1..all.len() {
            length += (all[i] - all[i - 1]).length();
            if kept.contains(&i) {
                s.push(length);
            }
        }
        Self { points, s }
    }

    pub(super) fn segments(&self) -> usize {
        self.points.len() - 1
    }

    pub(super) fn segment(&self, i: usize) -> (Vec2, Vec2) {
        (self.points[i], self.points[i + 1])
    }

    /// The kink angle (radians, 0 to π) of the path at point `i`, which is not an end.
    pub(super) fn turn(&self, i: usize) -> f64 {
        let (a, b) = (self.points[i] - self.points[i - 1], self.points[i + 1] - self.points[i]);
        a.cross(b).atan2(a.dot(b)).abs()
    }

    /// The distance (mm) of a point, and the arc length (mm) of the nearest point of the path.
    pub(super) fn nearest(&self, point: Vec2) -> (f64, f64) {
        let of_segment = |i: usize| {
            let (from, to) = self.segment(i);
            let at = self.arc_length(i, point).clamp(self.s[i], self.s[i + 1]);
            (point_to_segment(point, from, to), at)
        };
        let nearer = |a: (f64, f64), b: (f64, f64)| if b.0 < a.0 { b } else { a };
        (0..self.segments()).map(of_segment).fold((f64::INFINITY, 0.0), nearer)
    }

    /// Arc length of a point on segment `i`.
    pub(super) fn arc_length(&self, i: usize, point: Vec2) -> f64 {
        let (from, to) = self.segment(i);
        let along = to - from;
        self.s[i] + (self.s[i + 1] - self.s[i]) * ((point - from).dot(along) / along.dot(along))
    }
}

/// A tip with its frame and the crack behind it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TipPath {
    pub crack: usize,
    pub end: End,
    /// The crack, traversed towards the tip.
    points: Vec<Vec2>,
    pub ahead: Vec2,
}

impl TipPath {
    pub(super) fn new(crack: usize, path: &CutPath, end: End) -> Self {
        let mut points = path.points.clone();
        if end == End::First {
            points.reverse();
        }
        let n = points.len();
        Self { crack, end, ahead: (points[n - 1] - points[n - 2]).normalised(), points }
    }

    /// The part of the crack before its kink at point `i`, as if it ended there.
    pub(super) fn before_kink(crack: usize, path: &CutPath, i: usize) -> Self {
        let points = path.points[..=i].to_vec();
        Self { crack, end: End::Last, ahead: (points[i] - points[i - 1]).normalised(), points }
    }

    /// The tip, mm.
    pub(super) fn position(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    /// The segment that ends at the tip.
    pub(super) fn last_segment(&self) -> (Vec2, Vec2) {
        (self.points[self.points.len() - 2], self.position())
    }

    /// The kink angle (radians, 0 to π) of the crack at the beginning of its last segment; none if
    /// that is the only segment.
    pub(super) fn last_turn(&self) -> Option<f64> {
        let n = self.points.len();
        let before = self.points[n - 2] - *self.points.get(n.checked_sub(3)?)?;
        Some(before.cross(self.ahead).atan2(before.dot(self.ahead)).abs())
    }

    /// A point inside a convex cell that no crack cuts, and its angle (radians) from straight
    /// ahead, continued across the extension of the last segment and cut along the actual crack:
    /// the ray from the tip changes sheet where it crosses the crack.
    ///
    /// Sides are determined exactly from the corners of the cell, so that round-off cannot move the
    /// point of a sliver to the wrong side.
    pub(super) fn sheet(&self, cell: &[Vec2]) -> (Vec2, f64) {
        let inside = cell.iter().fold(Vec2::default(), |sum, &v| sum + v) * (1.0 / cell.len() as f64);
        let tip = self.position();
        let mut angle = self.straight_angle(inside);
        let (from, to) = self.last_segment();
        if angle.abs() > 0.5 * std::f64::consts::PI {
            match side_of(cell, inside, from, to) {
                Orientation::Left if angle < 0.0 => angle += std::f64::consts::TAU,
                Orientation::Right if angle > 0.0 => angle -= std::f64::consts::TAU,
                _ => {}
            }
        }
        for pair in self.points[..self.points.len() - 1].windows(2) {
            let left_of_ray = |v: Vec2| orientation(tip, inside, v) != Orientation::Right;
            // A ray through a kink is counted for one of the two segments that meet there.
            if left_of_ray(pair[0]) == left_of_ray(pair[1]) {
                continue;
            }
            match (orientation(pair[0], pair[1], tip), side_of(cell, inside, pair[0], pair[1])) {
                (Orientation::Left, Orientation::Right) => angle -= std::f64::consts::TAU,
                (Orientation::Right, Orientation::Left) => angle += std::f64::consts::TAU,
                _ => {}
            }
        }
        (inside, angle)
    }

    /// The angle of a point near another one whose angle is known; the straight line between them
    /// does not cross the crack.
    pub(super) fn angle_near(&self, point: Vec2, known: Vec2, angle: f64) -> f64 {
        let (a, b) = (known - self.position(), point - self.position());
        angle + a.cross(b).atan2(a.dot(b))
    }

    fn straight_angle(&self, point: Vec2) -> f64 {
        let arm = point - self.position();
        self.ahead.cross(arm).atan2(self.ahead.dot(arm))
    }

    /// Components along x and y of a vector that is given in the tip frame.
    pub(super) fn to_global(&self, v: Vec2) -> Vec2 {
        self.ahead * v.x + self.ahead.left() * v.y
    }
}

/// The side of the line p → q on which a cell lies; the side of its inner point when the line cuts
/// the cell.
fn side_of(cell: &[Vec2], inside: Vec2, p: Vec2, q: Vec2) -> Orientation {
    let has = |wanted| cell.iter().any(|&v| orientation(p, q, v) == wanted);
    match (has(Orientation::Left), has(Orientation::Right)) {
        (true, false) => Orientation::Left,
        (false, true) => Orientation::Right,
        _ => orientation(p, q, inside),
    }
}

/// The points of `crack` at which other cracks meet it, by index, in order.
pub(super) fn junctions_on(network: &CrackNetwork, crack: usize) -> Vec<usize> {
    let last = network.cracks()[crack].points().len() - 1;
    let mut points: Vec<usize> = network
        .junction_points()
        .iter()
        .flat_map(|point| {
            let ends = point.ends.iter().filter(|end| end.crack == crack).map(|end| match end.end {
                End::First => 0,
                End::Last => last,
            });
            let through = point.through.filter(|passing| passing.crack == crack);
            ends.chain(through.map(|passing| passing.vertex)).collect::<Vec<usize>>()
        })
        .collect();
    points.sort_unstable();
    points
}

/// Removes the face points at junctions and adds their share to the next point of the same arm.
/// `joined` are the points of each crack at which other cracks meet it.
pub(super) fn leave_junctions(
    curves: &[CrackCurve],
    joined: &[Vec<usize>],
    elements: &mut [FaceElement],
    faces: &mut FaceMesh,
) {
    let mut heir: Vec<usize> = (0..faces.points.len()).collect();
    for element in elements.iter_mut() {
        let vertices = curves[element.crack].vertices();
        let at = joined[element.crack].iter().map(|&point| vertices[point]);
        let ends = [element.range.0, element.range.1];
        for g in at {
            for (own, other) in [(0, 1), (1, 0)] {
                if let (true, [Some(a), Some(b)]) = (ends[own] == g, element.ends) {
                    heir[[a, b][own]] = [a, b][other];
                }
            }
        }
    }
    let stays: Vec<bool> = heir.iter().enumerate().map(|(i, &heir)| i == heir).collect();
    let mut number = vec![0; heir.len()];
    let mut next = 0;
    for (i, number) in number.iter_mut().enumerate() {
        *number = next;
        next += usize::from(stays[i]);
    }
    let new = |point: usize| number[heir[point]];
    for i in 0..heir.len() {
        if !stays[i] {
            let weight = faces.points[i].weight;
            faces.points[heir[i]].weight += weight;
        }
    }
    for element in elements {
        element.ends = element.ends.map(|point| point.map(new));
    }
    let samples = faces.samples.iter_mut().chain(&mut faces.graded);
    for (point, _) in samples.flat_map(|sample| &mut sample.shares) {
        *point = new(*point);
    }
    let mut stays = stays.into_iter();
    faces.points.retain(|_| stays.next().unwrap_or(true));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn straight_increments_make_one_segment() {
        let mut crack = Crack::surface_breaking(0.0, 6.0, 0.3).unwrap();
        for _ in 0..25 {
            crack = crack.extended(End::Last, 0.24, 0.0).unwrap();
        }
        let path = CutPath::new(&crack);
        assert_eq!(path.segments(), 1);
        assert!((path.s[1] - 12.0).abs() < 1e-12);
        let kinked = crack.extended(End::Last, 0.24, 1e-3).unwrap();
        assert_eq!(CutPath::new(&kinked).segments(), 2);
    }

    #[test]
    fn the_angle_is_cut_along_the_kinked_crack() {
        // The old segment rises behind the kink: points between it and the straight extension are
        // below the crack.
        let points = vec![Vec2::new(-1.0, -1.0), Vec2::new(0.0, -2.0), Vec2::new(1.0, -2.0)];
        let crack = Crack::polyline(points).unwrap();
        let tip = TipPath::new(0, &CutPath::new(&crack), End::Last);
        let angle = |x: f64, y: f64| tip.sheet(&[Vec2::new(x, y)]).1;
        let below = angle(-1.0, -1.9);
        assert!(below < -PI && below > -1.1 * PI, "{below}");
        let above = angle(-0.2, -1.7);
        assert!(above > 0.0 && above < PI, "{above}");
        assert!((angle(1.0, -1.0) - 0.5 * PI).abs() < 1e-15);
        let near = tip.angle_near(Vec2::new(-1.0, -2.1), Vec2::new(-1.0, -1.9), below);
        assert!((near - angle(-1.0, -2.1)).abs() < 1e-14);
    }
}
