//! `railcrack calibrate`: the coefficient of the growth law, in closed form.

use super::arguments::{CalibrateArguments, refuse};
use super::finish::{Written, finish};
use super::found::{Fitted, Found, New, calibrated_by};
use super::parameter::calibrate_parameter;
use super::plot::Drawn;
use super::rows::deepest;
use super::table::table;
use crate::commands::run::{is_same_file, listen};
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::default_folder;
use crate::print;
use crate::progress::Progress;
use railcrack_case::{Case, CaseErrors};
use railcrack_report::Pages;
use railcrack_run::calibration::{Measure, Prior, Site, SizeCurve, calibrate as fit, read_measured};
use railcrack_run::simulation::{Ending, RunEntry, Simulation};
use railcrack_run::summary::validity::unused_columns;

/// Computes the case, fits, writes the folder and prints the result.
pub fn calibrate(arguments: &CalibrateArguments) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.case)?;
    let refuse_case = |reason: &str| refuse(format!("{}: {reason}", arguments.case.display()));
    let Some(tonnes) = case.axle_load else {
        let reason = "a calibration over tonnes needs axle_load_t, in [traffic] or of every [[wheel]]";
        return Err(refuse_case(reason));
    };
    let sites: Result<Vec<Site>, CaseErrors> =
        arguments.measured.iter().map(|path| read_measured(path)).collect();
    let sites = sites?;
    for site in &sites {
        unused_columns(&site.name, &site.unused).iter().for_each(|says| print::warning(says));
    }
    for (i, path) in arguments.measured.iter().enumerate() {
        if arguments.measured[..i].contains(path) {
            return Err(refuse(format!("--measured {}: given twice, each file is one site", path.display())));
        }
    }
    if !arguments.parameter.is_empty() {
        return calibrate_parameter(arguments, &case, &sites);
    }
    let coefficient = case.coefficient().map_err(|error| refuse_case(&error.to_string()))?;
    if case.maintenance.is_some() {
        return Err(refuse_case(&format!(
            "with [maintenance] tonnages are not in proportion to 1/C: --parameter growth.{} fits it by runs",
            coefficient.key
        )));
    }
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    if is_same_file(&arguments.case, &folder.join("case.toml")) {
        return Err(Failure::CaseInRunFolder { path: arguments.case.clone() });
    }
    let interruption = listen()?;
    let verbosity = if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress };
    let progress = Progress::new(verbosity, case.growth.steps, &interruption);
    let entry = if arguments.force { RunEntry::Replace } else { RunEntry::Begin };
    let finished =
        Simulation::new(&case).observed_by(&progress).presented_by(&Pages).run_in(&folder, entry)?;
    if finished.ending == Ending::Interrupted {
        return Ok(Exit::Interrupted);
    }
    let rows = deepest(&folder)?;
    let prior = Prior::from(case.calibration);
    let of = |measure: Measure| SizeCurve::of(&rows, tonnes, measure);
    let calibration = fit(&sites, of, prior).map_err(|error| refuse(error.to_string()))?;
    let new = New::of(&calibration.posterior, prior, sites.len(), &case);
    let factor = calibration.posterior.mean.exp();
    let found = Found {
        title: &case.title,
        key: format!("growth.{}", coefficient.key),
        value: coefficient.value,
        prior,
        sites: &sites,
        fitted: Fitted::Coefficient { calibration: &calibration, new },
    };
    let drawn: [Drawn; 2] = [("case", &rows, 1.0), ("fitted", &rows, factor)];
    let mut overrides = coefficient.overrides(coefficient.value * factor);
    overrides.settings.push(new.setting());
    overrides.settings.push(calibrated_by(&sites));
    if prior.mean != 0.0 {
        // The prior was relative to the coefficient of the case, which is now the fitted one.
        overrides.settings.push("calibration.prior_log_mean=0.0".to_owned());
    }
    let fitted = Case::read_with(&arguments.case, &overrides)?;
    let table = table(&sites, &calibration, coefficient.value);
    finish(&folder, &found, &Written { table, drawn: &drawn, tonnes, case: &fitted })
}
