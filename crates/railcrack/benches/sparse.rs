//! Times of the uncracked rail: its sparse factor, forward solves of local columns, their scalar
//! products, and the correction of a block.

use divan::{Bencher, black_box};
use railcrack::bulk::{BlockCorrection, BottomSupport, Boundary, BulkRail, SideSupport};
use railcrack::field::HertzWheel;
use railcrack::interruption::Interruption;
use railcrack::linear::{ReachedPanel, SparseCholesky, SparseColumn, gram};
use railcrack::load::HertzianContact;
use railcrack::material::IsotropicElastic;
use railcrack::math::Vec2;
use railcrack::mesh::QuadMesh;
use std::sync::Arc;

/// Elements along each side of the grid, and how many columns are solved with it.
const SIZES: [(usize, usize); 3] = [(70, 500), (70, 1500), (120, 500)];

/// Samples of what takes tenths of seconds at most.
const SAMPLES: u32 = 10;

const CONTACT: HertzianContact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };

fn wheel() -> HertzWheel {
    HertzWheel::new(&CONTACT, &IsotropicElastic::new(210e3, 0.3).unwrap()).unwrap()
}

const CLAMPED: Boundary = Boundary::Block { bottom: BottomSupport::Clamped, sides: SideSupport::Free };

fn main() {
    for (name, rail) in [("70 x 70", square(70)), ("120 x 120", square(120)), ("block", rail(block_mesh()))] {
        let (nodes, factor) = (rail.mesh().node_count(), rail.factor().unwrap());
        let (order, entries, bytes) = (factor.order(), factor.entries(), factor.memory_bytes());
        println!("{name}: {nodes} nodes, {order} unknowns, {entries} entries of L, {bytes} bytes");
    }
    divan::main();
}

fn rail(mesh: QuadMesh) -> BulkRail {
    BulkRail::new(mesh, &IsotropicElastic::new(210e3, 0.3).unwrap(), CLAMPED).unwrap()
}

fn square(n: usize) -> BulkRail {
    let lines: Vec<f64> = (0..=n).map(|i| i as f64 - n as f64).collect();
    rail(QuadMesh::new(lines.clone(), lines).unwrap())
}

/// The block of 300 × 172 mm: elements of 0.2 mm in a window of 12 × 8 mm, growing outwards by a
/// quarter, up to 15 mm.
fn block_mesh() -> QuadMesh {
    let outwards = |window: f64, end: f64| {
        let (mut at, mut step, mut lines) = (0.0, 0.2, vec![0.0]);
        while at + 1.5 * step < end {
            at += step;
            lines.push(at);
            if at > window - 0.1 {
                step = f64::min(1.25 * step, 15.0);
            }
        }
        lines.push(end);
        lines
    };
    let right = outwards(6.0, 150.0);
    let x = right.iter().skip(1).rev().map(|x| -x).chain(right.iter().copied()).collect();
    QuadMesh::new(x, outwards(8.0, 172.0).into_iter().rev().map(|depth| -depth).collect()).unwrap()
}

fn analysed(rail: &BulkRail) -> SparseCholesky {
    let nodes = rail.mesh().nested_dissection().into_iter();
    let order = nodes.flat_map(|node| rail.unknowns(node)).flatten().collect();
    SparseCholesky::analyse(&rail.stiffness(), order).unwrap()
}

/// Columns on the unknowns of single elements, along a slanted line that begins at the middle of
/// the top.
fn local_columns(rail: &BulkRail, count: usize) -> Vec<SparseColumn> {
    let n = rail.mesh().columns();
    let column = |i: usize| {
        let along = i * (n / 3) / count;
        let unknowns = rail.element_unknowns((n - 1 - along) * n + n / 2 + along / 2);
        let entry = |(k, u): (usize, usize)| (u, ((i + k) as f64).sin());
        SparseColumn { entries: unknowns.into_iter().flatten().enumerate().map(entry).collect() }
    };
    (0..count).map(column).collect()
}

/// Points on a crack of 8 mm.
fn face_points() -> Vec<Vec2> {
    (0..200).map(|i| Vec2::new(0.02, -0.02) * f64::from(i)).collect()
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn analyse(bencher: Bencher, (n, _): (usize, usize)) {
    let rail = square(n);
    bencher.bench(|| analysed(black_box(&rail)));
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn factor(bencher: Bencher, (n, _): (usize, usize)) {
    let rail = square(n);
    let analysed = analysed(&rail);
    bencher.bench(|| analysed.factor(black_box(&rail.stiffness())).unwrap());
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn forward(bencher: Bencher, (n, count): (usize, usize)) {
    let rail = square(n);
    let columns = local_columns(&rail, count);
    bencher.bench(|| rail.factor().unwrap().forward(black_box(&columns), Interruption::NEVER).unwrap());
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn scalar_products(bencher: Bencher, (n, count): (usize, usize)) {
    let rail = square(n);
    let reached = rail.factor().unwrap().forward(&local_columns(&rail, count), Interruption::NEVER).unwrap();
    let panels: Vec<Arc<ReachedPanel>> = reached.into_iter().map(Arc::new).collect();
    bencher.bench(|| gram(black_box(&panels), 0, Interruption::NEVER));
}

#[divan::bench(args = SIZES, sample_count = SAMPLES, sample_size = 1)]
fn solve_one(bencher: Bencher, (n, _): (usize, usize)) {
    let rail = square(n);
    let factor = rail.factor().unwrap();
    let mut column: Vec<f64> = (0..factor.order()).map(|i| (i as f64).sin()).collect();
    bencher.bench_local(|| factor.solve(black_box(&mut column)).unwrap());
}

/// Assembly, analysis and factor of the block.
#[divan::bench(sample_count = SAMPLES, sample_size = 1)]
fn bulk_rail(bencher: Bencher) {
    let mesh = block_mesh();
    bencher.bench(|| rail(black_box(&mesh).clone()));
}

/// The correction for a wheel that runs over ±6 a.
#[divan::bench(sample_count = SAMPLES, sample_size = 1)]
fn block_correction(bencher: Bencher) {
    let rail = rail(block_mesh());
    let rail = Arc::new(rail);
    bencher.bench(|| BlockCorrection::new(black_box(&rail), &wheel(), -40.5..=40.5).unwrap());
}

/// The correction prepared for the points of a crack.
#[divan::bench(sample_count = SAMPLES, sample_size = 1)]
fn correction_at_points(bencher: Bencher) {
    let rail = rail(block_mesh());
    let correction = BlockCorrection::new(&Arc::new(rail.clone()), &wheel(), -40.5..=40.5).unwrap();
    bencher.bench(|| correction.at(black_box(&face_points())).unwrap());
}

/// The stress of the correction at the points of a crack, for one wheel position.
#[divan::bench]
fn correction_for_one_position(bencher: Bencher) {
    let rail = rail(block_mesh());
    let correction = BlockCorrection::new(&Arc::new(rail.clone()), &wheel(), -40.5..=40.5).unwrap();
    let points = face_points();
    let there = correction.at(&points).unwrap();
    bencher.bench(|| {
        let wheel = there.wheel_at(black_box(1.3)).unwrap();
        (0..points.len()).map(|k| wheel.stress(k).xx).sum::<f64>()
    });
}
