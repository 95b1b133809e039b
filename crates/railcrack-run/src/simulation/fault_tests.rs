//! Faults of the disk in a small run: whatever fails, and whenever the process is killed, the run
//! goes on to the same files.

use super::error::RunError;
use super::run::{RunEntry, Simulation};
use crate::disk::faults::{FAULTS, Fault, during};
use crate::disk::sign;
use crate::verify::verify;
use railcrack_case::Case;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

const CASE: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.3\n[[crack]]\n\
    mouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 40.0\nfriction = 0.2\n[passage]\npositions = 21\n\
    [mesh]\ninterface_elements = 12\n[solver]\nengine = \"dislocation\"\n[growth]\nsteps = 2\n";

fn run(folder: &Path, entry: RunEntry) -> Result<(), RunError> {
    let case = Case::parse(CASE, "case.toml", "".as_ref()).unwrap();
    Simulation::new(&case).run_in(folder, entry).map(|_| ())
}

/// Every file of the run but what holds wall times: of the summary its content without them.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let content = match name.as_str() {
            "checkpoint.bin" | "run-log.bin" => Vec::new(),
            "summary.json" => {
                let mut summary = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
                sign(&mut summary);
                summary["checksum"].to_string().into_bytes()
            }
            _ => fs::read(&path).unwrap(),
        };
        files.insert(name, content);
    }
    files
}

fn place(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("railcrack-faults-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// Every `stride`-th change of the run meets each fault; how many faults there were.
fn every(stride: usize, name: &str) -> usize {
    let (whole, folder) = (place(&format!("{name}-whole")), place(name));
    let changes = during(&whole, Fault::Killed, usize::MAX, || run(&whole, RunEntry::Begin).unwrap());
    assert!(changes > 40, "{changes} changes");
    let expected = files(&whole);
    let mut met = 0;
    for fault in FAULTS {
        for at in (0..changes).step_by(stride) {
            let _ = fs::remove_dir_all(&folder);
            during(&folder, fault, at, || drop(run(&folder, RunEntry::Begin)));
            let resumed = run(&folder, RunEntry::ResumeOrBegin);
            assert!(resumed.is_ok(), "{fault:?} at change {at}: {resumed:?}");
            assert!(files(&folder) == expected, "{fault:?} at change {at}: other files");
            assert_eq!(verify(&folder).unwrap().damages, [""; 0], "{fault:?} at change {at}");
            met += 1;
        }
    }
    for folder in [whole, folder] {
        fs::remove_dir_all(folder).unwrap();
    }
    met
}

#[test]
fn a_run_goes_on_behind_a_fault_of_the_disk() {
    every(3, "sample");
}

#[test]
#[ignore = "extra: every change of a run to its files meets every fault"]
fn a_run_goes_on_behind_every_fault_of_the_disk() {
    println!("{} faults", every(1, "all"));
}
