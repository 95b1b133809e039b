//! The case files of `cases/paper`, carried by the program.

/// A case file or a table that one names.
pub(super) struct PaperFile {
    pub name: &'static str,
    pub text: &'static str,
}

macro_rules! paper_file {
    ($name:literal) => {
        PaperFile { name: $name, text: include_str!(concat!("../cases/", $name)) }
    };
}

pub(super) const TABLE_1: PaperFile = paper_file!("table1.toml");
pub(super) const FIG_13: PaperFile = paper_file!("fig13.toml");
pub(super) const FIG_22: PaperFile = paper_file!("fig22.toml");
pub(super) const FIG_24: PaperFile = paper_file!("fig24.toml");
pub(super) const FIG_27: PaperFile = paper_file!("fig27.toml");
pub(super) const FIG_29: PaperFile = paper_file!("fig29.toml");

/// The table that case files name.
pub(super) const FIG_21: PaperFile = paper_file!("fig21.csv");

/// The page in the folder of results.
pub(super) const PAGE: &str = "paper.md";

/// The folder of the finished runs in it.
pub(super) const RUNS: &str = "runs";
