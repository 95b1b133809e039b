//! Border of the system of equations: couplings of the enriched unknowns with the standard unknowns
//! and with each other, and their jumps across the faces.

use super::basis::{CellBasis, Elasticity, Function, Rules, Target, WeightedPoint};
use super::cuts::{CellPlace, Cuts};
use super::interface::{Interface, Station};
use super::space::Space;
use crate::bulk::{BulkRail, RailStiffness};
use crate::interruption::{Interrupted, Interruption};
use crate::linear::ElementSum;
use crate::math::{Matrix, Vec2};
use rayon::prelude::*;
use std::ops::Range;

/// (unknown, value), in increasing order.
pub(super) type Entries = Vec<(usize, f64)>;

/// Stiffness of the enriched functions, cell by cell; N/mm per unit of each unknown.
#[derive(Debug, Clone)]
pub(super) struct Border {
    /// Number of enriched unknowns.
    pub unknowns: usize,
    pub cells: Vec<CellStiffness>,
}

/// Stiffness of the functions of one cell.
#[derive(Debug, Clone)]
pub(super) struct CellStiffness {
    pub targets: Vec<Target>,
    /// The lower triangle row by row.
    entries: Vec<f64>,
}

/// The assembled border of the system.
#[derive(Debug, Clone)]
pub(super) struct BorderEntries {
    /// K_se: per enriched unknown, the entries of the standard unknowns 2 node + axis, held ones
    /// included.
    pub columns: Vec<Entries>,
    /// K_ee: for row i the entries of the enriched unknowns j ≤ i, always including the diagonal.
    pub square: Vec<Entries>,
}

impl Border {
    /// Errors: an interruption.
    pub(super) fn new(
        cuts: &Cuts,
        space: &Space,
        elasticity: &Elasticity,
        interruption: Interruption<'_>,
    ) -> Result<Self, Interrupted> {
        let rules = Rules::new();
        let cells: Result<Vec<Vec<CellStiffness>>, Interrupted> = space
            .elements
            .par_iter()
            // Columns are distributed one by one, because the few neighbouring columns around a tip
            // take most of the time.
            .with_max_len(1)
            .map(|&e| {
                interruption.check()?;
                Ok(element_stiffness(cuts, space, e, elasticity, &rules))
            })
            .collect();
        Ok(Self { unknowns: space.unknowns(), cells: cells?.into_iter().flatten().collect() })
    }

    pub(super) fn entries(&self) -> BorderEntries {
        let mut functions_of: Vec<Vec<(&CellStiffness, usize)>> = vec![Vec::new(); self.unknowns];
        for cell in &self.cells {
            for (a, target) in cell.targets.iter().enumerate() {
                if let Some(unknown) = target.enriched {
                    functions_of[unknown].push((cell, a));
                }
            }
        }
        let of_unknown = |(i, functions): (usize, &Vec<(&CellStiffness, usize)>)| {
            let (mut column, mut row) = (Entries::new(), vec![(i, 0.0)]);
            for &(cell, a) in functions {
                for (b, target) in cell.targets.iter().enumerate() {
                    let value = cell.entry(a, b);
                    column.extend(target.standard.map(|standard| (standard, value)));
                    row.extend(target.enriched.filter(|&j| j <= i).map(|j| (j, value)));
                }
            }
            merge(&mut column);
            merge(&mut row);
            (column, row)
        };
        let (columns, square) = functions_of.par_iter().enumerate().map(of_unknown).unzip();
        BorderEntries { columns, square }
    }

    /// The diagonal of K_ee.
    pub(super) fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.unknowns];
        for cell in &self.cells {
            for (a, target) in cell.targets.iter().enumerate() {
                if let Some(enriched) = target.enriched {
                    diagonal[enriched] += cell.entry(a, a);
                }
            }
        }
        diagonal
    }
}

impl CellStiffness {
    /// The functions of a cell that have an unknown of this kind.
    pub(super) fn functions(&self, unknown: fn(&Target) -> Option<usize>) -> impl Iterator<Item = usize> {
        (0..self.targets.len()).filter(move |&a| unknown(&self.targets[a]).is_some())
    }

    /// The entry of two functions, numbered in the order of the targets.
    pub(super) fn entry(&self, a: usize, b: usize) -> f64 {
        let (row, column) = (a.max(b), a.min(b));
        self.entries[row * (row + 1) / 2 + column]
    }
}

/// Sorts by unknown and adds the entries of each unknown in their original order.
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

/// The stiffness of the enriched cells of an element. Products of the shape functions alone are
/// polynomials and are integrated as such even near a tip, so that their bits do not change when a
/// tip advances.
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
    (0..cut.arrangement.cells.len())
        .filter_map(|cell| {
            let place = CellPlace { element, cell };
            let basis = CellBasis::new(cuts, space, cut, place, &elasticity.steel);
            let (nodal, of_tips) = basis.targets.split_at(CellBasis::NODAL);
            let mut stiffness = Integral::new(&basis, elasticity);
            if nodal.iter().any(|target| target.enriched.is_some()) {
                stiffness.add(0..nodal.len(), &rules.on_cell(cut, cell, &[]));
            } else if of_tips.is_empty() {
                return None;
            }
            if !of_tips.is_empty() {
                stiffness.add(nodal.len()..basis.targets.len(), &rules.on_cell(cut, cell, &singular));
            }
            let entries = stiffness.entries;
            Some(CellStiffness { targets: basis.targets, entries })
        })
        .collect()
}

/// The lower triangle of ∫ ε_aᵀ D ε_b dA over a cell.
struct Integral<'a> {
    basis: &'a CellBasis<'a>,
    elasticity: &'a Elasticity,
    entries: Vec<f64>,
}

impl<'a> Integral<'a> {
    fn new(basis: &'a CellBasis<'a>, elasticity: &'a Elasticity) -> Self {
        let n = basis.targets.len();
        Self { basis, elasticity, entries: vec![0.0; n * (n + 1) / 2] }
    }

    /// Adds the contributions of the quadrature `points` to `rows`.
    fn add(&mut self, rows: Range<usize>, points: &[WeightedPoint]) {
        let start = |row: usize| row * (row + 1) / 2;
        let entries = &mut self.entries[start(rows.start)..start(rows.end)];
        let mut functions: Vec<Function> = Vec::new();
        let mut strains = [(); 3].map(|()| vec![0.0; rows.end]);
        for &(point, weight) in points {
            self.basis.at(point, &mut functions);
            for (b, function) in functions[..rows.end].iter().enumerate() {
                let strain = function.strain();
                strains.iter_mut().zip(strain).for_each(|(own, value)| own[b] = value);
            }
            let mut rest = &mut *entries;
            for (a, function) in functions[..rows.end].iter().enumerate().skip(rows.start) {
                let stress = self.elasticity.stress(function.strain()).map(|s| s * weight);
                let (row, others) = rest.split_at_mut(a + 1);
                rest = others;
                let [xx, yy, xy] = &strains;
                for (entry, ((xx, yy), xy)) in row.iter_mut().zip(xx.iter().zip(yy).zip(xy)) {
                    *entry += stress[0] * xx + stress[1] * yy + stress[2] * xy;
                }
            }
        }
    }
}

/// B: for row 2 j + axis of face point j, the entries (enriched unknown, ∫ λ_j ⟦φ⟧ ds), in
/// increasing order.
pub(super) fn face_jumps(
    background: &BulkRail,
    cuts: &Cuts,
    space: &Space,
    interface: &Interface,
) -> Vec<Entries> {
    let mut rows = vec![Entries::new(); 2 * interface.faces.points.len()];
    let mut functions: Vec<Function> = Vec::new();
    let points = |station: &Station| station.tractions.map(|(point, _)| point);
    let together = |a: &Station, b: &Station| a.piece == b.piece && points(a) == points(b);
    for stations in interface.stations.chunk_by(together) {
        let piece = &cuts.pieces[stations[0].piece];
        for (place, sign) in [(piece.plus, 1.0), (piece.minus, -1.0)] {
            let cut = &cuts.elements[&place.element];
            let basis = CellBasis::new(cuts, space, cut, place, background.steel());
            let mut integrals = vec![[Vec2::default(); 2]; basis.targets.len()];
            for station in stations {
                basis.at(station.point, &mut functions);
                let weights = station.tractions.map(|(_, lambda)| sign * lambda * station.length);
                for (own, function) in integrals.iter_mut().zip(&functions) {
                    own.iter_mut()
                        .zip(weights)
                        .for_each(|(sum, weight)| *sum = *sum + function.value * weight);
                }
            }
            for (target, own) in basis.targets.iter().zip(&integrals) {
                let Some(enriched) = target.enriched else { continue };
                for (point, integral) in points(&stations[0]).into_iter().zip(own) {
                    for (axis, value) in [integral.x, integral.y].into_iter().enumerate() {
                        if value != 0.0 {
                            rows[2 * point + axis].push((enriched, value));
                        }
                    }
                }
            }
        }
    }
    rows.iter_mut().for_each(merge);
    rows
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::{Crack, CrackNetwork, End};
    use crate::material::IsotropicElastic;
    use crate::math::RailBox;
    use crate::xfem::body::Discretisation;
    use crate::xfem::space::Enrichment;
    use crate::xfem::{MeshSettings, RefinedRegion, XfemSettings};

    #[test]
    fn an_advancing_tip_changes_no_bit_behind_it() {
        let short = Crack::surface_breaking(0.0, 6.0, 0.3).unwrap();
        let long = short.extended(End::Last, 0.7, -0.05).unwrap();
        let [short, long] = [short, long].map(CrackNetwork::from);
        let refined = RefinedRegion::new(&short, MeshSettings { element_size: 0.25, expected_growth: 1.5 });
        let mesh = refined.mesh(RailBox { width: 1800.0, depth: 900.0, centre: 0.0 }).unwrap();
        let elasticity = Elasticity::new(IsotropicElastic::new(210e3, 0.3).unwrap());
        let of = |network: &CrackNetwork| {
            let parts = Discretisation::new(&mesh, network, &XfemSettings::default()).unwrap();
            let entries =
                Border::new(&parts.cuts, &parts.space, &elasticity, Interruption::NEVER).unwrap().entries();
            (parts, entries)
        };
        let ((before, short), (after, long)) = (of(&short), of(&long));
        let (tip, size) = (before.cuts.tips[0].position(), before.sizes[0]);
        let mut behind = 0;
        for (i, enrichment) in before.space.enrichments.iter().enumerate() {
            let Enrichment::Part { node, .. } = enrichment else { continue };
            let distance = (mesh.node_position(*node) - tip).length();
            // Tip enrichments extend over 2.5 elements and the adjacent ones.
            if distance > 2.0 * size {
                behind += usize::from(distance < 3.5 * size);
                assert_eq!(*enrichment, after.space.enrichments[i]);
                for unknown in [2 * i, 2 * i + 1] {
                    assert_eq!(short.columns[unknown], long.columns[unknown], "{distance} mm");
                    assert_eq!(short.square[unknown], long.square[unknown], "{distance} mm");
                }
            }
        }
        assert!(behind > 5, "{behind} functions other than those of the tip");
    }
}
