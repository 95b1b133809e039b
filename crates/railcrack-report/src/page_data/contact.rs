//! The pressure of a wheel that feels the cracks, at the nodes of the running surface.

use super::faces::by_point;
use super::pack::{Deflated, Quantised};
use super::step_table::StepTable;
use super::thinned::Thinned;
use railcrack::growth::StepRecord;
use railcrack_run::OutputError;
use railcrack_run::csv::{ContactRow, StepBlock};
use serde::Serialize;
use std::collections::BTreeMap;

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
    fn of_rows(rows: &[ContactRow]) -> Option<Self> {
        let first = rows.first()?.position;
        let of_first = rows.iter().take_while(|row| row.position == first);
        let x: Vec<f64> = of_first.map(|row| row.x).collect();
        let (nodes, positions) = (x.len(), rows.len() / x.len());
        let pressures: Vec<f64> = rows.iter().map(|row| row.pressure.max(0.0)).collect();
        Some(Self {
            first: first.saturating_sub(1),
            positions,
            x: Deflated::singles(&x),
            pressure: Quantised::of(&by_point(&pressures, nodes), positions),
            loaded: pressures.iter().filter(|&&pressure| pressure > 0.0).count(),
        })
    }
}

/// The pressures of one step by wheel, from 1; those wheels that feel no cracks have none.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ContactOfStep(BTreeMap<usize, PackedContact>);

impl ContactOfStep {
    /// Errors: the first row that is one.
    fn of_rows(rows: impl Iterator<Item = Result<ContactRow, OutputError>>) -> Result<Self, OutputError> {
        let mut wheels: BTreeMap<usize, Vec<ContactRow>> = BTreeMap::new();
        for row in rows {
            let row = row?;
            wheels.entry(row.wheel.unwrap_or(1)).or_default().push(row);
        }
        let packed = |(wheel, rows): (usize, Vec<ContactRow>)| Some((wheel, PackedContact::of_rows(&rows)?));
        Ok(Self(wheels.into_iter().filter_map(packed).collect()))
    }
}

/// The pressures of the steps shown, within the size limit: every 2ⁿ-th step. Of the other wheels
/// of a mix the first and the last step, as many wheels as fit into the same limit.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactData {
    steps: Thinned<PackedContact>,
    others: Vec<(usize, ContactOfStep)>,
}

impl ContactData {
    pub(crate) fn of_record(record: &StepRecord) -> Result<ContactOfStep, OutputError> {
        ContactOfStep::of_rows(ContactRow::of_step(record).map(Ok))
    }

    /// The pressures under `wheel`, from 0, in a step that is shown.
    pub(crate) fn under(&self, wheel: usize, step: usize) -> Option<&PackedContact> {
        if wheel == 0 {
            return self.steps.get(step);
        }
        let up_to = self.others.iter().flat_map(|(_, of_step)| of_step.0.range(..=wheel + 1));
        let loaded: usize = up_to.map(|(_, contact)| contact.loaded).sum();
        let (_, of_step) = self.others.iter().find(|(at, _)| *at == step)?;
        of_step.0.get(&(wheel + 1)).filter(|_| loaded <= PRESSURES)
    }
}

impl StepTable for ContactData {
    type OfStep = ContactOfStep;
    type TableRow = ContactRow;

    fn keeps(&self, step: usize) -> bool {
        self.steps.is_kept(step)
    }

    fn read(&self, block: &StepBlock<ContactRow>) -> Result<ContactOfStep, OutputError> {
        ContactOfStep::of_rows(block.rows())
    }

    fn push(&mut self, step: usize, part: ContactOfStep) {
        let ContactOfStep(mut wheels) = part;
        let first = wheels.remove(&1);
        if !wheels.is_empty() {
            self.others.truncate(1);
            self.others.push((step, ContactOfStep(wheels)));
        }
        if let Some(contact) = first {
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
            wheel: None,
        };
        let rows = [row(4, -1.0, 0.0), row(4, 0.0, 800.0), row(5, -1.0, 400.0), row(5, 0.0, -1e-13)];
        let of_step = ContactOfStep::of_rows(rows.into_iter().map(Ok)).unwrap();
        let packed = &of_step.0[&1];
        assert_eq!((packed.first, packed.positions, packed.loaded), (3, 2, 2));
        assert_eq!(packed.x, Deflated::singles(&[-1.0, 0.0]));
        assert_eq!(packed.pressure, Quantised::of(&[0.0, 400.0, 800.0, 0.0], 2));
        assert_eq!(ContactOfStep::of_rows(std::iter::empty()).unwrap(), ContactOfStep::default());
    }

    #[test]
    fn a_second_wheel_has_its_own_pressures_in_the_first_and_the_last_step() {
        let row = |step: usize, wheel: usize| ContactRow {
            step,
            passage: 2,
            position: 3,
            xc: 0.0,
            x: 1.0,
            pressure: (100 * wheel + step) as f64,
            gap: 0.0,
            wheel: Some(wheel),
        };
        let mut shown = ContactData::default();
        for (step, wheels) in [(0, 2..=3), (1, 1..=1), (2, 1..=3)] {
            let rows = wheels.map(|wheel| Ok(row(step, wheel)));
            let part = ContactOfStep::of_rows(rows).unwrap();
            shown.push(step, part);
        }
        let there = |wheel: usize| [0, 1, 2].map(|step| shown.under(wheel, step).cloned());
        let packed = |step: usize, wheel: usize| PackedContact::of_rows(&[row(step, wheel)]);
        assert_eq!(there(0), [None, packed(1, 1), packed(2, 1)]);
        assert_eq!(there(1), [packed(0, 2), None, packed(2, 2)]);
        assert_eq!(there(2), [packed(0, 3), None, packed(2, 3)]);
        assert_eq!(there(3), [None, None, None]);
    }
}
