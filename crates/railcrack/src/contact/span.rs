//! The load between two stations as a combination of a few loads.

use super::LoadPath;
use crate::math::{Matrix, add_rows, chebyshev};

/// The loads along a path between two stations, from a few of them: a polynomial where the load is smooth, and what is missing elsewhere.
pub(super) struct LoadSpan {
    /// Chebyshev points of the span.
    points: Vec<f64>,
    /// Its end.
    station: f64,
    /// Nodal forces (N/mm): row k at point k, the last row at the end.
    loads: Matrix,
    /// Forces below this (N/mm) are not missed.
    negligible: f64,
}

/// How a load is combined from those of a span: Σ weights_k load_k + rest.
pub(super) struct Combination {
    /// Of each load of the span.
    pub weights: Vec<f64>,
    /// Nodal forces, N/mm; zero for most components.
    pub rest: Vec<f64>,
}

/// Chebyshev points of a span. Between stations 0.05 a apart the polynomial misses 40 of the 760 forces on nine cracks then, those near the running surface
/// under an edge of the contact.
const POINTS: usize = 8;
/// Forces that are not missed, over the largest of the span.
const NEGLIGIBLE: f64 = 1e-10;

impl LoadSpan {
    /// The loads of `path` between `from` and `station`.
    pub(super) fn new(path: &dyn LoadPath, from: f64, station: f64) -> Self {
        let points = chebyshev::points(&(from..=station), POINTS);
        let rows: Vec<Vec<f64>> = points.iter().chain([&station]).map(|&at| path.nodal_forces(at)).collect();
        let loads = Matrix::from_fn(rows.len(), rows[POINTS].len(), |k, i| rows[k][i]);
        let largest = rows.iter().flatten().fold(0.0f64, |m, force| m.max(force.abs()));
        Self { points, station, loads, negligible: NEGLIGIBLE * largest }
    }

    /// The loads that are combined, each a row.
    pub(super) fn loads(&self) -> &Matrix {
        &self.loads
    }

    /// The load of `path` at `at`, and how it is combined where that is shorter. Forces that the polynomial gives to 1e-10 of the
    /// largest are taken from it.
    pub(super) fn load(&self, path: &dyn LoadPath, at: f64) -> (Vec<f64>, Option<Combination>) {
        let components = self.loads.columns();
        if at == self.station {
            let weights = (0..=POINTS).map(|k| f64::from(k == POINTS)).collect();
            let combination = Combination { weights, rest: vec![0.0; components] };
            return (self.loads.row(POINTS).to_vec(), Some(combination));
        }
        let mut weights = chebyshev::weights(&self.points, at);
        weights.push(0.0);
        let mut forces = vec![0.0; components];
        add_rows(&weights, |k| self.loads.row(k), &mut forces);
        let mut rest = path.nodal_forces(at);
        let mut missed = 0;
        for (rest, force) in rest.iter_mut().zip(&mut forces) {
            let missing = *rest - *force;
            if missing.abs() > self.negligible {
                (*force, *rest) = (*rest, missing);
                missed += 1;
            } else {
                *rest = 0.0;
            }
        }
        let combined = missed <= components / 2;
        (forces, combined.then_some(Combination { weights, rest }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forces that go smoothly, like a root whose branch point is beyond the span, and like one with the branch point at its end.
    struct Roots;

    impl LoadPath for Roots {
        fn nodal_forces(&self, at: f64) -> Vec<f64> {
            vec![at.sin(), 3.0 + at, (2.0 - at).sqrt(), (1.0 - at).sqrt()]
        }
    }

    #[test]
    fn loads_are_combined_with_what_is_not_smooth_as_rest() {
        for (from, station) in [(0.5, 1.0), (1.0, 0.5)] {
            let span = LoadSpan::new(&Roots, from, station);
            for share in [0.01, 0.3, 0.77, 0.99, 1.0] {
                let at = if share == 1.0 { station } else { from + share * (station - from) };
                let (forces, combination) = span.load(&Roots, at);
                let Combination { weights, rest } = combination.unwrap();
                for (i, exact) in Roots.nodal_forces(at).into_iter().enumerate() {
                    let combined: f64 = (0..weights.len()).map(|k| weights[k] * span.loads()[(k, i)]).sum();
                    assert!((forces[i] - combined - rest[i]).abs() < 1e-14);
                    assert!((forces[i] - exact).abs() <= 4.0 * NEGLIGIBLE, "{at}, {i}");
                    assert_eq!(rest[i] == 0.0, i < 3 || at == station, "{at}, {i}: {}", rest[i]);
                }
            }
        }
    }
}
