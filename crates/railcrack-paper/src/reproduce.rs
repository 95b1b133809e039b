//! From chosen figures to runs, pictures, tables and the page.

use crate::claims::CLAIMS;
use crate::computation::{Computation, runs_table};
use crate::error::PaperError;
use crate::figure::{FIGURES, Figure, Kind};
use crate::figure_group::GROUPS;
use crate::figures::{
    FigureTable, OVERLAY_COLUMNS, Overlay, Quantity, distances, engines, forget_overlays, increments, kept,
    path_table, profile_table, sheet, sif_table,
};
use crate::files::{FIG_21, FIG_22, PAGE, RUNS, TABLE_1};
use crate::group_page::group_page;
use crate::page;
use crate::plan::{Job, plan};
use crate::profile::{StressProfile, profiles};
use crate::record::record;
use crate::report_page::paper_page;
use crate::results::Results;
use crate::steel::{STEELS, Steel};
use crate::telling::{Earlier, Telling};
use crate::verdict::Verdict;
use railcrack::shakedown::StabilisedRail;
use railcrack_case::Case;
use railcrack_report::put;
use railcrack_run::OutputError;
use railcrack_run::files::REPORT_FILE;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Results of the recomputed paper.
pub struct Reproduction {
    /// All runs.
    pub results: Results,
    /// The statements that the chosen figures decide.
    pub verdicts: Vec<Verdict>,
    /// Runs that a step ended early, with the reason.
    pub failures: Vec<(String, String)>,
    /// Number of runs.
    pub runs: usize,
    /// The page.
    pub page: PathBuf,
}

/// Computes what `figures` need and writes to `folder`: `cases/` (every case file that was run),
/// `figures/` (a picture and a table each), `claims.csv`, `runs.csv`, `paper.md`
/// and the pages of the groups of figures,
/// `statements.json`, `report.html`, and `runs/` as runs finish. Runs go to the threads of rayon;
/// apart from times the files do not depend on their number. Digitised curves of a figure go to
/// `overlays/`, are drawn with ours, and their distances are in `overlays.csv`.
///
/// Errors: the folder holds such results and may not be replaced; a case cannot be computed at all;
/// the system refuses; `telling` asks to stop.
pub fn reproduce(
    folder: &Path,
    figures: &[u8],
    overlays: &[Overlay],
    earlier: Earlier,
    telling: &dyn Telling,
) -> Result<Reproduction, PaperError> {
    if earlier == Earlier::Refuse && (folder.join(PAGE).exists() || folder.join(RUNS).exists()) {
        return Err(PaperError::Exists { folder: folder.to_path_buf() });
    }
    if let Some(overlay) = overlays.iter().find(|overlay| !figures.contains(&overlay.figure())) {
        let path = PathBuf::from(format!("fig{}.csv", overlay.figure()));
        let says = "this figure is not among the recomputed ones".to_owned();
        return Err(PaperError::Overlay { path, says });
    }
    let jobs = plan(figures);
    telling.planned(jobs.len());
    let rolled = rolled_rails(figures)?;
    let cases = write_cases(folder, &jobs, &rolled)?;
    make(&folder.join(RUNS))?;
    if earlier == Earlier::Replace {
        forget_overlays(folder)?;
    }
    for overlay in overlays {
        overlay.keep(folder)?;
    }
    let computed = Computation { folder, earlier, jobs: &jobs, cases: &cases, telling }.run()?;
    let mut results = Results::default();
    let mut failures = Vec::new();
    let runs = computed.into_iter().map(|run| Ok(Arc::new(run?))).collect::<Result<Vec<_>, PaperError>>()?;
    write(&folder.join("runs.csv"), &runs_table(&jobs, &runs))?;
    for (job, run) in jobs.iter().zip(&runs) {
        if let Some(failure) = &run.failure {
            failures.push((job.name.clone(), failure.clone()));
        }
        for &place in &job.uses {
            results.runs.insert(place, Arc::clone(run));
        }
    }
    failures.sort();
    let wanted = |claim: &&crate::claim::Claim| claim.figures.iter().all(|figure| figures.contains(figure));
    let claims = CLAIMS.iter().flat_map(|section| section.iter()).filter(wanted);
    let verdicts: Vec<Verdict> = claims.filter_map(|claim| Verdict::of(claim, &results)).collect();
    let profiles = if figures.contains(&21) { Some(stress_profiles(folder, &rolled)?) } else { None };
    write_figures(folder, figures, &results, profiles.as_deref())?;
    write(
        &folder.join("claims.csv"),
        &page::claims_table(&verdicts, profiles.as_deref().unwrap_or_default()),
    )?;
    let page_path = folder.join(PAGE);
    let record = record(figures, &results, &verdicts, &failures, jobs.len());
    write(&page_path, &page::page(figures, &results, &verdicts, &record))?;
    for group in GROUPS.iter().filter(|group| group.is_computed(figures)) {
        let text = group_page(group, figures, &results, &verdicts, profiles.as_deref(), &record);
        write(&folder.join(group.file()), &text)?;
    }
    record.write(folder)?;
    rebuild_report(folder)?;
    Ok(Reproduction { results, verdicts, failures, runs: jobs.len(), page: page_path })
}

/// The rails that Figs 21 to 23 show or carry.
fn rolled_rails(figures: &[u8]) -> Result<Vec<(Steel, StabilisedRail)>, PaperError> {
    if !figures.iter().any(|figure| (21..=23).contains(figure)) {
        return Ok(Vec::new());
    }
    let case = Case::parse(TABLE_1.text, TABLE_1.name, Path::new(""))?;
    STEELS.iter().map(|steel| Ok((*steel, steel.rolled(&case)?))).collect()
}

/// Writes every case with the tables that cases name, and reads it as a user's.
fn write_cases(
    folder: &Path,
    jobs: &[Job],
    rolled: &[(Steel, StabilisedRail)],
) -> Result<Vec<Case>, PaperError> {
    let cases = folder.join("cases");
    make(&cases)?;
    write(&cases.join(FIG_21.name), FIG_21.text)?;
    for (steel, rail) in rolled {
        write(&cases.join(steel.profile_file()), &steel.profile_table(rail))?;
    }
    jobs.iter()
        .map(|job| {
            let path = cases.join(format!("{}.toml", job.name));
            write(&path, &job.text)?;
            Ok(Case::read(&path)?)
        })
        .collect()
}

/// Fig. 21: its table is read like that of a case.
fn stress_profiles(
    folder: &Path,
    rolled: &[(Steel, StabilisedRail)],
) -> Result<Vec<StressProfile>, PaperError> {
    let case = Case::parse(FIG_22.text, FIG_22.name, &folder.join("cases"))?;
    let Some(given) = &case.residual_stress else { return Ok(Vec::new()) };
    Ok(profiles(given.content(), rolled))
}

fn write_figures(
    folder: &Path,
    figures: &[u8],
    results: &Results,
    profiles: Option<&[StressProfile]>,
) -> Result<(), OutputError> {
    let figures_folder = folder.join("figures");
    make(&figures_folder)?;
    let mut overlay_rows = String::new();
    let chosen = |figure: &&Figure| figures.contains(&figure.number);
    for figure in FIGURES.iter().filter(chosen) {
        let table = match figure.kind {
            Kind::Sif => sif_table(figure, results),
            Kind::Paths => path_table(figure, results),
            Kind::Profile => profile_table(profiles.unwrap_or_default()),
        };
        let path = figures_folder.join(format!("{}.csv", figure.file_stem()));
        write(&path, &table)?;
        let damaged = |reason| OutputError::damaged(&path, reason);
        let table = FigureTable::parse(&table).map_err(damaged)?;
        let mut quantities = Vec::new();
        for quantity in Quantity::of(figure) {
            let mut curves = quantity.curves(&table).map_err(damaged)?.unwrap_or_default();
            let digitised = kept(folder, figure, *quantity)?;
            for d in distances(*quantity, &curves, &digitised) {
                let start = format!("{},{},{},{}", figure.number, d.curve, d.crack, d.quantity.columns()[1]);
                let end = format!("{},{:?},{:?}", d.points, d.largest, d.mean);
                overlay_rows.push_str(&format!("{start},\"{}\",{end}\n", d.setup));
            }
            curves.extend(digitised);
            quantities.push((*quantity, curves));
        }
        write(&path.with_extension("svg"), &sheet(figure, &quantities).svg())?;
    }
    if !overlay_rows.is_empty() {
        write(&folder.join("overlays.csv"), &format!("{OVERLAY_COLUMNS}\n{overlay_rows}"))?;
    }
    if FIGURES.iter().filter(chosen).any(|figure| figure.kind == Kind::Paths) {
        write(&figures_folder.join("increments.svg"), &increments().svg())?;
    }
    if let Some(sheet) = engines(results) {
        write(&figures_folder.join("engines.svg"), &sheet.svg())?;
    }
    Ok(())
}

/// Builds `report.html` of the recomputed paper in `folder` from its files.
///
/// Errors: no such results there; a file of it is damaged; the system refuses.
pub fn rebuild_report(folder: &Path) -> Result<(), OutputError> {
    put(&folder.join(REPORT_FILE), &paper_page(folder)?.html())
}

fn make(folder: &Path) -> Result<(), OutputError> {
    std::fs::create_dir_all(folder).map_err(OutputError::io("create", folder))
}

fn write(path: &Path, text: &str) -> Result<(), OutputError> {
    put(path, text)
}
