//! `railcrack calibrate`: the coefficient of the growth law, in closed form.

use super::arguments::{CalibrateArguments, refuse};
use super::finish::{Written, finish, interrupted};
use super::growth::deepest_tip;
use super::parameter::calibrate_parameter;
use crate::commands::run::listen;
use crate::exit::{Exit, Failure};
use crate::interruption::Remains;
use crate::print;
use railcrack_case::{Case, CaseErrors};
use railcrack_report::{CalibratedRun, Pages};
use railcrack_run::calibration::{
    CalibrationResult, Fitted, Measure, NewRail, Prior, Site, SizeCurve, calibrate as fit, calibrated_by,
    coefficient_table, equal_sites, read_measured, shrinking,
};
use railcrack_run::simulation::{RunEntry, RunError, Simulation};
use railcrack_run::summary::validity::unused_columns;

/// Computes the case, fits, writes the folder and prints the result.
pub fn calibrate(arguments: &CalibrateArguments) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.case)?;
    let refuse_case = |reason: &str| refuse(format!("{}: {reason}", arguments.case.display()));
    let Some(tonnes) = case.axle_load else {
        let reason = "a calibration over tonnes needs axle_load_t, in [traffic] or of every [[wheel]]";
        return Err(refuse_case(reason));
    };
    let sites = read_sites(arguments)?;
    warn(&sites, &case);
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
    let entered = arguments.enter(&case)?;
    entered.mark().map_err(RunError::from)?;
    let interruption = listen(Remains::Nothing)?;
    let progress = arguments.progress(&case, &interruption);
    let simulation = Simulation::new(&case).observed_by(&progress).presented_by(&Pages);
    let Some(rows) = deepest_tip(&simulation, entered.path(), RunEntry::Entered)? else {
        return interrupted(entered);
    };
    let prior = Prior::from(case.calibration);
    let of = |measure: Measure| SizeCurve::of(&rows, tonnes, measure);
    let calibration = fit(&sites, of, prior).map_err(|error| refuse(error.to_string()))?;
    for (site, own) in sites.iter().zip(&calibration.sites) {
        own.consistency.and_then(|own| own.remark(site)).iter().for_each(|text| print::warning(text));
    }
    let new = NewRail::of(&calibration.posterior, prior, sites.len(), &case);
    let factor = calibration.posterior.mean.exp();
    let mut overrides = coefficient.overrides(coefficient.value * factor);
    overrides.settings.push(new.setting());
    overrides.settings.extend(calibrated_by(&sites));
    overrides.settings.extend(prior.reset());
    let fitted = Case::read_with(&arguments.case, &overrides)?;
    let run = |name, speed| CalibratedRun { name, rows: &rows, speed };
    let table = coefficient_table(&sites, &calibration, coefficient.value);
    let written = Written { table, drawn: &[run("case", 1.0), run("fitted", factor)], tonnes, case: &fitted };
    let result = CalibrationResult {
        title: &case.title,
        key: format!("growth.{}", coefficient.key),
        value: coefficient.value,
        prior,
        sites: &sites,
        fitted: Fitted::Coefficient { calibration, new },
    };
    finish(entered, &result, &written)
}

/// The measurements of all sites, each file once.
fn read_sites(arguments: &CalibrateArguments) -> Result<Vec<Site>, Failure> {
    let sites: Result<Vec<Vec<Site>>, CaseErrors> =
        arguments.measured.iter().map(|path| read_measured(path)).collect();
    let sites = sites?.concat();
    for (i, path) in arguments.measured.iter().enumerate() {
        if arguments.measured[..i].contains(path) {
            return Err(refuse(format!("--measured {}: given twice, each file is one site", path.display())));
        }
    }
    Ok(sites)
}

/// Warnings about measurements that follow without a run: columns and rows that are not read, a
/// crack that gets shallower, copies of a site.
fn warn(sites: &[Site], case: &Case) {
    for site in sites {
        unused_columns(&site.name, &site.unused).iter().for_each(|text| print::warning(text));
        site.remarks.iter().for_each(|text| print::warning(text));
        let shrinks = shrinking(site).filter(|_| case.maintenance.is_none());
        shrinks.iter().for_each(|text| print::warning(text));
    }
    equal_sites(sites).iter().for_each(|text| print::warning(text));
}
