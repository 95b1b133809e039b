//! Damaged files: a result or an error for any bytes.
//!
//! The damage follows a seed, so that a failure can be reproduced; `RAILCRACK_MUTATIONS` sets the
//! number of files.

use super::grid_of_every_shape;
use super::random::Random;
use railcrack_vtu::{read_vtu_bytes, vtu_text};
use std::path::Path;
use std::time::{Duration, Instant};

/// Default number of files, which takes about a second.
const FILES: u64 = 2000;

/// Time limit for one file on a busy machine.
const BUDGET: Duration = Duration::from_secs(5);

/// Fragments that are inserted anywhere: counts, types and markup of other files.
const PIECES: &[&[u8]] = &[
    b"18446744073709551615",
    b"-1",
    b"0",
    b"1e308",
    b"nan",
    b"appended",
    b"binary",
    b"ascii",
    b"UInt8",
    b"Float32",
    b"<",
    b">",
    b"\"",
    b"&#0;",
    b"\0",
    b"\xff\xfe",
    b"vtkZLibDataCompressor",
    b"NumberOfComponents=\"0\"",
    b"AAAA",
];

#[test]
fn damaged_fields_are_answered() {
    let files = std::env::var("RAILCRACK_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(FILES);
    let whole = vtu_text(&grid_of_every_shape()).unwrap();
    for seed in 0..files {
        let mut random = Random(seed);
        let mut below = |most: usize| random.below(most);
        let mut bytes = whole.clone();
        for _ in 0..=below(4) {
            let at = below(bytes.len());
            match below(4) {
                0 => bytes[at] ^= 1 << below(8),
                1 => bytes.truncate(at.max(1)),
                2 => drop(bytes.drain(at..(at + below(40)).min(bytes.len()))),
                _ => drop(bytes.splice(at..at, PIECES[below(PIECES.len())].iter().copied())),
            }
            if bytes.is_empty() {
                bytes.push(b'<');
            }
        }
        let started = Instant::now();
        drop(read_vtu_bytes(&bytes, Path::new("damaged.vtu")));
        assert!(started.elapsed() < BUDGET, "seed {seed}: {:?}", started.elapsed());
    }
}
