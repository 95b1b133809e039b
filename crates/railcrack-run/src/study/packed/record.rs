//! A record of a file of packed runs: a header that is found and checked by itself, and a body.

use crate::disk::{CHECKSUM_BYTES, Checksum};
use crate::error::OutputError;
use crate::run_folder::RunFiles;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use std::path::Path;

/// Begins every record: behind damage, the next one is found by it.
pub(super) const MARK: [u8; 7] = *b"RAILPAK";
/// The mark of records without SHA-256: no damage of a few bytes makes it of the other.
const MARK_OF_BEFORE: [u8; 7] = *b"RAILRUN";
/// Raised whenever the layout of a record changes.
pub(super) const FORMAT: u8 = 3;
/// Mark and format, number of the run, generation and length of the body, eight bytes each; the
/// checksums of case and body, and that of all these.
pub(super) const HEADER: usize = SUM + CHECKSUM_BYTES;
const CASE: usize = 4 * 8;
const BODY: usize = CASE + CHECKSUM_BYTES;
/// Place of the checksum of what is before it.
pub(super) const SUM: usize = BODY + CHECKSUM_BYTES;
/// Number of a record that stands for damaged bytes; runs count from 1.
pub(super) const VOID: u64 = 0;
/// Level of compression: higher levels do not reduce numbers further.
const LEVEL: u8 = 5;
/// Maximum size of a run, bytes.
const MOST: usize = 1 << 30;

/// The header of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Header {
    /// Number of the run.
    pub number: u64,
    /// How often the run has been revoked before this record; of a revocation, this one included.
    /// What is revoked does not depend on the order of files, which may be renamed.
    pub generation: u64,
    /// Checksum of the case: a run of another study is recognised.
    pub case: Checksum,
    /// Bytes of the body; none of a revocation.
    pub length: u64,
    /// Their checksum.
    pub body: Checksum,
}

impl Header {
    /// That of a record with this `body`.
    pub(super) fn new(number: u64, generation: u64, case: Checksum, body: &[u8]) -> Self {
        Self { number, generation, case, length: body.len() as u64, body: Checksum::of(body) }
    }

    /// As bytes of a file.
    pub(super) fn to_bytes(self) -> [u8; HEADER] {
        let mut bytes = [0; HEADER];
        bytes[..7].copy_from_slice(&MARK);
        bytes[7] = FORMAT;
        bytes[8..16].copy_from_slice(&self.number.to_le_bytes());
        bytes[16..24].copy_from_slice(&self.generation.to_le_bytes());
        bytes[24..CASE].copy_from_slice(&self.length.to_le_bytes());
        bytes[CASE..BODY].copy_from_slice(&self.case.to_bytes());
        bytes[BODY..SUM].copy_from_slice(&self.body.to_bytes());
        let sum = Checksum::of(&bytes[..SUM]);
        bytes[SUM..].copy_from_slice(&sum.to_bytes());
        bytes
    }

    /// The whole header at the beginning of `bytes`; none where there is none of this format.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        let whole = bytes.get(..HEADER).filter(|whole| is_whole(whole) && whole[7] == FORMAT)?;
        let number = |at: usize| little_endian(&whole[at..at + 8]);
        Some(Self {
            number: number(8),
            generation: number(16),
            length: number(24),
            case: Checksum::of_bytes(&whole[CASE..BODY])?,
            body: Checksum::of_bytes(&whole[BODY..SUM])?,
        })
    }
}

fn is_whole(header: &[u8]) -> bool {
    header[..7] == MARK && header[SUM..] == Checksum::of(&header[..SUM]).to_bytes()
}

/// The format of the records of a file that begins with `bytes`, where it is another one.
pub(super) fn other_format(bytes: &[u8]) -> Option<u64> {
    let of_before = bytes.get(..8).filter(|begins| begins[..7] == MARK_OF_BEFORE);
    let marked = bytes.get(..HEADER).filter(|whole| is_whole(whole) && whole[7] != FORMAT);
    of_before.or(marked).map(|header| u64::from(header[7]))
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | u64::from(byte))
}

/// The files of a run as the body of a record; nothing for a revocation.
pub(super) fn body_of(path: &Path, files: Option<&RunFiles>) -> Result<Vec<u8>, OutputError> {
    let Some(files) = files else { return Ok(Vec::new()) };
    let plain = postcard::to_stdvec(files);
    let plain = plain.map_err(|reason| OutputError::damaged(path, reason.to_string()))?;
    Ok(compress_to_vec(&plain, LEVEL))
}

/// The files in the body of a record, or why there are none.
pub(super) fn files_of(body: &[u8]) -> Result<RunFiles, String> {
    let plain = decompress_to_vec_with_limit(body, MOST).map_err(|reason| reason.to_string())?;
    postcard::from_bytes(&plain).map_err(|reason| reason.to_string())
}
