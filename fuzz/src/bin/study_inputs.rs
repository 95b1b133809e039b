//! Studies of cases that name a file: the first byte selects the kind of the file, the second how
//! its key varies.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_case::{Input, Overrides};
use railcrack_fuzz::case_files::{COMMON, CaseWithFile, GIVEN, cases};
use railcrack_fuzz::folder;
use std::sync::LazyLock;

static CASES: LazyLock<Vec<CaseWithFile>> = LazyLock::new(cases);

/// What varies: a number, a number that is drawn, the file itself.
const VARIED: [(&str, &str); 3] = [
    ("friction = 0.3\n", "friction = [0.2, 0.3]\n"),
    ("length_mm = 4.0", "length_mm = { normal = [4.0, 0.1] }"),
    ("\"input\"", "[\"input\", \"good\"]"),
];

fuzz_target!(|input: &[u8]| {
    let [kind, varied, content @ ..] = input else { return };
    let kind = &CASES[usize::from(*kind) % CASES.len()];
    let (one, several) = VARIED[usize::from(*varied) % VARIED.len()];
    let folder = folder();
    let text = format!("{}{COMMON}", kind.case).replacen(one, several, 1) + "[study]\nsamples = 2\n";
    std::fs::write(folder.join(GIVEN), content).expect("a file");
    std::fs::write(folder.join("good"), &kind.content).expect("a file");
    if let Some((name, text)) = &kind.other {
        std::fs::write(folder.join(name), text).expect("a file");
    }
    match Input::parse_with(&text, "study.toml", &folder, &Overrides::default()) {
        Ok(Input::Study(study)) => {
            // Every run is a case with its files.
            let names = |run: usize| study.runs[run].case.companions().iter().map(|file| file.name).collect();
            let all: Vec<Vec<&str>> = (0..study.runs.len()).map(names).collect();
            assert!(all.iter().all(|names| names.contains(&kind.kept_as)));
        }
        Ok(Input::Case(_)) => {}
        Err(errors) => errors.errors().iter().for_each(|error| drop((error.one_line(), error.excerpt()))),
    }
});
