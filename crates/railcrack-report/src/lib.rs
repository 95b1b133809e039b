//! Plots and pages of railcrack: one HTML file with everything in it, readable without a network, and the kit that pages are made of.
//!
//! A [`Page`] is a title, a verdict in a sentence, the numbers looked for first ([`Fact`]) and sections of [`Block`]s:
//! text, tables ([`Table`]), charts ([`LineChart`]), pictures. [`Page::html`] writes it with its style, the charting library
//! and the data. Texts are plain text; `K_{I}` and `10^{6}` set an index and a power. Numbers go in with six
//! significant digits. The same page has the same bytes.
//!
//! ```
//! use railcrack_report::{Block, ChartAxis, Curve, Fact, LineChart, Page, Section, Table};
//!
//! let mut table = Table::new(["friction", "load cycles"]);
//! table.row(["0.1", "1 197 467"]);
//! let chart = LineChart {
//!     id: "growth".into(),
//!     caption: "Crack length against load cycles.".into(),
//!     x: ChartAxis::linear("Load cycles (axles)"),
//!     y: ChartAxis::linear("Crack length (mm)"),
//!     curves: vec![Curve::line("friction 0.1", vec![[0.0, 6.0], [1.2e6, 16.0]])],
//!     ..LineChart::default()
//! };
//! let page = Page {
//!     title: "Friction of the wheel".into(),
//!     kind: "Study".into(),
//!     verdict: "One run.".into(),
//!     facts: vec![Fact { name: "Runs".into(), value: "1".into(), note: String::new() }],
//!     lead: vec![Block::Table(table)],
//!     sections: vec![Section { id: "overlay".into(), heading: "Overlay".into(), blocks: vec![Block::Chart(chart)] }],
//! };
//! assert!(page.html().contains("<td class=\"number\">1 197 467</td>"));
//! ```

mod chart;
mod choices;
mod direction;
mod figures;
mod html;
mod numbers;
mod page;
mod pages;
mod rebuild;
mod shown;
pub mod svg;
mod table;

pub use chart::{ChartAspect, ChartAxis, ChartLegend, ChartScale, Curve, CurveColour, CurveLook, LineChart};
pub use choices::{AtFirst, Choice, ChoiceGroup, ChoiceMark, Choices};
pub use numbers::{fixed, grouped, significant, tonnage};
pub use page::{Block, Fact, Page, Section};
pub use rebuild::{FolderKind, Pages, put, rebuild_report, write_plots};
pub use table::{Cell, MISSING, Table};
