//! Faces away from the wheel, whose points keep their statuses: they answer linearly and are
//! eliminated, group by group from both ends of a row of cracks.

use super::condition::Condition;
use super::{FaceProblem, FaceSolution, PointStatus};
use crate::body::BlockStiffness;
use crate::linear::{LinearError, add_product, add_transposed_product, general_inverse, product};
use crate::math::{Matrix, axpy};
use std::ops::Range;

/// The conditions of a group of cracks.
#[derive(Debug, Clone, Default, PartialEq)]
struct Conditions {
    /// Components without contact force q_i + c_i q_{i+1}, with c_i.
    free: Vec<(usize, f64)>,
}

/// A group eliminated towards a neighbour: with the free jumps u of the group, the forces z on it
/// and the jumps w of the neighbour, u = P z − R w.
#[derive(Debug)]
struct Eliminated {
    /// P, free × components.
    of_forces: Matrix,
    /// R, free × components of the neighbour.
    of_neighbour: Matrix,
    /// A between the components of the neighbour and the free ones.
    onto_neighbour: Matrix,
}

/// The faces of a row of cracks outside of a window of groups, with the statuses that they keep.
pub struct FrozenFaces<'a> {
    problem: &'a FaceProblem<'a>,
    pub(super) blocks: &'a BlockStiffness,
    conditions: Vec<Conditions>,
    /// Each group eliminated towards the next one and towards the one before.
    forward: Vec<Option<Eliminated>>,
    backward: Vec<Option<Eliminated>>,
}

/// Forces or jumps of every group under several loads: one column each.
pub type Columns = Vec<Matrix>;

impl<'a> FrozenFaces<'a> {
    /// The faces of `problem`, whose A is `blocks`.
    pub fn new(problem: &'a FaceProblem<'a>, blocks: &'a BlockStiffness) -> Self {
        let count = blocks.groups.len();
        Self {
            problem,
            blocks,
            conditions: vec![Conditions::default(); count],
            forward: (0..count).map(|_| None).collect(),
            backward: (0..count).map(|_| None).collect(),
        }
    }

    /// Takes over the `status` of every point.
    pub fn set(&mut self, status: &[PointStatus]) {
        for (k, points) in self.blocks.groups.iter().enumerate() {
            let mut free = Vec::new();
            for (i, &point) in points.iter().enumerate() {
                match status[point] {
                    PointStatus::Open => free.extend([(2 * i, 0.0), (2 * i + 1, 0.0)]),
                    PointStatus::Stick => {}
                    slips => free.push((2 * i, slips.direction() * self.problem.friction(point))),
                }
            }
            if self.conditions[k].free != free {
                self.conditions[k].free = free;
                self.forward[k..].fill_with(|| None);
                self.backward[..=k].fill_with(|| None);
            }
        }
    }

    /// Eliminates all groups outside of `window`; `asked` says before each whether to give up.
    ///
    /// Errors: statuses that leave the jumps undetermined.
    pub fn enclose(&mut self, window: &Range<usize>, asked: &dyn Fn() -> bool) -> Result<bool, LinearError> {
        for k in 0..window.start {
            if self.forward[k].is_none() {
                if asked() {
                    return Ok(false);
                }
                let before = k.checked_sub(1).map(|p| self.schur(&self.forward, p)).transpose()?;
                self.forward[k] = Some(self.eliminated(k, before, k + 1)?);
            }
        }
        for k in (window.end..self.blocks.groups.len()).rev() {
            if self.backward[k].is_none() {
                if asked() {
                    return Ok(false);
                }
                let after = (k + 1 < self.blocks.groups.len())
                    .then(|| self.schur(&self.backward, k + 1))
                    .transpose()?;
                self.backward[k] = Some(self.eliminated(k, after, k - 1)?);
            }
        }
        Ok(true)
    }

    /// The part of A of its neighbour that group `k`, eliminated, takes from it.
    fn schur(&self, way: &[Option<Eliminated>], k: usize) -> Result<Matrix, LinearError> {
        match &way[k] {
            Some(eliminated) => product(&eliminated.onto_neighbour, &eliminated.of_neighbour),
            None => Ok(Matrix::zeros(0, 0)),
        }
    }

    /// A between groups k and l, which are the same or neighbours.
    pub(super) fn entry(&self, k: usize, l: usize, i: usize, j: usize) -> f64 {
        match l {
            l if l == k => self.blocks.own[k][(i, j)],
            l if l > k => self.blocks.next[k][(i, j)],
            _ => self.blocks.next[l][(j, i)],
        }
    }

    /// The part of A of group `first` that the eliminated groups before it take.
    pub(super) fn taken_before(&self, first: usize) -> Result<Option<Matrix>, LinearError> {
        first.checked_sub(1).map(|k| self.schur(&self.forward, k)).transpose()
    }

    /// The part of A of the group before `end` that the eliminated ones from there on take.
    pub(super) fn taken_after(&self, end: usize) -> Result<Option<Matrix>, LinearError> {
        (end < self.blocks.groups.len()).then(|| self.schur(&self.backward, end)).transpose()
    }

    /// The conditions of the components of group `k`.
    pub(super) fn conditions_of(&self, k: usize) -> Vec<Condition> {
        let mut conditions = vec![Condition::Held(0.0); self.blocks.components(k)];
        for &(i, c) in &self.conditions[k].free {
            conditions[i] = Condition::Free(c);
        }
        conditions
    }

    /// The free jumps of group `k`, eliminated, for a unit of each force on it, and (negative) of
    /// each jump of its neighbour; `forward` towards the next one.
    pub(super) fn answer_of(&self, k: usize, forward: bool) -> Result<(&Matrix, &Matrix), LinearError> {
        let way = if forward { &self.forward } else { &self.backward };
        match &way[k] {
            Some(own) => Ok((&own.of_forces, &own.of_neighbour)),
            None => Err(LinearError::Singular { order: k }),
        }
    }

    fn eliminated(
        &self,
        k: usize,
        less: Option<Matrix>,
        neighbour: usize,
    ) -> Result<Eliminated, LinearError> {
        let free = &self.conditions[k].free;
        let own =
            |i: usize, j: usize| self.entry(k, k, i, j) - less.as_ref().map_or(0.0, |less| less[(i, j)]);
        let coupled = |entry: &dyn Fn(usize, usize) -> f64, m: usize, j: usize| {
            let (i, c) = free[m];
            if c == 0.0 { entry(i, j) } else { entry(i, j) + c * entry(i + 1, j) }
        };
        let n = free.len();
        let matrix = Matrix::from_fn(n, n, |m, p| coupled(&own, m, free[p].0));
        let inverse = general_inverse(&matrix)?;
        let (components, others) = (self.blocks.components(k), self.blocks.components(neighbour));
        let mut of_forces = Matrix::zeros(n, components);
        for m in 0..n {
            for (p, &(i, c)) in free.iter().enumerate() {
                of_forces[(m, i)] += inverse[(m, p)];
                if c != 0.0 {
                    of_forces[(m, i + 1)] += c * inverse[(m, p)];
                }
            }
        }
        let across = |i: usize, j: usize| self.entry(k, neighbour, i, j);
        let to_neighbour = Matrix::from_fn(n, others, |m, j| coupled(&across, m, j));
        let of_neighbour = product(&inverse, &to_neighbour)?;
        let onto_neighbour = Matrix::from_fn(others, n, |j, p| across(free[p].0, j));
        Ok(Eliminated { of_forces, of_neighbour, onto_neighbour })
    }

    /// Aᵀ of the groups of `window` with all others eliminated; those groups one after the other.
    ///
    /// Errors: none if the others are eliminated.
    pub fn stiffness(&self, window: &Range<usize>) -> Result<Matrix, LinearError> {
        let mut starts = vec![0];
        for k in window.clone() {
            starts.push(starts[starts.len() - 1] + self.blocks.components(k));
        }
        let n = starts[starts.len() - 1];
        let mut transposed = Matrix::zeros(n, n);
        let mut add = |k: usize, l: usize, block: &Matrix, factor: f64| {
            let (row, column) = (starts[k - window.start], starts[l - window.start]);
            for i in 0..block.rows() {
                for (j, value) in block.row(i).iter().enumerate() {
                    transposed[(column + j, row + i)] += factor * value;
                }
            }
        };
        for k in window.clone() {
            for l in k..window.end {
                let far;
                let block = match l - k {
                    0 => &self.blocks.own[k],
                    1 => &self.blocks.next[k],
                    _ => {
                        far = far_block(self.blocks, k, l)?;
                        &far
                    }
                };
                add(k, l, block, 1.0);
                if k != l {
                    add(l, k, &block.transposed(), 1.0);
                }
            }
        }
        if let Some(before) = window.start.checked_sub(1) {
            add(window.start, window.start, &self.schur(&self.forward, before)?, -1.0);
        }
        if window.end < self.blocks.groups.len() {
            let last = window.end - 1;
            add(last, last, &self.schur(&self.backward, window.end)?, -1.0);
        }
        Ok(transposed)
    }

    /// The forces on all groups, with those that the free jumps of all groups outside of `window`
    /// exert added up on the way to it: `forces` by group without them, one column for each load.
    pub fn towards(&self, window: &Range<usize>, mut forces: Columns) -> Result<Columns, LinearError> {
        let mut step = |way: &[Option<Eliminated>], k: usize, neighbour: usize| -> Result<(), LinearError> {
            if let Some(own) = &way[k] {
                let free = product(&own.of_forces, &forces[k])?;
                let onto = product(&own.onto_neighbour, &free)?;
                axpy(-1.0, onto.entries(), forces[neighbour].entries_mut());
            }
            Ok(())
        };
        for k in 0..window.start {
            step(&self.forward, k, k + 1)?;
        }
        for k in (window.end..self.blocks.groups.len()).rev() {
            step(&self.backward, k, k - 1)?;
        }
        Ok(forces)
    }

    /// The jumps of all groups, held ones outside of `window` zero: those in the window are given
    /// in `jumps`, `forces` are those of [`FrozenFaces::towards`].
    pub fn away(
        &self,
        window: &Range<usize>,
        forces: &Columns,
        mut jumps: Columns,
    ) -> Result<Columns, LinearError> {
        let mut step = |way: &[Option<Eliminated>], k: usize, neighbour: usize| -> Result<(), LinearError> {
            let Some(own) = &way[k] else { return Ok(()) };
            let mut free = product(&own.of_forces, &forces[k])?;
            let of_neighbour = product(&own.of_neighbour, &jumps[neighbour])?;
            axpy(-1.0, of_neighbour.entries(), free.entries_mut());
            for (m, &(i, _)) in self.conditions[k].free.iter().enumerate() {
                jumps[k].row_mut(i).copy_from_slice(free.row(m));
            }
            Ok(())
        };
        for k in (0..window.start).rev() {
            step(&self.forward, k, k + 1)?;
        }
        for k in window.end..self.blocks.groups.len() {
            step(&self.backward, k, k - 1)?;
        }
        Ok(jumps)
    }
}

/// A between the components of groups k and l > k + 1.
fn far_block(blocks: &BlockStiffness, k: usize, l: usize) -> Result<Matrix, LinearError> {
    let (moments, between) = (&blocks.far.moments, &blocks.far.between);
    product(&product(&moments[k], &between[k][l - k - 2])?, &moments[l].transposed())
}

/// The forces F w (N/mm) that jumps `w` (mm) exert between groups that are not neighbours,
/// those between two groups of `without` left out.
pub fn far_forces(
    blocks: &BlockStiffness,
    w: &Columns,
    without: &Range<usize>,
) -> Result<Columns, LinearError> {
    let (moments, between) = (&blocks.far.moments, &blocks.far.between);
    let count = w.len();
    let amplitudes: Vec<Matrix> = (0..count)
        .map(|k| {
            let mut sum = Matrix::zeros(moments[k].columns(), w[k].columns());
            add_transposed_product(&moments[k], &w[k], &mut sum).map(|()| sum)
        })
        .collect::<Result<_, _>>()?;
    let mut effects: Vec<Matrix> = amplitudes.iter().map(|a| Matrix::zeros(a.rows(), a.columns())).collect();
    for k in 0..count {
        for l in k + 2..count {
            if without.contains(&k) && without.contains(&l) {
                continue;
            }
            let e = &between[k][l - k - 2];
            add_product(1.0, e, &amplitudes[l], &mut effects[k])?;
            add_transposed_product(e, &amplitudes[k], &mut effects[l])?;
        }
    }
    (0..count).map(|k| product(&moments[k], &effects[k])).collect()
}

/// The status that the contact conditions ask of `point` in `solution`, where it is off by more
/// than `allowed` (mm, and forces of the stiffness `spring`, N/mm per mm); friction counts from
/// slip `reference` (mm).
pub fn demanded_beyond(
    problem: &FaceProblem,
    solution: &FaceSolution,
    point: usize,
    reference: f64,
    (allowed, spring): (f64, f64),
) -> Option<PointStatus> {
    let (tangential, normal) = (solution.contact[2 * point], solution.contact[2 * point + 1]);
    let (slip, opening) = (solution.jump[2 * point], solution.jump[2 * point + 1]);
    let (mu, force) = (problem.friction(point), allowed * spring);
    match solution.status[point] {
        PointStatus::Open => {
            (opening < -allowed).then(|| PointStatus::of_touching(slip - reference, -opening, mu))
        }
        _ if normal < -force => Some(PointStatus::Open),
        PointStatus::Stick => {
            let slips = if tangential < 0.0 { PointStatus::SlipForward } else { PointStatus::SlipBackward };
            (tangential.abs() - mu * normal > force).then_some(slips)
        }
        slips => {
            let against = -(slip - reference) * slips.direction();
            (mu > 0.0 && against > allowed).then_some(PointStatus::Stick)
        }
    }
}
