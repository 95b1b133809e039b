//! The case file: reading, errors, studies, and what derives from the table of keys.

mod bad_input;
mod modules;
mod reading;
mod studies;
mod table;
