//! Nested-dissection ordering of the nodes of a grid for elimination.

use super::QuadMesh;
use std::ops::RangeInclusive;

/// Lattice columns and rows of a part of the mesh.
struct LatticeBlock {
    columns: RangeInclusive<usize>,
    rows: RangeInclusive<usize>,
}

/// Number of elements in both directions at or below which a part is not divided further, because a
/// separator would cost as much as it saves.
const LEAF_ELEMENTS: usize = 2;

impl QuadMesh {
    /// The nodes in nested-dissection order: a grid line divides the mesh in two; the nodes of
    /// either part come first, each part ordered by the same rule, and the nodes on the line come
    /// last. Eliminated in this order, the nodes of a part fill in only among themselves and on the
    /// lines around the part. The direction with more elements is divided.
    ///
    /// Every node occurs once (George, SIAM J. Numer. Anal. 10, 1973).
    pub fn nested_dissection(&self) -> Vec<usize> {
        let mut order = Vec::with_capacity(self.node_count());
        self.dissect(LatticeBlock { columns: 0..=2 * self.columns(), rows: 0..=2 * self.rows() }, &mut order);
        order
    }

    fn dissect(&self, part: LatticeBlock, order: &mut Vec<usize>) {
        let LatticeBlock { columns, rows } = part;
        let wide = line_inside(&columns);
        let high = line_inside(&rows);
        match (wide, high) {
            (Some(line), other) if other.is_none() || elements(&columns) >= elements(&rows) => {
                self.dissect(
                    LatticeBlock { columns: *columns.start()..=line - 1, rows: rows.clone() },
                    order,
                );
                self.dissect(LatticeBlock { columns: line + 1..=*columns.end(), rows: rows.clone() }, order);
                self.collect(line..=line, rows, order);
            }
            (_, Some(line)) => {
                self.dissect(
                    LatticeBlock { columns: columns.clone(), rows: *rows.start()..=line - 1 },
                    order,
                );
                self.dissect(LatticeBlock { columns: columns.clone(), rows: line + 1..=*rows.end() }, order);
                self.collect(columns, line..=line, order);
            }
            (_, None) => self.collect(columns, rows, order),
        }
    }

    /// Appends the nodes among the lattice points of a box, row by row.
    fn collect(&self, columns: RangeInclusive<usize>, rows: RangeInclusive<usize>, order: &mut Vec<usize>) {
        for r in rows {
            let nodes = columns.clone().filter(|c| c.is_multiple_of(2) || r.is_multiple_of(2));
            order.extend(nodes.map(|c| self.node_at(c, r)));
        }
    }
}

/// Number of elements along one direction that touch the lattice indices of a range.
fn elements(range: &RangeInclusive<usize>) -> usize {
    range.end().div_ceil(2) - range.start() / 2
}

/// The even lattice index (a grid line) in the middle of a range that is worth dividing.
fn line_inside(range: &RangeInclusive<usize>) -> Option<usize> {
    (elements(range) > LEAF_ELEMENTS).then(|| 2 * ((range.start() + range.end() + 2) / 4))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Element;

    fn grid(columns: usize, rows: usize) -> QuadMesh {
        let lines = |n: usize| (0..=n).map(|i| i as f64).collect();
        QuadMesh::new(lines(columns), lines(rows)).unwrap()
    }

    #[test]
    fn every_node_once() {
        for (columns, rows) in [(1, 1), (2, 7), (5, 3), (16, 9), (33, 40)] {
            let mesh = grid(columns, rows);
            let mut order = mesh.nested_dissection();
            order.sort_unstable();
            assert!(order.into_iter().eq(0..mesh.node_count()), "{columns} x {rows}");
        }
    }

    /// Eliminates the nodes one by one and counts the entries of the factor.
    fn entries_of_factor(mesh: &QuadMesh, order: &[usize]) -> usize {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(i, &node)| place[node] = i);
        let mut later = vec![std::collections::BTreeSet::new(); order.len()];
        for Element { nodes, .. } in (0..mesh.element_count()).map(|e| mesh.element(e)) {
            let places = nodes.map(|node| place[node]);
            for a in places {
                later[a].extend(places.into_iter().filter(|&b| b > a));
            }
        }
        for i in 0..order.len() {
            let column = std::mem::take(&mut later[i]);
            if let Some(&parent) = column.first() {
                later[parent].extend(column.iter().copied().filter(|&j| j > parent));
            }
            later[i] = column;
        }
        later.iter().map(|column| column.len() + 1).sum()
    }

    #[test]
    fn fills_in_like_n_squared_log_n() {
        // From 20 to 40 elements: 4 log 40 / log 20 = 4.9 in theory, eightfold for an order row by
        // row.
        let entries = |n| {
            let mesh = grid(n, n);
            let row_by_row: Vec<usize> = (0..mesh.node_count()).collect();
            [entries_of_factor(&mesh, &mesh.nested_dissection()), entries_of_factor(&mesh, &row_by_row)]
        };
        let ([dissected, banded], [dissected_twice, banded_twice]) = (entries(20), entries(40));
        let growth = |n: usize, twice: usize| twice as f64 / n as f64;
        assert!(growth(dissected, dissected_twice) < 5.2, "{dissected} to {dissected_twice}");
        assert!(growth(banded, banded_twice) > 7.0, "{banded} to {banded_twice}");
    }
}
