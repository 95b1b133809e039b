//! Files of packed runs of any content.

use super::record::{HEADER, Header, MARK, SUM};
use super::runs::packed_file;
use super::{Flaw, PackedRuns};
use crate::disk::Checksum;
use crate::study::plan::PlannedRun;
use std::path::Path;

/// Reads `input` as a file of packed runs in `folder`, and again with the checksums that its
/// records should have, without which hardly any is read.
pub fn fuzz_packed(folder: &Path, input: &[u8]) {
    let run = |number: usize| PlannedRun { number, folder: String::new(), choice: Vec::new(), case: None };
    let planned: Vec<PlannedRun> = (1..=4).map(run).collect();
    for content in [input.to_vec(), mended(input)] {
        std::fs::write(packed_file(folder, 1), content).expect("a file");
        let Ok(runs) = PackedRuns::of(folder, &planned) else { continue };
        for run in &planned {
            let _ = runs.read(run.number);
        }
        runs.flaws().iter().map(Flaw::text).for_each(drop);
    }
}

fn mended(input: &[u8]) -> Vec<u8> {
    let mut bytes = input.to_vec();
    for at in 0..bytes.len().saturating_sub(HEADER - 1) {
        if !bytes[at..].starts_with(&MARK) {
            continue;
        }
        let sum = Checksum::of(&bytes[at..at + SUM]);
        bytes[at + SUM..at + HEADER].copy_from_slice(&sum.to_bytes());
        let Some(header) = Header::of(&bytes[at..]) else { continue };
        let length = usize::try_from(header.length).unwrap_or(usize::MAX);
        let Some(body) = bytes[at + HEADER..].get(..length) else { continue };
        let whole = Header { body: Checksum::of(body), ..header };
        bytes[at..at + HEADER].copy_from_slice(&whole.to_bytes());
    }
    bytes
}
