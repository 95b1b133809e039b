//! Nodal pressures of a wheel on the uncracked surface, as a function of its position.

use super::condition::{Condition, Degenerate};
use super::parabola::Parabola;
use super::tableau::{FaceRate, Tableau};
use crate::linear::LinearError;
use crate::math::Matrix;

/// The nodal pressures without cracks: quadratic in x_c between the positions at which a node comes
/// into contact or leaves it, because the gap without pressure is.
#[derive(Debug, Clone, Default)]
pub(crate) struct UncrackedPath {
    pieces: Vec<PathPiece>,
}

/// A part of the path without changes of contact.
#[derive(Debug, Clone)]
struct PathPiece {
    /// Its first x_c, mm.
    from: f64,
    /// The first node that may carry pressure.
    first: usize,
    /// Coefficients of powers of x_c − `from` of q from that node on, MPa.
    pressures: Vec<[f64; 3]>,
    /// The same of the approach δ, mm.
    approach: [f64; 3],
    /// ∂q/∂P′ from the first node on, 1/mm: that of a flat punch over the nodes in contact.
    rises: Vec<f64>,
}

/// Number of iterations for the first position. Pressures are found from those of a Hertzian
/// contact, from which few nodes differ.
const FIRST_ITERATIONS: usize = 100;
/// Largest number of changes at one position.
const MOST_AT_ONCE: usize = 16;

impl UncrackedPath {
    /// The path over all positions of `surface`.
    ///
    /// Errors: no contact at the first position, or a change of contact without end.
    pub(super) fn new(surface: UncrackedSurface) -> Result<Self, LinearError> {
        let order = surface.loaded.len();
        let walked = Walk::new(surface).and_then(Walk::pieces);
        walked.map_err(|Degenerate| LinearError::Singular { order })
    }

    fn piece(&self, xc: f64) -> Option<&PathPiece> {
        let after = self.pieces.partition_point(|piece| piece.from <= xc);
        self.pieces.get(after.max(1) - 1)
    }

    /// The nodes that may carry pressure with the wheel at `xc` (mm), and their q (MPa).
    pub fn pressures(&self, xc: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.piece(xc).into_iter().flat_map(move |piece| {
            let value = move |(i, q): (usize, &[f64; 3])| (piece.first + i, at(q, xc - piece.from));
            piece.pressures.iter().enumerate().map(value)
        })
    }

    /// The nodes that may carry pressure with the wheel at `xc` (mm), and their ∂q/∂P′ (1/mm).
    pub fn rises(&self, xc: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.piece(xc)
            .into_iter()
            .flat_map(|piece| piece.rises.iter().enumerate().map(move |(i, &rise)| (piece.first + i, rise)))
    }

    /// δ (mm) with the wheel at `xc` (mm).
    pub fn approach(&self, xc: f64) -> f64 {
        self.piece(xc).map_or(0.0, |piece| at(&piece.approach, xc - piece.from))
    }
}

fn at([c0, c1, c2]: &[f64; 3], d: f64) -> f64 {
    c0 + d * (c1 + d * c2)
}

/// The equations of a wheel on the uncracked surface: components of n nodes and of the approach.
pub(super) struct UncrackedSurface<'s> {
    /// Transposed matrix of all components.
    pub columns: &'s Matrix,
    /// The load on them with the wheel at a position (mm).
    pub load: &'s dyn Fn(f64) -> Vec<f64>,
    /// Estimate of the nodes in contact at the first position.
    pub loaded: Vec<bool>,
    /// The first and the last position, mm.
    pub range: (f64, f64),
    /// Round-off of the components of pressures and gaps.
    pub small: (f64, f64),
    /// Pressure (MPa) and approach (mm) of a unit of their components.
    pub units: (f64, f64),
}

/// A wheel that rolls over the uncracked surface.
struct Walk<'s> {
    surface: UncrackedSurface<'s>,
    tableau: Tableau<'s>,
    loaded: Vec<bool>,
    now: FaceRate,
    rates: [FaceRate; 2],
    /// Due to a unit of the line load.
    of_load: FaceRate,
    share: f64,
}

impl<'s> Walk<'s> {
    /// The wheel in contact at its first position.
    fn new(surface: UncrackedSurface<'s>) -> Result<Self, Degenerate> {
        let n = surface.loaded.len();
        let zero = || FaceRate::zero(n + 1);
        let mut walk = Self {
            tableau: Tableau::new(surface.columns),
            loaded: surface.loaded.clone(),
            now: zero(),
            rates: [zero(), zero()],
            of_load: zero(),
            share: 0.0,
            surface,
        };
        for node in 0..n {
            walk.set(node, walk.loaded[node]);
        }
        walk.tableau.set(n, Condition::Free(0.0));
        let first = (walk.surface.load)(walk.surface.range.0);
        walk.tableau.loads().set([first]);
        for _ in 0..FIRST_ITERATIONS {
            walk.tableau.solve(&mut walk.now.jump, &mut walk.now.contact)?;
            let (pressure, gap) = walk.surface.small;
            let wrong = |&i: &usize| match walk.loaded[i] {
                true => walk.now.jump[i] < -pressure,
                false => walk.now.contact[i] < -gap,
            };
            let changed: Vec<usize> = (0..n).filter(wrong).collect();
            if changed.is_empty() {
                return Ok(walk);
            }
            for node in changed {
                walk.set(node, !walk.loaded[node]);
            }
        }
        Err(Degenerate)
    }

    fn set(&mut self, node: usize, loaded: bool) {
        self.loaded[node] = loaded;
        let condition = if loaded { Condition::Free(0.0) } else { Condition::Held(0.0) };
        self.tableau.set(node, condition);
    }

    /// The path to the last position.
    fn pieces(mut self) -> Result<UncrackedPath, Degenerate> {
        let (from, to) = self.surface.range;
        let load = self.surface.load;
        let (start, middle, end) = (load(from), load(0.5 * (from + to)), load(to));
        let form = |of: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
            start.iter().zip(&middle).zip(&end).map(|((&s, &m), &e)| of(s, m, e)).collect()
        };
        let first = form(&|s, m, e| 4.0 * m - 3.0 * s - e);
        let second = form(&|s, m, e| 2.0 * (s + e) - 4.0 * m);
        let n = self.loaded.len();
        let mut unit_load = vec![0.0; n + 1];
        unit_load[n] = self.surface.units.1;
        self.tableau.loads().set([start.clone(), first, second, unit_load]);
        let mut pieces = Vec::new();
        let mut at_once = 0;
        loop {
            let [first, second] = &mut self.rates;
            self.tableau.rates(&mut [(1, first), (2, second), (3, &mut self.of_load)])?;
            pieces.push(self.piece());
            let Some((after, node)) = self.next_event() else { break };
            at_once = if after > 1e-12 { 0 } else { at_once + 1 };
            if at_once > MOST_AT_ONCE {
                return Err(Degenerate);
            }
            self.advance(after);
            let loaded = !self.loaded[node];
            self.set(node, loaded);
        }
        Ok(UncrackedPath { pieces })
    }

    fn parabola(&self, values: fn(&FaceRate) -> &Vec<f64>, i: usize) -> Parabola {
        let [first, second] = &self.rates;
        Parabola::of(values(&self.now)[i], values(first)[i], values(second)[i], self.share)
    }

    fn next_event(&self) -> Option<(f64, usize)> {
        let (pressure, gap) = self.surface.small;
        let mut span = 1.0 - self.share;
        let mut next = None;
        for node in 0..self.loaded.len() {
            let after = match self.loaded[node] {
                true => self.parabola(|rate| &rate.jump, node).first_fall(pressure, span),
                false => self.parabola(|rate| &rate.contact, node).first_fall(gap, span),
            };
            if let Some(after) = after {
                span = after;
                next = Some((after, node));
            }
        }
        next
    }

    fn advance(&mut self, after: f64) {
        let (one, two) = (after, after * (2.0 * self.share + after));
        let [first, second] = &self.rates;
        let go = |values: &mut [f64], first: &[f64], second: &[f64]| {
            for ((value, first), second) in values.iter_mut().zip(first).zip(second) {
                *value += one * first + two * second;
            }
        };
        go(&mut self.now.jump, &first.jump, &second.jump);
        go(&mut self.now.contact, &first.contact, &second.contact);
        self.share += after;
    }

    fn piece(&self) -> PathPiece {
        let (from, to) = self.surface.range;
        let per_mm = 1.0 / (to - from);
        let of = |i: usize, unit: f64| {
            let parabola = self.parabola(|rate| &rate.jump, i);
            [
                unit * parabola.value(),
                unit * parabola.rate() * per_mm,
                unit * 0.5 * parabola.bend() * per_mm * per_mm,
            ]
        };
        let n = self.loaded.len();
        let first = self.loaded.iter().position(|&loaded| loaded).unwrap_or(0);
        let last = self.loaded.iter().rposition(|&loaded| loaded).unwrap_or(0);
        PathPiece {
            from: from + self.share / per_mm,
            first,
            pressures: (first..=last).map(|i| of(i, self.surface.units.0)).collect(),
            approach: of(n, self.surface.units.1),
            rises: (first..=last).map(|i| self.surface.units.0 * self.of_load.jump[i]).collect(),
        }
    }
}
