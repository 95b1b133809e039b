//! Files that a case names, each kind of them: copied into run folders, part of the checksums of a
//! study, removed with the run that they belong to.

use super::common::{done, folder, names};
use railcrack_case::file_keys;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[path = "../../../../fuzz/src/case_files.rs"]
mod fixtures;

use fixtures::{CaseWithFile, GIVEN, cases};

/// Writes the case `kind`, with `crack`, to `name` in `place`, and its files.
fn write(place: &Path, name: &str, kind: &CaseWithFile, crack: &str) {
    fs::write(place.join(name), format!("{}{crack}", kind.case)).unwrap();
    fs::write(place.join(GIVEN), &kind.content).unwrap();
    if let Some((other, text)) = &kind.other {
        fs::write(place.join(other), text).unwrap();
    }
}

#[test]
fn every_kind_of_file_has_its_case() {
    let kinds: BTreeSet<&str> = cases().iter().map(|kind| kind.kept_as).collect();
    let declared: BTreeSet<&str> = file_keys().into_iter().map(|key| key.kept_as).collect();
    assert_eq!(kinds, declared);
    // Each file is the copy for one key, so that none replaces another.
    assert_eq!(file_keys().len(), declared.len());
}

#[test]
fn a_study_of_every_kind_of_file_is_computed_resumed_and_verified() {
    let plain = format!(
        "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n{}",
        fixtures::COMMON
    );
    for kind in cases() {
        let place = folder("case-files", &kind.kept_as.replace(['/', '.'], "-"));
        write(&place, "case.toml", &kind, fixtures::COMMON);
        let study = fixtures::COMMON.replace("friction = 0.3", "friction = [0.2, 0.3]");
        write(&place, "study.toml", &kind, &study);
        let steps = ["--steps", "0", "--quiet"];
        done(&place, &[&["sweep", "study.toml"], &steps[..]].concat());
        done(&place, &[&["sweep", "study.toml", "--resume"], &steps[..]].concat());
        let told = done(&place, &["verify", "study"]);
        assert!(!told.contains("damaged"), "{}: {told}", kind.kept_as);
        // A run folder has its copy, and the run that replaces it has none of it.
        done(&place, &[&["run", "case.toml", "--out", "run"], &steps[..]].concat());
        assert!(place.join("run").join(kind.kept_as).is_file(), "{}", kind.kept_as);
        fs::write(place.join("plain.toml"), &plain).unwrap();
        done(&place, &[&["run", "plain.toml", "--out", "run", "--force"], &steps[..]].concat());
        assert!(!names(&place.join("run")).contains(&"inputs".to_owned()), "{}", kind.kept_as);
    }
}
