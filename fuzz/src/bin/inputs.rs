//! Files that a case names, tables of samples, measurements and entries: the first byte selects the
//! kind. A case that is accepted is stored with its files and read again as the same.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_case::{Case, CaseErrors, Entry, SampleTable};
use railcrack_fuzz::case_files::{COMMON, CaseWithFile, GIVEN, cases};
use railcrack_fuzz::folder;
use railcrack_run::calibration::read_measured;
use std::path::Path;
use std::sync::LazyLock;

static CASES: LazyLock<Vec<CaseWithFile>> = LazyLock::new(cases);

fuzz_target!(|input: &[u8]| {
    let Some((&kind, content)) = input.split_first() else { return };
    let (kind, folder) = (usize::from(kind) % (CASES.len() + 3), folder());
    let path = folder.join(GIVEN);
    std::fs::write(&path, content).expect("a file");
    let read = match kind.checked_sub(CASES.len()) {
        None => of_case(&CASES[kind], &folder),
        Some(0) => SampleTable::read(&path).map(drop),
        Some(1) => read_measured(&path).map(drop),
        Some(_) => Entry::read(&path).map(drop),
    };
    if let Err(errors) = read {
        errors.errors().iter().for_each(|error| drop((error.one_line(), error.excerpt())));
    }
});

fn of_case(kind: &CaseWithFile, folder: &Path) -> Result<(), CaseErrors> {
    if let Some((name, text)) = &kind.other {
        std::fs::write(folder.join(name), text).expect("a file");
    }
    let case = Case::parse(&format!("{}{COMMON}", kind.case), "case.toml", folder)?;
    std::fs::create_dir_all(folder.join("inputs")).expect("a folder");
    for file in case.companions() {
        std::fs::write(folder.join(file.name), file.text).expect("a file");
    }
    let stored = case.to_toml();
    let again = Case::parse(&stored, "stored.toml", folder).expect("a stored case is read");
    assert_eq!((again.to_toml(), again.companions().len()), (stored, case.companions().len()));
    Ok(())
}
