//! Study files.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_case::{Input, Overrides};
use std::path::Path;

fuzz_target!(|text: &str| {
    let read = Input::parse_with(text, "study.toml", Path::new("/nonexistent"), &Overrides::default());
    if let Err(errors) = read {
        errors.errors().iter().for_each(|error| drop((error.one_line(), error.excerpt())));
    }
});
