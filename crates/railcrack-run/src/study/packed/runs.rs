//! The packed runs of a study: which of them are whole and belong to it.

use super::record::{VOID, files_of};
use super::scan::{Damage, Record, Scan};
use crate::disk::Checksum;
use crate::error::OutputError;
use crate::run_folder::RunFiles;
use crate::study::plan::PlannedRun;
use std::collections::HashMap;
use std::fs::File;
use std::io::{ErrorKind, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

const PREFIX: &str = "packed-";
const ENDING: &str = ".bin";

/// Whether `name` is that of a file of packed runs.
fn is_packed(name: &str) -> bool {
    name.starts_with(PREFIX) && name.ends_with(ENDING)
}

/// The name of the file `number` in `folder`.
pub(super) fn packed_file(folder: &Path, number: usize) -> PathBuf {
    folder.join(format!("{PREFIX}{number}{ENDING}"))
}

/// The files of packed runs in `folder`, in order.
pub(in crate::study) fn packed_files(folder: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let entries = match std::fs::read_dir(folder) {
        Err(reason) if reason.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(OutputError::io("read", folder))?,
    };
    let mut files = Vec::new();
    for entry in entries {
        let entry = entry.map_err(OutputError::io("read", folder))?;
        if entry.file_name().to_str().is_some_and(is_packed) {
            files.push(entry.path());
        }
    }
    files.sort();
    Ok(files)
}

/// A record in a file.
#[derive(Debug, Clone, Copy)]
struct Place {
    file: usize,
    record: Record,
}

/// Something in a file that is no run of the study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Flaw {
    /// The file.
    pub(crate) file: PathBuf,
    /// The run, where it is known.
    pub(crate) run: Option<usize>,
    /// The flaw, in words.
    pub(crate) reason: String,
}

/// The packed runs of a study and their positions. An incomplete record counts as missing.
#[derive(Debug, Default)]
pub(crate) struct PackedRuns {
    files: Vec<PathBuf>,
    places: HashMap<usize, Place>,
    /// How often each run was revoked.
    revoked: HashMap<usize, u64>,
    flaws: Vec<Flaw>,
    /// Records of other cases than those of the study, by number.
    foreign: HashMap<usize, Place>,
}

impl PackedRuns {
    /// Those of the study with the runs `planned` in `folder`.
    ///
    /// Errors: a file has another format; the system refuses.
    pub(in crate::study) fn of(folder: &Path, planned: &[PlannedRun]) -> Result<Self, OutputError> {
        let mut runs = Self { files: packed_files(folder)?, ..Self::default() };
        let cases: HashMap<usize, &str> =
            planned.iter().map(|run| (run.number, run.case.as_deref().unwrap_or_default())).collect();
        for file in 0..runs.files.len() {
            let scan = Scan::of(&runs.files[file])?;
            for record in scan.records.into_iter().filter(|record| record.header.number != VOID) {
                runs.add(&cases, Place { file, record });
            }
            for damage in scan.damages {
                let flaw = Flaw {
                    file: runs.files[file].clone(),
                    run: damage.run.map(|run| run as usize),
                    reason: damage_in_words(&damage),
                };
                runs.flaws.push(flaw);
            }
        }
        let revoked = &runs.revoked;
        let counts = |number: &usize, place: &mut Place| {
            revoked.get(number).is_none_or(|&times| place.record.header.generation >= times)
        };
        runs.places.retain(counts);
        Ok(runs)
    }

    fn add(&mut self, cases: &HashMap<usize, &str>, place: Place) {
        let header = place.record.header;
        let number = header.number as usize;
        // A study of an older version has no checksums of its cases.
        let is_own =
            cases.get(&number).is_some_and(|case| case.is_empty() || *case == header.case.to_string());
        if !is_own {
            let reason = match cases.contains_key(&number) {
                true => format!("holds run {number} of another study: its case differs"),
                false => format!("holds run {number}, which this study does not have"),
            };
            self.flaws.push(Flaw { file: self.files[place.file].clone(), run: Some(number), reason });
            if header.length > 0 {
                self.foreign.insert(number, place);
            }
        } else if header.length == 0 {
            let times = self.revoked.entry(number).or_default();
            *times = (*times).max(header.generation);
        } else {
            let before = self.places.entry(number).or_insert(place);
            if before.record.header.generation <= header.generation {
                *before = place;
            }
        }
    }

    /// Whether run `number` is among them.
    pub(crate) fn has(&self, number: usize) -> bool {
        self.places.contains_key(&number)
    }

    /// The files of run `number`.
    ///
    /// Errors: the record is damaged; the system refuses.
    pub(in crate::study) fn read(&self, number: usize) -> Result<Option<RunFiles>, OutputError> {
        self.places.get(&number).map(|place| self.content(place)).transpose()
    }

    /// The files of run `number` of another study, and where they are.
    ///
    /// Errors: the record is damaged; the system refuses.
    pub(in crate::study) fn read_foreign(
        &self,
        number: usize,
    ) -> Result<Option<(&Path, RunFiles)>, OutputError> {
        let place = self.foreign.get(&number);
        place.map(|place| Ok((self.files[place.file].as_path(), self.content(place)?))).transpose()
    }

    fn content(&self, place: &Place) -> Result<RunFiles, OutputError> {
        let path = &self.files[place.file];
        let refused = || OutputError::io("read", path);
        let mut file = File::open(path).map_err(refused())?;
        file.seek(SeekFrom::Start(place.record.body)).map_err(refused())?;
        let header = place.record.header;
        let mut body = vec![0; header.length as usize];
        file.read_exact(&mut body).map_err(refused())?;
        let whole = match Checksum::of(&body) == header.body {
            true => files_of(&body),
            false => Err("does not hold what was written (checksum)".to_owned()),
        };
        whole.map_err(|reason| OutputError::damaged(path, format!("run {}: {reason}", header.number)))
    }

    /// The flaws of the files: damaged bytes, and runs of other studies.
    pub(crate) fn flaws(&self) -> &[Flaw] {
        &self.flaws
    }

    /// Why run `number` is not among them, where a file says so.
    pub(in crate::study) fn flaw_of(&self, number: usize) -> Option<&Flaw> {
        self.flaws.iter().find(|flaw| flaw.run == Some(number))
    }

    /// The generation of the next record of run `number`.
    pub(super) fn generation(&self, number: usize) -> u64 {
        let recorded = self.places.get(&number).map_or(0, |place| place.record.header.generation);
        recorded.max(self.revoked.get(&number).copied().unwrap_or_default())
    }
}

pub(super) fn damage_in_words(damage: &Damage) -> String {
    let Damage { from, to, run } = damage;
    let of_run = run.map_or_else(String::new, |run| format!(" (run {run})"));
    format!("bytes {from} to {to} do not hold what was written{of_run}")
}

impl Flaw {
    /// The file and what is wrong with it.
    pub(crate) fn text(&self) -> String {
        format!("{}: {}", self.file.display(), self.reason)
    }
}
