//! The pressure of a wheel that feels the cracks, at the nodes of the running surface.

use super::faces::by_point;
use super::of_steps::OfSteps;
use super::pack::{Deflated, Quantised};
use super::thinned::Thinned;
use railcrack::growth::StepRecord;
use railcrack_run::OutputError;
use railcrack_run::csv::{ContactRow, StepBlock};
use serde::Serialize;

/// Maximum number of pressures shown that are not zero (nodes × positions × steps), of about two
/// bytes each in a page.
const PRESSURES: usize = 500_000;

/// The pressures of one step as a page holds them: rows by node, in them the positions at which the
/// wheel feels the cracks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct PackedContact {
    /// The first of these positions, from 0.
    first: usize,
    /// Their number.
    positions: usize,
    /// Abscissae of the nodes, mm.
    x: Deflated,
    /// MPa.
    pressure: Quantised,
    /// Number of pressures that are not zero.
    #[serde(skip)]
    loaded: usize,
}

impl PackedContact {
    /// `None` without rows: the cracks of the step have no mouth.
    ///
    /// Errors: the first row that is one.
    fn of_rows(
        rows: impl Iterator<Item = Result<ContactRow, OutputError>>,
    ) -> Result<Option<Self>, OutputError> {
        let rows = rows.collect::<Result<Vec<_>, _>>()?;
        let Some(first) = rows.first().map(|row| row.position) else { return Ok(None) };
        let of_first = rows.iter().take_while(|row| row.position == first);
        let x: Vec<f64> = of_first.map(|row| row.x).collect();
        let (nodes, positions) = (x.len(), rows.len() / x.len());
        let pressures: Vec<f64> = rows.iter().map(|row| row.pressure.max(0.0)).collect();
        Ok(Some(Self {
            first: first - 1,
            positions,
            x: Deflated::singles(&x),
            pressure: Quantised::of(&by_point(&pressures, nodes), positions),
            loaded: pressures.iter().filter(|&&pressure| pressure > 0.0).count(),
        }))
    }
}

/// The pressures of the steps shown, within the size limit: every 2ⁿ-th step.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShownContact {
    pub steps: Thinned<PackedContact>,
}

impl ShownContact {
    pub(crate) fn of_record(record: &StepRecord) -> Result<Option<PackedContact>, OutputError> {
        PackedContact::of_rows(ContactRow::of_step(record).map(Ok))
    }
}

impl OfSteps for ShownContact {
    type OfStep = Option<PackedContact>;
    type TableRow = ContactRow;

    fn keeps(&self, step: usize) -> bool {
        self.steps.is_kept(step)
    }

    fn read(&self, block: &StepBlock<ContactRow>) -> Result<Option<PackedContact>, OutputError> {
        PackedContact::of_rows(block.rows())
    }

    fn push(&mut self, step: usize, part: Option<PackedContact>) {
        if let Some(contact) = part {
            self.steps.push(step, contact);
            self.steps.thin_to(PRESSURES, |contact| contact.loaded);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_by_position_become_rows_by_node() {
        let row = |position: usize, x: f64, pressure: f64| ContactRow {
            step: 0,
            passage: 2,
            position,
            xc: position as f64,
            x,
            pressure,
            gap: 0.0,
        };
        let rows = [row(4, -1.0, 0.0), row(4, 0.0, 800.0), row(5, -1.0, 400.0), row(5, 0.0, -1e-13)];
        let packed = PackedContact::of_rows(rows.into_iter().map(Ok)).unwrap().unwrap();
        assert_eq!((packed.first, packed.positions, packed.loaded), (3, 2, 2));
        assert_eq!(packed.x, Deflated::singles(&[-1.0, 0.0]));
        assert_eq!(packed.pressure, Quantised::of(&[0.0, 400.0, 800.0, 0.0], 2));
        assert_eq!(PackedContact::of_rows(std::iter::empty()).unwrap(), None);
    }
}
