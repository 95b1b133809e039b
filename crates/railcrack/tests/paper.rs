//! The paper recomputed: its cheap figures, their tables, what is refused.

use railcrack::growth::Watch;
use railcrack::output::Existing;
use railcrack::paper::{FIGURES, PaperError, Reproduction, Telling, parse_figures, reproduce};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

struct Nobody;

impl Watch for Nobody {
    fn progress(&self, _: f64) {}
    fn interrupted(&self) -> bool {
        false
    }
}

impl Telling for Nobody {
    fn planned(&self, _: usize) {}
    fn finished(&self, _: &str) {}
}

/// Fig. 13, computed once for all tests, and their folder.
fn cheap() -> &'static (Reproduction, PathBuf) {
    static CHEAP: OnceLock<(Reproduction, PathBuf)> = OnceLock::new();
    CHEAP.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("paper");
        let _ = std::fs::remove_dir_all(&folder);
        let done = reproduce(&folder, &[13], Existing::Refuse, &Nobody).unwrap();
        (done, folder)
    })
}

#[test]
fn numbers_of_the_text() {
    // Design values of two independent codes: the locked plateau of Fig. 13, and the fixed steps of Table 1.
    let (done, _) = cheap();
    let half_plane = done.results.setup("half-plane, with").unwrap();
    let peak = half_plane.run("fig13").unwrap().crack().sif.peak();
    let table = support_table("verification/half-plane-histories/fig13.csv");
    let theirs = table.iter().fold(0.0, |peak: f64, row| peak.max(row[2].abs()));
    assert!((peak / theirs - 1.0).abs() < 0.005, "{peak} against {theirs}: its plateau is up to 0.5 % low");
    // K does not depend on Young's modulus.
    let soft = done.results.setup("E 70 GPa, with").unwrap();
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
    assert!(done.results.setup("half-plane, with").unwrap().run("reference").is_none());
}

#[test]
fn results_are_not_replaced_unasked() {
    let (_, folder) = cheap();
    let refused = reproduce(folder, &[13], Existing::Refuse, &Nobody).err().unwrap();
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
