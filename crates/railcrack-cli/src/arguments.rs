//! Command line: options and commands.

use crate::commands::{
    calibrate::CalibrateArguments, check::CheckArguments, compare::CompareArguments,
    completions::CompletionsArguments, completions::ManArguments, contact::ContactArguments,
    explorer::ExplorerArguments, init::InitArguments, plan::PlanArguments, report::ReportArguments,
    run::RunArguments, schema::SchemaArguments, shakedown::ShakedownArguments, show::ShowArguments,
    sweep::SweepArguments, validate::ValidateArguments, verify::VerifyArguments, view::ViewArguments,
};
use clap::{Parser, Subcommand};

const AFTER_HELP: &str = "\
Exit codes:
    0  done; a physical stop such as arrest or a spall is done
    1  compare --tolerance: the difference exceeds the tolerance
    2  bad input: the command line, the case file or a file named in it
    3  not converged
    4  cannot read or write
  130  interrupted; finished results are kept

Getting started:
  railcrack init case.toml     write a commented case file, the reference case
  railcrack check case.toml    validate it and show what would be computed
  railcrack run case.toml      compute crack growth
  railcrack contact case.toml  draw the contact patches and rate the wheels
  railcrack compare A B        compare two runs
  railcrack sweep study.toml   compute many cases: a case file with lists of values
  railcrack show DIR           print the main table of a folder, or columns of any table
  railcrack calibrate case.toml --measured depths.csv   fit the growth law to measured depths
  railcrack plan case.toml     find the least grinding that keeps the rail from failing
  railcrack validate           compare the model with measured growth rates, and score it
  railcrack report DIR         rebuild plots and HTML report from the folder alone
  railcrack view DIR           show the report in a browser while the run computes
  railcrack explorer case.toml   write a page that computes the case in any browser
  railcrack verify DIR         check the files of a folder against their checksums
  railcrack shakedown case.toml   compute the stabilised plastic state under the same wheel
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
    Contact(ContactArguments),
    Compare(CompareArguments),
    Sweep(SweepArguments),
    Show(ShowArguments),
    Calibrate(CalibrateArguments),
    Plan(PlanArguments),
    Report(ReportArguments),
    Shakedown(ShakedownArguments),
    View(ViewArguments),
    Explorer(ExplorerArguments),
    Validate(ValidateArguments),
    Verify(VerifyArguments),
    Schema(SchemaArguments),
    Completions(CompletionsArguments),
    Man(ManArguments),
}
