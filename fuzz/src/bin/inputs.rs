//! Files that a case names, and tables of samples: the first byte selects the kind.

#![no_main]

use libfuzzer_sys::fuzz_target;
use railcrack_case::{Case, Column, Columns, SampleTable};
use railcrack_fuzz::folder;

const CRACK: &str = "[[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n\
                     [solver]\nengine = \"dislocation\"\n";
const CONTACT: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n";
const TABLE: &str = "[contact]\nkind = \"table\"\nprofile = \"input\"\n";

/// What names the file in a case.
const NAMES: [&str; 5] = [
    "[residual_stress]\nprofile = \"input\"\n",
    "[plastic_stress]\nprofile = \"input\"\n",
    "[plastic_stress]\nfield = \"input\"\n",
    "[temperature]\nrail_c = -5.0\nneutral_c = 25.0\n[fracture]\nprofile = \"input\"\n",
    "[growth]\nlaw = \"table\"\ntable_profile = \"input\"\n",
];

const MEASURED: Columns = Columns {
    columns: &[Column::Needed("mgt"), Column::Alternative("depth_mm"), Column::Alternative("length_mm")],
    largest: 1e6,
    help: "",
};

fuzz_target!(|input: &[u8]| {
    let Some((&kind, content)) = input.split_first() else { return };
    let (kind, folder) = (usize::from(kind) % (NAMES.len() + 3), folder());
    let path = folder.join("input");
    std::fs::write(&path, content).expect("a file");
    let read = match kind.checked_sub(NAMES.len()) {
        None => Case::parse(&format!("{CONTACT}{CRACK}{}", NAMES[kind]), "case.toml", &folder).map(drop),
        Some(0) => Case::parse(&format!("{TABLE}{CRACK}"), "case.toml", &folder).map(drop),
        Some(1) => SampleTable::read(&path).map(drop),
        Some(_) => MEASURED.read_file(&path).map(drop),
    };
    if let Err(errors) = read {
        errors.errors().iter().for_each(|error| drop((error.one_line(), error.excerpt())));
    }
});
