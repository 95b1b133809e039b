//! Elastic redistribution: reciprocity, energy, closed forms and the effect of the period.

use super::*;

const SPACING: f64 = 0.25;

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

fn layers() -> Layers {
    Layers::graded(0.25, 2.0, 2.5)
}

fn zeros(columns: usize) -> Columns {
    [0, 1, 2].map(|_| vec![0.0; columns * layers().count()])
}

/// A strain around x = `centre` and depth `depth` (mm), of unit size, in `direction`.
fn spot(columns: usize, centre: f64, depth: f64, direction: [f64; 3]) -> Columns {
    let mut strain = zeros(columns);
    let middles = layers().middles();
    for i in 0..columns {
        let x = (i as f64 - 0.5 * columns as f64) * SPACING - centre;
        for (j, middle) in middles.iter().enumerate() {
            let size = 1e-3 * (-x * x - (middle - depth).powi(2)).exp();
            for c in 0..3 {
                strain[c][i * middles.len() + j] = size * direction[c];
            }
        }
    }
    strain
}

fn stress(columns: usize, strain: &Columns) -> Columns {
    let upstream = vec![[0.0; 3]; layers().count()];
    let mut stress = zeros(columns);
    Eigenstress::new(&steel(), columns, SPACING, layers()).stress(strain, &upstream, &mut stress);
    stress
}

/// ∫ σ : ε of the strain `of` in the stress of the strain `by`, with σ_zz = ν (σ_xx + σ_yy) − E
/// ε_zz.
fn work(of: &Columns, by: &Columns, columns: usize) -> f64 {
    let [xx, yy, xy] = stress(columns, by);
    let layers = layers();
    let strain = |field: &Columns, at: usize| {
        super::super::PlasticStrain::from_deviator([0, 1, 2].map(|c| field[c][at]))
    };
    let at = |at: usize| {
        let (e, own) = (strain(of, at), strain(by, at));
        let zz = steel().poisson() * (xx[at] + yy[at]) - steel().young() * own.zz;
        let density = xx[at] * e.xx + yy[at] * e.yy + zz * e.zz + 2.0 * xy[at] * e.xy;
        density * layers.thickness(at % layers.count()) * SPACING
    };
    (0..xx.len()).map(at).sum()
}

const DIRECTIONS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Betti: each strain does the same work on the stress of the other; on its own stress the work is
/// negative (the energy).
#[test]
fn reciprocal_and_dissipative() {
    let columns = 128;
    for one in DIRECTIONS {
        for other in DIRECTIONS {
            let (a, b) = (spot(columns, 0.5, 0.6, one), spot(columns, -0.7, 1.1, other));
            let (ab, ba, aa) = (work(&a, &b, columns), work(&b, &a, columns), work(&a, &a, columns));
            assert!(aa < 0.0);
            // Round-off.
            assert!((ab - ba).abs() < 1e-12 * aa.abs(), "{one:?}, {other:?}: {ab:e} {ba:e}");
        }
    }
}

/// A strain that fills a layer from end to end: −E′ (ε_xx + ν ε_zz) along the rail, and no other
/// stress.
#[test]
fn filled_layers() {
    let columns = 64;
    let upstream: Vec<[f64; 3]> = (0..layers().count()).map(|j| [1e-3, -2e-3, 5e-4 * j as f64]).collect();
    let mut strain = zeros(columns);
    for at in 0..strain[0].len() {
        for c in 0..3 {
            strain[c][at] = upstream[at % upstream.len()][c];
        }
    }
    let mut stress = zeros(columns);
    Eigenstress::new(&steel(), columns, SPACING, layers()).stress(&strain, &upstream, &mut stress);
    let e = super::super::PlasticStrain::from_deviator(upstream[0]);
    let want = -steel().plane_strain_modulus() * (e.xx + 0.3 * e.zz);
    assert!(stress[0].iter().all(|s| (s - want).abs() < 1e-9)); // round-off of some hundred MPa
    assert!(stress[1].iter().chain(&stress[2]).all(|s| s.abs() < 1e-9));
}

/// A strain that enters as zero and leaves as a constant: behind the step the stress tends to that
/// of filled layers, ahead of it to zero, and the period has an effect of its fourth power.
#[test]
fn step_in_an_endless_rail() {
    let step = |columns: usize| {
        let mut strain = zeros(columns);
        let layers = layers().count();
        for i in 0..columns {
            let x = (i as f64 - 0.5 * columns as f64) * SPACING;
            let height = 1e-3 / (1.0 + (2.0 * x).exp());
            for j in 0..layers {
                for c in 0..3 {
                    strain[c][i * layers + j] = height * [1.0, -0.5, 0.7][c];
                }
            }
        }
        stress(columns, &strain)
    };
    let of = |columns: usize| {
        let (field, layers) = (step(columns), layers().count());
        let middle = columns / 2 * layers;
        [0, 1, 2].map(|c| field[c][middle - 8 * layers..middle + 8 * layers].to_vec()).concat()
    };
    let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    // Periods of 6, 13 and 51 times the depth of the strain.
    let [short, longer, long] = [64, 128, 512].map(of);
    let (first, second) = (difference(&short, &long), difference(&longer, &long));
    let scale = 1e-3 * steel().plane_strain_modulus();
    assert!(first < 0.02 * scale && second < 0.1 * first, "{} {}", first / scale, second / scale);
}
