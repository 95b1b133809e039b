//! Every table that the program writes, as `docs/file-formats.md` describes it.

use crate::compare::{PositionRow, TipComparison};
use crate::csv::{ContactRow, FaceRow, ResidualRow, SifRow, Table, TipRow, markdown};
use crate::planner::PlanRow;
use crate::shakedown::{LayerRow, PassRow, SectionRow};
use crate::study::{StudySummaryRow, TimesRow};

/// Name and columns (a table of Markdown) of every table.
pub fn table_descriptions() -> Vec<(&'static str, String)> {
    fn of<T: Table>() -> (&'static str, String) {
        (T::FILE, markdown::<T>())
    }
    vec![
        of::<SifRow>(),
        of::<TipRow>(),
        of::<FaceRow>(),
        of::<ContactRow>(),
        of::<ResidualRow>(),
        of::<TipComparison>(),
        of::<PositionRow>(),
        of::<StudySummaryRow>(),
        of::<TimesRow>(),
        of::<PassRow>(),
        of::<LayerRow>(),
        of::<SectionRow>(),
        of::<PlanRow>(),
    ]
}
