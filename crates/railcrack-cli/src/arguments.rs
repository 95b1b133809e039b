//! Command line: options and commands.

use crate::commands::{
    calibrate::CalibrateArguments, check::CheckArguments, compare::CompareArguments,
    completions::CompletionsArguments, completions::ManArguments, init::InitArguments, paper::PaperArguments,
    report::ReportArguments, run::RunArguments, schema::SchemaArguments, shakedown::ShakedownArguments,
    show::ShowArguments, sweep::SweepArguments, verify::VerifyArguments, view::ViewArguments,
};
use clap::{Parser, Subcommand};

const AFTER_HELP: &str = "\
Exit codes:
    0  done; a physical stop such as arrest or a spall is done
    1  compare --tolerance: the runs differ by more
    2  bad input: the command line, the case file or a file that it names
    3  not converged
    4  cannot read or write
  130  interrupted; what was computed is kept

Start:
  railcrack init case.toml     a commented file, the reference case
  railcrack check case.toml    what would be computed
  railcrack run case.toml      compute it
  railcrack compare A B        what differs between two runs
  railcrack sweep study.toml   many cases: a case file with lists in place of values
  railcrack show DIR           its main table, or some columns of any
  railcrack calibrate case.toml --measured depths.csv   the growth law fitted to a rail
  railcrack report DIR         plots and HTML report again, from the folder alone
  railcrack view DIR           the same page in a browser, while the run computes
  railcrack verify DIR         whether its files hold what was written
  railcrack shakedown case.toml   the stabilised plastic state under the same wheel
  railcrack paper              the figures and statements of Trolle et al. (2014) recomputed
";

/// Predicts the growth of rolling-contact-fatigue cracks in rails.
///
/// A case file (TOML) describes the rail, the wheel, the cracks and the growth law. Lengths are in
/// mm, stresses in MPa, angles in degrees.
#[derive(Debug, Parser)]
#[command(name = "railcrack", version, after_long_help = AFTER_HELP, after_help = AFTER_HELP)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

/// The commands, in the order of `--help`.
#[derive(Debug, Subcommand)]
pub enum Command {
    Init(InitArguments),
    Check(CheckArguments),
    Run(RunArguments),
    Compare(CompareArguments),
    Sweep(SweepArguments),
    Show(ShowArguments),
    Calibrate(CalibrateArguments),
    Report(ReportArguments),
    Shakedown(ShakedownArguments),
    View(ViewArguments),
    Verify(VerifyArguments),
    Paper(PaperArguments),
    Schema(SchemaArguments),
    Completions(CompletionsArguments),
    Man(ManArguments),
}
