//! The paper recomputed: the cheap statements again, and whether docs/paper.md says what they say.

use railcrack::growth::Observer;
use railcrack_paper::{
    Decision, Earlier, FIGURES, GROUPS, PaperError, Reproduction, SETUPS, Telling, Verdict, parse_figures,
    reproduce,
};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

struct Nobody;

impl Observer for Nobody {
    fn progress(&self, _: f64) {}
    fn interrupted(&self) -> bool {
        false
    }
}

impl Telling for Nobody {
    fn planned(&self, _: usize) {}
    fn finished(&self, _: &str, _: f64) {}
}

/// Fig. 13, computed once for all tests, and their folder.
fn cheap() -> &'static (Reproduction, PathBuf) {
    static CHEAP: OnceLock<(Reproduction, PathBuf)> = OnceLock::new();
    CHEAP.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("paper");
        let _ = std::fs::remove_dir_all(&folder);
        let done = reproduce(&folder, &[13], &[], Earlier::Refuse, &Nobody).unwrap();
        (done, folder)
    })
}

fn docs(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The page in docs with the rules and numbers of the statement.
fn page_of(verdict: &Verdict) -> String {
    docs(&GROUPS.iter().find(|group| group.decides(verdict.claim)).unwrap().file())
}

/// The paragraph of `page` on the statement `id`: its rule and numbers.
fn paragraph<'a>(page: &'a str, id: &str) -> &'a str {
    let start = page.find(&format!("**{id}**")).unwrap_or_else(|| panic!("no {id} on the page"));
    let rest = &page[start..];
    rest[2..].find("\n**").or_else(|| rest[2..].find("\n## ")).map_or(rest, |end| &rest[..end + 2])
}

/// The numbers of a text.
fn numbers(text: &str) -> Vec<f64> {
    text.split(|c: char| !(c.is_ascii_digit() || ".-e".contains(c)))
        .filter_map(|word| word.parse().ok())
        .collect()
}

/// Whether `line` of the page says what `decision` says, to the three digits of the page and
/// round-off of another machine.
fn says(line: &str, setup: &str, decision: &Decision) -> bool {
    let answer = if decision.holds { "yes; " } else { "no; " };
    let Some(numbers_there) = line.strip_prefix(&format!("* {setup}: {answer}")) else { return false };
    let numbers_there = numbers_there.split(" (warnings: ").next().unwrap_or_default();
    let (theirs, ours) = (numbers(numbers_there), numbers(&decision.text()));
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 0.01 * b.abs() + 1e-9;
    theirs.len() == ours.len() && !ours.is_empty() && theirs.iter().zip(&ours).all(close)
}

#[test]
fn the_page_in_docs_has_the_deciding_numbers_of_the_cheap_statements() {
    let (done, _) = cheap();
    let page = docs("paper.md");
    let mut checked = 0;
    for verdict in &done.verdicts {
        let of_group = page_of(verdict);
        let lines: Vec<&str> = paragraph(&of_group, verdict.claim.id).lines().collect();
        for (at, decision) in &verdict.decisions {
            let setup = SETUPS[*at].name;
            // Variants that agree with what they vary are in claims.csv only.
            let shown = lines.iter().find(|line| line.starts_with(&format!("* {setup}: ")));
            let Some(line) = shown else { continue };
            let wanted = decision.text();
            assert!(says(line, setup, decision), "{}: \n{line}\nnow {wanted}", verdict.claim.id);
            checked += 1;
        }
        let row = format!("| {} | {} |", verdict.claim.statement, verdict.claim.place);
        assert!(page.contains(&row), "docs/paper.md: no row {row}");
    }
    assert!(checked >= 4, "{checked} decisions compared");
}

#[test]
fn a_line_that_says_something_else_is_seen() {
    let decision = &cheap().0.verdicts[0].decisions[0].1;
    let line = |holds: bool, text: &str| format!("* x: {}; {text}", if holds { "yes" } else { "no" });
    assert!(says(&line(decision.holds, &decision.text()), "x", decision));
    assert!(!says(&line(!decision.holds, &decision.text()), "x", decision));
    assert!(!says(&line(decision.holds, &decision.text().replace('.', "9.")), "x", decision));
    assert!(!says(&line(decision.holds, ""), "x", decision));
}

#[test]
fn the_page_in_docs_shows_every_figure_and_set_up() {
    let page = docs("paper.md");
    let groups: String = GROUPS.iter().map(|group| docs(&group.file())).collect();
    for group in GROUPS {
        assert!(page.contains(&format!("[{}]({})", group.heading(), group.file())));
    }
    for figure in FIGURES {
        assert!(groups.contains(&format!("(figures/{}.svg)", figure.file_stem())), "Fig. {}", figure.number);
        assert!(docs(&format!("figures/{}.svg", figure.file_stem())).starts_with("<svg"));
    }
    for setup in SETUPS {
        assert!(page.contains(&format!("| {} | {} |", setup.name, setup.words)), "{}", setup.name);
    }
}

#[test]
fn finished_runs_are_taken_over() {
    struct Count(std::sync::atomic::AtomicUsize);
    impl Observer for Count {
        fn progress(&self, _: f64) {}
        fn interrupted(&self) -> bool {
            false
        }
    }
    impl Telling for Count {
        fn planned(&self, _: usize) {}
        fn finished(&self, _: &str, wall_s: f64) {
            self.0.fetch_add(usize::from(wall_s > 0.0), std::sync::atomic::Ordering::Relaxed);
        }
    }
    let (done, from) = cheap();
    let folder = from.with_file_name("paper-again");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("runs")).unwrap();
    let runs: Vec<PathBuf> =
        std::fs::read_dir(from.join("runs")).unwrap().map(|f| f.unwrap().path()).collect();
    assert_eq!(runs.len(), done.runs);
    for run in &runs {
        std::fs::copy(run, folder.join("runs").join(run.file_name().unwrap())).unwrap();
    }
    // One of another case under this name, one that is damaged: both are computed.
    let name = |stem: &str| folder.join("runs").join(format!("{stem}.run"));
    std::fs::copy(name("fig13-half-plane-against"), name("fig13-half-plane-along")).unwrap();
    std::fs::write(name("fig13-E-70-GPa-along"), "half").unwrap();
    let count = Count(0.into());
    let again = reproduce(&folder, &[13], &[], Earlier::TakeOver, &count).unwrap();
    assert_eq!(count.0.into_inner(), 2);
    assert!(again.verdicts.iter().zip(&done.verdicts).all(|(a, b)| a.decisions == b.decisions));
    let page = |folder: &Path| std::fs::read_to_string(folder.join("paper.md")).unwrap();
    assert_eq!(page(&folder), page(from));
}

#[test]
fn numbers_of_the_text() {
    // Design values of two independent codes: the locked plateau of Fig. 13, and the fixed steps of
    // Table 1.
    let (done, _) = cheap();
    let half_plane = done.results.setup("half-plane, along").unwrap();
    let peak = half_plane.run("fig13").unwrap().crack().sif.peak();
    let table = support_table("verification/half-plane-histories/fig13.csv");
    let theirs = table.iter().fold(0.0, |peak: f64, row| peak.max(row[2].abs()));
    assert!((peak / theirs - 1.0).abs() < 0.005, "{peak} against {theirs}: its plateau is up to 0.5 % low");
    // K does not depend on Young's modulus.
    let soft = done.results.setup("E 70 GPa, along").unwrap();
    let (soft, steel) = (soft.run("fig13").unwrap().crack(), half_plane.run("fig13").unwrap().crack());
    assert!(soft.sif.difference(&steel.sif) < 1e-6, "{}", soft.sif.difference(&steel.sif));
}

/// The numbers of a table of the verification folder.
fn support_table(name: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    rows.map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

#[test]
fn tables_have_their_columns() {
    let (_, folder) = cheap();
    for (name, columns) in [
        ("figures/fig13.csv", "setup,curve,crack,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m"),
        ("claims.csv", "claim,place,setup,holds,number,value"),
    ] {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        assert_eq!(text.lines().next(), Some(columns), "{name}");
        assert!(text.lines().count() > 10, "{name}");
    }
}

#[test]
fn only_the_chosen_figures_are_computed() {
    let (done, folder) = cheap();
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder.join("figures")).unwrap().map(|f| f.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "svg"));
    assert_eq!(files.len(), 2, "{files:?}");
    let claims: Vec<&str> = done.verdicts.iter().map(|v| v.claim.id).collect();
    assert!(claims.contains(&"4-agreement") && !claims.contains(&"5.2-range"), "{claims:?}");
    assert!(done.results.setup("half-plane, along").unwrap().run("reference").is_none());
}

#[test]
fn results_are_not_replaced_unasked() {
    let (_, folder) = cheap();
    let refused = reproduce(folder, &[13], &[], Earlier::Refuse, &Nobody).err().unwrap();
    assert!(matches!(refused, PaperError::Exists { .. }), "{refused}");
    assert!(refused.to_string().contains("--force"));
}

#[test]
fn figures_are_called_by_their_numbers() {
    let names =
        |names: &[&str]| parse_figures(&names.iter().map(|name| name.to_string()).collect::<Vec<_>>());
    assert_eq!(names(&["20", "fig13", "Fig20"]), Ok(vec![13, 20]));
    assert_eq!(names(&[]).unwrap().len(), FIGURES.len());
    for wrong in ["26", "12", "x", "", "fig"] {
        let error = names(&[wrong]).unwrap_err().to_string();
        assert!(
            error.contains(&format!("`{wrong}`")) && error.contains("13, 14, 15") && error.contains("30"),
            "{error}"
        );
    }
}
