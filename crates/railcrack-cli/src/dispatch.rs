//! Dispatch of the commands.

use crate::arguments::{Arguments, Command};
use crate::commands::{
    calibrate, check, compare, completions, contact, explorer, init, plan, report, run, schema, shakedown,
    show, sweep, validate, verify, view,
};
use crate::exit::{Exit, Failure};
use clap::CommandFactory;

/// Executes `command`.
pub fn dispatch(command: Command) -> Result<Exit, Failure> {
    match command {
        Command::Init(arguments) => init::init(&arguments),
        Command::Calibrate(arguments) => calibrate::calibrate(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Contact(arguments) => contact::contact(&arguments),
        Command::Compare(arguments) => compare::compare(&arguments),
        Command::Sweep(arguments) => sweep::sweep(&arguments),
        Command::Report(arguments) => report::report(&arguments),
        Command::Plan(arguments) => plan::plan(&arguments),
        Command::Shakedown(arguments) => shakedown::shakedown(&arguments),
        Command::Validate(arguments) => validate::validate(&arguments),
        Command::Verify(arguments) => verify::verify(&arguments),
        Command::Explorer(arguments) => explorer::explorer(&arguments),
        Command::View(arguments) => view::view(&arguments),
        Command::Show(arguments) => show::show(&arguments),
        Command::Schema(arguments) => schema::schema(&arguments),
        Command::Completions(arguments) => completions::completions(&arguments, Arguments::command()),
        Command::Man(arguments) => completions::man(&arguments, Arguments::command()),
    }
}
