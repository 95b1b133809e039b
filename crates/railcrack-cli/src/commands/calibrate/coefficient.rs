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

/// Keys of the coefficient of each law.
const COEFFICIENTS: [&str; 5] = ["paris_c", "bold_c", "walker_c", "forman_c", "nasgro_c"];

/// Computes the case, fits, writes the folder and prints the result.
pub fn calibrate(arguments: &CalibrateArguments) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.case)?;
    let Some(tonnes) = case.axle_load else {
        let reason = "a calibration over tonnes needs axle_load_t, in [traffic] or of every [[wheel]]";
        return Err(Failure::Calibration { reason: format!("{}: {reason}", arguments.case.display()) });
    };
    let file = arguments.measured.display().to_string();
    let text = std::fs::read_to_string(&arguments.measured)
        .map_err(|reason| Failure::Calibration { reason: format!("{file}: cannot be read: {reason}") })?;
    let refuse = |error: CalibrationError| Failure::Calibration { reason: error.to_string() };
    let (measure, measured) = read_measured(&file, &text).map_err(refuse)?;
    if let Some(key) = &arguments.parameter {
        return calibrate_parameter(arguments, &case, key, (measure, &measured));
    }
    if case.maintenance.is_some() {
        let reason = "with [maintenance] tonnages are not in proportion to 1/C: --parameter growth.paris_c fits it by runs";
        return Err(refuse_text(arguments, reason));
    }
    let (key, coefficient) = coefficient(&case.to_toml()).ok_or_else(|| Failure::Calibration {
        reason: "[growth]: a steel or a table has no coefficient to fit; give law and constants".to_owned(),
    })?;
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
    let fitted = coefficient * calibration.factor;
    write(&folder, "calibration.csv", &table(&calibration, measure, coefficient))?;
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
    let old = format!("{key} = {coefficient:?}");
    write(&folder, "calibrated.toml", &case.to_toml().replacen(&old, &format!("{key} = {fitted:?}"), 1))?;
    print::stdout(&told(&calibration, key, coefficient, measured.len()))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}

/// The coefficient that a stored case has, with its key.
fn coefficient(toml: &str) -> Option<(&'static str, f64)> {
    let of = |key: &'static str| {
        let value = toml.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "))?;
        Some((key, value.parse().ok()?))
    };
    COEFFICIENTS.into_iter().find_map(of)
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
