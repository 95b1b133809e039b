//! Warnings and remarks on a run.

use super::data::explored_steps;
use super::stored::RunFolder;
use crate::numbers::{fixed, significant};
use crate::page_data::PageData;
use crate::row::NamedCrack;
use railcrack::bulk::Boundary;
use railcrack::growth::WarningKind;
use railcrack_run::summary::WarningSummary;
use std::fmt::Write;

/// Maximum number of warnings of a kind shown; the others are counted.
const OF_A_KIND: usize = 3;

/// Warnings of the run grouped by kind, a note on the boundary of a block, and a note on a run that
/// has not ended.
pub(super) fn warnings(run: &RunFolder) -> Vec<String> {
    let mut texts = Vec::new();
    if !run.summary.complete {
        texts.push("The run has not ended; repeat its command with --resume to continue it.".to_owned());
    }
    if run.case.boundary() != Boundary::HalfPlane {
        texts.push(
            "Boundary: block on supports. Bending of the block opens cracks that stay closed in a half-plane; compare only with \
             results for the same boundary."
                .to_owned(),
        );
    }
    let all: Vec<&WarningSummary> = before_failure(run).collect();
    let mut kinds: Vec<WarningKind> = Vec::new();
    for warning in &all {
        if !kinds.contains(&warning.kind) {
            kinds.push(warning.kind);
        }
    }
    for kind in kinds {
        let of_kind: Vec<&WarningSummary> =
            all.iter().copied().filter(|warning| warning.kind == kind).collect();
        texts.push(grouped_text(kind, &of_kind));
    }
    texts
}

/// The warnings on steps that begin before the rail has failed.
fn before_failure(run: &RunFolder) -> impl Iterator<Item = &WarningSummary> {
    run.summary.warnings.iter().filter(|warning| run.is_before_failure(warning.step))
}

/// Number of warnings, each counted, which [`warnings`] groups by kind.
pub(super) fn count(run: &RunFolder) -> usize {
    let notes = [!run.summary.complete, run.case.boundary() != Boundary::HalfPlane];
    before_failure(run).count() + notes.into_iter().filter(|is_so| *is_so).count()
}

fn grouped_text(kind: WarningKind, warnings: &[&WarningSummary]) -> String {
    let heading = match kind {
        WarningKind::NearTie => "Near ties of the direction criterion: the path is sensitive to this choice",
        WarningKind::PopIn => "Pop-ins: a tip extends at once under one load, and arrests",
        WarningKind::Passages => "Passages not stabilised within the limit",
        WarningKind::Groups => "Accuracy of the contact in groups of cracks",
        WarningKind::ContactFallback => "Contact solved by the alternative solver",
        WarningKind::Engine => "Remarks of the engine",
        WarningKind::ResidualStress => "Residual stress",
        WarningKind::Validity => "Outside the validity of the model",
        WarningKind::Input => "Numbers of the case that are probably not those that are meant",
    };
    let mut text = format!("{heading} ({}). ", kind.page());
    let several =
        warnings.iter().map(|warning| &warning.text).collect::<std::collections::BTreeSet<_>>().len() > 1;
    let shown = if several { OF_A_KIND } else { 1 };
    for warning in warnings.iter().take(shown) {
        // Writing to a string does not fail.
        let place = warning.place().replacen('s', "S", 1);
        let _ = write!(text, "{place}: {}. ", warning.text.trim_end_matches('.'));
    }
    if warnings.len() > shown {
        let steps: Vec<String> =
            warnings.iter().skip(shown).map(|warning| warning.step.to_string()).collect();
        let list = if steps.len() > 12 {
            format!("{} … {}", steps[..11].join(", "), steps[steps.len() - 1])
        } else {
            steps.join(", ")
        };
        let rest = warnings.len() - shown;
        let (others, steps) = match (several, rest) {
            (false, _) => ("the same", if rest == 1 { "step" } else { "steps" }),
            (true, 1) => ("other", "step"),
            (true, _) => ("others", "steps"),
        };
        let _ = write!(text, "And {rest} {others}, in {steps} {list}.");
    }
    text.trim_end().to_owned()
}

/// Remarks: the largest secondary maximum; results that the page leaves out.
pub(super) fn remarks(run: &RunFolder, page_data: &PageData, named: Option<&[NamedCrack]>) -> Vec<String> {
    let mut texts = Vec::new();
    let secondary_maxima = run.growth.iter().filter_map(|row| Some((row, row.rival_deg?, row.rival_ratio?)));
    if let Some((row, angle, ratio)) =
        secondary_maxima.reduce(|most, next| if next.2 > most.2 { next } else { most })
    {
        let kink = row.kink_deg.unwrap_or(0.0);
        texts.push(format!(
            "Largest secondary maximum of the direction criterion: step {}, crack {}, kink of {}°, {} times the maximum at the \
             selected kink of {}°. A ratio above 0.98 is a near tie.",
            row.step,
            row.crack,
            fixed(angle, 0),
            significant(ratio),
            fixed(kink, 0)
        ));
    }
    let later = run.summary.warnings.len() - before_failure(run).count();
    if later > 0 {
        texts.push(format!("{later} more warnings are on steps after the failure; summary.json has them."));
    }
    let steps = explored_steps(run, page_data, named).len();
    if steps < run.summary.steps_recorded {
        texts.push(format!(
            "To limit the file size, the passage explorer shows {} of {} growth steps; the growth charts show all.",
            steps, run.summary.steps_recorded
        ));
    }
    if let Some(named) = named {
        let mut numbers: Vec<usize> = named.iter().map(|named| named.crack).collect();
        numbers.sort_unstable();
        let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
        texts.push(format!(
            "To limit the file size, K of each crack is shown only for wheel positions near it, and the faces of cracks {} only in \
             the first and the last growth step; sif.csv and faces.csv have all.",
            numbers.join(", ")
        ));
    }
    if page_data.face_stride() > 1 {
        texts.push(format!(
            "To limit the file size, crack faces are shown at one in {} wheel positions; faces.csv has all.",
            page_data.face_stride()
        ));
    }
    texts
}
