//! Files of packed runs: cut by kills, damaged, of other studies, in any order.

use super::record::{HEADER, Header, SUM};
use super::{PackWriter, PackedRuns, void_damages};
use crate::disk::Checksum;
use crate::disk::files::CASE_FILE;
use crate::error::OutputError;
use crate::run_folder::{CaseFiles, RunFiles};
use crate::study::plan::PlannedRun;
use std::path::{Path, PathBuf};

/// The files of a run: those of a case, and a table.
pub(super) fn files(case: &str, text: &str) -> RunFiles {
    [(CASE_FILE.to_owned(), case.to_owned()), ("growth.csv".to_owned(), text.repeat(100))].into()
}

pub(super) fn checksum_of(case: &str) -> Checksum {
    CaseFiles::packed(&files(case, "")).checksum()
}

/// Runs that all compute the case `case`.
pub(super) fn plan(case: &str, runs: usize) -> Vec<PlannedRun> {
    let of_case = Some(checksum_of(case).to_string());
    let run = |number: usize| PlannedRun {
        number,
        folder: number.to_string(),
        choice: Vec::new(),
        case: of_case.clone(),
    };
    (1..=runs).map(run).collect()
}

pub(super) fn place(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("railcrack-packed-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn writer(folder: &Path) -> PackWriter {
    PackWriter::open(folder, &plan("own", 3)).unwrap()
}

fn put(writer: &mut PackWriter, number: usize, text: &str) {
    writer.append(number, checksum_of("own"), Some(&files("own", text))).unwrap();
}

fn packed(folder: &Path) -> PackedRuns {
    PackedRuns::of(folder, &plan("own", 3)).unwrap()
}

#[test]
fn what_is_appended_is_read_and_what_a_kill_cuts_is_not_there() {
    let folder = place("cut");
    let (mut one, mut other) = (writer(&folder), writer(&folder));
    assert_ne!(one.path(), other.path(), "a file belongs to one process");
    put(&mut one, 1, "a");
    put(&mut other, 2, "b");
    put(&mut one, 3, "c");
    let path = one.path().to_path_buf();
    drop((one, other));
    let whole = std::fs::read(&path).unwrap();
    for cut in [whole.len() - 1, whole.len() - 30, HEADER + 3, 5, 0] {
        std::fs::write(&path, &whole[..cut]).unwrap();
        let runs = packed(&folder);
        assert_eq!((runs.has(1), runs.has(2), runs.has(3)), (cut > HEADER + 30, true, false), "{cut}");
        assert!(runs.flaws().is_empty(), "a kill is no damage: {cut}, {:?}", runs.flaws());
        // The next process goes on behind the last whole record.
        put(&mut writer(&folder), 3, "d");
        assert_eq!(packed(&folder).read(3).unwrap().unwrap(), files("own", "d"));
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_turned_bit_loses_no_more_than_its_record() {
    let folder = place("bit");
    let mut one = writer(&folder);
    let mut ends = Vec::new();
    for (number, text) in [(1, "a"), (2, "b"), (3, "c")] {
        put(&mut one, number, text);
        ends.push(std::fs::metadata(one.path()).unwrap().len() as usize);
    }
    let path = one.path().to_path_buf();
    drop(one);
    let whole = std::fs::read(&path).unwrap();
    for at in 0..whole.len() {
        let mut turned = whole.clone();
        turned[at] ^= 1 << (at % 8);
        std::fs::write(&path, &turned).unwrap();
        let lost = 1 + ends.iter().filter(|&&end| end <= at).count();
        let has = |runs: &PackedRuns| [1, 2, 3].map(|number| runs.has(number));
        let runs = packed(&folder);
        assert_eq!(has(&runs), [1, 2, 3].map(|number| number != lost), "byte {at}");
        assert_eq!(runs.flaws().len(), 1, "byte {at}: {:?}", runs.flaws());
        // Once it is said, the bytes count as missing, and the run can be computed again.
        assert_eq!(void_damages(&folder).unwrap().len(), 1);
        put(&mut writer(&folder), lost, "again");
        let runs = packed(&folder);
        assert_eq!((has(&runs), runs.flaws()), ([true; 3], &[][..]), "byte {at}");
        for (number, text) in [(1, "a"), (2, "b"), (3, "c")] {
            let text = if number == lost { "again" } else { text };
            assert_eq!(runs.read(number).unwrap().unwrap(), files("own", text), "byte {at}");
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn runs_of_another_study_are_not_taken_over() {
    let folder = place("foreign");
    let other = plan("other", 3);
    let mut foreign = PackWriter::open(&folder, &other).unwrap();
    foreign.append(2, checksum_of("other"), Some(&files("other", "b"))).unwrap();
    foreign.append(9, checksum_of("own"), Some(&files("own", "b"))).unwrap();
    drop(foreign);
    let runs = packed(&folder);
    assert!(!runs.has(2) && !runs.has(9));
    assert_eq!(runs.flaws().len(), 2, "{:?}", runs.flaws());
    let (path, content) = runs.read_foreign(2).unwrap().unwrap();
    assert_eq!((path, content), (folder.join("packed-1.bin").as_path(), files("other", "b")));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_is_revoked_does_not_depend_on_the_order_of_files() {
    let folder = place("revoked");
    let (mut one, mut other) = (writer(&folder), writer(&folder));
    put(&mut other, 1, "a");
    drop((other, one));
    // Into the first file, of a run in the second one.
    one = writer(&folder);
    one.append(1, checksum_of("own"), None).unwrap();
    assert!(!packed(&folder).has(1));
    put(&mut one, 1, "b");
    assert_eq!(packed(&folder).read(1).unwrap().unwrap(), files("own", "b"));
    drop(one);
    std::fs::rename(folder.join("packed-1.bin"), folder.join("packed-3.bin")).unwrap();
    assert_eq!(packed(&folder).read(1).unwrap().unwrap(), files("own", "b"));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn other_formats_are_refused() {
    let folder = place("format");
    let path = folder.join("packed-1.bin");
    // Before SHA-256: seven numbers of eight bytes.
    let before = [&b"RAILRUN\x02"[..], &[0; 48]].concat();
    let mut later = Header::new(1, 0, Checksum::NONE, b"").to_bytes();
    later[7] += 1;
    let sum = Checksum::of(&later[..SUM]).to_bytes();
    later[SUM..].copy_from_slice(&sum);
    for (bytes, format) in [(&before[..], 2), (&later[..], 4)] {
        std::fs::write(&path, bytes).unwrap();
        let error = PackedRuns::of(&folder, &plan("own", 3)).unwrap_err();
        assert!(matches!(error, OutputError::OtherVersion { .. }));
        assert!(error.to_string().contains(&format!("packed format {format}")), "{error}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
