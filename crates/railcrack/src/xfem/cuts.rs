//! Elements cut by cracks, and their cells.

use super::arrangement::{Arrangement, CutLine, EdgeLine};
use super::path::{CutPath, STRAIGHT, TipPath};
use crate::crack::{CrackNetwork, CrackTip};
use crate::math::{Orientation, Vec2, orientation};
use crate::mesh::{Edge, Element, QuadMesh};
use std::collections::BTreeMap;

/// Parts of a side and chords of an element that are shorter than this fraction of the side are
/// ignored: they arise from round-off where a crack passes through a node. Such a part carries
/// 1e-24 of the energy of an element.
const NOTHING: f64 = 1e-12;

/// Angle (radians) above which a kink impedes the slip of the faces, so that jumps vary like √r.
/// Without √r functions at the kink, the error of K of an increment of 2.4 elements at a kink of
/// 15° is 3 to 6 %, with them 1 %; at 5° the difference is no longer visible.
pub(super) const SHARP_KINK: f64 = 0.1;

/// One element with its cells.
#[derive(Debug, Clone)]
pub(super) struct CutElement {
    pub element: Element,
    pub arrangement: Arrangement,
    /// The region of each cell: cells belong to one region when the element connects them without
    /// crossing a crack.
    pub region: Vec<usize>,
    /// Number of regions.
    pub regions: usize,
    /// Edges of cells on the sides of the element.
    pub sides: Vec<SidePiece>,
    /// Pieces of crack inside, each with its + and − cell.
    pub cracks: Vec<InnerCrack>,
}

/// The edge of a cell on a side of the element, from `from` to `to` (mm) along the side,
/// increasing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SidePiece {
    pub side: Edge,
    pub from: f64,
    pub to: f64,
    pub cell: usize,
}

/// A piece of crack between two cells of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct InnerCrack {
    pub crack: usize,
    pub segment: usize,
    pub ends: (Vec2, Vec2),
    pub plus: usize,
    pub minus: usize,
}

/// A cell of an element of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct CellPlace {
    pub element: usize,
    pub cell: usize,
}

/// A piece of crack with the cells at both faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CrackPiece {
    pub crack: usize,
    pub segment: usize,
    /// Ends along the curve, mm.
    pub ends: (Vec2, Vec2),
    /// Arc length at the ends, mm.
    pub s: (f64, f64),
    pub plus: CellPlace,
    pub minus: CellPlace,
}

/// A piece of crack along a side of the mesh.
#[derive(Debug, Clone, Copy)]
struct SideCrack {
    crack: usize,
    segment: usize,
    from: f64,
    to: f64,
}

/// The mesh cut by the cracks.
#[derive(Debug, Clone)]
pub(super) struct Cuts {
    pub paths: Vec<CutPath>,
    pub tips: Vec<TipPath>,
    /// Points with √r functions: the tips, then the kinks.
    pub poles: Vec<TipPath>,
    /// Elements that contain a part of a crack or a tip, and those requested explicitly.
    pub elements: BTreeMap<usize, CutElement>,
    /// All pieces, crack by crack along the curve.
    pub pieces: Vec<CrackPiece>,
    /// Keyed by the element below or left of the side, and that side (Top or Right).
    side_cracks: BTreeMap<(usize, Edge), Vec<SideCrack>>,
}

impl Cuts {
    pub(super) fn new(mesh: &QuadMesh, network: &CrackNetwork) -> Self {
        let paths: Vec<CutPath> = network.cracks().iter().map(CutPath::new).collect();
        let tip = |tip: CrackTip| TipPath::new(tip.crack, &paths[tip.crack], tip.end);
        let tips: Vec<TipPath> = network.tips().into_iter().map(tip).collect();
        let mut poles = tips.clone();
        for (crack, path) in paths.iter().enumerate() {
            // Where another crack ends at this one, the faces can slide into it.
            let joined = |i: usize| network.junction_points().iter().any(|j| j.position == path.points[i]);
            for i in (1..path.segments()).filter(|&i| path.turn(i) > SHARP_KINK && !joined(i)) {
                poles.push(TipPath::before_kink(crack, path, i));
            }
        }
        let mut held: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
        for (crack, path) in paths.iter().enumerate() {
            for segment in 0..path.segments() {
                for e in elements_of_segment(mesh, path.segment(segment)) {
                    held.entry(e).or_default().push((crack, segment));
                }
            }
        }
        // A segment may end at a kink in an element that the next segment leaves immediately.
        for (crack, path) in paths.iter().enumerate() {
            for i in 1..path.segments() {
                for e in elements_at(mesh, path.points[i]) {
                    let Some(list) = held.get_mut(&e) else { continue };
                    let both = [(crack, i - 1), (crack, i)];
                    if both.iter().any(|segment| list.contains(segment)) {
                        list.retain(|segment| !both.contains(segment));
                        list.extend(both);
                    }
                }
            }
        }
        for tip in &tips {
            for e in elements_at(mesh, tip.position()) {
                let segment = match tip.end {
                    crate::crack::End::First => 0,
                    crate::crack::End::Last => paths[tip.crack].segments() - 1,
                };
                let list = held.entry(e).or_default();
                if !list.contains(&(tip.crack, segment)) {
                    list.push((tip.crack, segment));
                }
            }
        }
        let mut cuts = Self {
            paths,
            tips,
            poles,
            elements: BTreeMap::new(),
            pieces: Vec::new(),
            side_cracks: BTreeMap::new(),
        };
        for (e, mut segments) in held {
            segments.sort_unstable();
            let cut = cuts.cut(mesh, e, &segments);
            cuts.elements.insert(e, cut);
        }
        cuts.collect_pieces(mesh);
        cuts
    }

    /// Ensures that `element` is among the elements, undivided if no crack cuts it.
    pub(super) fn include(&mut self, mesh: &QuadMesh, element: usize) {
        self.elements.entry(element).or_insert_with(|| CutElement::whole(mesh.element(element)));
    }

    fn cut(&mut self, mesh: &QuadMesh, e: usize, segments: &[(usize, usize)]) -> CutElement {
        let element = mesh.element(e);
        let mut lines: Vec<CutLine> = Vec::new();
        // The segments on each line.
        let mut owners: Vec<Vec<(usize, usize)>> = Vec::new();
        for &(crack, segment) in segments {
            self.note_side(mesh, e, &element, (crack, segment));
            let (from, to) = self.paths[crack].segment(segment);
            let goes_on = |(i, line): (usize, &CutLine)| Some((i, continuation(*line, (from, to))?));
            let Some((line, joint)) = lines.iter().enumerate().find_map(goes_on) else {
                lines.push(CutLine { from, to });
                owners.push(vec![(crack, segment)]);
                continue;
            };
            owners[line].push((crack, segment));
            if holds(&element, joint) {
                lines.push(CutLine { from: joint, to: joint + (to - from).left() });
                owners.push(Vec::new());
            }
        }
        for tip in &self.tips {
            let at = tip.position();
            if holds(&element, at) {
                let (from, to) = tip.last_segment();
                lines.push(CutLine { from: at, to: at + (to - from).left() });
                owners.push(Vec::new());
            }
        }
        let arrangement = Arrangement::new(&element, &lines);
        CutElement::new(element, arrangement, |border, a, b| {
            let EdgeLine::Line(line) = border else { return None };
            owners[line].iter().find_map(|&(crack, segment)| {
                let (from, to) = self.paths[crack].segment(segment);
                let along = to - from;
                let t = ((a + b) * 0.5 - from).dot(along) / along.dot(along);
                ((0.0..=1.0).contains(&t)).then_some((crack, segment, (b - a).dot(along) > 0.0))
            })
        })
    }

    /// Records the part of a segment that lies exactly on the top or right side of an element, or
    /// of its neighbour there.
    fn note_side(&mut self, mesh: &QuadMesh, e: usize, element: &Element, (crack, segment): (usize, usize)) {
        let (p, q) = self.paths[crack].segment(segment);
        let corners = element.corners();
        for side in [Edge::Top, Edge::Right] {
            if mesh.neighbour(e, side).is_none() {
                continue;
            }
            let i = side as usize;
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            if orientation(p, q, a) != Orientation::On || orientation(p, q, b) != Orientation::On {
                continue;
            }
            let (lower, upper) = (along_side(side, a), along_side(side, b));
            let (lower, upper) = (lower.min(upper), lower.max(upper));
            let (from, to) = (along_side(side, p), along_side(side, q));
            let (from, to) = (from.min(to).max(lower), from.max(to).min(upper));
            if to - from > NOTHING * (upper - lower) {
                let list = self.side_cracks.entry((e, side)).or_default();
                list.push(SideCrack { crack, segment, from, to });
            }
        }
    }

    fn collect_pieces(&mut self, mesh: &QuadMesh) {
        let mut pieces = Vec::new();
        for (&e, cut) in &self.elements {
            for inner in &cut.cracks {
                let place = |cell| CellPlace { element: e, cell };
                pieces.push((inner.crack, inner.segment, inner.ends, place(inner.plus), place(inner.minus)));
            }
        }
        for (&(e, side), cracks) in &self.side_cracks {
            let Some(other) = mesh.neighbour(e, side) else { continue };
            let facing = if side == Edge::Top { Edge::Bottom } else { Edge::Left };
            let level = match side {
                Edge::Top => mesh.element(e).upper.y,
                _ => mesh.element(e).upper.x,
            };
            let at = |t: f64| if side == Edge::Top { Vec2::new(t, level) } else { Vec2::new(level, t) };
            for (own, beyond, from, to) in self.overlaps(mesh, (e, side), (other, facing)) {
                for crack in cracks {
                    let (from, to) = (from.max(crack.from), to.min(crack.to));
                    if to <= from {
                        continue;
                    }
                    let (p, q) = self.paths[crack.crack].segment(crack.segment);
                    // The element above (beyond Top) is left of +x; the one beyond Right is right
                    // of +y.
                    let forward = (q - p).dot(at(to) - at(from)) > 0.0;
                    let ends = if forward { (at(from), at(to)) } else { (at(to), at(from)) };
                    let beyond_is_plus = forward == (side == Edge::Top);
                    let (plus, minus) = if beyond_is_plus { (beyond, own) } else { (own, beyond) };
                    pieces.push((crack.crack, crack.segment, ends, plus, minus));
                }
            }
        }
        self.pieces = pieces
            .into_iter()
            .map(|(crack, segment, ends, plus, minus)| {
                let path = &self.paths[crack];
                let s = (path.arc_length(segment, ends.0), path.arc_length(segment, ends.1));
                CrackPiece { crack, segment, ends, s, plus, minus }
            })
            .collect();
        self.pieces
            .sort_by(|a, b| (a.crack, a.segment).cmp(&(b.crack, b.segment)).then(a.s.0.total_cmp(&b.s.0)));
    }

    /// The cells of two neighbours that face each other across their common side, with the interval
    /// (mm along it).
    fn overlaps(
        &self,
        mesh: &QuadMesh,
        (e, side): (usize, Edge),
        (other, facing): (usize, Edge),
    ) -> Vec<(CellPlace, CellPlace, f64, f64)> {
        let (own, beyond) = (self.side_pieces(mesh, e, side), self.side_pieces(mesh, other, facing));
        let mut overlaps = Vec::new();
        for a in &own {
            for b in &beyond {
                let (from, to) = (a.from.max(b.from), a.to.min(b.to));
                if to > from {
                    let places =
                        (CellPlace { element: e, cell: a.cell }, CellPlace { element: other, cell: b.cell });
                    overlaps.push((places.0, places.1, from, to));
                }
            }
        }
        overlaps
    }

    fn side_pieces(&self, mesh: &QuadMesh, e: usize, side: Edge) -> Vec<SidePiece> {
        match self.elements.get(&e) {
            Some(cut) => cut.sides.iter().filter(|piece| piece.side == side).copied().collect(),
            None => {
                let element = mesh.element(e);
                let (from, to) = (along_side(side, element.lower), along_side(side, element.upper));
                vec![SidePiece { side, from, to, cell: 0 }]
            }
        }
    }

    /// The region of a cell within its element.
    pub(super) fn region(&self, place: CellPlace) -> usize {
        self.elements.get(&place.element).map_or(0, |cut| cut.region[place.cell])
    }

    /// Number of regions of an element.
    pub(super) fn regions(&self, element: usize) -> usize {
        self.elements.get(&element).map_or(1, |cut| cut.regions)
    }

    /// Pairs of regions of `e` and its neighbour across `side` (Top or Right) that are connected
    /// there.
    pub(super) fn joined(&self, mesh: &QuadMesh, e: usize, side: Edge) -> Vec<(usize, usize)> {
        let Some(other) = mesh.neighbour(e, side) else { return Vec::new() };
        let facing = if side == Edge::Top { Edge::Bottom } else { Edge::Left };
        let element = mesh.element(e);
        let length = along_side(side, element.upper) - along_side(side, element.lower);
        let cracks = self.side_cracks.get(&(e, side)).map_or(&[][..], Vec::as_slice);
        let mut pairs: Vec<(usize, usize)> = self
            .overlaps(mesh, (e, side), (other, facing))
            .into_iter()
            .filter(|&(_, _, from, to)| to - from - covered(cracks, from, to) > NOTHING * length)
            .map(|(own, beyond, ..)| (self.region(own), self.region(beyond)))
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}

/// The length of [from, to] covered by the cracks on a side, which do not overlap one another.
fn covered(cracks: &[SideCrack], from: f64, to: f64) -> f64 {
    cracks.iter().map(|c| (c.to.min(to) - c.from.max(from)).max(0.0)).sum()
}

impl CutElement {
    pub(super) fn whole(element: Element) -> Self {
        Self::new(element, Arrangement::whole(&element), |_, _, _| None)
    }

    /// `crack` says whether an edge on a border from a to b belongs to a crack: to which segment,
    /// and whether the crack runs from a to b.
    fn new(
        element: Element,
        arrangement: Arrangement,
        crack: impl Fn(EdgeLine, Vec2, Vec2) -> Option<(usize, usize, bool)>,
    ) -> Self {
        let cells = arrangement.cells.len();
        let mut region: Vec<usize> = (0..cells).collect();
        let mut sides = Vec::new();
        let mut cracks = Vec::new();
        let mut inner: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (i, cell) in arrangement.cells.iter().enumerate() {
            for (k, &border) in cell.edge_lines.iter().enumerate() {
                let (a, b) = (cell.vertices[k], cell.vertices[(k + 1) % cell.vertices.len()]);
                let ends = (arrangement.vertices[a], arrangement.vertices[b]);
                if let EdgeLine::Side(side) = border {
                    let (from, to) = (along_side(side, ends.0), along_side(side, ends.1));
                    sides.push(SidePiece { side, from: from.min(to), to: from.max(to), cell: i });
                    continue;
                }
                // The twin edge runs from b to a.
                inner.insert((a, b), i);
                let Some(&other) = inner.get(&(b, a)) else { continue };
                match crack(border, ends.0, ends.1) {
                    None => join(&mut region, i, other),
                    // The cell lies to the left of its edge: the + face when the crack runs in the
                    // same direction.
                    Some((crack, segment, true)) => {
                        cracks.push(InnerCrack { crack, segment, ends, plus: i, minus: other });
                    }
                    Some((crack, segment, false)) => {
                        let ends = (ends.1, ends.0);
                        cracks.push(InnerCrack { crack, segment, ends, plus: other, minus: i });
                    }
                }
            }
        }
        let mut names: Vec<usize> = region.clone();
        names.sort_unstable();
        names.dedup();
        let region = region.iter().map(|r| names.partition_point(|n| n < r)).collect();
        Self { element, arrangement, region, regions: names.len(), sides, cracks }
    }
}

/// Merges the sets of `a` and `b` under the smaller of their labels.
pub(super) fn join(names: &mut [usize], a: usize, b: usize) {
    let (low, high) = (names[a].min(names[b]), names[a].max(names[b]));
    for name in names.iter_mut().filter(|name| **name == high) {
        *name = low;
    }
}

/// Coordinate of a point along a side.
pub(super) fn along_side(side: Edge, point: Vec2) -> f64 {
    match side {
        Edge::Bottom | Edge::Top => point.x,
        Edge::Left | Edge::Right => point.y,
    }
}

/// The common end of a segment and a line through another one, if the segment continues the line
/// straight on from there up to round-off: a crack that continues another one from a junction. Two
/// lines that differ by round-off cannot be ordered, so they are treated as one line.
fn continuation(line: CutLine, (from, to): (Vec2, Vec2)) -> Option<Vec2> {
    let (joint, other) = match [line.from, line.to] {
        ends if ends.contains(&from) => (from, to),
        ends if ends.contains(&to) => (to, from),
        _ => return None,
    };
    let along = (line.to - line.from).normalised();
    let arm = other - joint;
    (along.cross(arm).abs() <= STRAIGHT * arm.length()).then_some(joint)
}

fn holds(element: &Element, point: Vec2) -> bool {
    point.x >= element.lower.x
        && point.x <= element.upper.x
        && point.y >= element.lower.y
        && point.y <= element.upper.y
}

/// The elements whose closure contains `point`.
pub(super) fn elements_at(mesh: &QuadMesh, point: Vec2) -> Vec<usize> {
    let (columns, rows) = mesh.places_meeting(point, point);
    rows.flat_map(|row| columns.clone().map(move |column| row * mesh.columns() + column)).collect()
}

/// The elements whose closure contains a part of a segment.
fn elements_of_segment(mesh: &QuadMesh, (p, q): (Vec2, Vec2)) -> Vec<usize> {
    let lower = Vec2::new(p.x.min(q.x), p.y.min(q.y));
    let upper = Vec2::new(p.x.max(q.x), p.y.max(q.y));
    let (columns, rows) = mesh.places_meeting(lower, upper);
    let places = rows.flat_map(|row| columns.clone().map(move |column| row * mesh.columns() + column));
    places
        .filter(|&e| {
            let element = mesh.element(e);
            let size = element.size();
            chord(&element, p, q) > 0.1 * NOTHING * size.x.min(size.y)
        })
        .collect()
}

/// Length (mm) of the part of the segment p–q in the closed element.
fn chord(element: &Element, p: Vec2, q: Vec2) -> f64 {
    let along = q - p;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    let slabs =
        [(p.x, along.x, element.lower.x, element.upper.x), (p.y, along.y, element.lower.y, element.upper.y)];
    for (start, slope, lower, upper) in slabs {
        if slope == 0.0 {
            if start < lower || start > upper {
                return 0.0;
            }
        } else {
            let (a, b) = ((lower - start) / slope, (upper - start) / slope);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
    }
    (to - from).max(0.0) * along.length()
}
