//! `plastic.vtu`, the plastic state as a field of the rail, `cycle.vtu`, stress and strain around
//! the contact, and `section.vtu`, the state across the rail.

use super::results::{SectionResults, ShakedownResults};
use super::tables::SectionRow;
use railcrack::math::{Stress, Tensor, Vec2};
use railcrack::mesh::{Array, CellBlock, CellShape, UnstructuredGrid};
use railcrack::shakedown::PlasticStrain;

/// Half-widths on each side of the contact in `cycle.vtu`.
const AROUND: f64 = 4.0;

/// The plastic state as a field of the rail: quadrilaterals over its whole length, one per layer,
/// with `plastic_stress_mpa` = 2 G ε_p, `plastic_strain` and `residual_stress_mpa`; zero below the
/// plastic layers.
pub(super) fn plastic_grid(results: &ShakedownResults) -> UnstructuredGrid {
    let state = &results.stabilised;
    let mut depths = state.layers.interfaces().to_vec();
    let mut strains: Vec<PlasticStrain> = state.profile.iter().map(|layer| layer.strain).collect();
    let mut stresses: Vec<Stress> = state.profile.iter().map(|layer| layer.stress).collect();
    let bottom = depths.last().copied().unwrap_or(0.0);
    if results.extent.depth > bottom {
        depths.push(results.extent.depth);
        strains.push(PlasticStrain::default());
        stresses.push(results.rail.initial_stress(0.5 * (bottom + results.extent.depth)));
    }
    let columns = <[f64; 2]>::from(results.extent.ends());
    let mut grid = quadrilaterals(&columns, &depths);
    let twice_shear = 2.0 * results.rail.steel.shear_modulus();
    let plastic: Vec<Stress> = strains.iter().map(|&strain| as_tensor(strain) * twice_shear).collect();
    let strains: Vec<Stress> = strains.into_iter().map(as_tensor).collect();
    grid.cell_data = vec![
        Array::stresses("plastic_stress_mpa", &plastic),
        Array::stresses("plastic_strain", &strains),
        Array::stresses("residual_stress_mpa", &stresses),
    ];
    grid
}

/// The last passage around the contact at x = 0: stress (of wheel, plastic strain and
/// manufacturing) and plastic strain.
pub(super) fn cycle_grid(results: &ShakedownResults) -> UnstructuredGrid {
    let (state, cycle) = (&results.stabilised, &results.stabilised.cycle);
    let layers = state.profile.len();
    let reach = AROUND * results.rail.contact.half_width();
    let mut shown: Vec<usize> =
        (0..cycle.abscissae.len()).filter(|&i| cycle.abscissae[i].abs() <= reach).collect();
    shown.sort_by(|&a, &b| cycle.abscissae[a].total_cmp(&cycle.abscissae[b]));
    let abscissae: Vec<f64> = shown.iter().map(|&i| cycle.abscissae[i]).collect();
    let mut borders: Vec<f64> = abscissae.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
    if let (Some(first), Some(last)) = (borders.first().copied(), borders.last().copied()) {
        let (start, end) = (abscissae[0], abscissae[abscissae.len() - 1]);
        borders.insert(0, 2.0 * start - first);
        borders.push(2.0 * end - last);
    }
    let mut grid = quadrilaterals(&borders, state.layers.interfaces());
    // Cells go down each column.
    let cells = || shown.iter().flat_map(|&i| (0..layers).map(move |j| i * layers + j));
    let stresses: Vec<Stress> = cells().map(|at| cycle.stress[at]).collect();
    let strains: Vec<Stress> = cells().map(|at| as_tensor(cycle.strain[at])).collect();
    grid.cell_data =
        vec![Array::stresses("stress_mpa", &stresses), Array::stresses("plastic_strain", &strains)];
    grid
}

/// The state across the rail: cells around the rows and layers of `rows`, with y across the rail
/// and heights upwards, and tensors in axes along the rail, across it and downwards.
pub(super) fn section_grid(section: &SectionResults, rows: &[SectionRow]) -> UnstructuredGrid {
    let layers = section.state.layers.count();
    let laterals: Vec<f64> = rows.iter().step_by(layers.max(1)).map(|row| row.lateral).collect();
    let spacing = laterals.windows(2).map(|pair| pair[1] - pair[0]).next().unwrap_or(1.0);
    let first = laterals.first().map(|lateral| lateral - 0.5 * spacing);
    let borders: Vec<f64> =
        first.into_iter().chain(laterals.iter().map(|lateral| lateral + 0.5 * spacing)).collect();
    let mut grid = quadrilaterals(&borders, section.state.layers.interfaces());
    // VTK's order is XX, YY, ZZ, XY, YZ, XZ.
    let tensors = |name: &str, of: fn(&SectionRow) -> Tensor| Array {
        name: name.to_owned(),
        components: 6,
        values: rows
            .iter()
            .map(of)
            .flat_map(|own| [own.xx, own.yy, own.zz, own.xy, own.yz, own.xz])
            .collect(),
    };
    let scalars =
        |name: &str, of: fn(&SectionRow) -> f64| Array::scalars(name, rows.iter().map(of).collect());
    grid.cell_data = vec![
        tensors("residual_stress_mpa", |row| row.stress),
        tensors("plastic_strain", |row| row.strain),
        scalars("plastic_per_pass", |row| row.plastic_per_pass),
        scalars("yield_utilisation", |row| row.yield_utilisation),
        scalars("shakedown_utilisation", |row| row.shakedown_utilisation),
        scalars("dang_van_mpa", |row| row.dang_van),
    ];
    grid
}

/// Cells between `borders` (mm, increasing) and `depths` (mm, increasing), down each column.
fn quadrilaterals(borders: &[f64], depths: &[f64]) -> UnstructuredGrid {
    let rows = depths.len();
    let points =
        borders.iter().flat_map(|&x| depths.iter().map(move |&depth| Vec2::new(x, -depth))).collect();
    let cell = |i: usize, j: usize| {
        let upper_left = i * rows + j;
        [upper_left + 1, upper_left + rows + 1, upper_left + rows, upper_left]
    };
    let columns = borders.len().saturating_sub(1);
    let connectivity = (0..columns).flat_map(|i| (0..rows - 1).flat_map(move |j| cell(i, j))).collect();
    let cells = vec![CellBlock { shape: CellShape::Quad, connectivity }];
    UnstructuredGrid { points, cells, ..UnstructuredGrid::default() }
}

/// A strain in the components of a stress.
fn as_tensor(strain: PlasticStrain) -> Stress {
    Stress { xx: strain.xx, yy: strain.yy, zz: strain.zz, xy: strain.xy }
}
