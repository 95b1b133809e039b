//! Laws of the growth rate: a file for each, in which it is declared, and the table of all of them.

mod rate_law;

pub(in crate::fatigue) use rate_law::K_UNIT;
pub use rate_law::{CheckValue, Constant, LawConstants, LawDeclaration, LawInput, OwnRange, RUNAWAY};
pub use table::RateTableError;

// The law that a case has by default stands first.
rate_law::laws! {
    Paris(paris::Paris);
    ParisThreshold(paris_threshold::ParisThreshold);
    Bold(bold::Bold);
    Walker(walker::Walker);
    Forman(forman::Forman);
    Nasgro(nasgro::Nasgro);
    Table(table::RateTable);
}
