//! Damaged folders of results: an answer in time, whatever stands in their files.
//!
//! The damage follows a seed, so that a failure can be made again; `RAILCRACK_MUTATIONS` sets how
//! many folders are tried.

use super::random::Random;
use super::simulation::run;
use super::support::Scratch;
use railcrack_report::rebuild_report;
use railcrack_run::simulation::RunEntry;
use railcrack_run::{RunFolder, verify};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Folders, unless the environment says otherwise: a second or two.
const FOLDERS: u64 = 200;

/// Time for one folder, on a machine that is busy.
const BUDGET: Duration = Duration::from_secs(10);

/// Pieces that are put in anywhere: numbers at the ends of their ranges, marks of the formats, and
/// lengths that no file has.
const PIECES: [&[u8]; 14] = [
    b"1e400",
    b"-1",
    b"nan",
    b"18446744073709551616",
    b"\"",
    b"{",
    b"]",
    b",",
    b"\n",
    b"\0",
    b"\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01",
    b"\xf0\x9f",
    b"../",
    b"",
];

/// `bytes` with one to three changes: a byte exchanged, a part removed or doubled, a piece put in,
/// the end cut off.
fn damaged(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len());
        let end = (at + random.below(40)).min(bytes.len());
        match random.below(6) {
            0 | 1 if !bytes.is_empty() => bytes[at] = random.below(256) as u8,
            2 => drop(bytes.drain(at..end)),
            3 => {
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            4 if random.below(4) == 0 => bytes.truncate(at),
            _ => drop(bytes.splice(at..end, PIECES[random.below(PIECES.len())].iter().copied())),
        }
    }
    bytes
}

/// The files of a folder that something is read from, those in its folders included.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(self::files(&path));
        } else if !path.extension().is_some_and(|end| end == "svg" || end == "html") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// Everything that reads a folder; every answer is fine.
fn read(folder: &Path) {
    if let Ok(run) = RunFolder::open(folder) {
        let _ = (run.case(), run.growth(), run.residual(), run.histories(run.summary.steps_recorded));
        let _ = run.sif().map(|steps| steps.filter(Result::is_ok).count());
        let _ = run.faces().map(|steps| steps.filter(Result::is_ok).count());
        let _ = run.fields().map(|files| files.iter().filter(|file| file.read().is_ok()).count());
    }
    let _ = verify(folder);
    let _ = rebuild_report(folder);
    let _ = run(folder, RunEntry::Resume, None);
}

#[test]
fn a_damaged_run_folder_is_answered() {
    let folders =
        std::env::var("RAILCRACK_MUTATIONS").ok().and_then(|count| count.parse().ok()).unwrap_or(FOLDERS);
    let scratch = Scratch::new("damaged-run");
    let folder = scratch.path().join("run");
    run(&folder, RunEntry::Begin, Some(3)).unwrap();
    let whole: Vec<(PathBuf, Vec<u8>)> =
        files(&folder).into_iter().map(|path| (path.clone(), fs::read(path).unwrap())).collect();
    assert!(whole.len() > 6, "{whole:?}");
    for seed in 0..folders {
        let mut random = Random(seed);
        let (path, bytes) = &whole[random.below(whole.len())];
        println!("seed {seed}: {}", path.display());
        fs::remove_dir_all(&folder).unwrap();
        for (path, bytes) in &whole {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        fs::write(path, damaged(bytes.clone(), &mut random)).unwrap();
        let started = Instant::now();
        read(&folder);
        assert!(started.elapsed() < BUDGET, "seed {seed}: {:?}", started.elapsed());
    }
}
