//! Which runs the chosen figures need: a case that several set-ups share is run once.

use crate::curve::{CURVES, PaperCurve};
use crate::figure::Figure;
use crate::setup::{Body, SETUPS, Setup, Stage};
use std::collections::BTreeMap;

/// One run.
pub(super) struct Job {
    /// The case file.
    pub text: String,
    /// Its name, without ending.
    pub name: String,
    /// Where its results belong: set-up and curve.
    pub uses: Vec<(usize, usize)>,
    /// Estimated duration, in arbitrary units: long runs start first.
    pub effort: f64,
}

/// The runs for `figures`, long ones first.
pub(super) fn plan(figures: &[u8]) -> Vec<Job> {
    let mut jobs: Vec<Job> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for (s, setup) in SETUPS.iter().enumerate() {
        for (c, curve) in CURVES.iter().enumerate() {
            let Some(stage) = wanted(setup, curve, figures) else { continue };
            let text = setup.text(curve, stage);
            let next = jobs.len();
            let job = *known.entry(text.clone()).or_insert(next);
            if job == next {
                let name = file_name(&format!("{} {}", curve.name, setup.name));
                jobs.push(Job { text, name, uses: Vec::new(), effort: effort(setup, curve, stage) });
            }
            jobs[job].uses.push((s, c));
        }
    }
    jobs.sort_by(|a, b| b.effort.total_cmp(&a.effort));
    jobs
}

/// How far `setup` runs `curve` for `figures`; none where they do not need it.
fn wanted(setup: &Setup, curve: &PaperCurve, figures: &[u8]) -> Option<Stage> {
    let mine = |figure: &&u8| setup.figures.contains(figure) && curve.figures.contains(figure);
    if !setup.concerns(curve) || !figures.iter().any(|figure| mine(&figure)) {
        return None;
    }
    let grows = setup.grows(curve) && figures.iter().filter(mine).any(|figure| Figure::is_path(*figure));
    Some(if grows { Stage::Growth } else { Stage::Initial })
}

fn effort(setup: &Setup, curve: &PaperCurve, stage: Stage) -> f64 {
    let cracks: f64 = match curve.name {
        "nine" | "nine-stress" => 9.0,
        "pair" => 2.0,
        _ => 1.0,
    };
    let steps = match (stage, curve.name) {
        (Stage::Initial, _) => 1.0,
        (Stage::Growth, "nine" | "nine-stress") => 6.0,
        (Stage::Growth, "pair") => 16.0,
        (Stage::Growth, _) => 26.0,
    };
    let engine = if setup.body == Body::HalfPlane { 1.0 } else { 5.0 };
    cracks * cracks * steps * engine
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use railcrack_case::Case;

    #[test]
    fn every_case_is_accepted_and_run_once() {
        let folder = std::env::temp_dir().join(format!("railcrack-paper-cases-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("fig21.csv"), crate::files::FIG_21.text).unwrap();
        for steel in &crate::steel::STEELS {
            std::fs::write(folder.join(steel.profile_file()), "depth_mm,sxx_mpa\n0,-50\n5,0\n").unwrap();
        }
        let all: Vec<u8> = crate::figure::FIGURES.iter().map(|figure| figure.number).collect();
        let jobs = plan(&all);
        for job in &jobs {
            Case::parse(&job.text, &job.name, &folder)
                .unwrap_or_else(|e| panic!("{}: {e}\n{}", job.name, job.text));
        }
        let mut names: Vec<&str> = jobs.iter().map(|job| job.name.as_str()).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "two cases with one name");
        assert!(jobs.iter().any(|job| job.uses.len() > 1), "nothing is shared");
    }

    #[test]
    fn a_figure_of_initial_cracks_grows_nothing() {
        for job in plan(&[13, 14, 27]) {
            assert!(job.text.contains("steps = 0"), "{}", job.text);
        }
        assert!(plan(&[18]).iter().any(|job| job.text.contains("steps = 25")));
    }
}
