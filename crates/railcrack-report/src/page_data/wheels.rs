//! K in the last step under every wheel of a mix.

use super::step_table::StepTable;
use railcrack::fracture::Sif;
use railcrack::growth::{PassageRecord, StepRecord, TipRecord};
use railcrack_run::OutputError;
use railcrack_run::csv::{SifRow, StepBlock};

/// K of one tip over the stabilised passage of one wheel.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct UnderWheel {
    /// The wheel, from 1.
    pub wheel: usize,
    /// Crack and tip, from 1.
    pub tip: (usize, usize),
    /// x_c (mm), K_I and K_II (MPa√m) by position.
    pub points: Vec<[f64; 3]>,
}

/// K of all tips in the last step under all wheels of a mix; empty under one wheel.
#[derive(Debug, Clone, Default)]
pub(crate) struct WheelData {
    pub last: Vec<UnderWheel>,
}

impl WheelData {
    /// Of a recorded step.
    pub fn of_record(record: &StepRecord) -> Vec<UnderWheel> {
        if record.other_wheels.is_empty() {
            return Vec::new();
        }
        let all = std::iter::once(&record.passages).chain(&record.other_wheels).enumerate();
        let of_wheel = |(wheel, passages): (usize, &Vec<PassageRecord>)| {
            let last = passages.last();
            let of_tip = move |passage: &PassageRecord| {
                let tips = record.tips.iter().zip(&passage.sifs);
                let under = |(tip, sifs): (&TipRecord, &Vec<Sif>)| {
                    let at = passage.xc.iter().zip(sifs);
                    UnderWheel {
                        wheel: wheel + 1,
                        tip: (tip.tip.crack + 1, tip.tip.tip + 1),
                        points: at.map(|(&xc, k)| [xc, k.ki_mpa_sqrt_m(), k.kii_mpa_sqrt_m()]).collect(),
                    }
                };
                tips.map(under).collect::<Vec<_>>()
            };
            last.map(of_tip).unwrap_or_default()
        };
        all.flat_map(of_wheel).collect()
    }
}

impl StepTable for WheelData {
    type OfStep = Vec<UnderWheel>;
    type TableRow = SifRow;

    fn keeps(&self, _: usize) -> bool {
        false
    }

    fn read(&self, block: &StepBlock<SifRow>) -> Result<Vec<UnderWheel>, OutputError> {
        let mut all: Vec<UnderWheel> = Vec::new();
        let mut passage = 0;
        for row in block.rows() {
            let row = row?;
            let (wheel, tip) = (row.wheel.unwrap_or(1), (row.crack, row.tip));
            // The last passage of a wheel is the stabilised one.
            if row.passage != passage {
                all.retain(|under| under.wheel != wheel);
                passage = row.passage;
            }
            if all.last().is_none_or(|under| (under.wheel, under.tip) != (wheel, tip)) {
                all.push(UnderWheel { wheel, tip, points: Vec::new() });
            }
            if let Some(under) = all.last_mut() {
                under.points.push([row.xc, row.ki, row.kii]);
            }
        }
        let is_mix = all.last().is_some_and(|under| under.wheel > 1);
        Ok(if is_mix { all } else { Vec::new() })
    }

    fn push(&mut self, _: usize, part: Vec<UnderWheel>) {
        self.last = part;
    }
}
