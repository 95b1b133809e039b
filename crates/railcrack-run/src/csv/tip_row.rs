//! `growth.csv` read back.

use super::{GROWTH_COLUMNS, GROWTH_FILE, read_steps};
use crate::OutputError;
use std::path::Path;

/// A row of `growth.csv`: one tip at one step, in the units of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct TipRow {
    pub step: usize,
    /// From 1.
    pub crack: usize,
    /// From 1 within its crack.
    pub tip: usize,
    pub place: [f64; 2],
    /// With what waits at the tips of the crack ([`waiting`]).
    pub length: f64,
    pub ki_max: f64,
    pub delta_ki: f64,
    pub delta_kii: f64,
    pub delta_keq: f64,
    pub kink_deg: Option<f64>,
    pub rival_deg: Option<f64>,
    pub rival_ratio: Option<f64>,
    pub increment: f64,
    pub rate: f64,
    pub load_cycles: f64,
    pub stop: String,
}

/// Growth (mm) of the tip of `row` that is not in its crack yet: its increments since it came to where it is. `growth` holds all rows of the run.
pub fn waiting(growth: &[TipRow], row: &TipRow) -> f64 {
    let before = growth
        .iter()
        .rev()
        .filter(|other| other.step < row.step && (other.crack, other.tip) == (row.crack, row.tip));
    before.take_while(|other| other.place == row.place).map(|other| other.increment).sum()
}

/// The rows of the first `steps` steps of the run in `folder`, by step, crack, tip.
///
/// Errors: the table is damaged; the system refuses.
pub fn read_growth(folder: &Path, steps: usize) -> Result<Vec<TipRow>, OutputError> {
    let mut growth = Vec::new();
    read_steps(
        &folder.join(GROWTH_FILE),
        &GROWTH_COLUMNS,
        |step| step < steps,
        |row| {
            growth.push(TipRow {
                step: row.count(0)?,
                crack: row.count(1)?,
                tip: row.count(2)?,
                place: [row.real(3)?, row.real(4)?],
                length: row.real(5)?,
                ki_max: row.real(6)?,
                delta_ki: row.real(7)?,
                delta_kii: row.real(8)?,
                delta_keq: row.real(9)?,
                kink_deg: row.optional(10)?,
                rival_deg: row.optional(11)?,
                rival_ratio: row.optional(12)?,
                increment: row.real(13)?,
                rate: row.real(14)?,
                load_cycles: row.real(15)?,
                stop: row.text(16).to_owned(),
            });
            Ok(())
        },
    )?;
    Ok(growth)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step: usize, tip: usize, x: f64, increment: f64) -> TipRow {
        TipRow {
            step,
            crack: 1,
            tip,
            place: [x, -1.0],
            length: 2.0,
            ki_max: 0.0,
            delta_ki: 0.0,
            delta_kii: 0.0,
            delta_keq: 0.0,
            kink_deg: None,
            rival_deg: None,
            rival_ratio: None,
            increment,
            rate: 0.0,
            load_cycles: 0.0,
            stop: String::new(),
        }
    }

    #[test]
    fn what_waits_are_the_increments_since_the_tip_moved() {
        let growth: Vec<TipRow> = (0..6)
            .flat_map(|step| {
                let slow = if step < 2 { 0.0 } else { 1.0 };
                [row(step, 1, step as f64, 1.0), row(step, 2, slow, 0.1 * (1 + step) as f64)]
            })
            .collect();
        let expected = [0.0, 0.1, 0.0, 0.3, 0.3 + 0.4, 0.3 + 0.4 + 0.5];
        for (pair, expected) in growth.chunks(2).zip(expected) {
            assert_eq!(waiting(&growth, &pair[0]), 0.0);
            assert!((waiting(&growth, &pair[1]) - expected).abs() < 1e-12, "step {}", pair[1].step);
        }
    }
}
