//! Checkpoints and entries of the run log, behind their checksums.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_fuzz::folder;
use railcrack_run::fuzzing;

fuzz_target!(|input: &[u8]| fuzzing::checkpoint(&folder(), input));
