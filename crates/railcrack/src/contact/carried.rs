//! The tableau of a window of groups, carried along with the window.
//!
//! Groups that leave the window keep their statuses, so that their rows and columns are left out of
//! the tableau. Groups that come in have been eliminated with their statuses before; the tableau
//! gains their rows and columns, and what it had stays as it is.

use super::condition::Condition;
use super::frozen::FrozenFaces;
use crate::linear::{LinearError, add_product, general_inverse, product};
use crate::math::Matrix;
use std::ops::Range;

/// A tableau whose basis has the present conditions.
#[derive(Debug, Clone)]
pub struct CarriedTableau {
    pub(super) conditions: Vec<Condition>,
    /// Tᵀ: the outputs for a unit of each input.
    pub(super) responses: Matrix,
    /// Unit of forces over jumps, N/mm per mm.
    pub(super) unit: f64,
}

/// The tableau of `window`, with what the eliminated neighbours take from A of its first and its
/// last group.
#[derive(Debug, Clone)]
pub struct WindowTableau {
    window: Range<usize>,
    tableau: CarriedTableau,
    before: Option<Matrix>,
    after: Option<Matrix>,
}

/// Where a group is at the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Before,
    After,
}

/// Changes of A below this share of the unit are none.
const NO_CHANGE: f64 = 1e-14;

impl WindowTableau {
    /// That of `window`, with the groups outside eliminated by `frozen`.
    ///
    /// Errors: none where they are.
    pub fn new(
        tableau: CarriedTableau,
        window: Range<usize>,
        frozen: &FrozenFaces<'_>,
    ) -> Result<Self, LinearError> {
        let (before, after) = (frozen.taken_before(window.start)?, frozen.taken_after(window.end)?);
        Ok(Self { window, tableau, before, after })
    }

    /// The tableau of another `window` that shares groups with this one, none if it does not.
    ///
    /// Errors: statuses that leave jumps undetermined.
    pub fn moved(
        mut self,
        window: &Range<usize>,
        frozen: &mut FrozenFaces<'_>,
        asked: &dyn Fn() -> bool,
    ) -> Result<Option<CarriedTableau>, LinearError> {
        let shared = self.window.start.max(window.start)..self.window.end.min(window.end);
        if shared.is_empty() || !frozen.enclose(&self.window, asked)? {
            return Ok(None);
        }
        self.renew(Side::Before, frozen)?;
        self.renew(Side::After, frozen)?;
        while self.window.end < window.end {
            self.add(Side::After, frozen)?;
            self.couple(self.window.end - 1, 1.0, frozen)?;
        }
        while self.window.start > window.start {
            self.add(Side::Before, frozen)?;
            self.couple(self.window.start, 1.0, frozen)?;
        }
        while self.window.start < window.start {
            self.leave_out(self.window.start, frozen)?;
        }
        while self.window.end > window.end {
            self.leave_out(self.window.end - 1, frozen)?;
        }
        Ok(Some(self.tableau))
    }

    /// Leaves out group `k` at an end of the window, which keeps its statuses.
    fn leave_out(&mut self, k: usize, frozen: &FrozenFaces<'_>) -> Result<(), LinearError> {
        self.couple(k, -1.0, frozen)?;
        let (all, own) = (self.tableau.conditions.len(), frozen.blocks.components(k));
        let kept = if k == self.window.start { own..all } else { 0..all - own };
        let CarriedTableau { conditions, responses, .. } = &mut self.tableau;
        *conditions = conditions[kept.clone()].to_vec();
        *responses =
            Matrix::from_fn(kept.len(), kept.len(), |i, j| responses[(kept.start + i, kept.start + j)]);
        if k == self.window.start {
            self.window.start += 1;
        } else {
            self.window.end -= 1;
        }
        Ok(())
    }

    /// Adds `factor` times A between group `k` of the window and those that are not beside it.
    fn couple(&mut self, k: usize, factor: f64, frozen: &FrozenFaces<'_>) -> Result<(), LinearError> {
        let unit = self.tableau.unit;
        let blocks = frozen.blocks;
        let (moments, between) = (&blocks.far.moments, &blocks.far.between);
        let n = self.tableau.conditions.len();
        let rank = moments[k].columns();
        // A changes by L Rᵀ with L = [U, X] and R = [X, U], the U of k and the X of the others.
        let mut own = Matrix::zeros(n, rank);
        let mut others = Matrix::zeros(n, rank);
        let mut start = 0;
        let mut any = false;
        for l in self.window.clone() {
            let count = blocks.components(l);
            if l == k {
                for i in 0..count {
                    own.row_mut(start + i).copy_from_slice(moments[k].row(i));
                }
            } else if l.abs_diff(k) > 1 {
                any = true;
                let block = if l < k {
                    product(&moments[l], &between[l][k - l - 2])?
                } else {
                    product(&moments[l], &between[k][l - k - 2].transposed())?
                };
                for i in 0..count {
                    let row = others.row_mut(start + i);
                    row.iter_mut().zip(block.row(i)).for_each(|(to, value)| *to = factor * value / unit);
                }
            }
            start += count;
        }
        if !any {
            return Ok(());
        }
        let pair = |i: usize, c: usize, (one, other): (&Matrix, &Matrix)| {
            if c < rank { one[(i, c)] } else { other[(i, c - rank)] }
        };
        let left = |i: usize, c: usize| pair(i, c, (&own, &others));
        let all = 0..n;
        let free = self.free(&all);
        // The forces L along the free components, and what the tableau makes of them.
        let along = Matrix::from_fn(2 * rank, free.len(), |c, m| {
            let (i, coupling) = free[m];
            left(i, c) + if coupling == 0.0 { 0.0 } else { coupling * left(i + 1, c) }
        });
        let of_free = Matrix::from_fn(free.len(), n, |m, j| self.tableau.responses[(free[m].0, j)]);
        let mut outputs = product(&along, &of_free)?;
        // Rᵀ w for a unit of each input.
        let right_free = Matrix::from_fn(free.len(), 2 * rank, |m, c| pair(free[m].0, c, (&others, &own)));
        let jumps_free = Matrix::from_fn(n, free.len(), |j, m| self.tableau.responses[(j, free[m].0)]);
        let mut amplitudes = product(&jumps_free, &right_free)?;
        let outputs_free = Matrix::from_fn(2 * rank, free.len(), |c, m| outputs[(c, free[m].0)]);
        let mut system = product(&outputs_free, &right_free)?.transposed();
        for c in 0..2 * rank {
            system[(c, c)] += 1.0;
        }
        for (i, condition) in self.tableau.conditions.iter().enumerate() {
            if condition.held().is_some() {
                for c in 0..2 * rank {
                    amplitudes[(i, c)] += pair(i, c, (&others, &own));
                    outputs[(c, i)] -= left(i, c);
                }
            }
        }
        let solved = product(&amplitudes, &general_inverse(&system)?.transposed())?;
        add_product(-1.0, &solved, &outputs, &mut self.tableau.responses)
    }

    /// The components of the group at one end of the window.
    fn end(&self, side: Side, frozen: &FrozenFaces<'_>) -> Range<usize> {
        let all = self.tableau.conditions.len();
        match side {
            Side::Before => 0..frozen.blocks.components(self.window.start),
            Side::After => all - frozen.blocks.components(self.window.end - 1)..all,
        }
    }

    /// The jumps of the components `own` for a unit of each input, a row each.
    fn jumps(&self, own: &Range<usize>) -> Matrix {
        let CarriedTableau { conditions, responses, .. } = &self.tableau;
        Matrix::from_fn(responses.rows(), own.len(), |j, i| match conditions[own.start + i] {
            Condition::Held(_) => f64::from(j == own.start + i),
            Condition::Free(_) => responses[(j, own.start + i)],
        })
    }

    /// The free ones of the components `own`, counted from the first, with their coupling.
    fn free(&self, own: &Range<usize>) -> Vec<(usize, f64)> {
        let condition = |i: usize| match self.tableau.conditions[own.start + i] {
            Condition::Free(c) => Some((i, c)),
            Condition::Held(_) => None,
        };
        (0..own.len()).filter_map(condition).collect()
    }

    /// Takes up a change of what the eliminated neighbours take from A.
    fn renew(&mut self, side: Side, frozen: &FrozenFaces<'_>) -> Result<(), LinearError> {
        let now = match side {
            Side::Before => frozen.taken_before(self.window.start)?,
            Side::After => frozen.taken_after(self.window.end)?,
        };
        let then = match side {
            Side::Before => std::mem::replace(&mut self.before, now.clone()),
            Side::After => std::mem::replace(&mut self.after, now.clone()),
        };
        let (Some(then), Some(now)) = (then, now) else { return Ok(()) };
        let unit = self.tableau.unit;
        // A changes by this, in units.
        let change = Matrix::from_fn(now.rows(), now.columns(), |i, j| (then[(i, j)] - now[(i, j)]) / unit);
        if change.entries().iter().all(|value| value.abs() <= NO_CHANGE) {
            return Ok(());
        }
        let own = self.end(side, frozen);
        let free = self.free(&own);
        let jumps = self.jumps(&own);
        // Its forces along the free components, for a unit of each jump: components × free.
        let along = Matrix::from_fn(own.len(), free.len(), |j, m| {
            let (i, c) = free[m];
            change[(i, j)] + if c == 0.0 { 0.0 } else { c * change[(i + 1, j)] }
        });
        let unknown = product(&jumps, &along)?;
        let system = Matrix::from_fn(free.len(), free.len(), |m, p| {
            f64::from(m == p) + unknown[(own.start + free[m].0, p)]
        });
        // Rows: v = (unknown) (I + …)⁻¹, by inputs.
        let forces = product(&unknown, &general_inverse(&system)?)?;
        let of_free = Matrix::from_fn(free.len(), self.tableau.responses.columns(), |m, j| {
            self.tableau.responses[(own.start + free[m].0, j)]
        });
        add_product(-1.0, &forces, &of_free, &mut self.tableau.responses)?;
        // Held components bear the change themselves.
        let after = self.jumps(&own);
        let borne = product(&after, &change.transposed())?;
        for j in 0..borne.rows() {
            for i in 0..own.len() {
                if self.tableau.conditions[own.start + i].held().is_some() {
                    self.tableau.responses[(j, own.start + i)] += borne[(j, i)];
                }
            }
        }
        Ok(())
    }

    /// Adds the group beside the window.
    fn add(&mut self, side: Side, frozen: &FrozenFaces<'_>) -> Result<(), LinearError> {
        let unit = self.tableau.unit;
        let own = self.end(side, frozen);
        let (group, beside) = match side {
            Side::Before => (self.window.start - 1, self.window.start),
            Side::After => (self.window.end, self.window.end - 1),
        };
        let taken = match side {
            Side::Before => frozen.taken_before(group)?,
            Side::After => frozen.taken_after(group + 1)?,
        };
        let stiffness =
            Matrix::from_fn(frozen.blocks.components(group), frozen.blocks.components(group), |i, j| {
                (frozen.blocks.own[group][(i, j)] - taken.as_ref().map_or(0.0, |t| t[(i, j)])) / unit
            });
        // A between the group beside (rows) and the new one.
        let across =
            Matrix::from_fn(own.len(), stiffness.rows(), |i, j| frozen.entry(beside, group, i, j) / unit);
        let conditions = frozen.conditions_of(group);
        let (of_forces, of_neighbour) = frozen.answer_of(group, side == Side::Before)?;
        let (n, old) = (stiffness.rows(), self.tableau.conditions.len());
        let new_free: Vec<usize> = (0..n).filter(|&i| conditions[i].held().is_none()).collect();
        let new_held: Vec<usize> = (0..n).filter(|&i| conditions[i].held().is_some()).collect();

        // (b) Units of the old inputs.
        let beside_jumps = self.jumps(&own);
        let mut free = product(&beside_jumps, &of_neighbour.transposed())?;
        free.entries_mut().iter_mut().for_each(|value| *value = -*value);
        let held_free =
            Matrix::from_fn(new_free.len(), new_held.len(), |m, h| stiffness[(new_held[h], new_free[m])]);
        let mut borne = product(&free, &held_free)?;
        let across_held = Matrix::from_fn(own.len(), new_held.len(), |i, h| across[(i, new_held[h])]);
        add_product(1.0, &beside_jumps, &across_held, &mut borne)?;

        // (a) Units of the new inputs: jumps of the new group with the old one at rest.
        let mut alone = Matrix::zeros(n, n);
        let of_stiffness = product(of_forces, &stiffness)?;
        for j in 0..n {
            if conditions[j].held().is_some() {
                alone[(j, j)] = 1.0;
                for (m, &i) in new_free.iter().enumerate() {
                    alone[(j, i)] = -unit * of_stiffness[(m, j)];
                }
            } else {
                for (m, &i) in new_free.iter().enumerate() {
                    alone[(j, i)] = unit * of_forces[(m, j)];
                }
            }
        }
        let onto = product(&alone, &across.transposed())?;
        let old_free = self.free(&own);
        let inputs = Matrix::from_fn(n, old_free.len(), |j, m| {
            let (i, c) = old_free[m];
            -(onto[(j, i)] + if c == 0.0 { 0.0 } else { c * onto[(j, i + 1)] })
        });
        let of_old_free = Matrix::from_fn(old_free.len(), old, |m, j| {
            self.tableau.responses[(own.start + old_free[m].0, j)]
        });
        let mut old_outputs = product(&inputs, &of_old_free)?;
        let back = Matrix::from_fn(n, own.len(), |j, i| match self.tableau.conditions[own.start + i] {
            Condition::Held(_) => 0.0,
            Condition::Free(_) => old_outputs[(j, own.start + i)],
        });
        for i in 0..own.len() {
            if self.tableau.conditions[own.start + i].held().is_some() {
                for j in 0..n {
                    old_outputs[(j, own.start + i)] += onto[(j, i)];
                }
            }
        }
        let corrections = product(&back, &of_neighbour.transposed())?;
        for j in 0..n {
            for (m, &i) in new_free.iter().enumerate() {
                alone[(j, i)] -= corrections[(j, m)];
            }
        }
        let mut forces = product(&alone, &stiffness.transposed())?;
        add_product(1.0, &back, &across, &mut forces)?;

        let shift = if side == Side::Before { n } else { 0 };
        let at_new = if side == Side::Before { 0 } else { old };
        let mut responses = Matrix::zeros(old + n, old + n);
        for j in 0..old {
            let row = responses.row_mut(shift + j);
            row[shift..shift + old].copy_from_slice(self.tableau.responses.row(j));
            for (m, &i) in new_free.iter().enumerate() {
                row[at_new + i] = free[(j, m)];
            }
            for (h, &i) in new_held.iter().enumerate() {
                row[at_new + i] = borne[(j, h)];
            }
        }
        for j in 0..n {
            let row = responses.row_mut(at_new + j);
            row[shift..shift + old].copy_from_slice(old_outputs.row(j));
            for i in 0..n {
                let held = conditions[i].held().is_some();
                row[at_new + i] = if held { forces[(j, i)] } else { alone[(j, i)] };
            }
        }
        self.tableau.responses = responses;
        match side {
            Side::Before => {
                self.tableau.conditions.splice(0..0, conditions);
                self.window.start -= 1;
                self.before = taken;
            }
            Side::After => {
                self.tableau.conditions.extend(conditions);
                self.window.end += 1;
                self.after = taken;
            }
        }
        Ok(())
    }
}
