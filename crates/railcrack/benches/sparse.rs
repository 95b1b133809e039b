//! Times of the sparse factor of an elastic grid: factorisation, forward solves of local columns, their scalar products.

use divan::{Bencher, black_box};
use railcrack::linear::{
    ReachedColumn, SparseCholesky, SparseColumn, SparseFactor, SparseSymmetric, SymmetricPattern, gram_of,
};
use railcrack::math::{Matrix, gauss_legendre};
use railcrack::mesh::{Element, NODES, QuadMesh, shape_functions};
use std::sync::Arc;

/// Elements along each side of the grid, and how many columns are solved with it.
const SIZES: [(usize, usize); 3] = [(70, 500), (70, 1500), (120, 500)];

/// Samples of what takes tenths of seconds at most.
const SAMPLES: u32 = 10;

fn main() {
    let sizes: std::collections::BTreeSet<usize> = SIZES.iter().map(|(n, _)| *n).collect();
    for n in sizes {
        let (_, factor) = Grid::new(n).factored();
        let (order, entries, bytes) = (factor.order(), factor.entries(), factor.memory_bytes());
        println!("{n} x {n} elements: {order} unknowns, {entries} entries of L, {bytes} bytes");
    }
    divan::main();
}

struct Grid {
    mesh: QuadMesh,
    elements: Vec<[Option<usize>; 2 * NODES]>,
    pattern: Arc<SymmetricPattern>,
}

impl Grid {
    fn new(n: usize) -> Self {
        let lines: Vec<f64> = (0..=n).map(|i| i as f64).collect();
        let mesh = QuadMesh::new(lines.clone(), lines).unwrap();
        let unknowns = |element: Element| {
            std::array::from_fn(|k| {
                let node = element.nodes[k / 2];
                // The bottom is held.
                (mesh.lattice_point(node).1 > 0).then(|| 2 * (node - (2 * mesh.columns() + 1)) + k % 2)
            })
        };
        let elements: Vec<_> = (0..mesh.element_count()).map(|e| unknowns(mesh.element(e))).collect();
        let order = 2 * (mesh.node_count() - (2 * mesh.columns() + 1));
        let pattern = Arc::new(SymmetricPattern::from_blocks(order, &elements).unwrap());
        Self { mesh, elements, pattern }
    }

    fn matrix(&self) -> SparseSymmetric {
        let stiffness = unit_stiffness();
        let mut matrix = SparseSymmetric::zeros(Arc::clone(&self.pattern));
        for element in &self.elements {
            matrix.add_block(element, &stiffness).unwrap();
        }
        matrix
    }

    fn analysed(&self) -> SparseCholesky {
        let held = 2 * self.mesh.columns() + 1;
        let nodes = self.mesh.nested_dissection().into_iter().filter_map(|node| node.checked_sub(held));
        let order = nodes.flat_map(|node| [2 * node, 2 * node + 1]).collect();
        SparseCholesky::analyse(Arc::clone(&self.pattern), order).unwrap()
    }

    fn factored(&self) -> (SparseCholesky, SparseFactor) {
        let analysed = self.analysed();
        let factor = analysed.factor(&self.matrix()).unwrap();
        (analysed, factor)
    }

    /// Columns on the unknowns of single elements, along a slanted line that begins at the middle of the top.
    fn local_columns(&self, count: usize) -> Vec<SparseColumn> {
        let n = self.mesh.columns();
        let column = |i: usize| {
            let along = i * (n / 3) / count;
            let e = (n - 1 - along) * n + n / 2 + along / 2;
            let unknowns = self.elements[e].iter().flatten();
            SparseColumn {
                entries: unknowns.enumerate().map(|(k, &u)| (u, ((i + k) as f64).sin())).collect(),
            }
        };
        (0..count).map(column).collect()
    }
}

/// The stiffness of a square with eight nodes in plane strain, E = 1, ν = 0.3.
fn unit_stiffness() -> Matrix {
    let (mu, lambda) = (0.5 / 1.3, 0.3 / (1.3 * 0.4));
    let mut stiffness = Matrix::zeros(2 * NODES, 2 * NODES);
    let rule = gauss_legendre(3);
    for (s, t, weight) in rule.iter().flat_map(|(s, v)| rule.iter().map(move |(t, w)| (*s, *t, v * w))) {
        let shapes = shape_functions(2.0 * s - 1.0, 2.0 * t - 1.0);
        for i in 0..2 * NODES {
            for j in 0..2 * NODES {
                let (a, b) = (shapes[i / 2], shapes[j / 2]);
                let (p, q) = (i % 2 + 1, j % 2 + 1);
                let shear = if p == q { a[1] * b[1] + a[2] * b[2] } else { 0.0 };
                stiffness[(i, j)] += 4.0 * weight * (lambda * a[p] * b[q] + mu * a[q] * b[p] + mu * shear);
            }
        }
    }
    stiffness
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn analyse(bencher: Bencher, (n, _): (usize, usize)) {
    let grid = Grid::new(n);
    bencher.bench(|| black_box(&grid).analysed());
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn factor(bencher: Bencher, (n, _): (usize, usize)) {
    let grid = Grid::new(n);
    let (analysed, matrix) = (grid.analysed(), grid.matrix());
    bencher.bench(|| analysed.factor(black_box(&matrix)).unwrap());
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn forward(bencher: Bencher, (n, count): (usize, usize)) {
    let grid = Grid::new(n);
    let (_, factor) = grid.factored();
    let columns = grid.local_columns(count);
    bencher.bench(|| factor.forward(black_box(&columns)).unwrap());
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn scalar_products(bencher: Bencher, (n, count): (usize, usize)) {
    let grid = Grid::new(n);
    let (_, factor) = grid.factored();
    let reached = factor.forward(&grid.local_columns(count)).unwrap();
    let columns: Vec<&ReachedColumn> = reached.iter().collect();
    bencher.bench(|| gram_of(black_box(&columns)));
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn solve_one(bencher: Bencher, (n, _): (usize, usize)) {
    let (_, factor) = Grid::new(n).factored();
    let mut column: Vec<f64> = (0..factor.order()).map(|i| (i as f64).sin()).collect();
    bencher.bench_local(|| factor.solve(black_box(&mut column)).unwrap());
}
