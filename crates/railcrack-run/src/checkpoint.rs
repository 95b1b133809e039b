//! The checkpoint: everything a run needs in order to go on after its last finished step.

use super::folder::{self, CHECKPOINT_FILE, CaseFiles, Durability};
use super::story::Story;
use super::{OutputError, VERSION};
use railcrack::growth::GrowthState;
use serde::{Deserialize, Serialize};
use std::path::Path;

const MAGIC: [u8; 8] = *b"RAILCRCK";

/// Raised whenever the layout of [`Checkpoint`] or of what it holds changes.
const FORMAT: u32 = 6;

/// Magic, format, checksum.
const HEADER: usize = 8 + 4 + 8;

/// Bytes in each table after the last finished step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct TableLengths {
    pub sif: u64,
    pub growth: u64,
    pub faces: u64,
}

/// The state of a run after a finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    /// Version of the program.
    pub program: String,
    pub case: CaseFiles,
    pub state: GrowthState,
    pub lengths: TableLengths,
    pub story: Story,
}

impl Checkpoint {
    /// Puts this checkpoint in the place of the one before.
    pub(crate) fn write(&self, folder: &Path, durability: Durability) -> Result<(), OutputError> {
        let path = folder.join(CHECKPOINT_FILE);
        let body =
            postcard::to_stdvec(self).map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let mut bytes = Vec::with_capacity(HEADER + body.len());
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&FORMAT.to_le_bytes());
        bytes.extend_from_slice(&checksum(&body).to_le_bytes());
        bytes.extend_from_slice(&body);
        folder::replace_file(&path, &bytes, durability)
    }

    /// The checkpoint in `folder`; none where no step has finished.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, OutputError> {
        let path = folder.join(CHECKPOINT_FILE);
        let Some(bytes) = folder::read_if_there(&path)? else {
            return Ok(None);
        };
        let damaged = |reason: &str| OutputError::damaged(&path, reason);
        if bytes.len() < HEADER || bytes[..8] != MAGIC {
            return Err(damaged("is not a checkpoint of railcrack"));
        }
        let other_version = |written_by: String, this: String| OutputError::OtherVersion {
            folder: folder.to_path_buf(),
            written_by,
            this,
        };
        let format = little_endian(&bytes[8..12]);
        if format != u64::from(FORMAT) {
            let this = format!("{VERSION} with checkpoint format {FORMAT}");
            return Err(other_version(format!("with checkpoint format {format}"), this));
        }
        let body = &bytes[HEADER..];
        if little_endian(&bytes[12..HEADER]) != checksum(body) {
            return Err(damaged("does not hold what was written (checksum)"));
        }
        let checkpoint: Self = postcard::from_bytes(body).map_err(|reason| damaged(&reason.to_string()))?;
        if checkpoint.program != VERSION {
            return Err(other_version(checkpoint.program, VERSION.to_owned()));
        }
        Ok(Some(checkpoint))
    }
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u64::from(byte))
}

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
