//! The checkpoint and the run log: everything a run needs to continue after its last finished step.
//! Each step appends an entry to the log; the checkpoint is replaced, and records how much of the
//! log and of the tables is valid.

use super::case_files::CaseFiles;
use crate::csv::{ContactRow, CsvFile, FaceRow, ResidualRow, SifRow, Table, TipRow};
use crate::disk::files::{CHECKPOINT_FILE, RUN_LOG_FILE};
use crate::disk::{CHECKSUM_BYTES, Checksum, Durability, Seal, VERSION, read_if_there, replace_file};
use crate::error::OutputError;
use crate::log::{Present, RunLog, StepDigest};
use railcrack::growth::GrowthState;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

const MAGIC: [u8; 8] = *b"RAILCRCK";

/// Raised whenever the layout of [`Checkpoint`] or of what it holds changes.
const FORMAT: u32 = 21;

/// Magic, format, checksum.
const HEADER: usize = 8 + 4 + CHECKSUM_BYTES;

/// Content of tables and run log after the last finished step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Seals {
    /// None where the run has no such table.
    pub sif: Option<Seal>,
    pub growth: Seal,
    /// None where the run has no such table.
    pub faces: Option<Seal>,
    /// None where no wheel feels the cracks.
    pub contact: Option<Seal>,
    pub log: Seal,
}

impl Seals {
    /// Checksums of the tables and fields of a run with this `log`, by file.
    pub(crate) fn checksums(&self, log: &RunLog) -> BTreeMap<String, String> {
        let tables = self.tables().map(|(file, seal)| (file.to_owned(), seal));
        let residual = log.now.residual_table.map(|seal| (ResidualRow::FILE.to_owned(), seal));
        let fields = log.fields().map(|field| (field.name.clone(), field.seal));
        let all = tables.chain(residual).chain(fields);
        all.map(|(file, seal)| (file, seal.checksum.to_string())).collect()
    }

    /// The tables with their files.
    pub(crate) fn tables(&self) -> impl Iterator<Item = (&'static str, Seal)> + use<> {
        let all = [
            (SifRow::FILE, self.sif),
            (TipRow::FILE, Some(self.growth)),
            (FaceRow::FILE, self.faces),
            (ContactRow::FILE, self.contact),
        ];
        all.into_iter().filter_map(|(file, seal)| Some((file, seal?)))
    }
}

/// The state of a run after a finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    /// Version of the program.
    pub program: String,
    pub state: GrowthState,
    pub seals: Seals,
    pub now: Present,
    /// The run before its last step, where it ended only because its case has no more steps.
    pub before_end: Option<Box<AfterStep>>,
}

/// A run after one of its steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct AfterStep {
    pub state: GrowthState,
    pub seals: Seals,
    pub now: Present,
}

/// The run log as a file: program and case, then an entry per step, in postcard encoding.
#[derive(Debug)]
pub(crate) struct LogFile {
    file: CsvFile,
}

impl LogFile {
    /// A new log of a run of `case` in `folder`.
    pub(crate) fn create(folder: &Path, case: &CaseFiles) -> Result<Self, OutputError> {
        let file = CsvFile::create(&folder.join(RUN_LOG_FILE), "")?;
        let mut log = Self { file };
        log.append(&encoded(folder, case)?)?;
        Ok(log)
    }

    /// Content of the log of the run in `folder` as far as `checkpoint` covers it: the case and
    /// the finished steps.
    pub(crate) fn read(folder: &Path, checkpoint: &Checkpoint) -> Result<(CaseFiles, RunLog), OutputError> {
        let path = folder.join(RUN_LOG_FILE);
        let bytes = read_if_there(&path)?.unwrap_or_default();
        let seal = checkpoint.seals.log;
        let counts = usize::try_from(seal.length).ok().and_then(|length| bytes.get(..length));
        let bytes = counts.filter(|bytes| Seal::of(bytes) == seal);
        let bytes =
            bytes.ok_or_else(|| OutputError::damaged(&path, "does not hold what was written (checksum)"))?;
        let damaged = |reason: postcard::Error| OutputError::damaged(&path, reason.to_string());
        let (mut case, mut rest): (CaseFiles, _) = postcard::take_from_bytes(bytes).map_err(damaged)?;
        if let Some(toml) = &checkpoint.now.longer_case {
            case.toml.clone_from(toml);
        }
        let mut steps: Vec<StepDigest> = Vec::new();
        while !rest.is_empty() {
            let (step, behind) = postcard::take_from_bytes(rest).map_err(damaged)?;
            steps.push(step);
            rest = behind;
        }
        Ok((case, RunLog { steps, now: checkpoint.now.clone() }))
    }

    /// The log of the run in `folder`, cut back to what `checkpoint` covers.
    pub(crate) fn cut_back(folder: &Path, checkpoint: &Checkpoint) -> Result<Self, OutputError> {
        Ok(Self { file: CsvFile::cut_back(&folder.join(RUN_LOG_FILE), checkpoint.seals.log)? })
    }

    /// Appends a finished step.
    pub(crate) fn add(&mut self, folder: &Path, step: &StepDigest) -> Result<(), OutputError> {
        self.append(&encoded(folder, step)?)
    }

    fn append(&mut self, entry: &[u8]) -> Result<(), OutputError> {
        self.file.append(entry)
    }

    /// Waits until the disk has it.
    pub(crate) fn sync(&self) -> Result<(), OutputError> {
        self.file.sync()
    }

    /// Content of the log.
    pub(crate) fn seal(&self) -> Seal {
        self.file.seal()
    }
}

fn encoded(folder: &Path, entry: &impl Serialize) -> Result<Vec<u8>, OutputError> {
    postcard::to_stdvec(entry)
        .map_err(|reason| OutputError::damaged(&folder.join(RUN_LOG_FILE), reason.to_string()))
}

impl Checkpoint {
    /// The checkpoint of this version for a run `after` a step.
    pub(crate) fn of(after: AfterStep, before_end: Option<AfterStep>) -> Self {
        let AfterStep { state, seals, now } = after;
        Self { program: VERSION.to_owned(), state, seals, now, before_end: before_end.map(Box::new) }
    }

    /// The run after its last step.
    pub(crate) fn after(&self) -> AfterStep {
        AfterStep { state: self.state.clone(), seals: self.seals, now: self.now.clone() }
    }

    /// Replaces the previous checkpoint by this one.
    pub(crate) fn write(&self, folder: &Path, durability: Durability) -> Result<(), OutputError> {
        let path = folder.join(CHECKPOINT_FILE);
        let body =
            postcard::to_stdvec(self).map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let mut bytes = Vec::with_capacity(HEADER + body.len());
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&FORMAT.to_le_bytes());
        bytes.extend_from_slice(&Checksum::of(&body).to_bytes());
        bytes.extend_from_slice(&body);
        replace_file(&path, &bytes, durability)
    }

    /// The checkpoint in `folder`; none where no step has finished.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, OutputError> {
        let path = folder.join(CHECKPOINT_FILE);
        let Some(bytes) = read_if_there(&path)? else {
            return Ok(None);
        };
        let damaged = |reason: &str| OutputError::damaged(&path, reason);
        if bytes.len() < 12 || bytes[..8] != MAGIC {
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
        let body = bytes.get(HEADER..).filter(|body| bytes[12..HEADER] == Checksum::of(body).to_bytes());
        let body = body.ok_or_else(|| damaged("does not hold what was written (checksum)"))?;
        let checkpoint: Self = postcard::from_bytes(body).map_err(|reason| damaged(&reason.to_string()))?;
        if checkpoint.program != VERSION {
            return Err(other_version(checkpoint.program, VERSION.to_owned()));
        }
        Ok(Some(checkpoint))
    }
}

/// Reads `input` as the content of a checkpoint in `folder` and as an entry of the run log, behind
/// their checksums.
#[cfg(fuzzing)]
pub fn fuzz_checkpoint(folder: &Path, input: &[u8]) {
    let header = [&MAGIC[..], &FORMAT.to_le_bytes(), &Checksum::of(input).to_bytes()].concat();
    std::fs::write(folder.join(CHECKPOINT_FILE), [&header, input].concat()).expect("a file");
    let _ = Checkpoint::read(folder);
    let _ = postcard::from_bytes::<StepDigest>(input);
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u64::from(byte))
}
