//! The wheels of the passage explorer.

use super::stored::RunFolder;
use crate::figures::WheelPassage;
use crate::numbers::{number, numbers};
use crate::page_data::{CrackWindows, PageData};
use crate::row::NamedCrack;
use railcrack::contact::{CrackFluid, FluidModel, PressureProfile};
use railcrack_case::TrafficWheel;
use railcrack_run::run_folder::History;
use serde_json::{Value, json};
use std::ops::Range;

/// A wheel and its positions.
pub(super) struct PassedWheel<'a> {
    pub(super) wheel: &'a TrafficWheel,
    /// Whether it is one of several.
    is_mixed: bool,
    /// Half-width a of its contact, mm.
    pub(super) half_width: f64,
    pub(super) xc_over_a: &'a [f64],
    /// Positions near the cracks.
    pub(super) near: Range<usize>,
    /// Of many cracks those near each.
    windows: Option<Vec<Range<usize>>>,
    /// Whether the pressure of the fluid falls from the mouth to the tip, as far as cracks of their
    /// own show it.
    fluid_falls: bool,
}

/// The wheels of which K is shown.
pub(super) fn wheels<'a>(
    run: &'a RunFolder,
    page_data: &'a PageData,
    named: Option<&[NamedCrack]>,
) -> Vec<PassedWheel<'a>> {
    let of_wheel = |(number, histories): (usize, &'a Vec<History>)| {
        let wheel = run.case.wheels.get(number)?;
        let passage = passage_of(run, number);
        let xc_over_a: &[f64] = histories.first().map_or(&[], |history| &history.xc_over_a);
        let cracks = 1..=run.summary.cracks.len();
        Some(PassedWheel {
            wheel,
            is_mixed: run.case.is_mix(),
            half_width: passage.half_width(),
            xc_over_a,
            near: passage.near(xc_over_a),
            windows: named.map(|_| cracks.map(|crack| passage.window(crack, xc_over_a)).collect()),
            fluid_falls: falls(wheel.fluid.as_ref()) && run.summary.junctions.is_empty(),
        })
    };
    page_data.by_wheel(0).iter().enumerate().filter_map(of_wheel).collect()
}

/// The passage of wheel `number`, from 0.
pub(super) fn passage_of(run: &RunFolder, number: usize) -> WheelPassage<'_> {
    match run.case.wheels.get(number).filter(|_| number > 0) {
        Some(TrafficWheel { wheel, passages, .. }) => {
            let ends = [passages.passage.from, passages.passage.to];
            WheelPassage::other(&run.summary, wheel.half_width(), ends)
        }
        None => WheelPassage::first(&run.summary),
    }
}

fn falls(fluid: Option<&CrackFluid>) -> bool {
    fluid.is_some_and(|fluid| {
        matches!(fluid.model, FluidModel::Mouth { .. }) && fluid.profile == PressureProfile::Linear
    })
}

impl PassedWheel<'_> {
    /// The wheel as the page has it, with every `stride`-th position of its faces.
    pub(super) fn page_data(&self, stride: usize) -> Value {
        let last_of = |window: &Range<usize>| json!([window.start, window.end.saturating_sub(1)]);
        let contact = self.wheel.wheel.contact();
        json!({
            "name": self.is_mixed.then_some(&self.wheel.name),
            "share": self.is_mixed.then(|| number(self.wheel.share)),
            "half_width": self.half_width,
            "is_coupled": self.wheel.wheel.coupling().is_some(),
            "peak_pressure": number(contact.map_or(0.0, |contact| contact.peak_pressure())),
            "friction": contact.map_or(0.0, |contact| contact.adhesion()),
            "fluid_falls": self.fluid_falls,
            "near": last_of(&self.near),
            "windows": self.windows.as_ref().map(|all| all.iter().map(last_of).collect::<Vec<_>>()),
            "xc_over_a": numbers(self.xc_over_a.iter().copied()),
            "face_stride": stride,
        })
    }

    /// The windows of the `named` cracks, by number.
    pub(super) fn windows_of(&self, named: &[NamedCrack]) -> CrackWindows {
        let of = |named: &NamedCrack| Some((named.crack, self.window(named.crack)?.clone()));
        named.iter().filter_map(of).collect()
    }

    /// The window of `crack`, from 1, one of many.
    pub(super) fn window(&self, crack: usize) -> Option<&Range<usize>> {
        self.windows.as_ref()?.get(crack.checked_sub(1)?)
    }
}
