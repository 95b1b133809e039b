//! Condensation of the cracked rail to C and S at its face points.

use super::border::{Border, BorderEntries, EnrichedStiffness, Entries};
use super::columns::{ColumnStore, Eliminated};
use super::error::XfemError;
use super::interface::Duality;
use super::sif::SifFunctional;
use super::space::{Enrichment, Space};
use crate::bulk::BulkRail;
use crate::interruption::Interruption;
use crate::linear::{
    LinearError, ReachedPanel, SparseCholesky, SparseColumn, SparseFactor, SpdFactor, gram, products_of_rows,
};
use crate::math::Matrix;
use std::sync::Arc;

/// C and S, and the data from which the unknowns under a load follow.
pub(super) struct Condensed {
    /// C.
    pub compliance: Matrix,
    /// S.
    pub sif_influence: Matrix,
    /// The eliminated unknowns.
    pub elimination: Elimination,
}

/// The system to condense.
pub(super) struct System<'a> {
    pub rail: &'a BulkRail,
    pub space: &'a Space,
    pub border: &'a Border,
    /// B, row by row.
    pub jumps: &'a [Entries],
    pub functionals: &'a [SifFunctional],
    pub duality: &'a Duality,
}

/// Method of eliminating the unknowns.
#[derive(Debug, Clone)]
pub(super) enum Elimination {
    /// The standard unknowns are eliminated with the factor of the uncracked rail, then the
    /// enriched ones as a dense border.
    Border {
        /// K_se.
        coupling: Arc<Vec<Entries>>,
        /// L Lᵀ = S_ee, of scaled unknowns.
        factor: SpdFactor,
        /// B, row by row.
        jumps: Vec<Entries>,
        /// Ratio of each unknown to its scaled value.
        scale: Vec<f64>,
    },
    /// All unknowns are eliminated in one factorisation.
    Together {
        /// Factor of [K_ss K_se; K_es K_ee].
        factor: Arc<SparseFactor>,
        /// Bᵀ, transposed.
        jumps: Vec<Entries>,
    },
}

/// Fraction of the diagonal that is added to the condensed matrix, to suppress functions that are
/// linearly dependent on others to within round-off.
const REDUNDANT: f64 = 1e-13;

/// Largest ratio of the number of enriched unknowns to the root of that of the standard ones at
/// which the enriched ones form a dense border, whose elimination grows with the third power of
/// their number. Beyond this ratio one factorisation of the whole system is faster, since its cost
/// grows with the 1.5th power of the number of standard unknowns. By operation counts both methods
/// cost the same in a growth step at a ratio of about eight. One crack stays below it; nine cracks
/// reach eighteen.
const DENSE: f64 = 8.0;

impl System<'_> {
    /// C = B S_ee⁻¹ Bᵀ with the Schur complement S_ee = K_ee − K_es K_ss⁻¹ K_se, as jumps at face
    /// points under nodal forces there, and S. The choice of elimination depends on the cracks and
    /// the mesh alone, so that a resumed run obtains the same bits.
    pub(super) fn condensed(
        &self,
        store: &mut ColumnStore,
        interruption: Interruption<'_>,
    ) -> Result<Condensed, XfemError> {
        let mesh = self.rail.order() as f64;
        if self.border.unknowns as f64 <= DENSE * mesh.sqrt() {
            self.by_border(store, interruption)
        } else {
            store.clear();
            self.together(interruption)
        }
    }

    /// Columns over the unknowns 2 node + axis of the mesh, restricted to its free unknowns.
    fn on_free_unknowns<'c>(&self, columns: impl Iterator<Item = &'c Entries>) -> Vec<SparseColumn> {
        let free = |&(unknown, value): &(usize, f64)| {
            self.rail.unknowns(unknown / 2)[unknown % 2].map(|free| (free, value))
        };
        columns.map(|column| SparseColumn { entries: column.iter().filter_map(free).collect() }).collect()
    }

    pub(super) fn by_border(
        &self,
        store: &mut ColumnStore,
        interruption: Interruption<'_>,
    ) -> Result<Condensed, XfemError> {
        let n = self.border.unknowns;
        let BorderEntries { columns, square } = self.border.entries();
        let scale: Vec<f64> = square
            .iter()
            .map(|row| row.last().map_or(0.0, |entry| entry.1))
            .map(|own| if own > 0.0 { 1.0 / own.sqrt() } else { 0.0 })
            .collect();
        let functionals = self.functionals.iter().map(|functional| &functional.standard);
        let free = self.on_free_unknowns(columns.iter().chain(functionals));
        let fill = |i: usize, row: &mut [f64], products: &[f64], square: &Entries| {
            row.iter_mut().zip(products).zip(&scale).for_each(|((entry, p), s)| *entry = -p * scale[i] * s);
            for &(j, value) in square {
                row[j] = (value - products[j]) * scale[i] * scale[j];
            }
            row[i] += if scale[i] > 0.0 { REDUNDANT } else { 1.0 };
        };
        let Eliminated { factor, further } =
            store.eliminated(self.rail.factor()?, free, square, interruption, fill)?;
        let faces = self.jumps.len();
        let mut right = Matrix::zeros(faces + self.functionals.len(), n);
        for (i, row) in self.jumps.iter().enumerate() {
            row.iter().for_each(|&(unknown, value)| right[(i, unknown)] = value * scale[unknown]);
        }
        for (k, functional) in self.functionals.iter().enumerate() {
            let row = right.row_mut(faces + k);
            row.iter_mut().zip(&*further[k]).for_each(|(own, product)| *own = -product);
            functional.enriched.iter().for_each(|&(unknown, value)| row[unknown] += value);
            row.iter_mut().zip(&scale).for_each(|(own, scale)| *own *= scale);
        }
        let half = factor.half_solve_rows(right, interruption)?;
        let energies = products_of_rows(&half, interruption)?;
        let compliance = Matrix::from_fn(faces, faces, |i, j| energies[(i, j)]);
        let influence: Vec<Vec<f64>> = self
            .functionals
            .iter()
            .enumerate()
            .map(|(k, f)| (0..faces).map(|j| energies[(faces + k, j)] + f.tractions[j]).collect())
            .collect();
        let elimination =
            Elimination::Border { coupling: Arc::new(columns), factor, jumps: self.jumps.to_vec(), scale };
        Ok(self.at_face_points(compliance, &influence, elimination))
    }

    pub(super) fn together(&self, interruption: Interruption<'_>) -> Result<Condensed, XfemError> {
        let mesh = self.rail.order();
        let redundant = |own: f64| if own > 0.0 { REDUNDANT * own } else { 1.0 };
        let added = self.border.diagonal().into_iter().map(redundant).collect();
        let stiffness = EnrichedStiffness::new(self.rail, self.border, added);
        let analysed = SparseCholesky::analyse_unless(interruption, &stiffness, self.order())?;
        let factor = analysed.factor_unless(interruption, &stiffness)?;
        let enriched = |entries: &Entries| entries.iter().map(|&(i, v)| (mesh + i, v)).collect::<Entries>();
        let jumps: Vec<Entries> = self.jumps.iter().map(enriched).collect();
        let mut columns: Vec<SparseColumn> =
            jumps.iter().map(|row| SparseColumn { entries: row.clone() }).collect();
        let functionals = self.functionals.iter().map(|functional| &functional.standard);
        let functionals = self.functionals.iter().zip(self.on_free_unknowns(functionals));
        for (functional, mut standard) in functionals {
            standard.entries.extend(enriched(&functional.enriched));
            columns.push(standard);
        }
        let panels: Vec<Arc<ReachedPanel>> =
            factor.forward(&columns, interruption)?.into_iter().map(Arc::new).collect();
        let products = gram(&panels, 0, interruption)?;
        let faces = jumps.len();
        let compliance = Matrix::from_fn(faces, faces, |i, j| products[i.max(j)][i.min(j)]);
        let influence: Vec<Vec<f64>> = self
            .functionals
            .iter()
            .enumerate()
            .map(|(k, f)| (0..faces).map(|j| products[faces + k][j] + f.tractions[j]).collect())
            .collect();
        let elimination = Elimination::Together { factor: Arc::new(factor), jumps };
        Ok(self.at_face_points(compliance, &influence, elimination))
    }

    /// The nested dissection of the mesh, in which each node is followed by its enrichments,
    /// because their support consists of the same elements as that of its standard functions.
    fn order(&self) -> Vec<usize> {
        let mesh = self.rail.order();
        let mut of_node: Vec<Vec<usize>> = vec![Vec::new(); self.rail.mesh().node_count()];
        for (i, enrichment) in self.space.enrichments.iter().enumerate() {
            let (Enrichment::Part { node, .. } | Enrichment::Tip { node, .. }) = enrichment;
            of_node[*node].extend([mesh + 2 * i, mesh + 2 * i + 1]);
        }
        let nodes = self.rail.mesh().nested_dissection();
        let of = |node| self.rail.unknowns(node).into_iter().flatten().chain(of_node[node].iter().copied());
        nodes.into_iter().flat_map(of).collect()
    }

    /// C and S from ∫ λ ⟦w⟧ and K under unit tractions λ.
    fn at_face_points(
        &self,
        compliance: Matrix,
        influence: &[Vec<f64>],
        elimination: Elimination,
    ) -> Condensed {
        let faces = self.jumps.len();
        let half = self.duality.nodal_jumps(compliance).transposed();
        let whole = self.duality.nodal_jumps(half);
        let compliance = Matrix::from_fn(faces, faces, |i, j| whole[(i.max(j), i.min(j))]);
        let influence = Matrix::from_fn(faces, influence.len(), |j, k| influence[k][j]);
        let sif_influence = self.duality.nodal_jumps(influence).transposed();
        Condensed { compliance, sif_influence, elimination }
    }
}

impl Elimination {
    /// The unknowns under each of some tractions Σ λ_j τ_j on the faces: `tractions` are the τ_j
    /// (MPa), along x and y. The standard unknowns are complete at `nodes` only.
    pub(super) fn unknowns(
        &self,
        rail: &BulkRail,
        tractions: &[Vec<f64>],
        nodes: impl Iterator<Item = usize>,
    ) -> Result<Unknowns, XfemError> {
        let mesh = rail.order();
        let mut enriched = self.enriched(tractions)?;
        let (factor, mut together) = match self {
            Self::Border { coupling, .. } => (rail.factor()?, pulls(rail, coupling, &enriched)),
            Self::Together { factor, jumps } => {
                (factor.as_ref(), under_tractions(jumps, tractions, factor.order()))
            }
        };
        let wanted = nodes.flat_map(|node| rail.unknowns(node)).flatten();
        factor.solve_for(wanted.chain(mesh..factor.order()), together.entries_mut())?;
        for (k, enriched) in enriched.iter_mut().enumerate() {
            enriched.extend_from_slice(&together.row(k)[mesh..]);
        }
        Ok(Unknowns { standard: together, enriched })
    }

    /// The enriched unknowns under each of some tractions, if they can be computed without the
    /// standard ones.
    fn enriched(&self, tractions: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, LinearError> {
        let Self::Border { factor, jumps, scale, .. } = self else {
            return Ok(vec![Vec::new(); tractions.len()]);
        };
        let scaled = |values: &mut [f64]| values.iter_mut().zip(scale).for_each(|(value, s)| *value *= s);
        let mut right = under_tractions(jumps, tractions, scale.len());
        (0..right.rows()).for_each(|k| scaled(right.row_mut(k)));
        let half = factor.half_solve_rows(right, Interruption::NEVER)?;
        let whole = |k: usize| {
            let mut enriched = half.row(k).to_vec();
            factor.back_solve(&mut enriched)?;
            scaled(&mut enriched);
            Ok(enriched)
        };
        (0..tractions.len()).map(whole).collect()
    }
}

/// Bᵀ τ of `unknowns` unknowns for each of some tractions τ, row by row, from B = `jumps` row by
/// row.
fn under_tractions(jumps: &[Entries], tractions: &[Vec<f64>], unknowns: usize) -> Matrix {
    let mut right = Matrix::zeros(tractions.len(), unknowns);
    for (k, tractions) in tractions.iter().enumerate() {
        let own = right.row_mut(k);
        for (row, traction) in jumps.iter().zip(tractions) {
            row.iter().for_each(|&(unknown, value)| own[unknown] += traction * value);
        }
    }
    right
}

/// The unknowns under some loads.
pub(super) struct Unknowns {
    /// The free standard unknowns, one row per load, at the beginning of the row.
    pub standard: Matrix,
    /// The enriched unknowns for each load.
    pub enriched: Vec<Vec<f64>>,
}

/// Right-hand sides −K_se u_e of the standard unknowns from the `enriched` unknowns, one row per
/// load.
fn pulls(rail: &BulkRail, coupling: &[Entries], enriched: &[Vec<f64>]) -> Matrix {
    let mut right = Matrix::zeros(enriched.len(), rail.order());
    for (k, enriched) in enriched.iter().enumerate() {
        let right = right.row_mut(k);
        for (column, value) in coupling.iter().zip(enriched) {
            for &(unknown, entry) in column {
                if let Some(free) = rail.unknowns(unknown / 2)[unknown % 2] {
                    right[free] -= entry * value;
                }
            }
        }
    }
    right
}

#[cfg(test)]
#[path = "condense_tests.rs"]
mod tests;
