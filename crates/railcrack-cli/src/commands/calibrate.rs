//! `railcrack calibrate`.

use super::calibrate_parameter::{calibrate_parameter, range};
use super::run::{is_same_file, listen};
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::default_folder;
use crate::print;
use crate::progress::Progress;
use clap::Args;
use railcrack_case::Case;
use railcrack_report::{Chart, ChartAxis, ChartSheet, Curve, CurveDots, CurveLook, Pages};
use railcrack_run::RunFolder;
use railcrack_run::calibration::{
    Calibration, CalibrationError, Measure, Measured, calibrate as fit, read_measured,
};
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::{Ending, RunEntry, Simulation};
use std::path::{Path, PathBuf};

/// Fit the growth law, or another number of the case, to measured depths or lengths over traffic
///
/// The case is computed, and each measurement gives a coefficient of the growth law: cycles are in
/// proportion to 1/C. Another number is fitted by runs with several values of it. The run folder
/// gets calibration.csv, calibration.svg and calibrated.toml, the case with the fitted value.
#[derive(Debug, Args)]
pub struct CalibrateArguments {
    /// The case file: its crack is the one from which the tonnes of the measurements count
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// CSV with the header mgt,depth_mm or mgt,length_mm
    #[arg(long, value_name = "FILE")]
    pub measured: PathBuf,
    /// The number that is fitted in place of the coefficient: crack.friction, wheel[1].share
    #[arg(long, value_name = "SECTION.KEY")]
    pub parameter: Option<String>,
    /// Its range [default: from half to twice the value of the case]
    #[arg(long, value_name = "LOW,HIGH", requires = "parameter", value_parser = range, allow_hyphen_values = true)]
    pub between: Option<(f64, f64)>,
    /// The run folder [default: the case's name beside it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Say nothing while computing
    #[arg(long)]
    pub quiet: bool,
    /// Replace the run in the folder
    #[arg(long)]
    pub force: bool,
}

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

pub(super) fn from_output(error: railcrack_run::OutputError) -> Failure {
    Failure::Run(error.into())
}

/// The rows of the tip that is deepest in the last step.
pub(super) fn deepest(growth: &[TipRow]) -> Vec<TipRow> {
    let last = growth.last().map_or(0, |row| row.step);
    let tips = growth.iter().filter(|row| row.step == last);
    let Some(deepest) = tips.reduce(|a, b| if b.place[1] < a.place[1] { b } else { a }) else {
        return Vec::new();
    };
    growth.iter().filter(|row| (row.crack, row.tip) == (deepest.crack, deepest.tip)).copied().collect()
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

/// A run: its name, its rows, and how many times as fast it is drawn.
pub(super) type Drawn<'a> = (&'a str, &'a [TipRow], f64);

/// Measured and computed sizes over traffic.
pub(super) fn plot(
    title: &str,
    tonnes: f64,
    measure: Measure,
    measured: &[Measured],
    runs: &[Drawn],
) -> String {
    let (what, size): (&str, fn(&TipRow) -> f64) = match measure {
        Measure::Depth => ("Depth", |row| -row.place[1]),
        Measure::Length => ("Length", |row| row.length),
    };
    let curve = |(name, rows, factor): &Drawn| {
        let points = rows.iter().map(|row| [1e-6 * tonnes * row.load_cycles / factor, size(row)]);
        Curve::line(name, points.collect())
    };
    let points = measured.iter().map(|one| [one.mgt, one.size]).collect();
    let chart = Chart {
        id: "calibration".to_owned(),
        caption: format!("{what} over traffic: measured, computed, and computed with the fitted value."),
        x: ChartAxis::linear("Traffic", "million gross tonnes"),
        y: ChartAxis::linear(what, "mm"),
        curves: runs
            .iter()
            .map(curve)
            .chain([
                Curve { look: CurveLook::Dots, ..Curve::line("measured", points) }.with_dots(CurveDots::All)
            ])
            .collect(),
        ..Chart::default()
    };
    ChartSheet::of(title, &format!("{what} over traffic"), chart).svg()
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

pub(super) fn write(folder: &Path, name: &str, text: &str) -> Result<(), Failure> {
    let path = folder.join(name);
    std::fs::write(&path, text).map_err(|source| Failure::CannotWrite { path, source })
}
