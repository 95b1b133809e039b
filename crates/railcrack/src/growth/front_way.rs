//! The way of a crack in space down its middle, where it turns out of the plane of its mouth.
//!
//! The surface of the crack is that way moved along the trace of its mouth: it bends about that
//! direction alone, and unrolls into a plane without being stretched.

use serde::{Deserialize, Serialize};

/// Largest number of pieces of a way; two neighbours become one where there would be more.
const MOST: usize = 24;

/// How a crack turns: straight from its mouth on, then piece by piece, each of which is an arc, and
/// straight behind the last one. A piece without length is a fold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontTurns {
    /// Length of the straight part at the mouth, mm.
    pub straight: f64,
    count: u8,
    /// Lengths (mm), and increases of the angle between way and +x (radians).
    pieces: [[f64; 2]; MOST],
}

impl FrontTurns {
    /// Straight for this length (mm).
    #[must_use]
    pub fn after(straight: f64) -> Self {
        Self { straight, count: 0, pieces: [[0.0; 2]; MOST] }
    }

    /// A single fold by `turn` (radians) at this distance (mm) from the mouth.
    #[must_use]
    pub fn fold(straight: f64, turn: f64) -> Self {
        Self::after(straight).and(0.0, turn)
    }

    /// Lengths (mm) and turns (radians) of the pieces.
    #[must_use]
    pub fn pieces(&self) -> &[[f64; 2]] {
        &self.pieces[..usize::from(self.count)]
    }

    /// The length (mm) of the straight part and of all pieces.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.straight + self.pieces().iter().map(|[length, _]| length).sum::<f64>()
    }

    /// The sum of all turns, radians.
    #[must_use]
    pub fn turn(&self) -> f64 {
        self.pieces().iter().map(|[_, turn]| turn).sum()
    }

    /// With a further piece of `length` (mm) that turns by `turn` (radians). Where there is no room
    /// for it, the two shortest neighbours become one piece, whose turn is the sum of theirs.
    #[must_use]
    pub fn and(mut self, length: f64, turn: f64) -> Self {
        if usize::from(self.count) == MOST {
            let both = |k: &usize| self.pieces[*k][0] + self.pieces[k + 1][0];
            let smooth = (0..MOST - 1).filter(|&k| self.pieces[k][0] > 0.0 && self.pieces[k + 1][0] > 0.0);
            let first = smooth.min_by(|a, b| both(a).total_cmp(&both(b))).unwrap_or(MOST - 2);
            let [after, by] = self.pieces[first + 1];
            self.pieces[first] = [self.pieces[first][0] + after, self.pieces[first][1] + by];
            self.pieces.copy_within(first + 2.., first + 1);
            self.count -= 1;
        }
        self.pieces[usize::from(self.count)] = [length, turn];
        self.count += 1;
        self
    }

    /// With a further piece of `length` (mm) that turns by `turn` (radians) at this distance `from`
    /// (mm) from the mouth, to which the way is continued straight.
    #[must_use]
    pub fn and_at(self, from: f64, length: f64, turn: f64) -> Self {
        let between = from - self.length();
        match (between > AT_END * from, self.count) {
            (true, 0) => Self { straight: from, ..self },
            (true, _) => self.and(between, 0.0),
            _ => self,
        }
        .and(length, turn)
    }

    /// A way that begins at the angle `dip` (radians) without its first `cut` (mm), and straight
    /// for at least `least` (mm) from there: its first angle, and its turns if any are left. Arcs
    /// next to the new mouth become chords of the same length.
    #[must_use]
    pub fn cut(&self, dip: f64, cut: f64, least: f64) -> (f64, Option<Self>) {
        let way = FrontWay::new(dip, Some(self));
        let straight_to = self.straight.max(cut + least);
        let mut left = Self::after(straight_to - cut);
        let (mut from, mut before) = (self.straight, dip);
        for &[length, turn] in self.pieces() {
            let (to, after) = (from + length, before + turn);
            let is_fold_behind = length == 0.0 && from >= straight_to * (1.0 - AT_END);
            if to > straight_to || (is_fold_behind && from > cut) {
                let share = if length > 0.0 { (to - from.max(straight_to)) / length } else { 1.0 };
                left = left.and(length * share, turn * share);
            }
            (from, before) = (to, after);
        }
        if left.count == 0 {
            return (before, None);
        }
        let [[x, depth], [end, bottom]] = [cut, straight_to].map(|s| way.at(s).place);
        let first = (bottom - depth).atan2(end - x);
        // What a chord does not turn is left to the piece behind it.
        left.pieces[0][1] += before - first - left.turn();
        (first, Some(left))
    }
}

/// A point of a way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WayPoint {
    /// Distance from the mouth along the horizontal of the way, and depth, mm.
    pub place: [f64; 2],
    /// Angle between way and +x, radians; on a fold that above it.
    pub dip: f64,
}

/// A part of a way: straight or an arc.
#[derive(Debug, Clone, Copy)]
struct Part {
    /// Distance of its beginning from the mouth along the way, mm.
    from: f64,
    place: [f64; 2],
    dip: f64,
    /// Turn per length, 1/mm.
    curvature: f64,
}

impl Part {
    /// The point at the distance `along` (mm) from its beginning.
    fn at(&self, along: f64) -> WayPoint {
        let dip = self.dip + self.curvature * along;
        let half = 0.5 * self.curvature * along;
        // The chord of an arc has the direction of its middle.
        let chord = along * if half.abs() < 1e-8 { 1.0 } else { half.sin() / half };
        let (sin, cos) = (self.dip + half).sin_cos();
        WayPoint { place: [self.place[0] + chord * cos, self.place[1] + chord * sin], dip }
    }
}

/// The way down the middle of a crack, ready to be followed.
#[derive(Debug, Clone)]
pub struct FrontWay {
    parts: Vec<Part>,
}

/// Relative distance from the end of a part within which a point still belongs to it.
const AT_END: f64 = 1e-9;

impl FrontWay {
    /// The way that leaves the surface at the angle `dip` (radians).
    #[must_use]
    pub fn new(dip: f64, turns: Option<&FrontTurns>) -> Self {
        let mut parts = vec![Part { from: 0.0, place: [0.0; 2], dip, curvature: 0.0 }];
        let Some(turns) = turns else { return Self { parts } };
        let straight = parts[0].at(turns.straight);
        let mut end = Part { from: turns.straight, place: straight.place, dip, curvature: 0.0 };
        for &[length, turn] in turns.pieces() {
            if length > 0.0 {
                let arc = Part { curvature: turn / length, ..end };
                parts.push(arc);
                end = Part { from: end.from + length, place: arc.at(length).place, ..end };
            }
            end.dip += turn;
        }
        parts.push(end);
        Self { parts }
    }

    /// Whether the way is a straight line.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        self.parts.len() == 1
    }

    /// Length of the straight part at the mouth, mm; infinite for a straight line.
    #[must_use]
    pub fn straight(&self) -> f64 {
        self.parts.get(1).map_or(f64::INFINITY, |part| part.from)
    }

    /// Whether the way has a fold at the distance s (mm) from the mouth.
    #[must_use]
    pub fn has_fold(&self, s: f64) -> bool {
        self.parts.windows(2).any(|pair| {
            let turn = pair[1].dip - pair[0].at(pair[1].from - pair[0].from).dip;
            turn.abs() > AT_END && (pair[1].from - s).abs() <= AT_END * s
        })
    }

    /// The part of the way (from 0) at the distance s (mm) from the mouth.
    #[must_use]
    pub fn part(&self, s: f64) -> usize {
        self.parts[1..].partition_point(|part| part.from < s * (1.0 - AT_END))
    }

    /// The point at the distance s (mm) from the mouth along the way.
    #[must_use]
    pub fn at(&self, s: f64) -> WayPoint {
        let part = &self.parts[self.part(s)];
        part.at(s - part.from)
    }

    /// The distance (mm) from the mouth along the way of its point at a `depth` (mm); the way
    /// descends everywhere.
    #[must_use]
    pub fn to_depth(&self, depth: f64) -> f64 {
        let part = &self.parts[self.parts[1..].partition_point(|part| part.place[1] < depth)];
        let down = depth - part.place[1];
        if part.curvature == 0.0 {
            return part.from + down / part.dip.sin();
        }
        let cosine = part.dip.cos() - part.curvature * down;
        part.from + (cosine.clamp(-1.0, 1.0).acos() - part.dip) / part.curvature
    }

    /// A lower bound on the ratio of a chord to the part of the way that it spans: the cosine of
    /// half the angle between its extreme directions.
    #[must_use]
    pub fn chord_over_length(&self) -> f64 {
        let dips = self.parts.iter().map(|part| part.dip);
        let [least, most] =
            dips.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], dip| [a.min(dip), b.max(dip)]);
        (0.5 * (most - least)).cos().max(0.0)
    }

    /// Distances (mm) from the mouth down to `s`, between which the way turns by no more than 3°.
    #[must_use]
    pub fn stops(&self, s: f64) -> Vec<f64> {
        let ends = self.parts[1..].iter().map(|part| part.from).chain([s]);
        let mut stops = vec![0.0];
        for (part, end) in self.parts.iter().zip(ends) {
            let length = end.min(s) - part.from;
            if length > AT_END * s {
                let count = (part.curvature * length).abs().div_euclid(3f64.to_radians()) as usize + 1;
                stops.extend((1..=count).map(|k| part.from + length * k as f64 / count as f64));
            }
        }
        stops
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f64; 2], b: [f64; 2], allowed: f64) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) < allowed
    }

    #[test]
    fn a_way_with_an_arc_and_a_fold() {
        let turns = FrontTurns::after(2.0).and(1.5, 0.6).and(0.0, -0.2).and(1.0, 0.3);
        let way = FrontWay::new(0.5, Some(&turns));
        // By small steps.
        let (mut place, steps) = ([0.0; 2], 60_000);
        let dip = |s: f64| match s {
            s if s < 2.0 => 0.5,
            s if s < 3.5 => 0.5 + 0.4 * (s - 2.0),
            s if s < 4.5 => 0.9 + 0.3 * (s - 3.5),
            _ => 1.2,
        };
        for k in 0..steps {
            let s = (f64::from(k) + 0.5) * 1e-4;
            place = [place[0] + 1e-4 * dip(s).cos(), place[1] + 1e-4 * dip(s).sin()];
            let point = way.at(s + 0.5e-4);
            assert!(close(point.place, place, 1e-7), "{s}: {point:?} {place:?}");
            assert!((way.to_depth(point.place[1]) - s - 0.5e-4).abs() < 1e-9, "{s}");
        }
        assert!((way.at(3.5).dip - 1.1).abs() < 1e-12, "above the fold");
        assert!((way.at(3.5001).dip - 0.90003).abs() < 1e-9, "below the fold");
        assert_eq!((way.part(1.0), way.part(3.0), way.part(3.5), way.part(4.0)), (0, 1, 1, 2));
        assert!((turns.turn() - 0.7).abs() < 1e-15 && (turns.length() - 4.5).abs() < 1e-15);
        let stops = way.stops(6.0);
        assert!(stops.len() > 15 && stops[stops.len() - 1] == 6.0, "{stops:?}");
        let turns = stops.windows(2).map(|pair| (way.at(pair[1]).dip - way.at(pair[0] + 1e-6).dip).abs());
        assert!(turns.fold(0.0, f64::max) < 3.001f64.to_radians());
    }

    #[test]
    fn more_pieces_than_there_is_room_for() {
        let mut turns = FrontTurns::after(1.0);
        for k in 0..40 {
            turns = turns.and(0.1 + 0.01 * f64::from(k), 0.02);
        }
        assert_eq!(turns.pieces().len(), MOST);
        assert!((turns.turn() - 0.8).abs() < 1e-12 && (turns.length() - 12.8).abs() < 1e-12);
    }

    #[test]
    fn a_way_that_is_cut() {
        let turns = FrontTurns::after(2.0).and(1.5, 0.6).and(1.0, 0.3);
        let way = FrontWay::new(0.5, Some(&turns));
        let after = |cut: f64, least: f64| {
            let (dip, left) = turns.cut(0.5, cut, least);
            let left_way = FrontWay::new(dip, left.as_ref());
            let start = way.at(cut).place;
            let error = [4.4, 5.0, 7.0].map(|s| {
                let [x, depth] = left_way.at(s - cut).place;
                (x + start[0] - way.at(s).place[0]).hypot(depth + start[1] - way.at(s).place[1])
            });
            let end = left_way.at(20.0).dip;
            assert!((end - 1.4).abs() < 1e-12, "{cut}: {end}");
            error.into_iter().fold(0.0, f64::max)
        };
        assert!(after(1.0, 0.1) < 1e-12, "within the straight part");
        // A chord of 0.2 mm, of whose 0.08 rad one half is turned over the next 0.8 mm.
        assert!(after(2.5, 0.2) < 0.02, "within an arc");
        let (dip, left) = turns.cut(0.5, 6.0, 0.2);
        assert!((dip - 1.4).abs() < 1e-12 && left.is_none());
    }
}
