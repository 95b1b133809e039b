//! `railcrack calibrate`: the coefficient of the growth law, in closed form.

use super::arguments::CalibrateArguments;
use super::parameter::calibrate_parameter;
use super::results::{deepest, from_output, plot, write};
use crate::commands::run::{is_same_file, listen};
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::default_folder;
use crate::print;
use crate::progress::Progress;
use railcrack_case::Case;
use railcrack_report::Pages;
use railcrack_run::RunFolder;
use railcrack_run::calibration::{Calibration, CalibrationError, Measure, calibrate as fit, read_measured};
use railcrack_run::simulation::{Ending, RunEntry, Simulation};

fn refuse_text(arguments: &CalibrateArguments, reason: &str) -> Failure {
    Failure::Calibration { reason: format!("{}: {reason}", arguments.case.display()) }
}

/// Computes the case, fits, writes the folder and prints the result.
pub fn calibrate(arguments: &CalibrateArguments) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.case)?;
    let Some(tonnes) = case.axle_load else {
        let reason = "a calibration over tonnes needs axle_load_t, in [traffic] or of every [[wheel]]";
        return Err(refuse_text(arguments, reason));
    };
    let refuse = |error: CalibrationError| Failure::Calibration { reason: error.to_string() };
    let (measure, measured) = read_measured(&arguments.measured)?;
    if let Some(key) = &arguments.parameter {
        return calibrate_parameter(arguments, &case, key, (measure, &measured));
    }
    let coefficient = case.coefficient().map_err(|error| refuse_text(arguments, &error.to_string()))?;
    if case.maintenance.is_some() {
        let reason = format!(
            "with [maintenance] tonnages are not in proportion to 1/C: --parameter growth.{} fits it by runs",
            coefficient.key
        );
        return Err(refuse_text(arguments, &reason));
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
    let rows = deepest(&RunFolder::open(&folder).and_then(|run| run.growth()).map_err(from_output)?);
    let calibration = fit(&rows, tonnes, measure, &measured).map_err(refuse)?;
    write(&folder, "calibration.csv", &table(&calibration, measure, coefficient.value))?;
    write(
        &folder,
        "calibration.svg",
        &plot(
            &case.title,
            tonnes,
            measure,
            &measured,
            &[("case", &rows, 1.0), ("fitted", &rows, calibration.factor)],
        ),
    )?;
    print::stdout(&told(&calibration, coefficient.key, coefficient.value, measured.len()))?;
    let fitted = coefficient.overrides(coefficient.value * calibration.factor);
    let fitted = Case::read_with(&arguments.case, &fitted)?;
    write(&folder, "calibrated.toml", &fitted.to_toml())?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}

fn table(calibration: &Calibration, measure: Measure, coefficient: f64) -> String {
    let name = match measure {
        Measure::Depth => "depth_mm",
        Measure::Length => "length_mm",
    };
    let mut text = format!("mgt,{name},computed_mgt,coefficient\n");
    for used in &calibration.used {
        text.push_str(&format!(
            "{},{},{},{}\n",
            used.measured.mgt,
            used.measured.size,
            used.computed_mgt,
            used.ratio * coefficient
        ));
    }
    text
}

fn told(calibration: &Calibration, key: &str, coefficient: f64, measured: usize) -> String {
    let mut text = format!(
        "{key} = {:.4e}, {:.4} times that of the case",
        coefficient * calibration.factor,
        calibration.factor
    );
    if let Some((low, high)) = calibration.interval {
        text.push_str(&format!(", 95 % from {:.4e} to {:.4e}", coefficient * low, coefficient * high));
    }
    text.push('\n');
    if let Some(std) = calibration.log_std {
        text.push_str(&format!("scatter of ln C from measurement to measurement {std:.4}\n"));
    }
    text.push_str(&format!("{} of {measured} measurements used\n", calibration.used.len()));
    text
}
