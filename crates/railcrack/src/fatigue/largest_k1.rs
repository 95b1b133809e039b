//! Brittle fracture: the largest k1 over virtual kinks, and the toughness of the steel.

use super::{KINK_ANGLES, KinkFunctions};
use crate::fracture::{Sif, SifHistory};
use crate::math::{MPA_SQRT_MM, OutOfRange, Ties, golden_section};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The largest k1 of a history, over its samples and over kink angles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LargestK1 {
    /// k1, MPa √mm, positive.
    pub k1: f64,
    /// β of the kink, radians, counter-clockwise positive from straight ahead.
    pub angle: f64,
    /// Index of the sample of the history in which it is reached, from 0.
    pub sample: usize,
}

impl LargestK1 {
    /// The largest k1 of `history`; none if no kink opens, or if samples are not finite.
    ///
    /// β is searched in [`KINK_ANGLES`] on a grid of 1° and refined by golden section. Under K_I
    /// alone it is 0 and k1 = K_I, under K_II alone ∓76.6° and k1 = 1.2316 |K_II|.
    pub fn of(history: &SifHistory) -> Option<Self> {
        if !history.samples.iter().all(|k| k.ki.is_finite() && k.kii.is_finite()) {
            return None;
        }
        let samples = history.samples.iter().enumerate();
        let best = samples.map(|(sample, &tip)| (sample, tip, coarse(tip)));
        let best = best.filter(|(_, _, (k1, _))| *k1 > 0.0).reduce(|a, b| if b.2.0 > a.2.0 { b } else { a });
        let (sample, tip, (_, angle)) = best?;
        let (k1, angle) = refined(tip, angle);
        Some(Self { k1, angle, sample })
    }

    /// k1, MPa √m.
    pub fn k1_mpa_sqrt_m(&self) -> f64 {
        self.k1 / MPA_SQRT_MM
    }
}

/// Step of 1°: near its maximum k1 varies by 2e-4 over half a step.
const GRID_STEP: f64 = std::f64::consts::PI / 180.0;
/// The grid, and its functions.
static GRID: std::sync::LazyLock<Vec<(f64, KinkFunctions)>> = std::sync::LazyLock::new(|| {
    let last = (*KINK_ANGLES.end() / GRID_STEP).round() as i32;
    (-last..=last).map(|i| GRID_STEP * f64::from(i)).map(|angle| (angle, KinkFunctions::at(angle))).collect()
});

/// The largest k1 of `tip` on the grid and its angle; of equal values the one nearest to straight
/// ahead.
fn coarse(tip: Sif) -> (f64, f64) {
    let opened = GRID.iter().map(|(angle, functions)| (functions.kinked(tip).k1, *angle));
    opened.fold((0.0, 0.0), |best, (k1, angle)| {
        if k1 > best.0 || (k1 == best.0 && angle.abs() < best.1.abs()) { (k1, angle) } else { best }
    })
}

fn refined(tip: Sif, around: f64) -> (f64, f64) {
    let k1 = |angle: f64| KinkFunctions::at(angle).kinked(tip).k1;
    let from = f64::max(*KINK_ANGLES.start(), around - GRID_STEP);
    let to = f64::min(*KINK_ANGLES.end(), around + GRID_STEP);
    // GRID_STEP · 0.618^30 = 1e-8 rad: round-off of a maximum.
    let angle = golden_section([from, to], 30, Ties::First, k1);
    // Straight ahead and the ends of the range are angles of the grid.
    if k1(around) >= k1(angle) { (k1(around), around) } else { (k1(angle), angle) }
}

/// K_Ic by temperature: linear between rows, constant beyond the first and the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Toughness {
    /// (temperature °C, K_Ic MPa√m), temperatures increasing.
    rows: Vec<(f64, f64)>,
}

/// An invalid toughness table.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ToughnessError {
    /// No rows.
    #[error("rows = 0: a toughness needs at least one")]
    Empty,
    /// A value outside its admissible range.
    #[error("row {row}: {reason}")]
    Row {
        /// Row, from 1.
        row: usize,
        /// The quantity, its value and its admissible range.
        reason: OutOfRange,
    },
}

impl Toughness {
    /// K_Ic = `toughness` (MPa√m) at all temperatures.
    pub fn constant(toughness: f64) -> Result<Self, OutOfRange> {
        OutOfRange::unless_positive("toughness_mpa_sqrt_m", toughness)?;
        Ok(Self { rows: vec![(0.0, toughness)] })
    }

    /// K_Ic of `rows` (temperature °C, K_Ic MPa√m).
    ///
    /// Errors: no rows; temperatures that do not increase; values that are not positive and finite.
    pub fn by_temperature(rows: Vec<(f64, f64)>) -> Result<Self, ToughnessError> {
        if rows.is_empty() {
            return Err(ToughnessError::Empty);
        }
        for (i, &(temperature, toughness)) in rows.iter().enumerate() {
            let before = if i == 0 { f64::NEG_INFINITY } else { rows[i - 1].0 };
            let increases = temperature > before && temperature.is_finite();
            OutOfRange::unless(
                increases,
                "temperature_c",
                temperature,
                "finite and greater than in the row before",
            )
            .and_then(|()| OutOfRange::unless_positive("toughness_mpa_sqrt_m", toughness))
            .map_err(|reason| ToughnessError::Row { row: i + 1, reason })?;
        }
        Ok(Self { rows })
    }

    /// K_Ic at `temperature` (°C), MPa√m.
    pub fn at(&self, temperature: f64) -> f64 {
        let next = self.rows.partition_point(|row| row.0 < temperature);
        match (next.checked_sub(1).map(|i| self.rows[i]), self.rows.get(next)) {
            (Some(before), Some(after)) => {
                before.1 + (after.1 - before.1) * (temperature - before.0) / (after.0 - before.0)
            }
            (Some(only), None) => only.1,
            (None, first) => first.map_or(f64::NAN, |first| first.1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(samples: &[(f64, f64)]) -> Option<LargestK1> {
        let samples = samples.iter().map(|&(ki, kii)| Sif { ki, kii }).collect();
        LargestK1::of(&SifHistory { samples })
    }

    #[test]
    fn opening_goes_straight_on_and_shear_turns() {
        let straight = of(&[(0.0, 0.0), (7.0, 0.0), (3.0, 0.0)]).unwrap();
        assert_eq!((straight.k1, straight.angle, straight.sample), (7.0, 0.0, 1));
        // docs/conventions.md: β = −76.6°, k1 = 1.2316 K_II.
        for sign in [1.0, -1.0] {
            let sheared = of(&[(0.0, sign * 10.0), (1.0, 0.0)]).unwrap();
            assert!((sheared.k1 - 12.316).abs() < 1e-3 && sheared.sample == 0, "{sheared:?}");
            assert!((sheared.angle.to_degrees() + sign * 76.6).abs() < 0.1, "{sheared:?}");
        }
    }

    #[test]
    fn a_tip_that_closes_opens_no_kink() {
        assert_eq!(of(&[(-3.0, 0.0), (0.0, 0.0)]), None);
        assert_eq!(of(&[]), None);
        assert_eq!(of(&[(f64::NAN, 1.0)]), None);
    }

    #[test]
    fn linear_between_rows_and_constant_beyond() {
        let table = Toughness::by_temperature(vec![(-40.0, 20.0), (0.0, 30.0), (20.0, 40.0)]).unwrap();
        assert_eq!(
            [-60.0, -40.0, -20.0, 0.0, 10.0, 50.0].map(|t| table.at(t)),
            [20., 20., 25., 30., 35., 40.]
        );
        assert_eq!(Toughness::constant(29.0).unwrap().at(-300.0), 29.0);
    }

    #[test]
    fn refused_with_row_and_value() {
        let message = |rows| Toughness::by_temperature(rows).unwrap_err().to_string();
        assert!(message(vec![]).starts_with("rows = 0"));
        assert!(
            message(vec![(0.0, 29.0), (0.0, 30.0)])
                .starts_with("row 2: temperature_c = 0: must be finite and")
        );
        assert!(message(vec![(0.0, -1.0)]).starts_with("row 1: toughness_mpa_sqrt_m = -1: must be positive"));
        assert!(Toughness::constant(0.0).is_err());
    }
}
