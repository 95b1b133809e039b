//! Plots and reports of railcrack: SVG files, and one HTML file per folder that is readable without
//! a network.
//!
//! A [`Chart`] has axes, curves, areas and notes. It is built once from results and drawn by two
//! writers: [`ChartSheet::svg`] makes a file of one or several charts, [`Page::html`] draws charts
//! with their values under the pointer. A [`Page`] is a title, a verdict in a sentence, key figures
//! ([`Fact`]) and sections of [`Block`]s: text, tables ([`Table`]), charts, pictures. Texts are
//! plain text; `K_{I}` and `10^{6}` set an index and a power. Numbers are written with six
//! significant digits. The same page has the same bytes.
//!
//! ```
//! use railcrack_report::{Block, Chart, ChartAxis, ChartSheet, Curve, Fact, Page, Section, Table};
//!
//! let mut table = Table::new(["friction", "load cycles"]);
//! table.row(["0.1", "1 197 467"]);
//! let chart = Chart {
//!     id: "growth".into(),
//!     caption: "Crack length against load cycles.".into(),
//!     x: ChartAxis::linear("Load cycles", "axles"),
//!     y: ChartAxis::linear("Crack length", "mm"),
//!     curves: vec![Curve::line("friction 0.1", vec![[0.0, 6.0], [1.2e6, 16.0]])],
//!     ..Chart::default()
//! };
//! let file = ChartSheet::of("Wheel–rail friction", "Crack length", chart.clone()).svg();
//! assert!(file.contains("axles"));
//! let section = Section { id: "overlay".into(), heading: "Overlay".into(), blocks: vec![Block::Chart(chart)] };
//! let page = Page {
//!     title: "Wheel–rail friction".into(),
//!     kind: "Study".into(),
//!     decision: None,
//!     verdict: "One run.".into(),
//!     facts: vec![Fact { name: "Runs".into(), value: "1".into(), note: String::new() }],
//!     lead: vec![Block::Table(table)],
//!     sections: vec![section],
//! };
//! assert!(page.html().contains("<td class=\"number\">1 197 467</td>"));
//! ```

mod built;
mod chart;
mod choices;
mod direction;
mod engine;
mod figures;
mod html;
mod live_page;
mod markup;
mod numbers;
mod page;
mod page_data;
mod pages;
mod rebuild;
mod recomputed;
mod row;
mod sensitivity;
mod svg;
mod table;

pub use built::{FolderKind, put};
pub use chart::{
    Chart, ChartArea, ChartAspect, ChartAxis, ChartLegend, ChartNote, ChartRange, ChartScale, ChartSheet,
    Curve, CurveColour, CurveDots, CurveLook, CurveWidth, LegendEntry, LegendMark, SheetLegend,
};
pub use choices::{AtFirst, Choice, ChoiceGroup, ChoiceMark, Choices};
pub use engine::PageEngine;
pub use figures::{CalibratedRun, PatchKey, calibration_charts, patches_picture};
pub use live_page::{LivePage, live_page};
pub use numbers::{fixed, grouped, significant, tonnage};
pub use page::{Banner, Block, Fact, Page, Section};
pub use pages::{ValidationPage, calibration_page, contact_page, explorer_page, is_validation_plot};
pub use rebuild::{Pages, rebuild_report};
pub use table::{Cell, CellTone, MISSING, Table};
