//! Wheel–rail contact given by a table of pressure and shear.

use super::contact_kind::{ContactKind, LineContact};
use crate::math::OutOfRange;
use thiserror::Error;

/// Pressure and shear at one abscissa of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRow {
    /// Abscissa from x_c, mm.
    pub u: f64,
    /// p, MPa, not negative.
    pub pressure: f64,
    /// q, MPa, along +x on the rail.
    pub shear: f64,
}

/// An invalid contact table.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ContactTableError {
    /// Fewer than three rows: a contact begins and ends at zero.
    #[error("rows = {count}: a contact needs at least 3, the first and the last without pressure")]
    TooFewRows {
        /// The number of rows.
        count: usize,
    },
    /// A value outside its admissible range.
    #[error("row {row}: {reason}")]
    Row {
        /// Row, from 1.
        row: usize,
        /// The quantity, its value and its admissible range.
        reason: OutOfRange,
    },
    /// No pressure anywhere.
    #[error("p_mpa = 0 in all rows: must be positive in one at least")]
    NoPressure,
}

/// Any pressure p(u) and shear q(u) under the wheel, u = x − x_c: linear between rows, zero
/// outside. Rows of zeros separate several patches.
#[derive(Debug, Clone, PartialEq)]
pub struct TableContact {
    rows: Vec<ContactRow>,
}

/// Fraction of the largest μ p by which |q| may exceed μ p, for numbers rounded in a file.
const ROUNDING: f64 = 1e-3;

impl TableContact {
    /// The contact of `rows`. Where `friction` (μ) is given, |q| ≤ μ p is required, up to the
    /// rounding of numbers in a file.
    ///
    /// Errors: fewer than three rows; values that are not finite; u that does not increase;
    /// negative pressure; pressure or shear in the first or last row, where a step of the traction
    /// makes the stress infinite; more shear than friction allows; no pressure at all.
    pub fn new(rows: Vec<ContactRow>, friction: Option<f64>) -> Result<Self, ContactTableError> {
        let [.., last] = &rows[..] else { return Err(ContactTableError::TooFewRows { count: 0 }) };
        let (count, last) = (rows.len(), last.u);
        if count < 3 {
            return Err(ContactTableError::TooFewRows { count });
        }
        if let Some(friction) = friction {
            let fine = friction >= 0.0;
            OutOfRange::unless(fine, "wheel\u{2013}rail friction", friction, "zero or more")
                .map_err(|reason| ContactTableError::Row { row: 1, reason })?;
        }
        let peak = rows.iter().fold(0.0f64, |peak, row| peak.max(row.pressure));
        for (i, row) in rows.iter().enumerate() {
            let at_end = i == 0 || row.u == last;
            let before = if i == 0 { f64::NEG_INFINITY } else { rows[i - 1].u };
            check_row(row, before, at_end, friction, peak)
                .map_err(|reason| ContactTableError::Row { row: i + 1, reason })?;
        }
        if peak == 0.0 { Err(ContactTableError::NoPressure) } else { Ok(Self { rows }) }
    }

    /// Pressure and shear multiplied by `scale`.
    ///
    /// Errors: a scale that is not positive and finite.
    pub fn scaled(&self, scale: f64) -> Result<Self, OutOfRange> {
        OutOfRange::unless_positive("scale of the contact table", scale)?;
        let times = |row: &ContactRow| ContactRow {
            pressure: scale * row.pressure,
            shear: scale * row.shear,
            ..*row
        };
        Ok(Self { rows: self.rows.iter().map(times).collect() })
    }

    /// The mirror image, which is the contact of a wheel that runs in the opposite direction.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mirror = |row: &ContactRow| ContactRow { u: -row.u, shear: -row.shear, ..*row };
        Self { rows: self.rows.iter().rev().map(mirror).collect() }
    }

    /// The rows by increasing u.
    pub fn rows(&self) -> &[ContactRow] {
        &self.rows
    }

    /// Half the extent of the table, mm.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.rows[self.rows.len() - 1].u - self.rows[0].u)
    }

    /// The middle of the table, mm from x_c.
    pub(crate) fn middle(&self) -> f64 {
        0.5 * (self.rows[self.rows.len() - 1].u + self.rows[0].u)
    }

    /// The largest pressure, MPa.
    pub fn peak_pressure(&self) -> f64 {
        self.rows.iter().fold(0.0, |peak, row| peak.max(row.pressure))
    }

    /// ∫ p du, N/mm.
    pub fn line_load(&self) -> f64 {
        self.integral(|row| row.pressure)
    }

    /// ∫ q du, N/mm along +x on the rail.
    pub(crate) fn shear_load(&self) -> f64 {
        self.integral(|row| row.shear)
    }

    /// ∫ (u − middle) q du, N.
    pub(crate) fn shear_moment(&self) -> f64 {
        let middle = self.middle();
        self.integral(|row| (row.u - middle) * row.shear)
    }

    /// The largest |q|/p over the rows with at least a thousandth of the largest pressure.
    pub fn largest_friction(&self) -> f64 {
        let least = ROUNDING * self.peak_pressure();
        let pressed = self.rows.iter().filter(|row| row.pressure > least);
        pressed.fold(0.0, |most, row| most.max(row.shear.abs() / row.pressure))
    }

    /// Abscissae from x_c of the ends of the patches, where the traction begins or ceases, mm,
    /// increasing.
    pub(crate) fn edges(&self) -> Vec<f64> {
        let loaded = |row: &ContactRow| row.pressure != 0.0 || row.shear != 0.0;
        let rows = &self.rows;
        let edge = |i: &usize| {
            let before = *i > 0 && loaded(&rows[i - 1]);
            let after = *i + 1 < rows.len() && loaded(&rows[i + 1]);
            !loaded(&rows[*i]) && (before || after)
        };
        (0..rows.len()).filter(edge).map(|i| rows[i].u).collect()
    }

    fn integral(&self, of: impl Fn(&ContactRow) -> f64) -> f64 {
        self.rows.windows(2).map(|pair| 0.5 * (of(&pair[0]) + of(&pair[1])) * (pair[1].u - pair[0].u)).sum()
    }
}

fn check_row(
    row: &ContactRow,
    before: f64,
    at_end: bool,
    friction: Option<f64>,
    peak: f64,
) -> Result<(), OutOfRange> {
    let &ContactRow { u, pressure, shear } = row;
    OutOfRange::unless_finite("u_mm", u)?;
    OutOfRange::unless_finite("p_mpa", pressure)?;
    OutOfRange::unless_finite("q_mpa", shear)?;
    OutOfRange::unless(u > before, "u_mm", u, "greater than in the row before")?;
    OutOfRange::unless(pressure >= 0.0, "p_mpa", pressure, "zero or more")?;
    if at_end {
        let none = "zero in the first and last row, or the stress is infinite there";
        OutOfRange::unless(pressure == 0.0, "p_mpa", pressure, none)?;
        OutOfRange::unless(shear == 0.0, "q_mpa", shear, none)?;
    }
    let Some(friction) = friction else { return Ok(()) };
    let most = friction * (pressure + ROUNDING * peak);
    OutOfRange::unless(shear.abs() <= most, "q_mpa", shear, "at most the given friction times p_mpa")
}

impl LineContact for TableContact {
    fn kind(&self) -> ContactKind {
        ContactKind::Table
    }

    fn checked(&self) -> Result<(), OutOfRange> {
        // It is checked where it is made.
        Ok(())
    }

    fn highest_pressure(&self) -> f64 {
        self.peak_pressure()
    }

    fn half_extent(&self) -> f64 {
        self.half_width()
    }

    fn offset(&self) -> f64 {
        self.middle()
    }

    fn normal_force(&self) -> f64 {
        self.line_load()
    }

    fn force_ratio(&self) -> f64 {
        self.shear_load() / self.line_load()
    }

    fn shear_ratio(&self) -> f64 {
        self.largest_friction()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(of: &[(f64, f64, f64)]) -> Vec<ContactRow> {
        of.iter().map(|&(u, pressure, shear)| ContactRow { u, pressure, shear }).collect()
    }

    #[test]
    fn loads_edges_and_extent_of_two_patches() {
        let two = rows(&[
            (-5.0, 0.0, 0.0),
            (-3.0, 100.0, 10.0),
            (-2.0, 0.0, 0.0),
            (-1.0, 0.0, 0.0),
            (1.0, 200.0, -60.0),
            (4.0, 0.0, 0.0),
        ]);
        let table = TableContact::new(two, None).unwrap();
        assert_eq!(table.edges(), [-5.0, -2.0, -1.0, 4.0]);
        assert_eq!((table.half_width(), table.middle(), table.peak_pressure()), (4.5, -0.5, 200.0));
        assert_eq!((table.line_load(), table.shear_load()), (150.0 + 500.0, 15.0 - 150.0));
        assert!((table.largest_friction() - 0.3).abs() < 1e-15);
        assert_eq!(table.scaled(2.0).unwrap().line_load(), 1300.0);
        assert!(table.scaled(0.0).is_err());
    }

    #[test]
    fn tables_that_are_no_contact_are_refused_with_row_value_and_what_is_accepted() {
        let message =
            |of: &[(f64, f64, f64)], friction| TableContact::new(rows(of), friction).unwrap_err().to_string();
        let hill = [(-1.0, 0.0, 0.0), (0.0, 100.0, 30.0), (1.0, 0.0, 0.0)];
        let with = |i: usize, row| {
            let mut changed = hill;
            changed[i] = row;
            changed
        };
        assert!(TableContact::new(rows(&hill), Some(0.3)).is_ok());
        assert!(message(&[], None).starts_with("rows = 0"));
        assert!(message(&hill[..1], None).starts_with("rows = 1: a contact needs at least 3"));
        assert!(
            message(&with(1, (0.0, -5.0, 0.0)), None).contains("row 2: p_mpa = -5: must be zero or more")
        );
        assert!(
            message(&with(2, (1.0, 7.0, 0.0)), None).contains("row 3: p_mpa = 7: must be zero in the first")
        );
        assert!(message(&with(0, (-1.0, 0.0, 3.0)), None).contains("row 1: q_mpa = 3"));
        assert!(message(&with(1, (-1.0, 9.0, 0.0)), None).contains("u_mm = -1: must be greater"));
        assert!(message(&with(1, (0.0, 9.0, f64::NAN)), None).contains("q_mpa = NaN: must be finite"));
        assert!(message(&hill, Some(0.2)).contains("row 2: q_mpa = 30: must be at most"));
        assert!(message(&hill, Some(-0.2)).contains("friction = -0.2"));
        assert!(message(&with(1, (0.0, 0.0, 0.0)), None).starts_with("p_mpa = 0 in all rows"));
    }
}
