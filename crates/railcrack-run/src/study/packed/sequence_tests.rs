//! Files of packed runs over any sequence of appending, revoking, kills, resumption, merging and
//! damage, and a model of their content: at any time a run is whole and of this study, or it is
//! missing, and damage is reported until it is made good.

use super::tests::{checksum_of, files, place, plan};
use super::{PackWriter, PackedRuns, void_damages};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseResult, TestRunner};
use std::path::{Path, PathBuf};

const RUNS: usize = 4;
/// Processes at a time; each has its own runs.
const WRITERS: usize = 2;

#[derive(Debug, Clone)]
enum Step {
    /// The process of a run appends it, with a text of its own.
    Append { run: usize, text: u16 },
    /// The process of a run revokes it.
    Revoke { run: usize },
    /// A process is killed within its last record, of which a part is written.
    Kill { writer: usize, written: f64 },
    /// The other processes have ended; one resumes the study.
    Resume,
    /// A file with a run is copied into the folder, of the same study or of another one.
    Merge { run: usize, text: u16, case: &'static str },
    /// Bytes of a file change while no process has it.
    Damage { file: usize, at: f64, how: How },
}

#[derive(Debug, Clone)]
enum How {
    /// A bit.
    Turn(u8),
    /// Some bytes become zero.
    Zero(usize),
    /// Some bytes go: those behind them move.
    Remove(usize),
    /// Some bytes come between.
    Insert(Vec<u8>),
}

fn step() -> impl Strategy<Value = Step> {
    let run = || 1..=RUNS;
    let how = prop_oneof![
        4 => (0..8u8).prop_map(How::Turn),
        1 => (1..400usize).prop_map(How::Zero),
        1 => (1..400usize).prop_map(How::Remove),
        1 => prop::collection::vec(any::<u8>(), 1..100).prop_map(How::Insert),
    ];
    prop_oneof![
        6 => (run(), any::<u16>()).prop_map(|(run, text)| Step::Append { run, text }),
        1 => run().prop_map(|run| Step::Revoke { run }),
        2 => (0..WRITERS, 0.0..1.0).prop_map(|(writer, written)| Step::Kill { writer, written }),
        2 => Just(Step::Resume),
        1 => (run(), any::<u16>(), prop_oneof![Just("own"), Just("other")])
            .prop_map(|(run, text, case)| Step::Merge { run, text, case }),
        2 => (any::<prop::sample::Index>(), 0.0..1.0, how)
            .prop_map(|(file, at, how)| Step::Damage { file: file.index(16), at, how }),
    ]
}

/// A record as it was written, at `from..to` of its file; a revocation has no text.
#[derive(Debug, Clone)]
struct Written {
    file: PathBuf,
    from: u64,
    to: u64,
    run: usize,
    text: Option<String>,
    generation: u64,
    is_own: bool,
    bytes: Vec<u8>,
    /// Whether some of its bytes have changed and nothing has been said about it.
    is_hit: bool,
}

impl Written {
    /// Whether its bytes are in its place.
    fn is_whole(&self) -> bool {
        let file = std::fs::read(&self.file).unwrap();
        file.get(self.from as usize..self.to as usize) == Some(&self.bytes)
    }
}

/// The folder, and what should be in it.
struct World {
    folder: PathBuf,
    elsewhere: PathBuf,
    writers: [Option<PackWriter>; WRITERS],
    /// Records, those of other studies, too, and those that are no longer whole.
    records: Vec<Written>,
    /// Generations that each process has read or made.
    generations: [u64; RUNS + 1],
    /// Whether bytes have moved: what remains of a record may then be too short to be marked.
    is_shifted: bool,
    merged: usize,
}

impl World {
    fn new(name: &str) -> Self {
        Self {
            folder: place(name),
            elsewhere: place(&format!("{name}-elsewhere")),
            writers: [None, None],
            records: Vec::new(),
            generations: [0; RUNS + 1],
            is_shifted: false,
            merged: 0,
        }
    }

    fn length(path: &Path) -> u64 {
        std::fs::metadata(path).map_or(0, |file| file.len())
    }

    /// Notes a record that has just been written.
    fn write(&mut self, mut record: Written) {
        record.bytes =
            std::fs::read(&record.file).unwrap()[record.from as usize..record.to as usize].to_vec();
        self.records.push(record);
    }

    fn append(&mut self, run: usize, text: Option<String>) {
        let of_run = run % WRITERS;
        if self.writers[of_run].is_none() {
            self.writers[of_run] = Some(PackWriter::open(&self.folder, &plan("own", RUNS)).unwrap());
            // It begins from what the files say.
            for own in (1..=RUNS).filter(|own| own % WRITERS == of_run) {
                let said = self.own(own).map(|record| record.generation).max();
                self.generations[own] = said.unwrap_or_default();
            }
        }
        let writer = self.writers[of_run].as_mut().unwrap();
        let file = writer.path().to_path_buf();
        let from = Self::length(&file);
        let content = text.as_ref().map(|text| files("own", text));
        writer.append(run, checksum_of("own"), content.as_ref()).unwrap();
        self.generations[run] += u64::from(text.is_none());
        let (to, generation) = (Self::length(&file), self.generations[run]);
        self.write(Written {
            file,
            from,
            to,
            run,
            text,
            generation,
            is_own: true,
            bytes: Vec::new(),
            is_hit: false,
        });
    }

    fn kill(&mut self, writer: usize, written: f64) {
        let Some(killed) = self.writers[writer].take() else { return };
        let path = killed.path().to_path_buf();
        drop(killed);
        // Its last record, where it has written one.
        let end = Self::length(&path);
        let Some(last) = self.records.iter().position(|record| record.file == path && record.to == end)
        else {
            return;
        };
        let record = self.records.remove(last);
        let left = ((record.to - record.from) as f64 * written) as u64;
        std::fs::OpenOptions::new().write(true).open(&path).unwrap().set_len(record.from + left).unwrap();
    }

    fn merge(&mut self, run: usize, text: u16, case: &'static str) {
        let mut writer = PackWriter::open(&self.elsewhere, &plan(case, RUNS)).unwrap();
        let text = format!("merged {text}");
        writer.append(run, checksum_of(case), Some(&files(case, &text))).unwrap();
        let from = writer.path().to_path_buf();
        drop(writer);
        self.merged += 1;
        let file = self.folder.join(format!("packed-{}.bin", 100 + self.merged));
        std::fs::rename(from, &file).unwrap();
        let to = Self::length(&file);
        let is_own = case == "own";
        let text = Some(text);
        self.write(Written {
            file,
            from: 0,
            to,
            run,
            text,
            generation: 0,
            is_own,
            bytes: Vec::new(),
            is_hit: false,
        });
    }

    fn damage(&mut self, file: usize, at: f64, how: &How) {
        let paths = super::packed_files(&self.folder).unwrap();
        if paths.is_empty() {
            return;
        }
        let path = &paths[file % paths.len()];
        self.writers = [None, None];
        let before = std::fs::read(path).unwrap();
        if before.is_empty() {
            return;
        }
        let mut bytes = before.clone();
        let at = ((bytes.len() as f64 * at) as usize).min(bytes.len() - 1);
        let end = |count: usize| (at + count).min(before.len());
        let (hit, moved): (_, i64) = match how {
            How::Turn(bit) => {
                bytes[at] ^= 1 << bit;
                (at..at + 1, 0)
            }
            How::Zero(count) => {
                bytes[at..end(*count)].fill(0);
                (at..end(*count), 0)
            }
            How::Remove(count) => {
                bytes.drain(at..end(*count));
                (at..end(*count), at as i64 - end(*count) as i64)
            }
            How::Insert(piece) => {
                bytes.splice(at..at, piece.iter().copied());
                (at..at, piece.len() as i64)
            }
        };
        std::fs::write(path, &bytes).unwrap();
        self.is_shifted |= moved != 0;
        for record in self.records.iter_mut().filter(|record| record.file == *path) {
            if moved != 0 {
                let unmoved = (record.from, record.to);
                let is_behind = record.from as usize >= hit.end;
                record.from = record.from.saturating_add_signed(moved);
                record.to = record.to.saturating_add_signed(moved);
                // Where an inserted piece equals what it is inserted behind, the record has moved.
                if !is_behind && !record.is_whole() {
                    (record.from, record.to) = unmoved;
                }
            } else if (record.from as usize) < hit.end && hit.start < record.to as usize {
                record.is_hit = true;
            }
        }
        if moved != 0 {
            // What was hit may be gone without a trace.
            self.records.retain(|record| record.file != *path || record.is_whole());
        }
    }

    /// Whether damage is to be reported.
    fn is_damaged(&self) -> bool {
        self.records.iter().any(|record| record.is_hit && !record.is_whole())
    }

    fn resume(&mut self) -> TestCaseResult {
        self.writers = [None, None];
        let is_damaged = self.is_damaged();
        let said = void_damages(&self.folder).unwrap();
        prop_assert!(!is_damaged || !said.is_empty(), "damage that nothing is said about");
        self.records.retain(Written::is_whole);
        self.records.iter_mut().for_each(|record| record.is_hit = false);
        Ok(())
    }

    /// The whole records of run `run`, revocations included, in the order of files and places.
    fn own(&self, run: usize) -> impl Iterator<Item = &Written> {
        self.records.iter().filter(move |record| record.is_own && record.run == run && record.is_whole())
    }

    /// The texts that run `run` may have; none where it must be missing.
    fn expected(&self, run: usize) -> Vec<&str> {
        let revoked =
            self.own(run).filter(|record| record.text.is_none()).map(|record| record.generation).max();
        let whole = || self.own(run).filter_map(|record| Some((record.generation, record.text.as_deref()?)));
        let Some(newest) = whole().map(|(generation, _)| generation).max() else { return Vec::new() };
        if revoked.is_some_and(|revoked| newest < revoked) {
            return Vec::new();
        }
        whole().filter(|(generation, _)| *generation == newest).map(|(_, text)| text).collect()
    }

    fn check(&self) -> TestCaseResult {
        let packed = PackedRuns::of(&self.folder, &plan("own", RUNS)).unwrap();
        for run in 1..=RUNS {
            let expected = self.expected(run);
            prop_assert_eq!(packed.has(run), !expected.is_empty(), "run {}, {:?}", run, packed.flaws());
            if let Some(found) = packed.read(run).unwrap() {
                prop_assert!(expected.iter().any(|text| files("own", text) == found), "run {}", run);
            }
        }
        prop_assert!(!self.is_damaged() || !packed.flaws().is_empty(), "damage that nothing is said about");
        for record in self.records.iter().filter(|record| !record.is_own && record.is_whole()) {
            let is_said = packed.flaws().iter().any(|flaw| flaw.file == record.file);
            prop_assert!(is_said, "run {} of another study", record.run);
        }
        Ok(())
    }

    fn take(&mut self, step: Step) -> TestCaseResult {
        match step {
            Step::Append { run, text } => self.append(run, Some(format!("{text}"))),
            Step::Revoke { run } => self.append(run, None),
            Step::Kill { writer, written } => self.kill(writer, written),
            Step::Resume => {
                self.resume()?;
                let packed = PackedRuns::of(&self.folder, &plan("own", RUNS)).unwrap();
                let is_foreign = self.records.iter().any(|record| !record.is_own && record.is_whole());
                // Files of other studies stay, and scraps that are too short to be marked.
                prop_assert!(self.is_shifted || is_foreign || packed.flaws().is_empty());
            }
            Step::Merge { run, text, case } => self.merge(run, text, case),
            Step::Damage { file, at, how } => self.damage(file, at, &how),
        }
        self.check()
    }
}

fn sequences(cases: u32, name: &str) {
    let steps = prop::collection::vec(step(), 1..40);
    let answer = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() }).run(
        &steps,
        |steps| {
            let mut world = World::new(name);
            steps.into_iter().try_for_each(|step| world.take(step))
        },
    );
    for folder in [place(name), place(&format!("{name}-elsewhere"))] {
        let _ = std::fs::remove_dir_all(folder);
    }
    if let Err(error) = answer {
        panic!("{error}");
    }
}

#[test]
fn a_run_is_whole_and_of_this_study_or_missing() {
    sequences(60, "sequence");
}

#[test]
#[ignore = "extra: a thousand sequences"]
fn a_run_is_whole_and_of_this_study_or_missing_in_full() {
    sequences(1000, "sequence-in-full");
}
