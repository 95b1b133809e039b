//! A run before its first step: its case, and what it starts from.

use super::observer::RunObserver;
use crate::log::{MixInfo, RunInfo};
use crate::presentation::Presentation;
use crate::run_folder::CaseFiles;
use crate::setup::SharedRail;
use crate::summary::validity;
use railcrack::growth::GrowthState;
use railcrack_case::{Case, MixedWheel};
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
        Self {
            case: case_files(case),
            info: RunInfo {
                title: case.title.clone(),
                engine: case.engine,
                contact: case.contact_solver,
                boundary: case.rail.boundary,
                half_width: case.half_width(),
                passage: [case.passages.passage.from, case.passages.passage.to],
                bends: case.rail.section.is_none()
                    && (case.wheel.load.track.is_some()
                        || case.mix.iter().any(|mixed| mixed.wheel.load.track.is_some())),
                toughness: case.fracture.as_ref().map(|fracture| fracture.at_rail),
                steel: case.growth_steel,
                calibrated_sites: case.calibration.sites,
                law_table: case.growth_rates.as_ref().map(|file| file.content().covers()),
                fluid: case.has_fluid(),
                coupled: case.has_coupled_wheel(),
                axle_load: case.axle_load,
                output: case.output,
                mix: case.mix.iter().map(of_wheel).collect(),
                maintenance: case.maintenance,
                inspection: case.inspection,
                inspection_risk: case.inspection_risk.clone(),
                mgt_per_year: case.mgt_per_year,
                scatter: case.scatter,
                critical_length: case.growth.critical_length,
                flowing: validity::flowing(case),
                arrest_rate: case.growth.arrest_rate,
                warnings: validity::of_case(case),
            },
        }
    }
}

fn of_wheel(wheel: &MixedWheel) -> MixInfo {
    MixInfo {
        name: wheel.name.clone(),
        share: wheel.share,
        axle_load: wheel.axle_load,
        half_width: wheel.wheel.half_width(),
    }
}

/// `case.toml` and the files that it names.
pub fn case_files(case: &Case) -> CaseFiles {
    let companions = case.companions().into_iter().map(|file| (file.name.into(), file.text.into())).collect();
    CaseFiles { toml: case.to_toml(), companions }
}
