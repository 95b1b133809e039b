//! Case files, read to a case or to all their errors.

use super::build::build;
use super::by_geometry::ByGeometry;
use super::case::Case;
use super::overrides::Overrides;
use crate::schema::{
    CaseErrors, Chosen, Fault, Reading, Report, Sections, Source, from_file, parse_document, read_sections,
};
use crate::tables::{CASE_FILE, OUTPUT, RUN_FOLDERS, STUDY};
use std::path::Path;
use toml::de::DeTable;

impl Case {
    /// The case in the file `path`, written by a user or the `case.toml` of a run folder. Relative
    /// file names in it are relative to its folder.
    ///
    /// Errors: all of the file, a file that cannot be read included.
    pub fn read(path: &Path) -> Result<Self, CaseErrors> {
        Self::read_with(path, &Overrides::default())
    }

    /// As [`Case::read`], with `overrides` replacing values of the file.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        from_file(path, |text, name, folder| Self::parse_with(text, name, folder, overrides))
    }

    /// The case written in `text`; errors call it `name`, relative file names are relative to
    /// `folder`.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self, CaseErrors> {
        Self::parse_with(text, name, folder, &Overrides::default())
    }

    /// As [`Case::parse`], with `overrides` replacing values of the text.
    pub fn parse_with(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<Self, CaseErrors> {
        let mut report = Report::new(Source::of_file(name, text, &CASE_FILE));
        let case = parse_document(text, &mut report)
            .filter(|root| is_no_study(root.get_ref(), &mut report))
            .and_then(|root| {
                let overrides = overrides.list(&mut report);
                let reading = Reading {
                    file: &CASE_FILE,
                    overrides: &overrides,
                    chosen: &Chosen::default(),
                    defaults: &[],
                };
                let sections = read_sections(root.get_ref(), reading, &mut report);
                refuse_no_folder(&sections, &mut report);
                build(sections, folder, &ByGeometry::default(), &mut report)
            });
        match case {
            Some(case) if report.is_clean() => Ok(case),
            _ => Err(report.into_errors()),
        }
    }
}

/// A single run is its folder.
fn refuse_no_folder(sections: &Sections, report: &mut Report) {
    if let Some(output) = sections.one(&OUTPUT).filter(|output| output.get(RUN_FOLDERS) == Some(false)) {
        let help = "`railcrack sweep` computes studies; a single run writes less with faces, sif, plots and report = false";
        report.add(output.fault(RUN_FOLDERS, "only a study can be stored without run folders").help(help));
    }
}

/// A study is not a case: an error that explains how it is computed.
fn is_no_study(root: &DeTable, report: &mut Report) -> bool {
    let Some((name, _)) = root.get_key_value(STUDY.name) else { return true };
    let (file, header) = (&report.source.name, STUDY.header());
    let help = format!("`railcrack sweep {file}` computes it, `railcrack check {file}` lists its cases");
    let message = format!(
        "`{header}`: this file is a study, which describes many cases, but a single case is expected"
    );
    report.add(Fault::of(STUDY.name, name.span(), message).help(help));
    false
}
