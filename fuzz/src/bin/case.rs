//! Case files.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_case::Case;
use std::path::Path;

fuzz_target!(|text: &str| {
    match Case::parse(text, "case.toml", Path::new("/nonexistent")) {
        Ok(case) => {
            let stored = case.to_toml();
            let again = Case::parse(&stored, "stored.toml", Path::new("/nonexistent"));
            assert_eq!(again.expect("a stored case is read").to_toml(), stored);
        }
        Err(errors) => errors.errors().iter().for_each(|error| drop((error.one_line(), error.excerpt()))),
    }
});
