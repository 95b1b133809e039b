//! Parquet tables of a study, as `verify` reads them.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_run::fuzzing;

fuzz_target!(|input: &[u8]| fuzzing::parquet(input));
