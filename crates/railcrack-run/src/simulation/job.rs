//! A run before its first step: its case, and what it starts from.

use super::observer::RunObserver;
use crate::log::{RunInfo, WheelInfo};
use crate::presentation::Presentation;
use crate::run_folder::CaseFiles;
use crate::setup::SharedRail;
use crate::summary::validity;
use railcrack::growth::GrowthState;
use railcrack_case::{Case, TrafficWheel};
use std::path::Path;

/// The start of a run.
pub struct Stage<'a> {
    /// The run folder.
    pub folder: &'a Path,
    /// Observer of the run.
    pub observer: &'a dyn RunObserver,
    /// Maker of plots and pages.
    pub presentation: &'a dyn Presentation,
    /// A rail built by another run.
    pub shared: Option<&'a SharedRail>,
    /// The state to continue from; none at the beginning.
    pub state: Option<GrowthState>,
}

/// A run before anything is computed.
#[derive(Debug, Clone)]
pub struct Job {
    /// `case.toml` and the files that it names.
    pub case: CaseFiles,
    /// Facts of the case for the files of the run.
    pub info: RunInfo,
}

impl Job {
    /// The run of `case`.
    pub fn of(case: &Case) -> Self {
        let passage = case.first_wheel().passages.passage;
        Self {
            case: case_files(case),
            info: RunInfo {
                title: case.title.clone(),
                engine: case.engine(),
                contact: case.contact_solver(),
                boundary: case.boundary(),
                wheels: case.wheels.iter().map(of_wheel).collect(),
                passage: [passage.from, passage.to],
                bends: case.has_track() && case.plane().is_none_or(|plane| plane.section.is_none()),
                toughness: case.fracture.as_ref().map(|fracture| fracture.at_rail),
                steel: case.growth_steel,
                calibration: case.calibration,
                law_table: case.growth_rates.as_ref().map(|file| file.content().covers()),
                fluid: case.has_fluid(),
                coupled: case.has_coupled_wheel(),
                axle_load: case.axle_load,
                output: case.output,
                maintenance: case.maintenance,
                inspection: case.inspection,
                inspection_risk: case.inspection_risk.clone(),
                mgt_per_year: case.mgt_per_year,
                scatter: case.scatter,
                critical_length: case.growth.critical_length,
                flowing: validity::flowing(case),
                arrest_rate: case.growth.arrest_rate,
                unusual_law: validity::unusual_law(case),
                warnings: validity::of_case(case),
            },
        }
    }
}

fn of_wheel(wheel: &TrafficWheel) -> WheelInfo {
    WheelInfo {
        name: wheel.name.clone(),
        share: wheel.share,
        axle_load: wheel.axle_load,
        half_width: wheel.wheel.half_width(),
    }
}

/// `case.toml` and the files that it names.
pub fn case_files(case: &Case) -> CaseFiles {
    let companions = case.companions().into_iter().map(|file| (file.name.into(), file.text.into())).collect();
    let groups = case.wheel_table.as_ref().and_then(|table| table.groups.as_ref());
    // Numbers alone can always be written.
    let wheel_groups = groups.and_then(|groups| serde_json::to_string(groups).ok());
    CaseFiles { toml: case.to_toml(), companions, wheel_groups }
}
