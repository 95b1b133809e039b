//! `[output]`: what a run writes.

use crate::schema::{
    Choice, Defaults, Preset, SectionValues, Word, choice, integer, numbers, read_by_word, section, switch,
    within,
};

section! {
    OUTPUT "output", Defaulted,
        "Output of a run. Defaults in a study are `faces = \"none\"`, `sif = \"ends\"` and no fields, plots or pages; `railcrack report` makes plots and pages later.";
    FIELDS_OVER_A: Vec<f64> = numbers("fields_over_a", "a", within(1e3), &[-1.0, 0.0, 1.0],
        "Wheel positions, from the mouth of the first crack, of written fields of displacement and stress; finite elements only.");
    FIELDS_EVERY: usize = integer("fields_every", (0, 10_000), 25,
        "Growth steps between fields, from step 0 on; 0 writes none.");
    FIELDS: bool = switch("fields", Preset::Switch(true), "Whether fields are written.");
    FACES: Kept = choice("faces", "Growth steps written to `faces.csv`.");
    SIF: Kept = choice("sif", "Growth steps written to `sif.csv`.");
    PLOTS: bool = switch("plots", Preset::Switch(true), "Whether plots are drawn.");
    REPORT: bool = switch("report", Preset::Switch(true), "Whether the page `report.html` is written.");
    EXPLORER: bool = switch("explorer", Preset::Switch(false),
        "Whether the page can recompute the case with other values, at 2 MB more. Dislocations only, in cases without files; needs the engine of pages.");
    RUN_FOLDERS: bool = switch("run_folders", Preset::Switch(true),
        "In a study, whether each run has its own folder; otherwise all runs share a few files.");
}

/// Growth steps of which a table has rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    /// Every step.
    All,
    /// The first and the last.
    Ends,
    /// None: there is no such table.
    None,
}

read_by_word!(Kept);

impl Choice for Kept {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::All, Word::now("all", "every step").or(true)),
        (Self::Ends, Word::now("ends", "the first and the last")),
        (Self::None, Word::now("none", "no such table").or(false)),
    ];
}

/// Fields that are computed and written.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldOutput {
    /// Wheel positions x_c/a, from the mouth of the first crack.
    pub over_a: Vec<f64>,
    /// Interval between growth steps with fields, from step 0 on; 0 is never.
    pub every: usize,
}

impl FieldOutput {
    pub(crate) fn read(section: &SectionValues) -> Option<Self> {
        let every = if section.get(FIELDS)? { section.get(FIELDS_EVERY)? } else { 0 };
        Some(Self { over_a: section.get(FIELDS_OVER_A)?, every })
    }
}

/// Tables, plots and page that a run writes. Growth, case and summary it always does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Output {
    /// Steps in `faces.csv`.
    pub faces: Kept,
    /// Steps in `sif.csv`.
    pub sif: Kept,
    /// Whether plots are drawn.
    pub plots: bool,
    /// Whether the page is made.
    pub report: bool,
    /// Whether the page computes.
    pub explorer: bool,
    /// In a study, whether each run keeps a folder of its own.
    pub run_folders: bool,
}

impl Output {
    /// Written by a single run by default.
    pub const ALL: Self = Self {
        faces: Kept::All,
        sif: Kept::All,
        plots: true,
        report: true,
        explorer: false,
        run_folders: true,
    };
    /// Growth, case and summary only.
    pub const LEAST: Self = Self {
        faces: Kept::None,
        sif: Kept::None,
        plots: false,
        report: false,
        explorer: false,
        run_folders: true,
    };

    pub(crate) fn read(section: &SectionValues) -> Option<Self> {
        Some(Self {
            faces: section.get(FACES)?,
            sif: section.get(SIF)?,
            plots: section.get(PLOTS)?,
            report: section.get(REPORT)?,
            explorer: section.get(EXPLORER)?,
            run_folders: section.get(RUN_FOLDERS)?,
        })
    }

    /// Whether plots and page can be made of the tables alone.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        (self.faces, self.sif) == (Kept::All, Kept::All)
    }

    /// Whether plots or a page are made.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.plots || self.report
    }
}

/// Written by a run of a study by default.
pub(crate) const OF_STUDY: Defaults = &[
    (OUTPUT.name, FIELDS.key.name, Preset::Switch(false)),
    (OUTPUT.name, FACES.key.name, Preset::Text("none")),
    (OUTPUT.name, SIF.key.name, Preset::Text("ends")),
    (OUTPUT.name, PLOTS.key.name, Preset::Switch(false)),
    (OUTPUT.name, REPORT.key.name, Preset::Switch(false)),
];
