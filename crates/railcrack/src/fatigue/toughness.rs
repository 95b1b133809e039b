//! Fracture toughness by temperature.

use crate::math::OutOfRange;
use thiserror::Error;

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
