//! The inexpensive statements again, against the pages in the repository and an independent code.

use crate::check::{chapter_path, check};
use crate::pages::{Contents, STATEMENTS};
use crate::results::Results;
use crate::tables::{Paper, home};
use crate::verdict::verdicts;
use std::path::PathBuf;
use std::sync::OnceLock;

/// Fig. 13, computed once for all tests.
fn fig_13() -> &'static (Paper, Results, PathBuf) {
    static FIG_13: OnceLock<(Paper, Results, PathBuf)> = OnceLock::new();
    FIG_13.get_or_init(|| {
        let folder = std::env::temp_dir().join(format!("paper-of-2014-fig13-{}", std::process::id()));
        let paper = Paper::read().unwrap();
        let (results, _) = crate::compute(&paper, &[13], &folder).unwrap();
        (paper, results, folder)
    })
}

#[test]
fn the_pages_in_the_repository_have_the_deciding_numbers_of_fig_13() {
    let (paper, results, folder) = fig_13();
    let verdicts = verdicts(paper, results, &[13]);
    let ids: Vec<&str> = verdicts.iter().map(|verdict| verdict.claim.id.as_str()).collect();
    assert_eq!(ids, ["4-agreement", "4-locked"]);
    assert_eq!(verdicts[0].words(), "holds in the 2 decided");
    let mut contents = Contents { paper, figures: &[13], results, verdicts: &verdicts, profiles: &[] };
    check(&contents).unwrap();

    crate::write_figures(&contents, &[], folder).unwrap();
    crate::write_pages(&contents, folder).unwrap();
    for (file, columns) in [
        ("figures/fig13.csv", "setup,curve,crack,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m"),
        ("claims.csv", "claim,place,setup,holds,number,value"),
        ("runs.csv", "run,steps,contact_solutions,wall_s,ended,warnings"),
    ] {
        let text = std::fs::read_to_string(folder.join(file)).unwrap();
        assert_eq!(text.lines().next(), Some(columns), "{file}");
        assert!(text.lines().count() > 10, "{file}");
    }
    assert!(!folder.join("figures/fig14.svg").exists());
    // Every case is there to be run and changed.
    railcrack_case::Case::read(&folder.join("cases/fig13-half-plane-along/case.toml")).unwrap();

    // Another decision is seen.
    let mut others = crate::verdict::verdicts(paper, results, &[13]);
    others[0].decisions.iter_mut().for_each(|(_, decision)| decision.holds = false);
    contents.verdicts = &others;
    let row = contents.row(&others[0]);
    assert!(check(&contents).unwrap_err().to_string().contains(&row), "{row}");
}

#[test]
fn k_of_fig_13_is_that_of_an_independent_code() {
    let (paper, results, _) = fig_13();
    let sif = |setup: &str| &results.setup(paper, setup).unwrap().crack("fig13").unwrap().sif;
    let (steel, soft) = (sif("half-plane, along"), sif("E 70 GPa, along"));
    let path = home().join("../../verification/half-plane-histories/fig13.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    let kii = rows.map(|row| row.split(',').nth(2).unwrap().parse::<f64>().unwrap());
    let theirs = kii.fold(0.0, |peak: f64, k| peak.max(k.abs()));
    let off = steel.peak() / theirs - 1.0;
    assert!(off.abs() < 0.005, "{off}: the locked plateau of that code is up to 0.5 % low");
    // K does not depend on Young's modulus.
    assert!(soft.difference(steel) < 1e-6, "{}", soft.difference(steel));
}

#[test]
fn the_pages_show_every_figure_and_set_up() {
    let paper = Paper::read().unwrap();
    let statements = std::fs::read_to_string(home().join("results").join(STATEMENTS)).unwrap();
    for group in &paper.groups {
        assert!(statements.contains(&format!("({})", group.file())));
        let page = std::fs::read_to_string(home().join("results").join(group.file())).unwrap();
        for number in &group.figures {
            assert!(page.contains(&format!("(figures/fig{number}.svg)")), "Fig. {number}");
            let picture = home().join(format!("results/figures/fig{number}.svg"));
            assert!(std::fs::read_to_string(picture).unwrap().starts_with("<svg"));
        }
    }
    for setup in &paper.setups {
        assert!(statements.contains(&format!("| {} | {} |", setup.name, setup.words)), "{}", setup.name);
    }
}

/// The table of `tools/path_limit.py` on the statements that depend on the increment.
#[test]
fn the_chapter_counts_the_statements_that_depend_on_the_increment() {
    let paper = Paper::read().unwrap();
    let table = std::fs::read_to_string(home().join("../../verification/path/statements.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|row| row.split(',').collect())
        .collect();
    assert!(rows.len() > 200, "{}", rows.len());
    assert!(rows.iter().all(|row| paper.claims.iter().any(|claim| claim.id == row[2])));
    let answers = |claim: &str, travel: &str| -> Vec<&str> {
        let own = rows.iter().filter(|row| row[2] == claim && row[0] == travel).map(|row| row[3]);
        own.filter(|answer| ["yes", "no"].contains(answer)).collect()
    };
    let (mut decided, mut dependent) = (0, 0);
    for claim in &paper.claims {
        let by_travel = ["along", "against"].map(|travel| answers(&claim.id, travel));
        let depends = |answers: &Vec<&str>| answers.contains(&"yes") && answers.contains(&"no");
        decided += usize::from(by_travel.iter().any(|answers| !answers.is_empty()));
        dependent += usize::from(by_travel.iter().any(depends));
    }
    let chapter = std::fs::read_to_string(chapter_path()).unwrap().replace('\n', " ");
    let counts = format!("Of the {decided} statements on the paths of one and two cracks, {dependent} have");
    assert!(chapter.contains(&counts), "{counts}");
}

#[test]
fn figures_are_called_by_their_numbers() {
    let paper = Paper::read().unwrap();
    let called =
        |names: &[&str]| paper.figures_called(&names.iter().map(|name| name.to_string()).collect::<Vec<_>>());
    assert_eq!(called(&["20", "fig13", "Fig20"]).unwrap(), [13, 20]);
    assert_eq!(called(&[]).unwrap().len(), paper.figures.len());
    for wrong in ["26", "12", "x", "", "fig"] {
        let error = called(&[wrong]).unwrap_err().to_string();
        assert!(
            error.contains(&format!("`{wrong}`")) && error.contains("13, 14, 15") && error.contains("30"),
            "{error}"
        );
    }
}
