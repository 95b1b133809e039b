//! Elastic redistribution in space: the plane, symmetries, reciprocity and the effect of periods.

use super::super::super::eigenstress::{Columns, Eigenstress};
use super::super::super::fourier::Layers;
use super::super::grid::Across;
use super::*;

const SPACING: f64 = 0.25;

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

fn layers() -> Layers {
    Layers::graded(0.25, 1.5, 1.8)
}

fn grid(columns: usize, rows: usize, across: Across, symmetry: Symmetry) -> SpaceGrid {
    let half = match symmetry {
        Symmetry::Mirrored => rows / 2,
        Symmetry::None => 0,
    };
    let (spacing, row_spacing, middle) = (SPACING, SPACING, 0.0);
    let active = half..rows;
    SpaceGrid { columns, spacing, rows, row_spacing, middle, active, layers: layers(), across, symmetry }
}

/// A strain by x, y and depth on all columns and active rows.
fn strain(grid: &SpaceGrid, of: impl Fn(f64, f64, f64) -> [f64; 5]) -> Field<5> {
    let (middles, streamlines) = (grid.layers.middles(), grid.streamlines());
    let mut field: Field<5> = std::array::from_fn(|_| vec![0.0; grid.columns * streamlines]);
    for i in 0..grid.columns {
        for (row, m) in grid.active.clone().enumerate() {
            for (l, depth) in middles.iter().enumerate() {
                let own = of(grid.abscissa(i), grid.lateral(m), *depth);
                for c in 0..5 {
                    field[c][i * streamlines + row * middles.len() + l] = own[c];
                }
            }
        }
    }
    field
}

fn stress(grid: &SpaceGrid, strain: &Field<5>) -> Field<6> {
    let mut elasticity = SpaceEigenstress::new(&steel(), grid.clone());
    elasticity.redistribute(strain, &vec![[0.0; 5]; grid.streamlines()]);
    elasticity.stress
}

/// A strain of unit size (1e-3) around a place.
fn spot(centre: [f64; 3], direction: [f64; 5]) -> impl Fn(f64, f64, f64) -> [f64; 5] {
    move |x, y, z| {
        let away = (x - centre[0]).powi(2) + (y - centre[1]).powi(2) + (z - centre[2]).powi(2);
        direction.map(|d| 1e-3 * (-2.0 * away).exp() * d)
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| value.abs().max(most))
}

/// Stress of a strain of 1e-3.
const SCALE: f64 = 230.0;
/// Round-off of the sums over waves.
const ROUNDING: f64 = 1e-10 * SCALE;
/// The longest waves are extrapolated with all components of the strain, in the plane with those
/// whose response is linear in k: they differ by the remainder of the extrapolation.
const LONGEST: f64 = 3e-4 * SCALE;

/// A step that does not vary across the rail: the redistribution of the plane, and antiplane shear
/// apart from it.
#[test]
fn uniform_across_is_plane_strain() {
    let step = |x: f64, _: f64, z: f64| {
        let height = 1e-3 / (1.0 + (2.0 * x).exp()) * (1.0 + z);
        [1.0, -0.6, 0.4, 0.0, 0.0].map(|own| own * height)
    };
    let grid = grid(64, 4, Across::Periodic, Symmetry::None);
    let all = strain(&grid, step);
    let space = stress(&grid, &all);
    let layers = layers().count();
    let one = |c: usize, sign: f64| -> Vec<f64> {
        all[c]
            .chunks_exact(grid.streamlines())
            .flat_map(|column| column[..layers].iter().map(|e| sign * e))
            .collect()
    };
    let plane_strain: Columns = [one(0, 1.0), one(1, 1.0), one(2, -1.0)];
    let mut plane: Columns = [0, 1, 2].map(|_| vec![0.0; 64 * layers]);
    let entering = vec![[0.0; 3]; layers];
    Eigenstress::new(&steel(), 64, SPACING, self::layers()).stress(&plane_strain, &entering, &mut plane);
    for (at, own) in space[0].iter().enumerate() {
        let same = at / grid.streamlines() * layers + at % layers;
        let differences =
            [own - plane[0][same], space[2][at] - plane[1][same], space[4][at] + plane[2][same]];
        assert!(largest(differences.into_iter()) < LONGEST, "{at}: {differences:?}");
        assert!(space[3][at].abs().max(space[5][at].abs()) < ROUNDING);
    }
}

/// A strain that does not vary along the rail is that of the plane in the section.
#[test]
fn section_is_plane_strain_across() {
    let grid = grid(16, 64, Across::Confined, Symmetry::None);
    let layers = layers().count();
    let (along, across, shear) = (0.4, -1.0, 0.7);
    // Deviator coordinates in space from those of the plane of y and z: out of it is x.
    let tensor = Tensor { xx: along, yy: across, zz: -along - across, yz: shear, ..Tensor::ZERO };
    let plane = super::super::super::PlasticStrain { xx: across, yy: -along - across, zz: along, xy: -shear };
    let size = |y: f64, z: f64| 1e-3 * (-2.0 * y * y - z).exp();
    // The section has four times the period of the rows.
    let (wider, first) = (256, 96);
    let (mut columns, mut rows): (Columns, Vec<[f64; 5]>) = Default::default();
    for n in 0..wider {
        for z in self::layers().middles() {
            let size = size((n as f64 - 0.5 * wider as f64) * SPACING, z);
            for (c, own) in plane.deviator().into_iter().enumerate() {
                columns[c].push(size * own);
            }
            if (first..first + 64).contains(&n) {
                rows.push((tensor * size).deviator());
            }
        }
    }
    let mut want: Columns = [0, 1, 2].map(|_| vec![0.0; wider * layers]);
    let entering = vec![[0.0; 3]; layers];
    Eigenstress::new(&steel(), wider, SPACING, self::layers()).stress(&columns, &entering, &mut want);
    let got = SpaceEigenstress::new(&steel(), grid).section_stress(&rows);
    for (n, (got, strain)) in got.iter().zip(&rows).enumerate() {
        let at = first * layers + n;
        let xx = 0.3 * (got.yy + got.zz) - 210e3 * Tensor::from_deviator(*strain).xx;
        let differences = [got.yy - want[0][at], got.zz - want[1][at], got.yz + want[2][at], got.xx - xx];
        assert!(largest(differences.into_iter()) < LONGEST, "{at}: {differences:?} {got:?}");
    }
}

/// A spot seen with x and y exchanged.
#[test]
fn no_direction_is_preferred() {
    let grid = grid(32, 32, Across::Periodic, Symmetry::None);
    let tensor = Tensor { xx: 0.4, yy: -1.0, zz: 0.6, yz: 0.5, xz: -0.3, xy: 0.8 };
    let exchanged = Tensor { xx: tensor.yy, yy: tensor.xx, yz: tensor.xz, xz: tensor.yz, ..tensor };
    let one = stress(&grid, &strain(&grid, spot([0.25, -0.5, 0.4], tensor.deviator())));
    let other = stress(&grid, &strain(&grid, spot([-0.5, 0.25, 0.4], exchanged.deviator())));
    let (layers, streamlines) = (layers().count(), grid.streamlines());
    // The periodic parts are exchanged to round-off; the longest waves are treated along the rail
    // alone, and differ by what is the same in the whole layer.
    for c in 0..6 {
        let to = [1, 0, 2, 4, 3, 5][c];
        for l in 0..layers {
            let at = |i: usize, m: usize| i * streamlines + m * layers + l;
            let offset = one[c][at(0, 0)] - other[to][at(0, 0)];
            for i in 0..32 {
                for m in 0..32 {
                    let difference = one[c][at(i, m)] - other[to][at(m, i)] - offset;
                    assert!(difference.abs() < ROUNDING, "{c} {l} {i} {m}: {difference:e}");
                }
            }
        }
    }
}

const DIRECTIONS: [[f64; 5]; 5] = [
    [1.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0],
];

/// Betti: each strain does the same work on the stress of the other; on its own stress the work is
/// negative (the energy).
#[test]
fn reciprocal_and_dissipative() {
    let grid = grid(32, 32, Across::Confined, Symmetry::None);
    let fields = DIRECTIONS.map(|d| strain(&grid, spot([0.3, -0.2, 0.3], d)));
    let others = DIRECTIONS.map(|d| strain(&grid, spot([-0.4, 0.5, 0.8], d)));
    let (stresses, by_others) =
        (fields.each_ref().map(|f| stress(&grid, f)), others.each_ref().map(|f| stress(&grid, f)));
    let layers = layers();
    let work = |of: &Field<5>, by: &Field<6>| -> f64 {
        let density = |at: usize| {
            let stress = Tensor::of(std::array::from_fn(|c| by[c][at])).deviator();
            let density: f64 = (0..5).map(|c| of[c][at] * stress[c]).sum();
            density * layers.thickness(at % layers.count())
        };
        (0..of[0].len()).map(density).sum()
    };
    for one in 0..5 {
        let own = work(&fields[one], &stresses[one]);
        assert!(own < 0.0, "{one}: {own}");
        for other in 0..5 {
            let (ab, ba) = (work(&fields[one], &by_others[other]), work(&others[other], &stresses[one]));
            assert!((ab - ba).abs() < 1e-11 * own.abs(), "{one}, {other}: {ab:e} {ba:e}");
        }
    }
}

/// A state that is its own mirror image, from one half of its rows.
#[test]
fn halves_of_symmetric_states() {
    let even = |x: f64, y: f64, z: f64| {
        let size = 1e-3 / (1.0 + (2.0 * x).exp()) * (-y * y - z).exp();
        [size, -0.5 * size, 0.3 * size, 0.6 * size * y, -size * y]
    };
    let whole = grid(32, 32, Across::Confined, Symmetry::None);
    let half = grid(32, 32, Across::Confined, Symmetry::Mirrored);
    let (all, own) = (stress(&whole, &strain(&whole, even)), stress(&half, &strain(&half, even)));
    let layers = layers().count();
    // The outermost row has no mirror image in the whole grid.
    let (offset, size) = (16 * layers, own[0].len());
    for c in 0..6 {
        let most = largest(all[c].iter().copied());
        for at in 0..size {
            let (i, j) = (at / half.streamlines(), at % half.streamlines());
            let same = i * whole.streamlines() + offset + j;
            let difference = own[c][at] - all[c][same];
            assert!(difference.abs() < 1e-5 * SCALE, "{c} {i} {j}: {difference:e} of {most}");
        }
    }
}

/// A strain that enters as zero and leaves as a constant, confined across the rail: both periods
/// have an effect of a high power.
#[test]
fn strip_that_begins_in_an_endless_rail() {
    let step = |x: f64, y: f64, _: f64| {
        let height = 1e-3 / (1.0 + (2.0 * x).exp()) * (-y.powi(2)).exp();
        [1.0, -0.5, 0.7, 0.4, 0.3].map(|own| height * own)
    };
    let of = |columns: usize, rows: usize| -> Vec<f64> {
        let grid = grid(columns, rows, Across::Confined, Symmetry::None);
        let (field, layers) = (stress(&grid, &strain(&grid, step)), layers().count());
        let mut inner = Vec::new();
        for component in &field {
            for i in columns / 2 - 8..columns / 2 + 8 {
                for m in rows / 2 - 6..rows / 2 + 6 {
                    let from = i * grid.streamlines() + m * layers;
                    inner.extend(&component[from..from + layers]);
                }
            }
        }
        inner
    };
    let long = of(128, 128);
    let off = |columns: usize, rows: usize| {
        largest(of(columns, rows).iter().zip(&long).map(|(a, b)| a - b)) / SCALE
    };
    let offs = [off(32, 128), off(64, 128), off(128, 32), off(128, 64)];
    // Periods of 4.4 and 8.9 times the depth of the strain.
    assert!(offs[1] < 0.2 * offs[0] && offs[0] < 0.03, "{offs:?}");
    assert!(offs[3] < 0.2 * offs[2] && offs[2] < 0.03, "{offs:?}");
}

/// The section is in equilibrium: at every lateral place the stress across the rail has no
/// resultant over the depth, but for that of strain that fills its layer, which is the mean over
/// the period.
#[test]
fn no_resultant_across_the_rail() {
    let layers = Layers::graded(0.25, 1.5, 40.0);
    let grid = SpaceGrid { layers: layers.clone(), ..grid(16, 32, Across::Periodic, Symmetry::None) };
    let tensor = Tensor { xx: 0.4, yy: -1.0, zz: 0.6, yz: 0.5, xz: -0.3, xy: 0.8 };
    let mut rows = Vec::new();
    for m in 0..32 {
        for z in layers.middles() {
            rows.push((tensor * (1e-3 * (-grid.lateral(m).powi(2) - 4.0 * z * z).exp())).deviator());
        }
    }
    let stress = SpaceEigenstress::new(&steel(), grid).section_stress(&rows);
    let thicknesses: Vec<f64> = (0..layers.count()).map(|l| layers.thickness(l)).collect();
    let resultant = |m: usize| -> f64 {
        let row = &stress[m * layers.count()..(m + 1) * layers.count()];
        row.iter().zip(&thicknesses).map(|(own, thickness)| own.yy * thickness).sum()
    };
    let resultants: Vec<f64> = (0..32).map(resultant).collect();
    let mean = resultants.iter().sum::<f64>() / 32.0;
    for (m, own) in resultants.iter().enumerate() {
        // What waves of the period leave below a depth of 40 mm: e^(−2π 40/8) of SCALE.
        assert!((own - mean).abs() < 1e-9 * SCALE, "{m}: {own} {mean}");
    }
}
