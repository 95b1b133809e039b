//! Depth over load cycles by the growth rates of straight cracks of several lengths.

use crate::calibration::SizeCurve;
use crate::csv::TipRow;

/// Points of the integral between two lengths; the trapezoidal rule in the logarithm of the depth
/// is then exact to 1e-4 where the rate rises with the sixth power of the depth.
const PARTS: usize = 32;

/// Depth (mm) over load cycles (millions) of a crack whose rate at each depth is that of a straight
/// crack: N(z) = ∫ dz/(dz/dN), with dz/dN a power of z between two lengths. `runs` are the tips of
/// each straight crack; the deepest one counts. A tip that does not grow ends the curve.
pub(super) fn straight_curve<'a>(runs: impl Iterator<Item = &'a [TipRow]>) -> SizeCurve {
    let depth = |row: &TipRow| row.depth.unwrap_or(-row.place[1]);
    let deepest = |rows: &'a [TipRow]| rows.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)));
    // The depth of a straight crack grows by the sine of its angle.
    let mut rates: Vec<(f64, f64)> =
        runs.filter_map(deepest).map(|row| (depth(row), row.rate * depth(row) / row.length)).collect();
    rates.sort_by(|a, b| a.0.total_cmp(&b.0));
    curve_by_rates(&rates)
}

/// The curve by (depth in mm, growth in depth in mm per cycle), depths ascending.
fn curve_by_rates(rates: &[(f64, f64)]) -> SizeCurve {
    let mut points: Vec<(f64, f64)> = rates.first().map(|(depth, _)| (0.0, *depth)).into_iter().collect();
    for pair in rates.windows(2) {
        let [(from, slow), (to, fast)] = [pair[0], pair[1]];
        if !(slow > 0.0 && fast > 0.0 && to > from) {
            break;
        }
        let at = |part: usize| {
            let share = part as f64 / PARTS as f64;
            (from * (to / from).powf(share), slow * (fast / slow).powf(share))
        };
        for part in 1..=PARTS {
            let (before, after) = (at(part - 1), at(part));
            // dN = dz/(dz/dN) = (z/rate) d ln z.
            let cycles = 0.5 * (before.0 / before.1 + after.0 / after.1) * (after.0 / before.0).ln();
            let passed = points.last().map_or(0.0, |last| last.0) + 1e-6 * cycles;
            points.push((passed, after.0));
        }
    }
    SizeCurve::through(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// dz/dN = c z^p gives N = (z1^(1−p) − z0^(1−p))/(c (1 − p)), whatever the depths at which the
    /// rate is known.
    #[test]
    fn a_power_of_the_depth_in_closed_form() {
        for power in [0.0_f64, 0.5, 2.0, 4.0] {
            let c = 1e-6;
            let rates: Vec<(f64, f64)> =
                [0.25_f64, 0.5, 1.0, 3.0, 9.0].iter().map(|&z| (z, c * z.powf(power))).collect();
            let curve = curve_by_rates(&rates);
            let exact =
                |z: f64| 1e-6 * (z.powf(1.0 - power) - 0.25_f64.powf(1.0 - power)) / (c * (1.0 - power));
            for depth in [0.3, 0.8, 2.0, 8.0] {
                let (passed, _) = curve.reaches(depth).unwrap();
                assert!((passed / exact(depth) - 1.0).abs() < 0.01, "z^{power} at {depth}: {passed}");
            }
            let (passed, _) = curve.reaches(9.0).unwrap();
            assert!((passed / exact(9.0) - 1.0).abs() < 2e-3, "z^{power}: {passed}");
        }
    }

    #[test]
    fn a_tip_that_does_not_grow_ends_the_curve() {
        let curve = curve_by_rates(&[(0.25, 1e-7), (1.0, 1e-7), (2.0, 0.0), (4.0, 1e-7)]);
        assert_eq!(curve.ends().1, 1.0);
        assert!(curve.reaches(1.5).is_none() && curve.reaches(0.9).is_some());
        assert_eq!(curve_by_rates(&[]).ends(), (0.0, 0.0));
    }
}
