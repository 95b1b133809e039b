//! Joint stiffness of standard and enriched unknowns.

use super::border::{Border, CellStiffness};
use crate::bulk::{BulkRail, RailStiffness};
use crate::linear::ElementSum;
use crate::math::Matrix;

/// The stiffness of the free standard unknowns followed by the enriched ones: the elements of the
/// mesh, the enriched cells, and additions to the diagonal.
pub(super) struct EnrichedStiffness<'a> {
    rail: &'a BulkRail,
    mesh: RailStiffness<'a>,
    border: &'a Border,
    /// Addition to the diagonal for each enriched unknown.
    added: Vec<f64>,
}

/// An element of the sum.
enum Summand<'a> {
    /// An element of the mesh.
    Mesh(usize),
    /// A cell: the contribution of its enriched functions.
    Cell(&'a CellStiffness),
    /// An addition to the diagonal at an enriched unknown.
    Added(usize),
}

impl<'a> EnrichedStiffness<'a> {
    /// The stiffness with `added[i]` on the diagonal at enriched unknown i.
    pub(super) fn new(rail: &'a BulkRail, border: &'a Border, added: Vec<f64>) -> Self {
        Self { rail, mesh: rail.stiffness(), border, added }
    }

    fn part(&self, element: usize) -> Summand<'a> {
        let cells = &self.border.cells;
        match element.checked_sub(self.mesh.count()) {
            None => Summand::Mesh(element),
            Some(other) => {
                cells.get(other).map_or_else(|| Summand::Added(other - cells.len()), Summand::Cell)
            }
        }
    }
}

impl ElementSum for EnrichedStiffness<'_> {
    fn order(&self) -> usize {
        self.mesh.order() + self.border.unknowns
    }

    fn count(&self) -> usize {
        self.mesh.count() + self.border.cells.len() + self.added.len()
    }

    fn unknowns(&self, element: usize) -> Vec<Option<usize>> {
        let free = |unknown: usize| self.rail.unknowns(unknown / 2)[unknown % 2];
        let enriched = |unknown: usize| Some(self.mesh.order() + unknown);
        match self.part(element) {
            Summand::Mesh(element) => self.mesh.unknowns(element),
            Summand::Cell(cell) => {
                let standard = cell.targets.iter().filter_map(|target| target.standard.map(free));
                standard
                    .chain(cell.targets.iter().filter_map(|target| target.enriched.map(enriched)))
                    .collect()
            }
            Summand::Added(unknown) => vec![enriched(unknown)],
        }
    }

    fn matrix(&self, element: usize) -> Matrix {
        match self.part(element) {
            Summand::Mesh(element) => self.mesh.matrix(element),
            Summand::Cell(cell) => {
                let mut functions: Vec<usize> = cell.functions(|target| target.standard).collect();
                let standard = functions.len();
                functions.extend(cell.functions(|target| target.enriched));
                // Entries between standard unknowns come from the elements of the mesh.
                let entry = |i, j| if i < standard { 0.0 } else { cell.entry(functions[i], functions[j]) };
                Matrix::from_fn(functions.len(), functions.len(), entry)
            }
            Summand::Added(unknown) => Matrix::from_fn(1, 1, |_, _| self.added[unknown]),
        }
    }
}
