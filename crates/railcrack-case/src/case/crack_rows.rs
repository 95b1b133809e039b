//! `[[crack]] table`: the cracks of an inspection as if each had a section of its own.

use crate::files::{CrackKeys, CrackTableFile, InspectedCrack, read_crack_table};
use crate::schema::{Report, SectionValues, Sections};
use crate::tables::{
    ANGLE, ANGLE_SD, COUNT, CRACK, CRACK_DEPTH, CRACK_LATERAL, CRACK_TABLE, LENGTH, LENGTH_SD, MOUTH,
    ROW_SEED, SPACING, SPACING_SD, SURFACE_HALF_LENGTH,
};
use std::path::Path;

const KEYS: CrackKeys = CrackKeys {
    mouth: MOUTH,
    depth: CRACK_DEPTH,
    length: LENGTH,
    surface_half_length: SURFACE_HALF_LENGTH,
    angle: ANGLE,
    lateral: CRACK_LATERAL,
};

/// `sections` with a section for each crack of a list, and the list; none where it has errors,
/// which are added to `report`. Without a list they are what they are.
pub(super) fn write_out(
    sections: &Sections,
    folder: &Path,
    report: &mut Report,
) -> (Sections, Option<CrackTableFile>) {
    let mut cracks = Vec::new();
    let mut file = None;
    for section in sections.all(&CRACK) {
        if section.get(CRACK_TABLE).is_none() {
            cracks.push(section.clone());
        } else if file.is_some() {
            let says = "is the second list of cracks of a case, which takes one";
            report.add(section.fault(CRACK_TABLE, says).help("one list holds all cracks"));
        } else {
            file = read_rows(section, folder, report);
            cracks.extend(file.iter().flat_map(|file| rows(section, file)));
        }
    }
    (sections.with(&CRACK, cracks), file)
}

/// A section for each crack of the list of `section`.
fn rows<'a>(
    section: &'a SectionValues,
    file: &'a CrackTableFile,
) -> impl Iterator<Item = SectionValues> + 'a {
    let of = |(i, crack): (usize, &InspectedCrack)| section.of_row(CRACK_TABLE, i + 1, crack.values(&KEYS));
    file.content().iter().enumerate().map(of)
}

/// The list of `section`, whose keys are those that it may have.
fn read_rows(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<CrackTableFile> {
    let of_copies = [LENGTH_SD, ANGLE_SD, SPACING, SPACING_SD].map(|row| row.key.name);
    let given = of_copies.into_iter().find(|name| section.is_given_name(name));
    let seed = section.is_given(ROW_SEED).then_some(ROW_SEED.key.name);
    let count = section.get(COUNT).filter(|count| *count > 1).map(|_| COUNT.key.name);
    if let Some(name) = count.or(given).or(seed) {
        let says = "applies to the copies of a crack, and a table has a row for each crack";
        return report.refuse(section.fault_of_name(name, says).help("leave it out, or table"));
    }
    let file = read_crack_table(section, CRACK_TABLE, &KEYS, folder, report)?;
    let without = file.content().iter().position(|crack| crack.angle.is_none());
    if let (Some(row), None, false) = (without, section.get(ANGLE), section.is_refused(ANGLE)) {
        let says = format!("row {} has no angle_deg, and neither has the section", row + 1);
        return report.refuse(section.fault(CRACK_TABLE, says).help(ANGLE.key.doc));
    }
    Some(file)
}
