//! Measured growth rates as a table.

use super::rate_law::{Law, LawDeclaration, LawInput};
use crate::math::OutOfRange;
use crate::words::Word;
use std::sync::Arc;
use thiserror::Error;

/// Rates (mm per cycle) by equivalent range (MPa√m): log-log linear between rows. Below the first
/// row nothing grows; beyond the last the last slope goes on.
#[derive(Debug, Clone, PartialEq)]
pub struct RateTable {
    rows: Arc<[(f64, f64)]>,
}

/// Rows that do not form a rate table.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum RateTableError {
    /// Fewer than two rows.
    #[error("{rows} rows: a table of rates needs at least two")]
    TooShort {
        /// How many there are.
        rows: usize,
    },
    /// A value that is not accepted.
    #[error("row {row}: {reason}")]
    Row {
        /// Row, from 1.
        row: usize,
        /// Which quantity, its value, what is accepted.
        reason: OutOfRange,
    },
}

impl RateTable {
    /// The table of `rows` (ΔK_eq in MPa√m, da/dN in mm per cycle).
    ///
    /// Errors: fewer than two rows; ranges that do not increase; rates that are not positive.
    pub fn new(rows: Vec<(f64, f64)>) -> Result<Self, RateTableError> {
        if rows.len() < 2 {
            return Err(RateTableError::TooShort { rows: rows.len() });
        }
        for (i, &(delta, rate)) in rows.iter().enumerate() {
            let before = if i == 0 { 0.0 } else { rows[i - 1].0 };
            let increases = delta > before && delta.is_finite();
            let accepted = "finite, positive and greater than in the row before";
            OutOfRange::unless(increases, "delta_keq_mpa_sqrt_m", delta, accepted)
                .and_then(|()| OutOfRange::unless_positive("rate_mm_per_cycle", rate))
                .map_err(|reason| RateTableError::Row { row: i + 1, reason })?;
        }
        Ok(Self { rows: rows.into() })
    }

    /// The rows (ΔK_eq in MPa√m, da/dN in mm per cycle).
    #[must_use]
    pub fn rows(&self) -> &[(f64, f64)] {
        &self.rows
    }

    /// The table with all its rates times `factor`.
    pub(super) fn times(&self, factor: f64) -> Self {
        Self { rows: self.rows.iter().map(|&(delta, rate)| (delta, rate * factor)).collect() }
    }

    /// The smallest and the largest range that it covers, MPa√m.
    #[must_use]
    pub fn covers(&self) -> (f64, f64) {
        (self.rows[0].0, self.rows[self.rows.len() - 1].0)
    }
}

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration =
    LawDeclaration { word: Word::now("table", "measured rates"), own_range: None, input: LawInput::Table };

impl Law for RateTable {
    fn rate(&self, delta: f64, _: f64) -> f64 {
        if delta < self.rows[0].0 {
            return 0.0;
        }
        let next = self.rows.partition_point(|row| row.0 <= delta).clamp(1, self.rows.len() - 1);
        let ((d0, r0), (d1, r1)) = (self.rows[next - 1], self.rows[next]);
        r0 * (delta / d0).powf((r1 / r0).ln() / (d1 / d0).ln())
    }

    fn formula(&self) -> String {
        let (low, high) = self.covers();
        format!("a table of {} rows from dK = {low} to {high}", self.rows.len())
    }

    /// Of the table as a whole.
    fn exponent(&self) -> f64 {
        let ((d0, r0), (d1, r1)) = (self.rows[0], self.rows[self.rows.len() - 1]);
        (r1 / r0).ln() / (d1 / d0).ln()
    }

    fn constants(&self) -> Vec<f64> {
        Vec::new()
    }
}
