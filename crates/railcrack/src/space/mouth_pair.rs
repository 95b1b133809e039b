//! Products of a cell with an edge of the mouth.

use super::cell::{Cell, CellPoint};
use super::duffy::{DuffyRules, PairPoint};
use super::patch::{ApartRules, CORNER_RATIO, Cover, DIVISIONS, EDGE_RATIO, Patch};

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
