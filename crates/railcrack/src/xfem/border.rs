//! The border of the system: enriched unknowns against those of the mesh and one another.

use super::basis::{CellBasis, Elasticity, Function, Target};
use super::cuts::{CellPlace, Cuts};
use super::quadrature::Rules;
use super::space::Space;
use crate::math::Vec2;
use rayon::prelude::*;

/// (unknown, value), in increasing order.
pub(super) type Entries = Vec<(usize, f64)>;

/// Stiffness of the enriched unknowns, N/mm per unit of each unknown.
#[derive(Debug, Clone)]
pub(super) struct Border {
    /// K_se: per enriched unknown, the entries of unknowns 2 node + axis of the mesh, held ones included.
    pub columns: Vec<Entries>,
    /// K_ee: of row i the entries of the enriched unknowns j ≤ i; the diagonal is always there.
    pub square: Vec<Entries>,
}

/// Stiffness of the functions of one cell, lower triangle row by row.
struct CellStiffness {
    targets: Vec<Target>,
    entries: Vec<f64>,
}

impl Border {
    pub(super) fn new(cuts: &Cuts, space: &Space, elasticity: &Elasticity) -> Self {
        let rules = Rules::new();
        let cells: Vec<Vec<CellStiffness>> = space
            .elements
            .par_iter()
            .map(|&e| element_stiffness(cuts, space, e, elasticity, &rules))
            .collect();
        let unknowns = space.unknowns();
        let mut columns: Vec<Entries> = vec![Vec::new(); unknowns];
        let mut square: Vec<Entries> = (0..unknowns).map(|i| vec![(i, 0.0)]).collect();
        for cell in cells.iter().flatten() {
            let mut entries = cell.entries.iter();
            for (a, row) in cell.targets.iter().enumerate() {
                for column in &cell.targets[..=a] {
                    let value = *entries.next().expect("lower triangle");
                    for (s, e) in [(row, column), (column, row)].iter().take(if std::ptr::eq(row, column) {
                        1
                    } else {
                        2
                    }) {
                        if let (Some(standard), Some(enriched)) = (s.standard, e.enriched) {
                            columns[enriched].push((standard, value));
                        }
                    }
                    if let (Some(i), Some(j)) = (row.enriched, column.enriched) {
                        let twice = i == j && !std::ptr::eq(row, column);
                        square[i.max(j)].push((i.min(j), if twice { 2.0 * value } else { value }));
                    }
                }
            }
        }
        columns.par_iter_mut().chain(&mut square).for_each(merge);
        Self { columns, square }
    }
}

/// Sorts by unknown and adds what belongs together, in the order in which it came.
pub(super) fn merge(entries: &mut Entries) {
    entries.sort_by_key(|entry| entry.0);
    entries.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
}

fn element_stiffness(
    cuts: &Cuts,
    space: &Space,
    element: usize,
    elasticity: &Elasticity,
    rules: &Rules,
) -> Vec<CellStiffness> {
    let cut = &cuts.elements[&element];
    let singular: Vec<Vec2> =
        space.tips_in(element).iter().map(|&(tip, _)| cuts.poles[tip].position()).collect();
    let mut functions: Vec<Function> = Vec::new();
    (0..cut.arrangement.cells.len())
        .filter_map(|cell| {
            let place = CellPlace { element, cell };
            let basis = CellBasis::new(cuts, space, cut, place, &elasticity.steel);
            if basis.targets.iter().all(|target| target.enriched.is_none()) {
                return None;
            }
            let n = basis.targets.len();
            let mut entries = vec![0.0; n * (n + 1) / 2];
            let mut strains = vec![[0.0; 3]; n];
            for (point, weight) in rules.on_cell(cut, cell, &singular) {
                basis.at(point, &mut functions);
                for (strain, function) in strains.iter_mut().zip(&functions) {
                    *strain = function.strain();
                }
                let mut rest = entries.iter_mut();
                for (a, strain) in strains.iter().enumerate() {
                    let stress = elasticity.stress(*strain).map(|s| s * weight);
                    for other in &strains[..=a] {
                        *rest.next().expect("lower triangle") +=
                            stress[0] * other[0] + stress[1] * other[1] + stress[2] * other[2];
                    }
                }
            }
            Some(CellStiffness { targets: basis.targets, entries })
        })
        .collect()
}
