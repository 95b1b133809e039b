//! Limits of a web page: cases that it computes, and those that it leaves to the program.

use super::case::Case;
use super::geometry::PlaneCase;
use crate::schema::{Choice, Report, Sections};
use crate::tables::{EXPLORER, OUTPUT, PlaneEngine};
use railcrack::dislocation::face_points;

/// Unknowns of the contact problem at most: a page has 4 GB of addresses, and four dense matrices
/// of this order have half of that.
const MOST_UNKNOWNS: usize = 8000;

/// A reason why a page does not compute a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotInPage {
    /// The key or section.
    pub key: &'static str,
    /// A sentence.
    pub message: String,
    /// A remedy.
    pub help: &'static str,
}

impl Case {
    /// Why a page does not compute the case: it has no memory for finite elements and no files.
    /// Empty where it does.
    #[must_use]
    pub fn not_in_page(&self) -> Vec<NotInPage> {
        let is_plain = |plane: &&PlaneCase| plane.engine == PlaneEngine::Dislocation;
        let Some(plane) = self.plane().filter(is_plain) else {
            return vec![NotInPage {
                key: "solver.engine",
                message: format!(
                    "solver.engine = \"{}\": a page computes with \"dislocation\" only",
                    self.engine().word()
                ),
                help: "write engine = \"dislocation\" below [solver]",
            }];
        };
        let mut all = Vec::new();
        if plane.plastic_stress.is_some() {
            all.push(NotInPage {
                key: "plastic_stress",
                message: "[plastic_stress]: a page does not balance a plastic stress".into(),
                help: "leave the section out",
            });
        }
        if let Some(file) = self.companions().first() {
            all.push(NotInPage {
                key: "file",
                message: format!(
                    "{}: a page computes from the text of the case alone, without other files",
                    file.name
                ),
                help: "leave out what names a file",
            });
        }
        let unknowns = 2 * face_points(&self.cracks, plane.face_resolution(&self.cracks));
        if unknowns > MOST_UNKNOWNS {
            all.push(NotInPage {
                key: "crack",
                message: format!("{unknowns} unknowns of contact: a page computes at most {MOST_UNKNOWNS}"),
                help: "fewer cracks, or a smaller [mesh] interface_elements",
            });
        }
        all
    }
}

/// Reports a page that is to compute what it does not.
pub(super) fn check_explorer(case: &Case, sections: &Sections, report: &mut Report) {
    let Some(output) = sections.one(&OUTPUT).filter(|_| case.output.explorer) else { return };
    if !case.output.report {
        let says = "is true, but report is false: the page is what computes";
        report.add(output.fault(EXPLORER, says).help("write report = true, or leave explorer out"));
    }
    for NotInPage { message, help, .. } in case.not_in_page() {
        let says = format!("is true, which this case does not allow: {message}");
        report.add(output.fault(EXPLORER, says).help(help));
    }
}
