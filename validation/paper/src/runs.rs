//! The runs that figures need: a case that several set-ups share is run once.

use crate::case_run::CaseRun;
use crate::error::PaperError;
use crate::files::write;
use crate::results::Results;
use crate::tables::{OtherStress, Paper, PaperCurve, Setup, Travel, home};
use railcrack_case::{Case, Overrides};
use railcrack_run::OutputError;
use railcrack_run::setup::RailKey;
use railcrack_run::simulation::{NextRun, RunQueue, WaitingRun};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

/// One run.
pub struct Job {
    /// Its name, that of its case file.
    pub name: String,
    case: Case,
    /// Where its results belong: set-up and curve.
    uses: Vec<(usize, usize)>,
}

/// Extent of one run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Extent {
    Initial,
    Growth,
}

/// The runs for `figures`, whose cases name tables in `folder`.
///
/// Errors: a case is refused; the system refuses.
pub fn plan(paper: &Paper, figures: &[u8], folder: &Path) -> Result<Vec<Job>, PaperError> {
    let mut jobs: Vec<Job> = Vec::new();
    let mut known: BTreeMap<Vec<String>, usize> = BTreeMap::new();
    let given = home().join("cases").join(FIG_21);
    let given = std::fs::read_to_string(&given).map_err(OutputError::io("read", &given))?;
    write(&folder.join(FIG_21), &given)?;
    for (s, setup) in paper.setups.iter().enumerate() {
        for (c, curve) in paper.curves.iter().enumerate() {
            let Some(extent) = extent(paper, setup, curve, figures) else { continue };
            let case = case(setup, curve, extent, folder)?;
            let next = jobs.len();
            let job = *known.entry(identity(&case)).or_insert(next);
            if job == next {
                let name = file_name(&format!("{} {}", curve.name, setup.name));
                jobs.push(Job { name, case, uses: Vec::new() });
            }
            jobs[job].uses.push((s, c));
        }
    }
    jobs.sort_by(|a, b| b.effort().total_cmp(&a.effort()));
    Ok(jobs)
}

/// Everything that determines the results of `case`.
fn identity(case: &Case) -> Vec<String> {
    let tables = case.companions().into_iter().map(|table| table.text.to_owned());
    std::iter::once(case.to_toml()).chain(tables).collect()
}

/// How far `setup` runs `curve` for `figures`; none where they do not need it.
fn extent(paper: &Paper, setup: &Setup, curve: &PaperCurve, figures: &[u8]) -> Option<Extent> {
    let has = |names: &Option<Vec<String>>| names.as_ref().is_none_or(|names| names.contains(&curve.name));
    let is_shown = |figure: &&u8| setup.row.figures.contains(figure) && curve.figures.contains(figure);
    if !has(&setup.row.curves) || !figures.iter().any(|figure| is_shown(&figure)) {
        return None;
    }
    let mut shown = figures.iter().filter(is_shown);
    let grows = has(&setup.row.grows) && shown.any(|figure| paper.shows_paths(*figure));
    Some(if grows { Extent::Growth } else { Extent::Initial })
}

/// The case of `curve` in `setup`.
fn case(setup: &Setup, curve: &PaperCurve, extent: Extent, folder: &Path) -> Result<Case, PaperError> {
    let drag = if setup.row.reversed_drag { -1.0 } else { 1.0 };
    let mut settings = vec![
        format!("contact.friction={:?}", drag * setup.travel.sign() * curve.wheel_friction),
        // No figure shows fields, and one costs as much as a growth step.
        "output.fields_every=0".to_owned(),
    ];
    if setup.travel == Travel::Against {
        settings.extend(["passage.from_over_a=6.0".to_owned(), "passage.to_over_a=-6.0".to_owned()]);
    }
    if extent == Extent::Initial {
        settings.push("growth.steps=0".to_owned());
    }
    settings.extend(curve.set.iter().chain(&setup.row.set).cloned());
    let path = home().join("cases").join(&curve.case);
    let mut text = std::fs::read_to_string(&path).map_err(OutputError::io("read", &path))?;
    match &setup.row.stress {
        Some(OtherStress::Plastic) => text = text.replace("[residual_stress]", "[plastic_stress]"),
        Some(OtherStress::Rolled(table)) => text = text.replace(FIG_21, table),
        None => {}
    }
    let overrides = Overrides { settings, ..Overrides::default() };
    Ok(Case::parse_with(&text, &curve.case, folder, &overrides)?)
}

/// The table of Fig. 21, which cases name.
pub const FIG_21: &str = "fig21.csv";

/// Letters, digits, signs; hyphens for the rest.
fn file_name(name: &str) -> String {
    let mut out = String::new();
    for letter in name.chars() {
        match letter {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '+' => out.push(letter),
            _ if out.ends_with('-') => {}
            _ => out.push('-'),
        }
    }
    out.replace(".-", "-")
}

impl Job {
    /// Estimated duration, in arbitrary units: long runs start first.
    fn effort(&self) -> f64 {
        /// A crack meshed by finite elements takes about five times as long.
        const ELEMENTS: f64 = 5.0;
        let cracks = self.case.cracks.cracks().len() as f64;
        let engine = if RailKey::of_case(&self.case).is_some() { ELEMENTS } else { 1.0 };
        cracks * cracks * (1 + self.case.growth.steps) as f64 * engine
    }

    fn compute(&self, next: &NextRun) -> Result<CaseRun, PaperError> {
        let started = Instant::now();
        let run = CaseRun::compute(&self.name, &self.case, next.shared_rail(&self.case))?;
        let wall_s = started.elapsed().as_secs_f64();
        eprintln!("{}, {wall_s:.1} s", self.name);
        Ok(CaseRun { wall_s, ..run })
    }
}

/// Computes `jobs`, one thread each because runs are independent, on shared rails; their cases
/// go to folders in `folder`, and `runs.csv` next to it.
///
/// Errors: a run could not do its first step; the system refuses.
pub fn compute(jobs: &[Job], folder: &Path) -> Result<Results, PaperError> {
    for job in jobs {
        let folder = folder.join(&job.name);
        write(&folder.join("case.toml"), &job.case.to_toml())?;
        for table in job.case.companions() {
            write(&folder.join(table.name), table.text)?;
        }
    }
    let slots: Vec<OnceLock<Result<CaseRun, PaperError>>> = jobs.iter().map(|_| OnceLock::new()).collect();
    let waiting =
        jobs.iter().enumerate().map(|(run, job)| WaitingRun { run, case: &job.case, effort: job.effort() });
    let queue = RunQueue::new(waiting);
    // A pool for each run: in a common pool a thread that waits for parts of its run could start
    // another run and wait there for the rail that it is about to make.
    let pools = (0..rayon::current_num_threads())
        .map(|_| rayon::ThreadPoolBuilder::new().num_threads(1).build())
        .collect::<Result<Vec<_>, _>>()?;
    std::thread::scope(|scope| {
        for pool in &pools {
            scope.spawn(|| {
                pool.install(|| {
                    let mut last = None;
                    while let Some(next) = queue.take(last.as_ref()) {
                        // Each slot is set once.
                        drop(slots[next.run].set(jobs[next.run].compute(&next)));
                        last = Some(next);
                    }
                });
            });
        }
    });
    let mut results = Results::default();
    let mut table = "run,steps,contact_solutions,wall_s,ended,warnings\n".to_owned();
    for (job, slot) in jobs.iter().zip(slots) {
        let Some(run) = slot.into_inner().transpose()? else { continue };
        let ended = if run.failure.is_some() { "early" } else { "" };
        let warnings = run.warnings.join("; ").replace('"', "'");
        let numbers = format!("{},{},{:.3}", run.steps, run.solves, run.wall_s);
        table.push_str(&format!("{},{numbers},{ended},\"{warnings}\"\n", job.name));
        results.failures.extend(run.failure.iter().map(|reason| (job.name.clone(), reason.clone())));
        let run = Arc::new(run);
        results.runs.extend(job.uses.iter().map(|place| (*place, Arc::clone(&run))));
    }
    results.failures.sort();
    results.count = jobs.len();
    write(&folder.with_file_name("runs.csv"), &table)?;
    Ok(results)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    /// A folder with the tables that cases name.
    fn tables() -> PathBuf {
        let folder = std::env::temp_dir().join(format!("paper-of-2014-cases-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for steel in &crate::rolled::STEELS {
            std::fs::write(folder.join(steel.profile_file()), "depth_mm,sxx_mpa\n0,-50\n5,0\n").unwrap();
        }
        folder
    }

    #[test]
    fn every_case_is_accepted_and_run_once() {
        let paper = Paper::read().unwrap();
        let jobs = plan(&paper, &paper.figures_called(&[]).unwrap(), &tables()).unwrap();
        let mut names: Vec<&str> = jobs.iter().map(|job| job.name.as_str()).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "two cases with one name");
        assert!(jobs.iter().any(|job| job.uses.len() > 1), "nothing is shared");
        for (setup, row) in paper.setups.iter().enumerate() {
            let is_used = |job: &Job| job.uses.iter().any(|(used, _)| *used == setup);
            assert!(jobs.iter().any(is_used), "{}", row.name);
        }
    }

    #[test]
    fn a_figure_of_initial_cracks_grows_nothing() {
        let (paper, folder) = (Paper::read().unwrap(), tables());
        let steps = |figures: &[u8]| -> Vec<usize> {
            plan(&paper, figures, &folder).unwrap().iter().map(|job| job.case.growth.steps).collect()
        };
        assert!(steps(&[13, 14, 27]).iter().all(|steps| *steps == 0));
        assert!(steps(&[18]).contains(&25));
    }

    #[test]
    fn a_setup_changes_the_case_as_it_says() {
        let (paper, folder) = (Paper::read().unwrap(), tables());
        let of = |setup: &str, curve: &str| {
            let setup = paper.setups.iter().find(|row| row.name == setup).unwrap();
            let curve = paper.curves.iter().find(|row| row.name == curve).unwrap();
            case(setup, curve, Extent::Growth, &folder).unwrap()
        };
        let friction = |setup: &str| {
            let case = of(setup, "wheel+0.1");
            case.first_wheel().wheel.contact().unwrap().sliding().unwrap().friction
        };
        assert_eq!(friction("half-plane, along"), 0.1);
        assert_eq!(friction("half-plane, against"), -0.1);
        assert_eq!(friction("drag reversed, along"), -0.1);
        let passage = of("block, against", "pair").first_wheel().passages.passage;
        assert!(passage.from > passage.to);
        let plastic = of("Fig. 21 plastic, along", "stress");
        assert!(plastic.plastic_stress().is_some() && plastic.residual_stress.is_none());
        let stress = of("half-plane, along", "stress").residual_stress.unwrap();
        assert_eq!(stress.given_name(), FIG_21);
        // What is compared with it has no stress at all.
        let reference = of("rolled 430 MPa, along", "reference");
        assert!(reference.plastic_stress().is_none() && reference.residual_stress.is_none());
        assert!(
            of("rolled 430 MPa, along", "stress")
                .residual_stress
                .is_some_and(|file| file.given_name() == "rolled-430-20000-0.025.csv")
        );
    }
}
