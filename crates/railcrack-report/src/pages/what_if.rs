//! The part of a page that computes its case anew while its values change, and the page of it
//! alone.

use crate::engine::PageEngine;
use crate::page::{Block, Page, Section};

const WHAT_IF: &str = include_str!("../assets/explorer.html");
const SCRIPT: &str = concat!(include_str!("../assets/engine.js"), include_str!("../assets/explorer.js"));

/// A section with the values of `case` as sliders; `first` is the name of the curves of that case,
/// and `says` introduces it. The engine starts when the section is seen.
pub(super) fn section(engine: &PageEngine, case: &str, first: &str, says: &str) -> Section {
    let data = engine.data(case, first);
    Section::new(
        "what-if",
        "What if",
        vec![
            Block::Text(says.to_owned()),
            Block::Viewer {
                id: "what-if-engine",
                html: WHAT_IF,
                blocks: Vec::new(),
                data_id: "what-if-data",
                data,
                script: SCRIPT,
            },
        ],
    )
}

/// The explorer: a page that computes `case` and whatever is made of it.
#[must_use]
pub fn explorer_page(engine: &PageEngine, case: &str) -> String {
    let says = "Everything on this page is computed in this browser, by the program itself: no file is sent anywhere, and nothing is loaded from anywhere. Move a slider or edit the case file below; the address keeps the state of the page.";
    let section = section(engine, case, "as at first", says);
    Page {
        title: "What makes a head check grow?".to_owned(),
        kind: "Explorer".to_owned(),
        verdict: "A crack in a rail under the wheels that pass over it: its stress intensity factors, path, depth and life, recomputed while a value changes.".to_owned(),
        sections: vec![section],
        ..Page::default()
    }
    .html()
}
