//! The equations of the free jumps, solved as points change status.

use super::bordered::BorderedInverse;
use crate::linear::{LinearError, general_inverse, product};
use crate::math::{Matrix, axpy, axpy_two, dot};

/// The free jump components and their equations A_i + c_i A_{i+1}; c_i ≠ 0 couples the shear of a slipping point to its pressure.
///
/// The inverse G of the equations R of some statuses, the base, is known. What has changed since is a border: a freed component brings its
/// equation and its column, a held one the condition that it stays where it is and a force in its equation,
///
/// ```text
/// R  C   x     b
/// D  E   y  =  d,     x = G b − (G C) y,   (E − D G C) y = d − D G b.
/// ```
///
/// A change costs one product with G at most, and none to be undone; many changes together become a new base.
pub(super) struct ActiveInverse<'a> {
    stiffness: &'a Matrix,
    base: Base,
    changes: Vec<Change>,
    /// (E − D G C)⁻¹.
    border: BorderedInverse,
    /// What each component is now.
    now: Vec<Now>,
    /// Jump (mm) at which each component is held that is not free in the base.
    held_at: Vec<f64>,
    /// A times these.
    held: Vec<f64>,
    /// G b of the last load; none if b or G are no longer the same.
    unchanged: Option<Vec<f64>>,
    kept: Kept,
}

/// The free components at some moment, and the inverse of their equations.
struct Base {
    free: Vec<usize>,
    /// Place of each component in `free`.
    place: Vec<Option<usize>>,
    /// c_i of each component.
    coupling: Vec<f64>,
    /// G.
    inverse: Matrix,
}

/// What a component is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Now {
    /// Free, with an equation of the base or of a change.
    Free(Equation),
    Held,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Equation {
    Base(usize),
    Change(usize),
}

/// A row and a column of the border.
struct Change {
    component: usize,
    kind: Kind,
    /// What the component was before.
    before: Now,
    /// Its row of D.
    row: Row,
    /// G times its column of C.
    response: Vec<f64>,
}

enum Kind {
    /// Free from now on, with this c_i.
    Freed(f64),
    /// Held from now on at this jump, mm.
    Held(f64),
}

/// A row of D.
enum Row {
    Dense(Vec<f64>),
    /// One at a place, or nothing but zeros.
    Unit(Option<usize>),
}

impl Row {
    fn times(&self, x: &[f64]) -> f64 {
        match self {
            Self::Dense(row) => dot(row, x),
            Self::Unit(place) => place.map_or(0.0, |place| x[place]),
        }
    }

    fn entry(&self, j: usize) -> f64 {
        match self {
            Self::Dense(row) => row[j],
            Self::Unit(place) => f64::from(*place == Some(j)),
        }
    }
}

/// What to return to.
#[derive(Default)]
struct Kept {
    changes: usize,
    border: BorderedInverse,
    /// The jumps of changes that hold.
    values: Vec<f64>,
    held_at: Vec<f64>,
    held: Vec<f64>,
    /// The base and its changes, if another has been made since.
    base: Option<(Base, Vec<Change>, Vec<Now>)>,
}

/// Components per change that it takes to make a new base, and how many changes at least: measured, and flat around these.
const MANY: usize = 16;
const FEW: usize = 8;

impl<'a> ActiveInverse<'a> {
    /// All components held at zero.
    pub(super) fn new(stiffness: &'a Matrix) -> Self {
        let n = stiffness.rows();
        let (place, coupling) = (vec![None; n], vec![0.0; n]);
        let base = Base { free: Vec::new(), place, coupling, inverse: Matrix::zeros(0, 0) };
        let kept = Kept { held_at: vec![0.0; n], held: vec![0.0; n], ..Kept::default() };
        Self {
            stiffness,
            base,
            changes: Vec::new(),
            border: BorderedInverse::default(),
            now: vec![Now::Held; n],
            held_at: vec![0.0; n],
            held: vec![0.0; n],
            unchanged: None,
            kept,
        }
    }

    /// c_i of a free component.
    fn coupling(&self, equation: Equation) -> (usize, f64) {
        match equation {
            Equation::Base(place) => {
                let component = self.base.free[place];
                (component, self.base.coupling[component])
            }
            Equation::Change(k) => match self.changes[k].kind {
                Kind::Freed(coupling) => (self.changes[k].component, coupling),
                Kind::Held(_) => (self.changes[k].component, 0.0),
            },
        }
    }

    /// The free components and their c_i.
    pub(super) fn free(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.now.iter().filter_map(|now| match *now {
            Now::Free(equation) => Some(self.coupling(equation)),
            Now::Held => None,
        })
    }

    /// Entry of the equation A_row + `coupling` A_{row+1} at `column`.
    fn entry(&self, (row, coupling): (usize, f64), column: usize) -> f64 {
        let own = self.stiffness[(row, column)];
        if coupling == 0.0 { own } else { own + coupling * self.stiffness[(row + 1, column)] }
    }

    /// Frees `component` with the equation A_i + `coupling` A_{i+1}. False if that makes the equations singular to working precision:
    /// the component is free all the same, and [`ActiveInverse::refresh`] decides.
    #[must_use]
    pub(super) fn free_with(&mut self, component: usize, coupling: f64) -> bool {
        let own = (component, coupling);
        // The stiffness is symmetric: the column of `component` is its row.
        let column_row = self.stiffness.row(component);
        let column: Vec<f64> = self
            .base
            .free
            .iter()
            .map(|&i| {
                let coupling = self.base.coupling[i];
                if coupling == 0.0 { column_row[i] } else { column_row[i] + coupling * column_row[i + 1] }
            })
            .collect();
        let response = self.base.rows().map(|row| dot(row, &column)).collect();
        let row = Row::Dense(self.base.free.iter().map(|&j| self.entry(own, j)).collect());
        let diagonal = self.entry(own, component);
        let below = self.changes.iter().map(|change| match change.kind {
            Kind::Freed(_) => self.entry(own, change.component),
            Kind::Held(_) => 0.0,
        });
        let beside = self.changes.iter().map(|change| match change.kind {
            Kind::Freed(coupling) => self.entry((change.component, coupling), component),
            // What held it holds the variables before this one.
            Kind::Held(_) => 0.0,
        });
        let (below, beside) = (below.collect(), beside.collect());
        let change =
            Change { component, kind: Kind::Freed(coupling), before: self.now[component], row, response };
        self.now[component] = Now::Free(Equation::Change(self.changes.len()));
        self.border_by(change, below, beside, diagonal, SINGULAR * diagonal.abs())
    }

    /// Whether `component` is free with this c_i.
    pub(super) fn is_free_with(&self, component: usize, coupling: f64) -> bool {
        match self.now[component] {
            Now::Free(equation) => self.coupling(equation).1 == coupling,
            Now::Held => false,
        }
    }

    /// Holds `component` at `jump` (mm). False if that makes the equations singular.
    #[must_use]
    pub(super) fn hold_at(&mut self, component: usize, jump: f64) -> bool {
        let Now::Free(equation) = self.now[component] else {
            self.move_held(component, jump);
            return true;
        };
        let response = match equation {
            Equation::Base(place) => self.base.rows().map(|row| row[place]).collect(),
            Equation::Change(_) => vec![0.0; self.base.free.len()],
        };
        let row = Row::Unit(self.base.place[component]);
        let below = self.changes.iter().map(|change| match change.kind {
            Kind::Freed(_) => f64::from(change.component == component),
            Kind::Held(_) => 0.0,
        });
        let beside = (0..self.changes.len()).map(|k| f64::from(equation == Equation::Change(k)));
        let (below, beside) = (below.collect(), beside.collect());
        let change = Change { component, kind: Kind::Held(jump), before: self.now[component], row, response };
        self.now[component] = Now::Held;
        self.border_by(change, below, beside, 0.0, f64::MIN_POSITIVE)
    }

    /// Adds a change whose row of E is `below`, its column `beside`, and its own entry `diagonal`. False if its pivot is not above `singular`.
    fn border_by(
        &mut self,
        change: Change,
        mut below: Vec<f64>,
        mut beside: Vec<f64>,
        mut diagonal: f64,
        singular: f64,
    ) -> bool {
        for (k, other) in self.changes.iter().enumerate() {
            below[k] -= change.row.times(&other.response);
            beside[k] -= other.row.times(&change.response);
        }
        diagonal -= change.row.times(&change.response);
        self.changes.push(change);
        let sound = self.border.grow(&below, &beside, diagonal, singular);
        if sound && self.changes.len() > 2 * self.many() {
            return self.fold().is_ok();
        }
        sound
    }

    /// Changes that become a new base once a step is done, and twice as many at once.
    fn many(&self) -> usize {
        (self.now.len() / MANY).max(FEW)
    }

    /// Holds a component that is held already at another jump.
    fn move_held(&mut self, component: usize, jump: f64) {
        let last = self.changes.iter_mut().rev().find(|change| change.component == component);
        if let Some(Change { kind: Kind::Held(value), .. }) = last {
            *value = jump;
            return;
        }
        let change = jump - self.held_at[component];
        if change != 0.0 {
            self.held_at[component] = jump;
            self.unchanged = None;
            axpy(change, self.stiffness.row(component), &mut self.held);
        }
    }

    /// The jumps of all components under the nodal forces `load`.
    pub(super) fn solve(&mut self, load: &[f64], jump: &mut [f64]) {
        self.unchanged = None;
        self.solve_again(load, jump);
    }

    /// [`ActiveInverse::solve`] after changes since, under the same `load`.
    pub(super) fn solve_again(&mut self, load: &[f64], jump: &mut [f64]) {
        let unchanged = self.unchanged.take().unwrap_or_else(|| {
            let right: Vec<f64> =
                self.base.free.iter().map(|&i| self.right(load, (i, self.base.coupling[i]))).collect();
            self.base.rows().map(|row| dot(row, &right)).collect()
        });
        let right: Vec<f64> = self
            .changes
            .iter()
            .map(|change| {
                let own = match change.kind {
                    Kind::Freed(coupling) => self.right(load, (change.component, coupling)),
                    Kind::Held(jump) => jump - self.held_at[change.component],
                };
                own - change.row.times(&unchanged)
            })
            .collect();
        let shares = self.border.times(&right);
        let mut free = unchanged.clone();
        let mut pairs = self.changes.chunks_exact(2).zip(shares.chunks_exact(2));
        for (changes, y) in pairs.by_ref() {
            axpy_two((-y[0], &changes[0].response), (-y[1], &changes[1].response), &mut free);
        }
        if let (true, Some(change), Some(y)) =
            (self.changes.len() % 2 == 1, self.changes.last(), shares.last())
        {
            axpy(-y, &change.response, &mut free);
        }
        jump.copy_from_slice(&self.held_at);
        for (&i, x) in self.base.free.iter().zip(&free) {
            jump[i] += x;
        }
        for (change, y) in self.changes.iter().zip(&shares) {
            match change.kind {
                Kind::Freed(_) => jump[change.component] += y,
                // Exactly, so that what sticks does not creep.
                Kind::Held(value) => jump[change.component] = value,
            }
        }
        self.unchanged = Some(unchanged);
    }

    fn right(&self, load: &[f64], (i, coupling): (usize, f64)) -> f64 {
        let own = load[i] - self.held[i];
        if coupling == 0.0 { own } else { own + coupling * (load[i + 1] - self.held[i + 1]) }
    }

    /// A times the jumps of what the base holds, N/mm.
    pub(super) fn held(&self) -> &[f64] {
        &self.held
    }

    /// A times the jumps.
    pub(super) fn forces(&self, jump: &[f64], forces: &mut Vec<f64>) {
        forces.clone_from(&self.held);
        let mut moved: Vec<(usize, f64)> = self.base.free.iter().map(|&i| (i, jump[i])).collect();
        for (k, change) in self.changes.iter().enumerate() {
            let i = change.component;
            // Once each: with its first change, where the base does not have it.
            if self.base.place[i].is_none() && self.changes[..k].iter().all(|other| other.component != i) {
                moved.push((i, jump[i] - self.held_at[i]));
            }
        }
        let weights: Vec<f64> = moved.iter().map(|entry| entry.1).collect();
        add_rows(&weights, |k| self.stiffness.row(moved[k].0), forces);
    }

    /// Makes the present state the one to return to.
    pub(super) fn keep(&mut self) {
        if self.changes.len() > self.many() {
            // Shapes fit; and if not, the changes remain changes.
            let _ = self.fold();
        }
        self.kept.base = None;
        self.kept.changes = self.changes.len();
        self.kept.border.clone_from(&self.border);
        self.kept.values.clear();
        self.kept.values.extend(self.changes.iter().map(|change| match change.kind {
            Kind::Held(value) => value,
            Kind::Freed(_) => 0.0,
        }));
        self.kept.held_at.clone_from(&self.held_at);
        self.kept.held.clone_from(&self.held);
    }

    /// Returns to what was kept.
    pub(super) fn restore(&mut self) {
        if let Some((base, changes, now)) = self.kept.base.take() {
            (self.base, self.changes, self.now) = (base, changes, now);
        }
        while self.changes.len() > self.kept.changes {
            let Some(change) = self.changes.pop() else { break };
            self.now[change.component] = change.before;
        }
        for (change, kept) in self.changes.iter_mut().zip(&self.kept.values) {
            if let Kind::Held(value) = &mut change.kind {
                *value = *kept;
            }
        }
        self.unchanged = None;
        self.border.clone_from(&self.kept.border);
        self.held_at.clone_from(&self.kept.held_at);
        self.held.clone_from(&self.kept.held);
    }

    /// Inverts the equations of the present free components afresh: a new base without changes.
    pub(super) fn refresh(&mut self) -> Result<(), LinearError> {
        let (free, coupling) = self.free_now();
        let equations =
            Matrix::from_fn(free.len(), free.len(), |i, j| self.entry((free[i], coupling[free[i]]), free[j]));
        let inverse = general_inverse(&equations)?;
        self.rebase(free, coupling, inverse);
        Ok(())
    }

    /// The free components, those of the base first, and the c_i of all.
    fn free_now(&self) -> (Vec<usize>, Vec<f64>) {
        let mut coupling = vec![0.0; self.now.len()];
        self.free().for_each(|(i, own)| coupling[i] = own);
        let of_base = |i: &usize| matches!(self.now[*i], Now::Free(Equation::Base(_)));
        let mut free: Vec<usize> = self.base.free.iter().copied().filter(of_base).collect();
        free.extend(self.of_changes().map(|k| self.changes[k].component));
        (free, coupling)
    }

    /// The changes whose component is free by them.
    fn of_changes(&self) -> impl Iterator<Item = usize> + '_ {
        let stands = |k: &usize| self.now[self.changes[*k].component] == Now::Free(Equation::Change(*k));
        (0..self.changes.len()).filter(stands)
    }

    /// Makes the present state a base, by the inverse of the bordered equations
    ///
    /// ```text
    /// G + (G C) Z (D G)   −(G C) Z
    /// −Z (D G)            Z,          Z = (E − D G C)⁻¹.
    /// ```
    fn fold(&mut self) -> Result<(), LinearError> {
        let (free, coupling) = self.free_now();
        let (n, changes) = (self.base.free.len(), self.changes.len());
        let rows = Matrix::from_fn(changes, n, |k, j| self.changes[k].row.entry(j));
        let border = Matrix::from_fn(changes, changes, |k, m| self.border.row(k)[m]);
        let shares = product(&border, &product(&rows, &self.base.inverse)?)?;
        let kept: Vec<usize> = free.iter().map_while(|&i| self.place_kept(i)).collect();
        let new: Vec<usize> = self.of_changes().collect();
        let response = Matrix::from_fn(kept.len(), changes, |i, k| self.changes[k].response[kept[i]]);
        let update = product(&response, &shares)?;
        let beside = product(&response, &border)?;
        let inverse = Matrix::from_fn(free.len(), free.len(), |i, j| match (kept.get(i), kept.get(j)) {
            (Some(&row), Some(&column)) => self.base.inverse[(row, column)] + update[(i, column)],
            (Some(_), None) => -beside[(i, new[j - kept.len()])],
            (None, Some(&column)) => -shares[(new[i - kept.len()], column)],
            (None, None) => border[(new[i - kept.len()], new[j - kept.len()])],
        });
        self.rebase(free, coupling, inverse);
        Ok(())
    }

    /// The place in the base of a component that is free by it now.
    fn place_kept(&self, component: usize) -> Option<usize> {
        match self.now[component] {
            Now::Free(Equation::Base(place)) => Some(place),
            Now::Free(Equation::Change(_)) | Now::Held => None,
        }
    }

    fn rebase(&mut self, free: Vec<usize>, coupling: Vec<f64>, inverse: Matrix) {
        // Where free components were held, and where held ones are now.
        let mut held_at = self.held_at.clone();
        for change in &self.changes {
            if let Kind::Held(value) = change.kind {
                held_at[change.component] = value;
            }
        }
        free.iter().for_each(|&i| held_at[i] = 0.0);
        for (i, &at) in held_at.iter().enumerate() {
            let change = at - self.held_at[i];
            if change != 0.0 {
                axpy(change, self.stiffness.row(i), &mut self.held);
            }
        }
        self.held_at = held_at;
        let mut place = vec![None; self.now.len()];
        let mut now = vec![Now::Held; self.now.len()];
        for (k, &i) in free.iter().enumerate() {
            place[i] = Some(k);
            now[i] = Now::Free(Equation::Base(k));
        }
        let base = std::mem::replace(&mut self.base, Base { free, place, coupling, inverse });
        let changes = std::mem::take(&mut self.changes);
        let now = std::mem::replace(&mut self.now, now);
        self.kept.base.get_or_insert((base, changes, now));
        self.border = BorderedInverse::default();
        self.unchanged = None;
    }
}

impl Base {
    fn rows(&self) -> impl Iterator<Item = &[f64]> {
        (0..self.free.len()).map(|i| self.inverse.row(i))
    }
}

/// Pivots below this fraction of the diagonal are taken for zero.
const SINGULAR: f64 = 1e-12;

/// y += Σ weights_i rows(i), two rows at a time.
fn add_rows<'m>(weights: &[f64], rows: impl Fn(usize) -> &'m [f64], y: &mut [f64]) {
    let mut pairs = weights.chunks_exact(2);
    for (k, pair) in pairs.by_ref().enumerate() {
        axpy_two((pair[0], rows(2 * k)), (pair[1], rows(2 * k + 1)), y);
    }
    if let [last] = pairs.remainder() {
        axpy(*last, rows(weights.len() - 1), y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stiffness() -> Matrix {
        Matrix::from_fn(8, 8, |i, j| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + 2.0 * f64::from(i == j))
    }

    /// The largest residual of the equations of the free components, and distance of the held ones from `held`.
    fn residual(active: &mut ActiveInverse, load: &[f64], held: &[f64]) -> f64 {
        let mut jump = vec![0.0; load.len()];
        active.solve(load, &mut jump);
        let mut forces = Vec::new();
        active.forces(&jump, &mut forces);
        let gap: Vec<f64> = forces.iter().zip(load).map(|(f, l)| f - l).collect();
        let exact = active.stiffness.times(&jump);
        let mut worst = forces.iter().zip(&exact).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        let free: Vec<(usize, f64)> = active.free().collect();
        for &(i, coupling) in &free {
            let next = if coupling == 0.0 { 0.0 } else { coupling * gap[i + 1] };
            worst = worst.max((gap[i] + next).abs());
        }
        for i in (0..load.len()).filter(|i| free.iter().all(|(j, _)| j != i)) {
            worst = worst.max((jump[i] - held[i]).abs());
        }
        worst
    }

    #[test]
    fn equations_hold_after_any_changes() {
        const ROUND_OFF: f64 = 1e-13;
        let stiffness = stiffness();
        let load = [1.0, -2.0, 0.5, 3.0, 0.3, -1.0, 2.0, 0.7];
        let mut held = [0.0; 8];
        let mut active = ActiveInverse::new(&stiffness);
        for (component, coupling) in [(2, 0.0), (4, 0.3), (0, -0.3), (7, 0.0), (6, 0.0)] {
            assert!(active.free_with(component, coupling));
            assert!(residual(&mut active, &load, &held) < ROUND_OFF);
        }
        for round in 0..3 {
            assert!(active.hold_at(4, 0.25) && active.hold_at(6, 0.0) && active.free_with(4, -0.2));
            assert!(active.hold_at(1, 0.5));
            held[1] = 0.5;
            assert!(residual(&mut active, &load, &held) < ROUND_OFF, "round {round}");
            active.keep();
            assert!(active.hold_at(2, -0.125) && active.hold_at(1, 0.1) && active.free_with(1, 0.0));
            let mut bent = held;
            bent[2] = -0.125;
            assert!(residual(&mut active, &load, &bent) < ROUND_OFF);
            if round == 1 {
                active.refresh().unwrap();
                assert!(residual(&mut active, &load, &bent) < ROUND_OFF);
                assert!(active.hold_at(0, 0.3));
            }
            active.restore();
            assert!(residual(&mut active, &load, &held) < ROUND_OFF, "restored");
            if round == 0 {
                active.fold().unwrap();
                assert!(active.changes.is_empty());
                active.keep();
            }
            let free: Vec<usize> = active.free().map(|(i, _)| i).collect();
            assert_eq!(free, [0, 2, 4, 7]);
            assert!(active.free_with(6, 0.0));
            assert!(residual(&mut active, &load, &held) < ROUND_OFF);
        }
    }

    #[test]
    fn a_pivot_that_vanishes_is_told_and_repaired_once_the_equations_are_sound() {
        // A_0 + A_1 vanishes on component 0, but not on 0 and 2 together.
        let rows = [[2.0, -2.0, 1.0], [-2.0, 3.0, 0.5], [1.0, 0.5, 4.0]];
        let stiffness = Matrix::from_fn(3, 3, |i, j| rows[i][j]);
        let mut active = ActiveInverse::new(&stiffness);
        assert!(!active.free_with(0, 1.0));
        assert!(active.refresh().is_err());
        let _ = active.free_with(2, 0.0);
        active.refresh().unwrap();
        // (A_0 + A_1)·x = 1.5 x_2 = 3 and A_2·x = x_0 + 4 x_2 = 1.
        let mut x = [0.0; 3];
        active.solve(&[1.0, 2.0, 1.0], &mut x);
        assert!((x[0] + 7.0).abs() < 1e-14 && (x[2] - 2.0).abs() < 1e-14, "{x:?}");
    }
}
