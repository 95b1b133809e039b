//! `railcrack view`.

mod answer;
mod command;
mod live;
mod request;
mod server;
mod site;

pub use command::{ViewArguments, view};
#[cfg(fuzzing)]
pub use request::fuzz_request;
