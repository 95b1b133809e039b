//! Files that a case names, and how they are stored with it.

use super::columns::Columns;
use super::detection_table::DetectionTable;
use crate::schema::{Fault, KeyRow, Kind, Report, SMALLER, SectionValues, Source, read_text};
use railcrack::fatigue::{RateTable, Toughness};
use railcrack::field::DepthProfile;
use railcrack::load::TableContact;
use railcrack::residual::PlasticField;
use std::path::Path;

/// A file that belongs to the text of [`Case::to_toml`](crate::Case::to_toml), under the name used
/// in that text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Companion<'a> {
    /// Its name, relative to the folder of the case file, with `/`.
    pub name: &'static str,
    /// Its content.
    pub text: &'a str,
    /// The file as the case of the user names it.
    pub given: &'a str,
    /// Columns of it that are not read.
    pub unused: &'a [String],
}

/// A file that a case names. Two are equal when their texts are.
#[derive(Debug, Clone)]
pub struct CaseFile<T> {
    given: String,
    kept_as: &'static str,
    text: String,
    content: T,
    unused: Vec<String>,
}

/// A plastic stress on a mesh, and its file reduced to the mesh and this one array.
pub type FieldFile = CaseFile<PlasticField>;

/// Probability of detection by depth, and the text it was read from.
pub type DetectionFile = CaseFile<DetectionTable>;

/// Growth rates by equivalent range, and the text they were read from.
pub type RatesFile = CaseFile<RateTable>;

/// A contact of wheel and rail and the text it was read from.
pub type ContactFile = CaseFile<TableContact>;

/// A toughness over temperature and the text it was read from.
pub type ToughnessFile = CaseFile<Toughness>;

/// A stress profile and the text it was read from.
pub type ProfileFile = CaseFile<DepthProfile>;

impl<T> PartialEq for CaseFile<T> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl<T> CaseFile<T> {
    /// The file that `row` names `given`.
    pub(super) fn new(row: KeyRow<String>, given: String, text: String, content: T) -> Self {
        let kept_as = match row.key.kind {
            Kind::Path { kept_as } => kept_as,
            _ => row.key.name,
        };
        Self { given, kept_as, text, content, unused: Vec::new() }
    }

    /// Its content.
    #[must_use]
    pub fn content(&self) -> &T {
        &self.content
    }

    /// Its text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its name as the case gives it.
    #[must_use]
    pub fn given_name(&self) -> &str {
        &self.given
    }

    /// The file stored with a case.
    pub(crate) fn companion(&self) -> Companion<'_> {
        Companion { name: self.kept_as, text: &self.text, given: &self.given, unused: &self.unused }
    }
}

/// Help where a file cannot be found.
pub(super) const RELATIVE: &str = "file names are relative to the folder of the case file";

/// The table in the file that a key names, relative to `folder`, with what `parse` makes of it;
/// none if no file is named or it is refused; errors are added to `report`.
pub(super) fn read_named<T>(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
    columns: &Columns,
    parse: impl FnOnce(&Source) -> Result<T, Box<Fault>>,
) -> Option<CaseFile<T>> {
    let given = section.get(row)?;
    let path = folder.join(&given);
    let key = || Some(section.dotted(row.key.name));
    match read_text(&path, &path.display().to_string()) {
        Ok(source) => match parse(&source) {
            Ok(content) => {
                let unused = columns.unused_of(&source);
                return Some(CaseFile {
                    unused,
                    ..CaseFile::new(row, given, source.text.to_string(), content)
                });
            }
            // The file as a whole is wrong, and so is the key that names it.
            Err(fault) if fault.span.is_none() => {
                let at_key = section.fault(row, fault.message);
                report.add(Fault { help: fault.help, ..at_key });
            }
            Err(fault) => report.add_to(&source, Fault { key: key(), ..*fault }),
        },
        Err(unreadable) => match *unreadable {
            (source, fault) if fault.span.is_some() => report.add_to(&source, Fault { key: key(), ..fault }),
            (_, fault) => {
                let help = if fault.help.as_deref() == Some(SMALLER) { SMALLER } else { RELATIVE };
                report.add(section.fault(row, fault.message).help(help));
            }
        },
    }
    None
}
