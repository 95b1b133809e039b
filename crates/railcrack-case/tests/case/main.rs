//! The case file: reading, errors, studies, and what derives from the table of keys.

mod bad_input;
mod crack_table;
mod fitted;
mod limits;
mod modules;
mod plausible;
mod reading;
mod rows;
mod samples;
mod seasons;
mod studies;
mod table;
mod wheels;

#[path = "../common/wheels.rs"]
mod cases;
