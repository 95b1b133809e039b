//! `contact.csv`: the running surface under a wheel that feels the cracks.

use super::table;
use railcrack::growth::{FaceRecord, PassageRecord, StepRecord};

/// Micrometres per millimetre.
const MICROMETRES: f64 = 1e3;

table! {
    /// A node of the running surface at a wheel position.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct ContactRow in "contact.csv", [
        "Running surface under a wheel that feels the cracks, during the stabilised passage of each step",
        "step: 0 is the initial geometry; passage, position: from 1; positions as in sif.csv, those at which the wheel feels the cracks",
        "x_mm: abscissa of the node; a mouth has two nodes, of the left and of the right lip",
        "p_mpa: pressure, linear between nodes; gap_um: mean gap between wheel and rail around the node",
        "wheel, of a mix: from 1; every step has the first wheel, the first and the last step have all",
    ] {
        /// As in `sif.csv`.
        step: usize = "step";
        /// As in `sif.csv`.
        passage: usize = "passage";
        /// As in `sif.csv`.
        position: usize = "position";
        /// As in `sif.csv`.
        xc: f64 = "xc_mm";
        /// Abscissa of the surface node, mm; the two nodes of a mouth are those of its left and
        /// right lip.
        x: f64 = "x_mm";
        /// Contact pressure, MPa.
        pressure: f64 = "p_mpa";
        /// Mean gap between wheel and rail over the hat function of the node, µm.
        gap: f64 = "gap_um";
        /// As in `faces.csv`.
        wheel: Option<usize> = "wheel", with "wheel";
    }
}

impl ContactRow {
    /// The rows of a step: wheel by wheel, position by position, node by node.
    pub fn of_step(record: &StepRecord) -> impl Iterator<Item = Self> {
        let all = record.faces_by_wheel().enumerate();
        all.flat_map(|(wheel, (passages, faces))| Self::under(record.step, wheel, passages, faces))
    }

    fn under<'a>(
        step: usize,
        wheel: usize,
        passages: &'a [PassageRecord],
        faces: &'a FaceRecord,
    ) -> impl Iterator<Item = Self> + 'a {
        let positions = passages.last().map_or(&[][..], |passage| &passage.xc);
        faces.surface.iter().zip(positions).enumerate().flat_map(move |(i, (nodes, &xc))| {
            nodes.iter().map(move |node| Self {
                step,
                passage: passages.len(),
                position: i + 1,
                xc,
                x: node.x,
                pressure: node.pressure,
                gap: MICROMETRES * node.gap,
                wheel: Some(wheel + 1),
            })
        })
    }
}
