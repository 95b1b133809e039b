//! Requests to `railcrack view`.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: &[u8]| railcrack_cli::fuzzing::request(input));
