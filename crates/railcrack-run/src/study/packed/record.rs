//! A record of a file of packed runs: a header that is found and checked by itself, and a body.

use crate::disk::Checksum;
use crate::error::OutputError;
use crate::run_folder::RunFiles;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use std::path::Path;

/// Begins every record: behind damage, the next one is found by it.
pub(super) const MARK: [u8; 7] = *b"RAILRUN";
/// Raised whenever the layout of a record changes.
pub(super) const FORMAT: u8 = 2;
/// Mark and format, number of the run, generation, case, length of the body and its checksum, and
/// the checksum of all these: seven times eight bytes.
pub(super) const HEADER: usize = 56;
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
        bytes[24..32].copy_from_slice(&self.case.to_bytes());
        bytes[32..40].copy_from_slice(&self.length.to_le_bytes());
        bytes[40..48].copy_from_slice(&self.body.to_bytes());
        let sum = Checksum::of(&bytes[..48]);
        bytes[48..].copy_from_slice(&sum.to_bytes());
        bytes
    }

    /// The whole header at the beginning of `bytes`; none where there is none of this format.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        let whole = bytes.get(..HEADER).filter(|whole| is_whole(whole) && whole[7] == FORMAT)?;
        let number = |at: usize| little_endian(&whole[at..at + 8]);
        Some(Self {
            number: number(8),
            generation: number(16),
            case: Checksum::of_number(number(24)),
            length: number(32),
            body: Checksum::of_number(number(40)),
        })
    }
}

fn is_whole(header: &[u8]) -> bool {
    header[..7] == MARK && header[48..HEADER] == Checksum::of(&header[..48]).to_bytes()
}

/// The format of the records of a file that begins with `bytes`, where it is another one. The first
/// format had no mark: number of the run, length and checksum before the body.
pub(super) fn other_format(bytes: &[u8]) -> Option<u64> {
    let marked = bytes.get(..HEADER).filter(|whole| is_whole(whole) && whole[7] != FORMAT);
    let first = || {
        let length = usize::try_from(little_endian(bytes.get(8..16)?)).ok()?;
        let body = bytes.get(24..24usize.checked_add(length)?)?;
        (bytes[16..24] == Checksum::of(&bytes[..16]).with(body).to_bytes()).then_some(1)
    };
    marked.map(|header| u64::from(header[7])).or_else(first)
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
