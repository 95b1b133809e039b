//! Reuse of the columns and the factor of the border between growth steps.

use super::border::Entries;
use crate::interruption::Interruption;
use crate::linear::{LinearError, PANEL_COLUMNS, ReachedPanel, SparseColumn, SparseFactor, SpdFactor, gram};
use std::sync::Arc;

/// Half-solved columns L⁻¹ b of the border, scalar products of the last ones, and the factor of
/// their Schur complement.
///
/// The results for the leading columns are reused as long as these columns have the same bits. The
/// results depend on nothing else, so that a resumed run obtains the same bits without reuse. A
/// clone shares all data.
#[derive(Debug, Clone, Default)]
pub struct ColumnStore {
    columns: Arc<[SparseColumn]>,
    panels: Vec<Arc<ReachedPanel>>,
    /// b_iᵀ K⁻¹ b_j for the columns i from `first_product` on and all j ≤ i; the factor contains
    /// the products of the earlier columns.
    products: Vec<Arc<[f64]>>,
    first_product: usize,
    factored: Option<Factored>,
}

/// A factor, and the data of the rows of its matrix: for each row its column of the border and its
/// row of K_ee.
#[derive(Debug, Clone)]
struct Factored {
    columns: Arc<[SparseColumn]>,
    square: Arc<[Entries]>,
    factor: SpdFactor,
}

/// The eliminated border.
pub(super) struct Eliminated {
    /// L Lᵀ of the Schur complement.
    pub factor: SpdFactor,
    /// The scalar products of each further column with all those before it and itself.
    pub further: Vec<Arc<[f64]>>,
}

/// Number of leading items with the same bits.
fn in_common<'a>(one: impl Iterator<Item = &'a Entries>, other: impl Iterator<Item = &'a Entries>) -> usize {
    let same = |(a, b): &(&Entries, &Entries)| a.len() == b.len() && bits(a).eq(bits(b));
    one.zip(other).take_while(same).count()
}

fn bits(entries: &Entries) -> impl Iterator<Item = (usize, u64)> {
    entries.iter().map(|&(unknown, value)| (unknown, value.to_bits()))
}

fn entries(columns: &[SparseColumn]) -> impl Iterator<Item = &Entries> {
    columns.iter().map(|column| &column.entries)
}

impl ColumnStore {
    /// Clears all stored results.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    #[cfg(test)]
    pub(super) fn is_kept(&self) -> bool {
        !self.panels.is_empty() && self.factored.is_some()
    }

    /// Eliminates a border of `columns` and rows `square` of K_ee; `columns` may continue after
    /// those of the border. `fill(i, row, products, square)` makes row i of the Schur complement as
    /// for [`SpdFactor::changed`], from the products b_iᵀ K⁻¹ b_j and its row of K_ee. Data that
    /// the next call may reuse are kept, the rest is dropped.
    pub(super) fn eliminated(
        &mut self,
        rail: &SparseFactor,
        columns: Vec<SparseColumn>,
        square: Vec<Entries>,
        interruption: Interruption<'_>,
        fill: impl Fn(usize, &mut [f64], &[f64], &Entries) + Sync,
    ) -> Result<Eliminated, LinearError> {
        let same = in_common(entries(&columns), entries(&self.columns));
        let before = self.factored.take();
        let unchanged = before.as_ref().map_or(0, |before| {
            let same_columns = in_common(entries(&columns), entries(&before.columns));
            same_columns.min(in_common(square.iter(), before.square.iter()))
        });
        let filled = before.as_ref().map_or(0, |before| before.factor.kept(unchanged.min(square.len())));
        self.solve(rail, columns, [same, filled], interruption)?;
        let first = self.first_product;
        let fill = |i: usize, row: &mut [f64]| fill(i, row, &self.products[i - first], &square[i]);
        let before = before.map_or_else(SpdFactor::default, |before| before.factor);
        let factor = before.changed(unchanged, square.len(), interruption, fill)?;
        let further = self.products[square.len() - first..].to_vec();
        let (columns, square) = (Arc::clone(&self.columns), square.into());
        self.factored = Some(Factored { columns, square, factor: factor.clone() });
        Ok(Eliminated { factor, further })
    }

    /// Solves `columns`, of which the leading `same` ones are unchanged, and forms the products of
    /// each column from `needed` on with all columns up to itself.
    fn solve(
        &mut self,
        rail: &SparseFactor,
        columns: Vec<SparseColumn>,
        [same, needed]: [usize; 2],
        interruption: Interruption<'_>,
    ) -> Result<(), LinearError> {
        let whole = |columns: usize| columns / PANEL_COLUMNS * PANEL_COLUMNS;
        let (kept, needed) = (whole(same), whole(needed.min(same)));
        // The memory of columns that cannot be reused is freed first; after a failed solution
        // nothing is kept.
        let Self { mut panels, mut products, first_product, .. } = std::mem::take(self);
        panels.truncate(kept / PANEL_COLUMNS);
        products.truncate(kept.saturating_sub(first_product));
        if needed < first_product {
            products.clear();
        } else {
            products.drain(..(needed - first_product).min(products.len()));
        }
        panels.extend(rail.forward(&columns[kept..], interruption)?.into_iter().map(Arc::new));
        let first = (needed + products.len()) / PANEL_COLUMNS;
        products.extend(gram(&panels, first, interruption)?.into_iter().map(Arc::from));
        *self = Self { columns: columns.into(), panels, products, first_product: needed, factored: None };
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bulk::{Boundary, BulkRail};
    use crate::material::IsotropicElastic;
    use crate::math::Matrix;
    use crate::mesh::QuadMesh;

    const BORDER: usize = 330;
    const FURTHER: usize = 2;

    fn rail() -> BulkRail {
        let lines = |from: f64| (0..=16).map(|i| from + f64::from(i)).collect();
        let mesh = QuadMesh::new(lines(-8.0), lines(-16.0)).unwrap();
        BulkRail::new(mesh, &IsotropicElastic::new(210e3, 0.3).unwrap(), Boundary::HalfPlane).unwrap()
    }

    /// Columns with a different `seed` from `changed` on.
    fn columns(order: usize, changed: usize, seed: usize) -> Vec<SparseColumn> {
        let entry = |i: usize, k: usize| {
            let chance = if i < changed { 0 } else { seed };
            (((3 * i + k) % order), 30.0 * ((7 * i + 3 * k + 11 * chance) as f64).sin())
        };
        (0..BORDER + FURTHER)
            .map(|i| SparseColumn { entries: (0..5).map(|k| entry(i, k)).collect() })
            .collect()
    }

    /// The diagonal of K_ee, with a different value at `changed`.
    fn square(changed: Option<usize>) -> Vec<Entries> {
        (0..BORDER).map(|i| vec![(i, 60.0 + f64::from(changed == Some(i)))]).collect()
    }

    /// L⁻¹ of a row, and the further products.
    fn result(
        store: &mut ColumnStore,
        rail: &BulkRail,
        columns: Vec<SparseColumn>,
        square: Vec<Entries>,
    ) -> (Matrix, Vec<Arc<[f64]>>) {
        let fill = |i: usize, row: &mut [f64], products: &[f64], square: &Entries| {
            row.iter_mut().zip(products).for_each(|(entry, product)| *entry -= product);
            row[i] += square[0].1;
        };
        let Eliminated { factor, further } =
            store.eliminated(rail.factor().unwrap(), columns, square, Interruption::NEVER, fill).unwrap();
        let right = Matrix::from_fn(1, BORDER, |_, j| (j as f64).cos());
        (factor.half_solve_rows(right, Interruption::NEVER).unwrap(), further)
    }

    #[test]
    fn reuse_changes_no_bit_wherever_the_columns_begin_to_differ() {
        let rail = rail();
        let order = rail.order();
        let mut kept = ColumnStore::default();
        let mut seen = Vec::new();
        // Changes late in the columns, changes before the kept part of K_ee and of the columns, a
        // change of everything, and no change.
        let changes =
            [(0, None), (250, None), (300, None), (BORDER, None), (320, Some(120)), (40, None), (310, None)];
        for (seed, (changed, in_square)) in changes.into_iter().chain([(0, None), (0, None)]).enumerate() {
            let columns = columns(order, changed, seed.min(7));
            let afresh = result(&mut ColumnStore::default(), &rail, columns.clone(), square(in_square));
            assert_eq!(result(&mut kept, &rail, columns, square(in_square)), afresh, "from column {changed}");
            assert_eq!(afresh.1.len(), FURTHER);
            assert!(!seen.contains(&afresh) || seed > 7, "from column {changed}");
            seen.push(afresh);
        }
        assert!(kept.products.len() < BORDER + FURTHER, "products that the factor contains are dropped");
    }
}
