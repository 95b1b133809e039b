//! `faces.csv`: the crack faces during the stabilised passage.

use super::{Rows, header};
use railcrack::body::FacePoint;
use railcrack::contact::FaceStatus;
use railcrack::growth::StepRecord;

pub const FACES_FILE: &str = "faces.csv";

/// Columns of `faces.csv`.
pub const FACES_COLUMNS: [&str; 11] = [
    "step",
    "passage",
    "position",
    "crack",
    "segment",
    "s_mm",
    "opening_mm",
    "slip_mm",
    "s22_mpa",
    "s12_mpa",
    "status",
];

pub fn faces_header() -> String {
    header(
        &[
            "Crack faces during the stabilised passage of each step",
            "step: 0 is the initial geometry; passage, position, crack, segment: from 1; positions as in sif.csv",
            "s_mm: arc length from the first point of the crack, mm",
            "x1 walks from the first point to the last, x2 is x1 turned by +90 degrees, the + face lies on the x2 side",
            "opening_mm, slip_mm: jump (+ face minus - face) along x2 and x1, mm; opening >= 0",
            "s22_mpa, s12_mpa: stress transmitted across the faces, MPa; s22 <= 0 is pressure",
            "status: open, stick or slip",
        ],
        &FACES_COLUMNS,
    )
}

/// The name of a status in the table.
pub fn status_name(status: FaceStatus) -> &'static str {
    match status {
        FaceStatus::Open => "open",
        FaceStatus::Stick => "stick",
        FaceStatus::Slip => "slip",
    }
}

/// The status of this name; none where it is not one.
pub fn status_of(name: &str) -> Option<FaceStatus> {
    [FaceStatus::Open, FaceStatus::Stick, FaceStatus::Slip]
        .into_iter()
        .find(|&status| status_name(status) == name)
}

/// The rows of a step: position by position, point by point.
pub struct FaceRows<'a> {
    record: &'a StepRecord,
    /// Crack, segment and s of each point, as text: they recur at every position.
    places: Vec<String>,
}

impl<'a> FaceRows<'a> {
    pub fn of(record: &'a StepRecord) -> Self {
        let place = |point: &FacePoint| {
            let s = ryu::Buffer::new().format(point.s).to_owned();
            format!("{},{},{s}", point.crack + 1, point.segment + 1)
        };
        Self { record, places: record.faces.points.iter().map(place).collect() }
    }

    /// Appends the rows of position `i` (from 0).
    pub fn append(&self, rows: &mut Rows, i: usize) {
        let [_, _, _, _, _, s_mm, opening, slip, s22, s12, _] = FACES_COLUMNS;
        let StepRecord { step, passages, faces, .. } = self.record;
        for ((point, place), state) in faces.points.iter().zip(&self.places).zip(&faces.states[i]) {
            rows.count(*step);
            rows.count(passages.len());
            rows.count(i + 1);
            if point.s.is_finite() {
                rows.name(place);
            } else {
                rows.real(s_mm, point.s);
            }
            rows.real(opening, state.opening);
            rows.real(slip, state.slip);
            rows.real(s22, state.s22);
            rows.real(s12, state.s12);
            rows.name(status_name(state.status));
            rows.end();
        }
    }
}
