//! The commands, one file each.

pub mod check;
pub mod compare;
pub mod init;
pub mod residual;
pub mod run;
pub mod schema;
pub mod shakedown;

use crate::arguments::Command;
use crate::exit::{Exit, Failure};

/// Does what `command` asks for.
pub fn dispatch(command: Command) -> Result<Exit, Failure> {
    match command {
        Command::Init(arguments) => init::init(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Compare(arguments) => compare::compare(&arguments),
        Command::Shakedown(arguments) => shakedown::shakedown(&arguments),
        Command::Schema => schema::schema(),
    }
}
