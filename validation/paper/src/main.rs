//! The results of Trollé et al. 2014 recomputed: every figure, and every statement of the text
//! compared with the numbers.
//!
//! `figures.toml` has the figures and their curves, which are cases of the paper; `setups.toml` the
//! choices that it leaves open; `claims.toml` its statements, each with the rule that decides it.

mod case_run;
mod charts;
mod check;
mod error;
mod figures;
mod files;
mod measure;
mod overlay;
mod pages;
mod path_shape;
mod results;
mod rolled;
mod rules;
mod runs;
mod single_rules;
mod tables;
#[cfg(test)]
mod tests;
mod verdict;

use check::check;
use clap::Parser;
use error::PaperError;
use files::write;
use overlay::{OVERLAY_COLUMNS, Overlay};
use pages::{Contents, STATEMENTS};
use results::Results;
use rolled::{StressProfile, profiles};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tables::Paper;
use verdict::verdicts;

/// Recompute the figures of Trolle et al. (2014) and decide every statement of its text
///
/// Figs 13 to 25 and 27 to 30 are recomputed for each choice that the paper leaves open: half-plane
/// or block, direction of travel, friction, load steps, criterion. The folder gets a page of the
/// statements (statements.md) and of each group of figures, a plot and a table of each figure
/// (figures/), the numbers that decide each statement (claims.csv), the effort and the warnings of
/// each run (runs.csv), and the cases (cases/).
#[derive(Debug, Parser)]
#[command(name = "paper-of-2014")]
struct Arguments {
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "target/paper")]
    out: PathBuf,
    /// Recompute only these figures (13 to 25 and 27 to 30) and the statements they decide
    #[arg(long, value_name = "FIG", num_args = 1..)]
    only: Vec<String>,
    /// Curves digitised from a figure of the paper, in a file named after it (fig18.csv): drawn
    /// over the computed curves, with their distances in overlays.csv
    #[arg(long, value_name = "FILE", num_args = 1..)]
    overlay: Vec<PathBuf>,
    /// Compare the pages in the repository with what was computed; fail where they differ
    #[arg(long)]
    check: bool,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), PaperError> {
    let paper = Paper::read()?;
    let figures = paper.figures_called(&arguments.only)?;
    let read = |path: &PathBuf| Overlay::read(&paper, path, &figures);
    let overlays = arguments.overlay.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let folder = &arguments.out;
    let (results, profiles) = compute(&paper, &figures, folder)?;
    let verdicts = verdicts(&paper, &results, &figures);
    let contents = Contents {
        paper: &paper,
        figures: &figures,
        results: &results,
        verdicts: &verdicts,
        profiles: &profiles,
    };
    write_figures(&contents, &overlays, folder)?;
    write_pages(&contents, folder)?;
    for verdict in &verdicts {
        println!("{}: {}", verdict.claim.id, verdict.words());
    }
    for (name, reason) in &results.failures {
        println!("ended early: {name}: {reason}");
    }
    let page = folder.join(STATEMENTS);
    println!("{} statements, {} runs; page in {}", verdicts.len(), results.count, page.display());
    if arguments.check { check(&contents) } else { Ok(()) }
}

/// Computes the runs of `figures`, and the profiles of Fig. 21 where they need them.
fn compute(
    paper: &Paper,
    figures: &[u8],
    folder: &Path,
) -> Result<(Results, Vec<StressProfile>), PaperError> {
    let cases = folder.join("cases");
    let needs_rolled_rails = figures.iter().any(|figure| (21..=23).contains(figure));
    let profiles = if needs_rolled_rails { profiles(&cases)? } else { Vec::new() };
    let jobs = runs::plan(paper, figures, &cases)?;
    Ok((runs::compute(&jobs, &cases)?, profiles))
}

fn write_figures(contents: &Contents, overlays: &[Overlay], folder: &Path) -> Result<(), PaperError> {
    let Contents { paper, results, .. } = *contents;
    let folder_of_figures = folder.join("figures");
    let mut distances = String::new();
    for figure in paper.figures.iter().filter(|figure| contents.figures.contains(&figure.number)) {
        let mut curves = figures::curves(paper, figure, results, contents.profiles);
        let path = folder_of_figures.join(format!("fig{}.csv", figure.number));
        write(&path, &figures::table(&curves))?;
        for overlay in overlays.iter().filter(|overlay| overlay.figure == figure.number) {
            distances.push_str(&overlay.add_to(figure, &mut curves)?);
        }
        write(&path.with_extension("svg"), &charts::sheet(paper, figure, &curves).svg())?;
    }
    if !overlays.is_empty() {
        write(&folder.join("overlays.csv"), &format!("{OVERLAY_COLUMNS}\n{distances}"))?;
    }
    if let Some(sheet) = charts::engines(paper, results) {
        write(&folder_of_figures.join("engines.svg"), &sheet.svg())?;
    }
    Ok(())
}

fn write_pages(contents: &Contents, folder: &Path) -> Result<(), PaperError> {
    write(&folder.join("claims.csv"), &contents.claims_table())?;
    write(&folder.join(STATEMENTS), &contents.statements()?)?;
    for group in contents.paper.groups.iter().filter(|group| contents.has(group)) {
        write(&folder.join(group.file()), &contents.group_page(group))?;
    }
    Ok(())
}
