//! Pairs of cells, divided into parts until one rule suffices for each pair of parts.

use super::duffy::{DuffyRules, PairPoint};
use super::grid::{Cell, CellPoint};

/// A rectangle of the unit square of a cell with coordinates (p, q) from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    origin: [f64; 2],
    p: [f64; 2],
    q: [f64; 2],
}

/// Coordinate directions of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Along {
    P,
    Q,
}

fn moved(from: [f64; 2], factor: f64, by: [f64; 2]) -> [f64; 2] {
    [from[0] + factor * by[0], from[1] + factor * by[1]]
}

fn scaled(factor: f64, v: [f64; 2]) -> [f64; 2] {
    [factor * v[0], factor * v[1]]
}

impl Patch {
    /// The whole cell.
    pub const WHOLE: Self = Self { origin: [0.0; 2], p: [1.0, 0.0], q: [0.0, 1.0] };

    /// The whole cell, with p running from the corner `from` along the edge to the adjacent corner
    /// `to`.
    pub fn along(from: usize, to: usize) -> Self {
        let (a, b) = (super::grid::CORNERS[from], super::grid::CORNERS[to]);
        let p = [b[0] - a[0], b[1] - a[1]];
        let inward = |c: usize| if a[c] == 0.0 { 1.0 } else { -1.0 };
        let q = if p[0] == 0.0 { [inward(0), 0.0] } else { [0.0, inward(1)] };
        Self { origin: a, p, q }
    }

    /// The whole cell, with p = q = 0 at `corner`.
    pub fn around(corner: usize) -> Self {
        Self::along(corner, (corner + 1) % 4)
    }

    /// The point (u, v) at (p, q).
    pub fn at(&self, [p, q]: [f64; 2]) -> [f64; 2] {
        moved(moved(self.origin, p, self.p), q, self.q)
    }

    /// Area in the unit square.
    pub fn measure(&self) -> f64 {
        (self.p[0] * self.q[1] - self.p[1] * self.q[0]).abs()
    }

    /// The halves, the one with smaller coordinates first.
    fn halves(&self, along: Along) -> [Self; 2] {
        match along {
            Along::P => {
                let p = scaled(0.5, self.p);
                [Self { p, ..*self }, Self { origin: moved(self.origin, 1.0, p), p, ..*self }]
            }
            Along::Q => {
                let q = scaled(0.5, self.q);
                [Self { q, ..*self }, Self { origin: moved(self.origin, 1.0, q), q, ..*self }]
            }
        }
    }

    /// The halves along p, the one with smaller p first.
    pub fn along_halves(&self) -> [Self; 2] {
        self.halves(Along::P)
    }

    /// The halves along q, the one with smaller q first.
    pub fn across_halves(&self) -> [Self; 2] {
        self.halves(Along::Q)
    }

    /// The same patch with p reversed.
    pub fn turned(&self) -> Self {
        Self { origin: moved(self.origin, 1.0, self.p), p: scaled(-1.0, self.p), ..*self }
    }

    /// The direction of the edge q = 0 in the unit square.
    pub fn edge(&self) -> [f64; 2] {
        self.p
    }

    /// The two halves, both with p along their common edge and q away from it.
    fn back_to_back(&self, along: Along) -> [Self; 2] {
        let (across, edge) = match along {
            Along::P => (scaled(0.5, self.p), self.q),
            Along::Q => (scaled(0.5, self.q), self.p),
        };
        let origin = moved(self.origin, 1.0, across);
        [Self { origin, p: edge, q: scaled(-1.0, across) }, Self { origin, p: edge, q: across }]
    }

    /// Lengths along p and q in the middle, mm.
    pub fn lengths(&self, cell: &Cell) -> [f64; 2] {
        let [u, v] = self.at([0.5, 0.5]);
        [self.p, self.q].map(|along| {
            let slope = cell.slope(u, v, along);
            slope[0].hypot(slope[1])
        })
    }

    /// The points of a rule and their weights.
    pub fn points(&self, cell: &Cell, rule: &[(f64, f64)]) -> Vec<(CellPoint, f64)> {
        let measure = self.measure();
        let mut points = Vec::with_capacity(rule.len() * rule.len());
        for (x, wx) in rule {
            for (y, wy) in rule {
                let [u, v] = self.at([*x, *y]);
                points.push((cell.at(u, v), wx * wy * measure));
            }
        }
        points
    }

    /// A disc that contains the patch.
    pub fn cover(&self, cell: &Cell) -> Cover {
        let at = |p: f64, q: f64| {
            let [u, v] = self.at([p, q]);
            cell.at(u, v).position
        };
        let centre = at(0.5, 0.5);
        let away = |[p, q]: [f64; 2]| {
            let point = at(p, q);
            (point[0] - centre[0]).hypot(point[1] - centre[1])
        };
        let radius = super::grid::CORNERS.map(away).into_iter().fold(0.0, f64::max);
        Cover { centre, radius }
    }
}

/// A disc about a part of a cell or of the mouth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    pub centre: [f64; 2],
    pub radius: f64,
}

/// Distance of two patches, relative to their size, and the number of points per direction that it
/// requires; closer patches are divided.
const ORDERS: [(f64, usize); 4] = [(3.0, 2), (1.2, 3), (0.5, 4), (0.25, 6)];
/// Largest number of divisions of a patch.
pub(super) const DIVISIONS: usize = 12;
/// Factors by which sides may differ: of one patch, of two patches that touch along an edge, and of
/// two that touch at a corner.
pub(super) const EDGE_RATIO: f64 = 2.0;
pub(super) const CORNER_RATIO: f64 = 3.0;

/// The rules for separate patches, by order.
#[derive(Debug, Clone)]
pub(super) struct ApartRules(Vec<Vec<(f64, f64)>>);

impl ApartRules {
    /// The rules with `more` points per direction than `ORDERS`.
    pub fn new(more: usize) -> Self {
        Self(ORDERS.iter().map(|&(_, order)| crate::math::gauss_legendre(order + more)).collect())
    }

    /// Index of the rule that suffices for patches at the distance `gap`; `None` where they must be
    /// divided.
    pub fn place(gap: f64, one: &Cover, other: &Cover) -> Option<usize> {
        let ratio = gap / (2.0 * one.radius.max(other.radius));
        ORDERS.iter().position(|&(limit, _)| ratio > limit)
    }

    /// The rule with a given index; the finest one where no rule suffices.
    pub fn rule(&self, place: Option<usize>) -> &[(f64, f64)] {
        &self.0[place.unwrap_or(ORDERS.len() - 1)]
    }

    pub fn all(&self) -> &[Vec<(f64, f64)>] {
        &self.0
    }
}

/// Receives a point, whose gradients and area include its weight, and points of the other cell with
/// their weights.
pub(super) type Visit<'v> = dyn FnMut(&CellPoint, &[(CellPoint, f64)]) + 'v;

/// Two cells whose products are integrated.
pub(super) struct CellPair<'a> {
    pub cells: [&'a Cell; 2],
    pub touching: &'a DuffyRules,
    pub apart: &'a ApartRules,
    /// Distance of two discs, the second one possibly reflected in the surface.
    pub gap: &'a dyn Fn(&Cover, &Cover) -> f64,
}

impl CellPair<'_> {
    fn lengths(&self, patches: &[Patch; 2]) -> [[f64; 2]; 2] {
        [patches[0].lengths(self.cells[0]), patches[1].lengths(self.cells[1])]
    }

    fn touch(&self, rule: &[PairPoint], [one, other]: &[Patch; 2], visit: &mut Visit) {
        let measure = one.measure() * other.measure();
        for pair in rule {
            let ([u, v], [p, q]) = (one.at(pair.first), other.at(pair.second));
            visit(&self.cells[0].at(u, v), &[(self.cells[1].at(p, q), pair.weight * measure)]);
        }
    }

    /// A patch of a cell with itself.
    pub fn same(&self, patch: Patch, visit: &mut Visit) {
        let [p, q] = patch.lengths(self.cells[0]);
        if p.max(q) <= EDGE_RATIO * p.min(q) {
            return self.touch(&self.touching.same, &[patch; 2], visit);
        }
        let along = if p > q { Along::P } else { Along::Q };
        patch.halves(along).into_iter().for_each(|half| self.same(half, visit));
        let [one, other] = patch.back_to_back(along);
        self.edge([one, other], visit);
        self.edge([other, one], visit);
    }

    /// Patches whose edges q = 0 coincide.
    pub fn edge(&self, patches: [Patch; 2], visit: &mut Visit) {
        let [[p, q], [_, r]] = self.lengths(&patches);
        let [one, other] = patches;
        if p > EDGE_RATIO * q.max(r) {
            let ([a, b], [c, d]) = (one.halves(Along::P), other.halves(Along::P));
            self.edge([a, c], visit);
            self.edge([b, d], visit);
            // In both patches, p and q begin at the common corner.
            self.corner([a.turned(), d], visit);
            self.corner([b, c.turned()], visit);
        } else if q > EDGE_RATIO * p {
            let [near, far] = one.halves(Along::Q);
            self.edge([near, other], visit);
            self.apart([far, other], 0, visit);
        } else if r > EDGE_RATIO * p {
            let [near, far] = other.halves(Along::Q);
            self.edge([one, near], visit);
            self.apart([one, far], 0, visit);
        } else {
            self.touch(&self.touching.edge, &patches, visit);
        }
    }

    /// Patches whose corners p = q = 0 coincide.
    pub fn corner(&self, patches: [Patch; 2], visit: &mut Visit) {
        let lengths = self.lengths(&patches);
        let smallest = lengths.as_flattened().iter().fold(f64::INFINITY, |m, v| m.min(*v));
        let longest =
            if lengths[0][0].max(lengths[0][1]) >= lengths[1][0].max(lengths[1][1]) { 0 } else { 1 };
        let [p, q] = lengths[longest];
        if p.max(q) <= CORNER_RATIO * smallest {
            return self.touch(&self.touching.corner, &patches, visit);
        }
        let [near, far] = patches[longest].halves(if p > q { Along::P } else { Along::Q });
        let with = |half: Patch| if longest == 0 { [half, patches[1]] } else { [patches[0], half] };
        self.corner(with(near), visit);
        self.apart(with(far), 0, visit);
    }

    /// Patches that do not touch.
    pub fn apart(&self, patches: [Patch; 2], level: usize, visit: &mut Visit) {
        let covers = [patches[0].cover(self.cells[0]), patches[1].cover(self.cells[1])];
        let place = ApartRules::place((self.gap)(&covers[0], &covers[1]), &covers[0], &covers[1]);
        if place.is_some() || level == DIVISIONS {
            let rule = self.apart.rule(place);
            let second = patches[1].points(self.cells[1], rule);
            for (x, weight) in patches[0].points(self.cells[0], rule) {
                visit(&weighted(&x, weight), &second);
            }
            return;
        }
        let larger = if covers[0].radius >= covers[1].radius { 0 } else { 1 };
        let [p, q] = patches[larger].lengths(self.cells[larger]);
        for half in patches[larger].halves(if p > q { Along::P } else { Along::Q }) {
            let halves = if larger == 0 { [half, patches[1]] } else { [patches[0], half] };
            self.apart(halves, level + 1, visit);
        }
    }
}

/// A point whose gradients and area include its weight.
pub(super) fn weighted(point: &CellPoint, weight: f64) -> CellPoint {
    let gradients = point.gradients.map(|g| scaled(weight, g));
    CellPoint { gradients, area: weight * point.area, ..*point }
}

/// A point of the mouth.
#[derive(Debug, Clone, Copy)]
pub(super) struct LinePoint {
    pub zeta: f64,
    /// Hat functions times the length per unit of the segment, mm.
    pub hats: [f64; 4],
    /// Whether ζ increases (1) or decreases (−1) along the segment.
    pub sense: f64,
}

impl LinePoint {
    /// The point p of the edge q = 0 of a patch.
    pub fn new(cell: &Cell, patch: &Patch, p: f64) -> Self {
        let [u, v] = patch.at([p, 0.0]);
        let point = cell.at(u, v);
        let length = cell.slope(u, v, patch.edge())[1];
        let hats = point.hats.map(|h| h * length.abs());
        Self { zeta: point.position[1], hats, sense: length.signum() }
    }
}

/// Receives a point of the cell, a point of the mouth and their weight.
pub(super) type VisitLine<'v> = dyn FnMut(&CellPoint, &LinePoint, f64) + 'v;

/// A cell, and the cell of which the edge q = 0 of a patch lies on the mouth.
pub(super) struct MouthPair<'a> {
    pub cells: [&'a Cell; 2],
    pub touching: &'a DuffyRules,
    pub apart: &'a ApartRules,
}

impl MouthPair<'_> {
    fn touch(&self, rule: &[PairPoint], [area, line]: &[Patch; 2], visit: &mut VisitLine) {
        for pair in rule {
            let [u, v] = area.at(pair.first);
            let on_mouth = LinePoint::new(self.cells[1], line, pair.second[0]);
            visit(&self.cells[0].at(u, v), &on_mouth, pair.weight * area.measure());
        }
    }

    /// A patch whose edge q = 0 is the segment, with p in the same sense.
    pub fn own(&self, [area, line]: [Patch; 2], visit: &mut VisitLine) {
        let [p, q] = area.lengths(self.cells[0]);
        if p > EDGE_RATIO * q {
            let ([a, b], [c, d]) = (area.along_halves(), line.along_halves());
            self.own([a, c], visit);
            self.own([b, d], visit);
            self.corner([a.turned(), d], visit);
            self.corner([b, c.turned()], visit);
        } else if q > EDGE_RATIO * p {
            let [near, far] = area.across_halves();
            self.own([near, line], visit);
            self.apart([far, line], 0, visit);
        } else {
            self.touch(&self.touching.own_line, &[area, line], visit);
        }
    }

    /// A patch and a segment that begin at the same point.
    pub fn corner(&self, [area, line]: [Patch; 2], visit: &mut VisitLine) {
        let ([p, q], [s, _]) = (area.lengths(self.cells[0]), line.lengths(self.cells[1]));
        let smallest = p.min(q).min(s);
        if p.max(q).max(s) <= CORNER_RATIO * smallest {
            self.touch(&self.touching.corner_line, &[area, line], visit);
        } else if s >= p.max(q) {
            let [near, far] = line.along_halves();
            self.corner([area, near], visit);
            self.apart([area, far], 0, visit);
        } else {
            let [near, far] = if p > q { area.along_halves() } else { area.across_halves() };
            self.corner([near, line], visit);
            self.apart([far, line], 0, visit);
        }
    }

    /// A patch and a segment that do not touch.
    pub fn apart(&self, [area, line]: [Patch; 2], level: usize, visit: &mut VisitLine) {
        let own = area.cover(self.cells[0]);
        let [start, end] = [0.0, 1.0].map(|p| {
            let [u, v] = line.at([p, 0.0]);
            self.cells[1].at(u, v).position[1]
        });
        let on_mouth = Cover { centre: [0.0, 0.5 * (start + end)], radius: 0.5 * (end - start).abs() };
        let distance = own.centre[0].hypot(own.centre[1] - on_mouth.centre[1]);
        let place = ApartRules::place(distance - own.radius - on_mouth.radius, &own, &on_mouth);
        if place.is_some() || level == DIVISIONS {
            let rule = self.apart.rule(place);
            let points = area.points(self.cells[0], rule);
            for (p, weight) in rule {
                let line = LinePoint::new(self.cells[1], &line, *p);
                points.iter().for_each(|(x, w)| visit(x, &line, w * weight));
            }
        } else if own.radius >= on_mouth.radius {
            let [p, q] = area.lengths(self.cells[0]);
            let halves = if p > q { area.along_halves() } else { area.across_halves() };
            halves.into_iter().for_each(|half| self.apart([half, line], level + 1, visit));
        } else {
            line.along_halves().into_iter().for_each(|half| self.apart([area, half], level + 1, visit));
        }
    }
}
