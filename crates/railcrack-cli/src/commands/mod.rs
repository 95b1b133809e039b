//! The commands, one file each.

pub mod calibrate;
mod calibrate_parameter;
pub mod check;
mod check_study;
pub mod compare;
pub mod completions;
pub mod init;
pub mod paper;
pub mod report;
pub mod run;
pub mod schema;
pub mod shakedown;
pub mod show;
pub mod sweep;
mod template;
pub mod verify;
pub mod view;

use crate::arguments::Command;
use crate::exit::{Exit, Failure};

/// Does what `command` asks for.
pub fn dispatch(command: Command) -> Result<Exit, Failure> {
    match command {
        Command::Init(arguments) => init::init(&arguments),
        Command::Calibrate(arguments) => calibrate::calibrate(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Compare(arguments) => compare::compare(&arguments),
        Command::Sweep(arguments) => sweep::sweep(&arguments),
        Command::Report(arguments) => report::report(&arguments),
        Command::Shakedown(arguments) => shakedown::shakedown(&arguments),
        Command::Verify(arguments) => verify::verify(&arguments),
        Command::View(arguments) => view::view(&arguments),
        Command::Paper(arguments) => paper::paper(&arguments),
        Command::Show(arguments) => show::show(&arguments),
        Command::Schema(arguments) => schema::schema(&arguments),
        Command::Completions(arguments) => completions::completions(&arguments),
        Command::Man(arguments) => completions::man(&arguments),
    }
}
