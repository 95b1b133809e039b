//! Histories of the stress intensity factors over the stabilised passages.

use crate::csv::SifRow;
use crate::error::OutputError;

/// K of one tip over the stabilised passage of one step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// Growth step, from 0.
    pub step: usize,
    /// Crack, from 1.
    pub crack: usize,
    /// Tip of the crack, from 1.
    pub tip: usize,
    /// x_c/a by position.
    pub xc_over_a: Vec<f64>,
    /// K_I, MPa√m.
    pub ki: Vec<f64>,
    /// K_II, MPa√m.
    pub kii: Vec<f64>,
    /// K_III in space, MPa√m; empty in the plane.
    pub kiii: Vec<f64>,
    /// Pressure of the fluid in the crack, MPa; empty for dry cracks.
    pub pressure: Vec<f64>,
    /// Volume of the crack with fluid per unit width, mm²; empty for dry cracks.
    pub volume: Vec<f64>,
    /// How much farther a wheel that feels the cracks approaches the rail, µm; none by position
    /// where it does not feel them.
    pub approach: Vec<Option<f64>>,
    /// Contact load within 0.1 a of the mouth of the crack, N/mm, in the same way.
    pub lip_load: Vec<Option<f64>>,
}

impl History {
    /// Histories of every tip under the first wheel, in the rows of one growth step, in their
    /// order.
    ///
    /// Errors: the first row that is one.
    pub fn of_step(
        rows: impl Iterator<Item = Result<SifRow, OutputError>>,
    ) -> Result<Vec<Self>, OutputError> {
        // Those of the first wheel of a mix stand first.
        let is_first = |row: &Result<SifRow, OutputError>| !matches!(row, Ok(row) if row.wheel.is_some_and(|wheel| wheel > 1));
        Ok(Self::by_wheel(rows.take_while(is_first))?.into_iter().next().unwrap_or_default())
    }

    /// Histories of every tip under every wheel, in the rows of one growth step, in their order.
    ///
    /// Errors: the first row that is one.
    pub fn by_wheel(
        rows: impl Iterator<Item = Result<SifRow, OutputError>>,
    ) -> Result<Vec<Vec<Self>>, OutputError> {
        let mut wheels: Vec<Vec<Self>> = Vec::new();
        let (mut wheel, mut passage) = (0, 0);
        for row in rows {
            let row = row?;
            let own = row.wheel.unwrap_or(1);
            if own != wheel || wheels.is_empty() {
                (wheel, passage) = (own, row.passage);
                wheels.push(Vec::new());
            }
            let Some(histories) = wheels.last_mut() else { continue };
            // The last passage of a wheel is the stabilised one: a later passage replaces an
            // earlier one.
            if row.passage != passage {
                passage = row.passage;
                histories.clear();
            }
            let SifRow { step, crack, tip, .. } = row;
            if histories.last().is_none_or(|h| (h.crack, h.tip) != (crack, tip)) {
                histories.push(Self { step, crack, tip, ..Self::default() });
            }
            if let Some(history) = histories.last_mut() {
                history.xc_over_a.push(row.xc_over_a);
                history.ki.push(row.ki);
                history.kii.push(row.kii);
                history.kiii.extend(row.kiii);
                history.pressure.extend(row.fluid_pressure);
                history.volume.extend(row.fluid_volume);
                history.approach.push(row.approach);
                history.lip_load.push(row.lip_load);
            }
        }
        Ok(wheels)
    }
}
