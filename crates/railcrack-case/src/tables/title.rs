//! Keys before the first section.

use crate::schema::{Preset, section, text};

section! {
    TOP "", Defaulted, "The case.";
    TITLE: String = text("title", "Untitled", "Heading of plots and reports.")
        .first(Preset::Text("Reference case, Table 1"));
}
