//! `faces.csv`: the crack faces during the stabilised passage.

use super::table;
use railcrack::contact::FaceStatus;
use railcrack::growth::{FaceRecord, StepRecord};

table! {
    /// A face point at a wheel position.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct FaceRow in "faces.csv", [
        "Crack faces during the stabilised passage of each step",
        "step: 0 is the initial geometry; passage, position, crack, segment: from 1; positions as in sif.csv",
        "s_mm: arc length from the first point of the crack, mm",
        "x1 walks from the first point to the last, x2 is x1 turned by +90 degrees, the + face lies on the x2 side",
        "opening_mm, slip_mm: jump (+ face minus - face) along x2 and x1, mm; opening >= 0",
        "s22_mpa, s12_mpa: stress transmitted across the faces, MPa; s22 <= 0 is pressure",
        "status: open, stick or slip",
        "wheel, of a mix: from 1; every step has the first wheel, the first and the last step have all",
    ] {
        /// As in `sif.csv`.
        step: usize = "step";
        /// As in `sif.csv`.
        passage: usize = "passage";
        /// As in `sif.csv`.
        position: usize = "position";
        /// Crack, and its straight segment.
        crack: usize = "crack";
        /// Crack, and its straight segment.
        segment: usize = "segment";
        /// Arc length from the first point of the crack in this step, mm.
        s: f64 = "s_mm";
        /// Opening, mm, ≥ 0.
        opening: f64 = "opening_mm";
        /// Slip, mm.
        slip: f64 = "slip_mm";
        /// Normal stress transmitted across the faces, MPa, ≤ 0: minus the contact pressure.
        s22: f64 = "s22_mpa";
        /// Shear stress transmitted across the faces, MPa.
        s12: f64 = "s12_mpa";
        /// `open`, `stick` or `slip`.
        status: FaceStatus = "status";
        /// Wheel of a mix, from 1: the first one in every step, all in the first and the last.
        wheel: Option<usize> = "wheel", with "wheel";
        /// Lateral position of a face point in space, mm.
        lateral: Option<f64> = "z_mm", with "space";
        /// Slip along the trace of the plane of a crack in space, mm.
        slip_across: Option<f64> = "slip_z_mm", with "space";
        /// Shear stress transmitted along that trace, MPa.
        s23: Option<f64> = "s23_mpa", with "space";
    }
}

impl FaceRow {
    /// The rows of a step: wheel by wheel, position by position, point by point.
    pub fn of_step(record: &StepRecord) -> impl Iterator<Item = Self> {
        let all = record.faces_by_wheel().enumerate();
        all.flat_map(|(wheel, (passages, faces))| Self::under(record.step, wheel, passages.len(), faces))
    }

    fn under(step: usize, wheel: usize, passage: usize, faces: &FaceRecord) -> impl Iterator<Item = Self> {
        faces.states.iter().enumerate().flat_map(move |(i, states)| {
            let across = faces.across.as_ref();
            faces.points.iter().zip(states).enumerate().map(move |(a, (point, state))| Self {
                step,
                passage,
                position: i + 1,
                crack: point.crack + 1,
                segment: point.segment + 1,
                s: point.s,
                opening: state.opening,
                slip: state.slip,
                s22: state.s22,
                s12: state.s12,
                status: state.status,
                wheel: Some(wheel + 1),
                lateral: across.and_then(|across| across.lateral.get(a).copied()),
                slip_across: across.and_then(|across| Some(across.states.get(i)?.get(a)?[0])),
                s23: across.and_then(|across| Some(across.states.get(i)?.get(a)?[1])),
            })
        })
    }
}
