//! Tables of results: the first byte selects the kind.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_fuzz::folder;
use railcrack_run::fuzzing;

fuzz_target!(|input: &[u8]| fuzzing::results(&folder(), input));
