//! Dispatch of the commands.

use crate::arguments::{Arguments, Command};
use crate::commands::run::{use_other_threads, use_threads};
use crate::commands::{
    calibrate, check, compare, completions, contact, explorer, init, plan, report, run, schema, shakedown,
    show, sweep, validate, verify, view,
};
use crate::exit::{Exit, Failure};
use clap::CommandFactory;
use std::num::NonZeroUsize;

/// The threads of a command.
enum Threads {
    /// None: it computes nothing.
    None,
    /// That many, the calling one among them.
    Calling(Option<NonZeroUsize>),
    /// Others than the calling one, which waits.
    Others,
}

impl Threads {
    fn of(command: &Command) -> Self {
        match command {
            Command::Run(arguments) => Self::Calling(arguments.execution.threads),
            Command::Plan(arguments) => Self::Calling(arguments.execution.threads),
            Command::Sweep(_) | Command::View(_) => Self::Others,
            Command::Init(_)
            | Command::Verify(_)
            | Command::Show(_)
            | Command::Schema(_)
            | Command::Completions(_)
            | Command::Man(_) => Self::None,
            _ => Self::Calling(None),
        }
    }
}

/// Executes `command`, on a pool of threads where it computes.
pub fn dispatch(command: Command) -> Result<Exit, Failure> {
    match Threads::of(&command) {
        Threads::None => {}
        Threads::Calling(threads) => use_threads(threads)?,
        Threads::Others => use_other_threads()?,
    }
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
