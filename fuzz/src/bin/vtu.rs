//! Fields of VTK.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_vtu::{read_vtu_bytes, vtu_text};
use std::path::Path;

fuzz_target!(|input: &[u8]| {
    if let Ok(grid) = read_vtu_bytes(input, Path::new("field.vtu")) {
        // A grid with numbers that are not finite is read, but not written.
        let _ = vtu_text(&grid);
    }
});
