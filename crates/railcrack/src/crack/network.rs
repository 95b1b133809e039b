//! Networks of cracks in one rail, and their junctions.

use super::polyline::intersect_elsewhere;
use super::{Crack, CrackCurve, End};
use crate::math::Vec2;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Cracks that do not form a network.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// No crack at all.
    #[error("a network needs at least one crack")]
    Empty,
    /// Two cracks that cross, touch or overlap.
    #[error("cracks {first} and {second} cross, touch or overlap")]
    Meeting {
        /// Number of a crack, from 1.
        first: usize,
        /// Number of another, from 1.
        second: usize,
    },
    /// A junction of a missing crack, of a mouth, of a crack with itself, or of an end that is
    /// joined already.
    #[error(
        "junction {number}: the {end:?} end of crack {crack} cannot join crack {onto}; a junction takes an end below the surface, \
         once, onto another of the {cracks} cracks"
    )]
    Junction {
        /// Number of the junction, from 1.
        number: usize,
        /// Number of the joining crack, from 1.
        crack: usize,
        /// Its end.
        end: End,
        /// Number of the receiving crack, from 1.
        onto: usize,
        /// How many cracks there are.
        cracks: usize,
    },
    /// A junction whose receiving crack has no vertex there.
    #[error("junction {number}: crack {onto} has no vertex at ({x}, {y}) mm, where the other crack ends")]
    NoVertex {
        /// Number of the junction, from 1.
        number: usize,
        /// Number of the receiving crack, from 1.
        onto: usize,
        /// Abscissa of the joining end, mm.
        x: f64,
        /// Its ordinate, mm.
        y: f64,
    },
    /// Cracks, or cracks and the running surface, that enclose a piece of the rail.
    #[error("junction {number} closes a loop: it would detach a piece of the rail")]
    Detached {
        /// Number of the junction that closes the loop, from 1.
        number: usize,
    },
}

/// Cracks in the order in which they were given. They meet at declared junctions only.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackNetwork {
    cracks: Vec<Crack>,
    junctions: Vec<Junction>,
    points: Vec<JunctionPoint>,
}

impl CrackNetwork {
    /// A network of `cracks`, at least one, none meeting another.
    pub fn new(cracks: Vec<Crack>) -> Result<Self, NetworkError> {
        Self::joined(cracks, Vec::new())
    }

    /// A network of `cracks`, at least one, that meet at `junctions` and nowhere else. No piece of
    /// the rail may be cut off.
    pub fn joined(cracks: Vec<Crack>, junctions: Vec<Junction>) -> Result<Self, NetworkError> {
        if cracks.is_empty() {
            return Err(NetworkError::Empty);
        }
        for (i, junction) in junctions.iter().enumerate() {
            check(&cracks, &junctions[..i], junction)?;
        }
        closed_loop(&cracks, &junctions)?;
        let points = junction_points(&cracks, &junctions);
        for (i, one) in cracks.iter().enumerate() {
            for (j, other) in cracks.iter().enumerate().skip(i + 1) {
                let shared = points.iter().find(|point| point.holds(i) && point.holds(j));
                if intersect_elsewhere(one, other, shared.map(|point| point.position)) {
                    return Err(NetworkError::Meeting { first: i + 1, second: j + 1 });
                }
            }
        }
        Ok(Self { cracks, junctions, points })
    }

    /// Plane sections of one or more cracks in space. They may cross, because the cracks themselves
    /// may lie in different planes. The plane engines do not accept such a network.
    pub fn sections(cracks: Vec<Crack>) -> Result<Self, NetworkError> {
        if cracks.is_empty() {
            return Err(NetworkError::Empty);
        }
        Ok(Self { cracks, junctions: Vec::new(), points: Vec::new() })
    }

    /// The cracks, in order.
    pub fn cracks(&self) -> &[Crack] {
        &self.cracks
    }

    /// The junctions, in order.
    pub fn junctions(&self) -> &[Junction] {
        &self.junctions
    }

    /// The points at which cracks meet, in order of the first junction there.
    pub(crate) fn junction_points(&self) -> &[JunctionPoint] {
        &self.points
    }

    /// The cracks with the indices `kept` (from 0) alone, in this order, with the junctions among
    /// them.
    ///
    /// Errors: no crack is kept.
    pub fn part(&self, kept: &[usize]) -> Result<Self, NetworkError> {
        let number = |crack: usize| kept.iter().position(|own| *own == crack);
        let junction = |junction: &Junction| {
            let joining = CrackEnd { crack: number(junction.joining.crack)?, ..junction.joining };
            Some(Junction { joining, onto: number(junction.onto)? })
        };
        let cracks = kept.iter().filter_map(|&crack| self.cracks.get(crack)).cloned().collect();
        Self::joined(cracks, self.junctions.iter().filter_map(junction).collect())
    }

    /// The cracks (from 0, ascending) with the indices in `middle`, up to `neighbours` on each side
    /// of each along the rail, and all that these are joined to.
    #[must_use]
    pub fn around(&self, middle: &[usize], neighbours: usize) -> Vec<usize> {
        let place = |crack: usize| self.cracks[crack].points()[0].x;
        let mut order: Vec<usize> = (0..self.cracks.len()).collect();
        order.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
        let mut kept = vec![false; self.cracks.len()];
        for at in (0..order.len()).filter(|&at| middle.contains(&order[at])) {
            let last = (at + neighbours).min(order.len() - 1);
            order[at.saturating_sub(neighbours)..=last].iter().for_each(|&crack| kept[crack] = true);
        }
        // A chain of joined cracks is as long as there are junctions at most.
        for _ in &self.junctions {
            for junction in &self.junctions {
                let is_kept = kept[junction.joining.crack] || kept[junction.onto];
                kept[junction.joining.crack] = is_kept;
                kept[junction.onto] = is_kept;
            }
        }
        (0..kept.len()).filter(|&crack| kept[crack]).collect()
    }

    /// The kind of `end`.
    pub(crate) fn end_kind(&self, end: CrackEnd) -> EndKind {
        if end.end == End::First && self.cracks[end.crack].is_surface_breaking() {
            EndKind::Mouth
        } else if self.points.iter().any(|point| point.ends.contains(&end)) {
            EndKind::Junction
        } else {
            EndKind::Tip
        }
    }

    /// The ends of crack `crack` (from 0) that are tips, first before last.
    pub(crate) fn tips_of(&self, crack: usize) -> Vec<End> {
        let is_tip = |end: &End| self.end_kind(CrackEnd { crack, end: *end }) == EndKind::Tip;
        [End::First, End::Last].into_iter().filter(is_tip).collect()
    }

    /// All tips, in order of crack and end: neither mouths nor ends at junctions.
    pub fn tips(&self) -> Vec<CrackTip> {
        let below_surface = |(crack, one): (usize, &Crack)| {
            one.tips().into_iter().enumerate().map(move |(tip, end)| CrackTip { crack, tip, end }).collect()
        };
        let ends = self.cracks.iter().enumerate().flat_map(|one| -> Vec<CrackTip> { below_surface(one) });
        ends.filter(|tip| self.end_kind(tip.crack_end()) == EndKind::Tip).collect()
    }

    /// The curve of each crack, with the square-root parameter at its tips.
    pub(crate) fn curves(&self) -> Vec<CrackCurve> {
        self.cracks
            .iter()
            .enumerate()
            .map(|(crack, one)| CrackCurve::with_tips(one, &self.tips_of(crack)))
            .collect()
    }

    /// Abscissa of the leftmost mouth, mm; of the leftmost point where no crack breaks the surface.
    pub fn leftmost_mouth(&self) -> f64 {
        self.mouths().into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Abscissa of the rightmost mouth, mm; of the rightmost point where no crack breaks the
    /// surface.
    pub fn rightmost_mouth(&self) -> f64 {
        self.mouths().into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    fn mouths(&self) -> Vec<f64> {
        let mouths: Vec<f64> =
            self.cracks.iter().filter(|c| c.is_surface_breaking()).map(|c| c.points()[0].x).collect();
        if mouths.is_empty() {
            return self.cracks.iter().flat_map(|c| c.points()).map(|p| p.x).collect();
        }
        mouths
    }
}

impl From<Crack> for CrackNetwork {
    fn from(crack: Crack) -> Self {
        Self { cracks: vec![crack], junctions: Vec::new(), points: Vec::new() }
    }
}

/// Checks that `junction` is compatible with the junctions `before` it.
fn check(cracks: &[Crack], before: &[Junction], junction: &Junction) -> Result<(), NetworkError> {
    let Junction { joining, onto } = *junction;
    let number = before.len() + 1;
    let possible = joining.crack < cracks.len()
        && onto < cracks.len()
        && onto != joining.crack
        && cracks[joining.crack].tips().contains(&joining.end)
        && before.iter().all(|other| other.joining != joining);
    if !possible {
        let (crack, end) = (joining.crack + 1, joining.end);
        return Err(NetworkError::Junction { number, crack, end, onto: onto + 1, cracks: cracks.len() });
    }
    let at = cracks[joining.crack].tip(joining.end);
    match cracks[onto].vertex_at(at) {
        Some(_) => Ok(()),
        None => Err(NetworkError::NoVertex { number, onto: onto + 1, x: at.x, y: at.y }),
    }
}

/// Rejects a junction between cracks that are connected already, directly or through other cracks;
/// the running surface counts as a crack.
fn closed_loop(cracks: &[Crack], junctions: &[Junction]) -> Result<(), NetworkError> {
    // Each crack stores the lowest index of its connected part; the surface has a lower index than
    // any crack.
    const SURFACE: usize = 0;
    let part = |(i, crack): (usize, &Crack)| if crack.is_surface_breaking() { SURFACE } else { i + 1 };
    let mut parts: Vec<usize> = cracks.iter().enumerate().map(part).collect();
    for (i, junction) in junctions.iter().enumerate() {
        let (one, other) = (parts[junction.joining.crack], parts[junction.onto]);
        if one == other {
            return Err(NetworkError::Detached { number: i + 1 });
        }
        for part in &mut parts {
            if *part == one.max(other) {
                *part = one.min(other);
            }
        }
    }
    Ok(())
}

fn junction_points(cracks: &[Crack], junctions: &[Junction]) -> Vec<JunctionPoint> {
    let mut points: Vec<JunctionPoint> = Vec::new();
    for junction in junctions {
        let at = cracks[junction.joining.crack].tip(junction.joining.end);
        let index = points.iter().position(|point| point.position == at).unwrap_or_else(|| {
            points.push(JunctionPoint::at(at));
            points.len() - 1
        });
        let point = &mut points[index];
        point.ends.push(junction.joining);
        let receiving = &cracks[junction.onto];
        let vertex = receiving.vertex_at(at).expect("checked");
        let crack = junction.onto;
        if vertex == 0 {
            point.ends.push(CrackEnd { crack, end: End::First });
        } else if vertex == receiving.segment_count() {
            point.ends.push(CrackEnd { crack, end: End::Last });
        } else {
            let s = CrackCurve::new(receiving).arc_length_at(vertex);
            point.through = Some(Passing { crack, vertex, s });
        }
    }
    for point in &mut points {
        point.ends.sort_by_key(|end| (end.crack, end.end == End::Last));
        point.ends.dedup();
    }
    points
}

/// One end of one crack of a network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrackEnd {
    /// Index of the crack in the network, from 0.
    pub crack: usize,
    /// The end of that crack.
    pub end: End,
}

/// A tip: which crack of the network (from 0) and which of its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrackTip {
    /// Index of the crack, from 0.
    pub crack: usize,
    /// Index among the ends of the crack that lie below the surface, from 0; ends that have joined
    /// a crack count.
    pub tip: usize,
    /// The end of the crack.
    pub end: End,
}

impl CrackTip {
    /// The crack end at which the tip lies.
    pub(crate) fn crack_end(self) -> CrackEnd {
        CrackEnd { crack: self.crack, end: self.end }
    }
}

/// Kinds of crack end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EndKind {
    /// A tip in the steel, with a singular stress ahead; it may grow.
    Tip,
    /// A mouth at the running surface.
    Mouth,
    /// An end that lies on another crack.
    Junction,
}

/// An end of a crack that lies on another crack. It coincides with a vertex of the receiving crack,
/// bit for bit, so that later growth of either crack does not move the junction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Junction {
    /// The end that lies on the other crack.
    pub joining: CrackEnd,
    /// Index of the receiving crack in the network, from 0.
    pub onto: usize,
}

/// A point at which cracks of a network meet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JunctionPoint {
    /// Position, mm.
    pub position: Vec2,
    /// All crack ends at this point, in order of crack and end.
    pub ends: Vec<CrackEnd>,
    /// The crack that passes through the point; none where only ends meet.
    pub through: Option<Passing>,
}

/// A crack that passes through a junction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passing {
    /// Index of the crack, from 0.
    pub crack: usize,
    /// Index of the junction among its points, from 0; segment `vertex` − 1 ends there and segment
    /// `vertex` begins.
    pub vertex: usize,
    /// Arc length from the crack's first point, mm: it changes when the first end of a buried crack
    /// grows.
    pub s: f64,
}

impl JunctionPoint {
    /// The first crack end at `position`.
    pub(super) fn at(position: Vec2) -> Self {
        Self { position, ends: Vec::new(), through: None }
    }

    /// Whether `crack` is at this point.
    pub(crate) fn holds(&self, crack: usize) -> bool {
        self.ends.iter().any(|end| end.crack == crack)
            || self.through.is_some_and(|passing| passing.crack == crack)
    }
}

impl Crack {
    /// Index of the vertex that equals `point` bit for bit, if there is one.
    pub fn vertex_at(&self, point: Vec2) -> Option<usize> {
        self.points().iter().position(|&p| p == point)
    }
}

#[cfg(test)]
#[path = "network_tests.rs"]
mod tests;
