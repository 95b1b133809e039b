//! `railcrack validate`.

use super::common::{self, column, done, ends, numbers, read, stderr};
use std::fs;
use std::path::Path;

/// A folder of entries that are compared with the default law of a study of one line.
fn law_folder(name: &str) -> std::path::PathBuf {
    let folder = common::folder("validate", name);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation");
    fs::create_dir(folder.join("conditions")).unwrap();
    for file in ["L1.toml", "X1.toml", "F1.toml", "conditions/law.toml"] {
        fs::copy(source.join(file), folder.join(file)).unwrap();
    }
    folder
}

/// The measured values of the entry `L1` (Xian et al. 1993) with the default law, and of `X1`,
/// known from memory: a row, but no score.
#[test]
fn a_folder_of_entries_is_scored() {
    let folder = law_folder("law");
    let told = done(&folder, &["validate", ".", "--quiet"]);
    assert!(
        told.starts_with("law: 1 entry, 1 within 95 %, 1 within a factor of 2, 1 within a factor of 5"),
        "{told}"
    );
    assert!(told.contains("3 entries, 1 scored; 1 from memory, never scored"), "{told}");
    let table = folder.join("validation.csv");
    assert_eq!(column(&table, "id"), ["L1", "X1"]);
    assert_eq!(column(&table, "scored"), ["true", "false"]);
    // 2e-9 ΔK^3.33 over the law of U71Mn, 2.56e-9 ΔK^3.18, at 13.5 MPa√m.
    let law = 2e-9 * 13.5_f64.powf(3.33) / (2.56e-9 * 13.5_f64.powf(3.18));
    let factor = numbers(&table, "factor")[0];
    assert!((factor / law - 1.0).abs() < 0.02, "{factor} {law}");
    // The scatter of C in the conditions is that of the rate.
    let scatter = numbers(&table, "predicted_log_std")[0];
    assert!((scatter - 0.3).abs() < 0.02, "{scatter}");
    let page = read(&folder.join("validation.html"));
    assert!(page.contains("Xian Aiping") && page.contains("no: from memory"));
    assert!(read(&folder.join("plots/law-mm-per-cycle.svg")).contains("factor 5"));
}

/// No cell of the table is a formula of a spreadsheet.
#[test]
fn no_cell_is_a_formula() {
    let folder = law_folder("formula");
    let text = read(&folder.join("L1.toml"));
    let line = text.lines().find(|line| line.starts_with("quantity = ")).unwrap();
    fs::write(folder.join("L1.toml"), text.replace(line, "quantity = \"=HYPERLINK(1,2)\"")).unwrap();
    done(&folder, &["validate", ".", "--quiet"]);
    let table = read(&folder.join("validation.csv"));
    assert!(table.contains(",\"'=HYPERLINK(1,2)\","), "{table}");
}

/// The rate of a crack whose growth the study computes, against the growth of the same case.
#[test]
fn the_rate_of_a_sample_is_that_of_its_run() {
    let folder = common::folder("validate", "rate");
    let case = common::DISLOCATION_CASE.replace("steps = 2", "steps = 6\ndirection = \"coplanar\"")
        + "\n[traffic]\naxle_load_t = 20.0\n";
    fs::write(folder.join("case.toml"), &case).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let depth = numbers(&folder.join("run/growth.csv"), "depth_mm");
    let mgt = numbers(&folder.join("run/growth.csv"), "mgt");
    let (from, to) = (1, 4);
    let rate = (depth[to] - depth[from]) / (mgt[to] - mgt[from]);
    let study = case.replace("paris_c", "") + "[study]\n";
    fs::write(folder.join("study.toml"), study.replace("friction = 0.2", "friction = [0.2]")).unwrap();
    let entry = |id: &str| {
        format!(
            "id = \"{id}\"\ngrade = \"track\"\nquantity = \"q\"\nconditions = \"c\"\nsource = \"s\"\nread = \"full-text\"\ncertainty = 3\n[compare]\nkind = \"depth-rate\"\nstudy = \"../study.toml\"\nlow = {}\nhigh = {}\nfrom_mm = {}\nto_mm = {}\n",
            0.9 * rate,
            rate / 0.9,
            depth[from],
            depth[to]
        )
    };
    fs::create_dir(folder.join("entries")).unwrap();
    fs::write(folder.join("entries/a.toml"), entry("A")).unwrap();
    let told = done(&folder, &["validate", "entries", "--out", "result", "--quiet"]);
    assert!(told.contains("track: 1 entry, 1 within 95 %"), "{told}");
    let factor = numbers(&folder.join("result/validation.csv"), "factor")[0];
    assert!((factor - 1.0).abs() < 1e-6, "{factor}");
    // Depths that no sample reaches.
    fs::write(folder.join("entries/b.toml"), entry("B").replace("to_mm = ", "to_mm = 9")).unwrap();
    let told = done(&folder, &["validate", "entries", "--out", "result", "--force", "--quiet"]);
    assert!(
        told.contains("B: not compared, since no sample") && told.contains("2 entries, 1 scored"),
        "{told}"
    );
    // Twice the same name.
    fs::write(folder.join("entries/b.toml"), entry("A")).unwrap();
    let refused = ends(&folder, &["validate", "entries"], 2);
    assert!(stderr(&refused).contains("two entries have the id `A`"), "{}", stderr(&refused));
}

/// Entries with the scatter of ln C in their conditions, of the kinds that need a run.
const ENTRY: &str = "quantity = \"q\"\nconditions = \"c\"\nsource = \"s\"\nread = \"full-text\"\ncertainty = 3\n[compare]\nlow = 0.1\nhigh = 0.2\nfrom_mm = 1.4\nto_mm = 2.2\n";

/// Rates of straight cracks of several lengths give the life of one that grows straight ahead; the
/// life under another coefficient is in proportion to 1/C; rates per axle and per tonne agree.
#[test]
fn straight_cracks_grown_cracks_and_ratios_agree() {
    let folder = common::folder("validate", "kinds");
    let grown = "[contact]\npeak_pressure_mpa = 1000.0\nhalf_width_mm = 6.0\nfriction = 0.2\n[passage]\npositions = 61\n[[crack]]\nmouth_mm = 0.0\nlength_mm = 3.0\nangle_deg = 25.0\nfriction = 0.4\n[growth]\ndirection = \"coplanar\"\nsteps = 16\nincrement = 0.05\nparis_c = [2e-9]\n[solver]\nengine = \"dislocation\"\n[traffic]\naxle_load_t = 20.0\n";
    let straight = grown
        .replace("length_mm = 3.0", "length_mm = [3.0, 3.3, 3.6, 4.0, 4.4, 4.9, 5.4, 6.0, 6.5]")
        .replace("steps = 16\nincrement = 0.05", "steps = 0");
    for (name, text) in [
        ("grown.toml", grown.to_owned()),
        ("straight.toml", straight),
        ("double.toml", grown.replace("2e-9", "4e-9")),
        ("two.toml", grown.replace("[2e-9]", "[2e-9, 4e-9]")),
    ] {
        fs::write(folder.join(name), text).unwrap();
    }
    fs::create_dir(folder.join("entries")).unwrap();
    let write = |id: &str, grade: &str, lines: &str| {
        let text = format!("id = \"{id}\"\ngrade = \"{grade}\"\n{ENTRY}{lines}");
        fs::write(folder.join(format!("entries/{id}.toml")), text).unwrap();
    };
    let pair = "study = \"../grown.toml\"\nstudy_in_space = \"../straight.toml\"\n";
    write("A", "track", &format!("kind = \"depth-rate\"\nplace_log_std = 1.0\n{pair}"));
    write("B", "track", &format!("kind = \"depth-rate\"\nplace_log_std = 1.0\n{pair}"));
    write("C", "rig", &format!("kind = \"depth-per-cycle\"\n{pair}"));
    write("D", "rig", "kind = \"life-ratio\"\nstudy = \"../grown.toml\"\nover_study = \"../double.toml\"\n");
    let told = done(&folder, &["validate", "entries", "--out", "all", "--quiet"]);
    for line in [
        "track: 2 entries",
        "rig: 2 entries",
        "track, in space: 2 entries",
        "rig, in space: 1 entry",
        "prior of ln C by the residuals of 2 entries of track in the plane: mean ",
        ", sd 1.00\n",
    ] {
        assert!(told.contains(line), "{line}: {told}");
    }
    let table = folder.join("all/validation.csv");
    let predicted = numbers(&table, "predicted");
    assert_eq!(column(&table, "id"), ["A", "B", "C", "D"]);
    let [a, c, d] = [predicted[0], predicted[2], predicted[3]];
    assert!((a * 20e-6 / c - 1.0).abs() < 1e-9, "{a} per MGT, {c} per cycle");
    assert!((d - 2.0).abs() < 1e-6, "{d}");
    let straight: f64 = column(&table, "space_predicted")[0].parse().unwrap();
    assert!((straight / a - 1.0).abs() < 0.01, "{straight} {a}");
    let page = read(&folder.join("all/validation.html"));
    assert!(page.contains("Prior of the coefficient") && page.contains("median in space"));
    // Without the predictions in space.
    let told = done(&folder, &["validate", "entries", "--out", "plane", "--no-space", "--quiet"]);
    assert!(!told.contains("in space") && told.contains("rig: 2 entries"), "{told}");
    // Two samples cannot be taken in pairs with one.
    write("D", "rig", "kind = \"life-ratio\"\nstudy = \"../grown.toml\"\nover_study = \"../two.toml\"\n");
    let refused = ends(&folder, &["validate", "entries", "--quiet"], 2);
    let says = "`study` has 1 samples and `over_study` 2";
    assert!(stderr(&refused).contains(says), "{}", stderr(&refused));
}

#[test]
fn what_cannot_be_used_is_refused_with_its_place() {
    let folder = law_folder("refused");
    for (file, from, to, says) in [
        ("L1.toml", "grade = \"law\"", "grade = \"guess\"", "L1.toml:2"),
        ("L1.toml", "conditions/law.toml", "conditions/none.toml", "none.toml"),
        ("conditions/law.toml", "friction = 0.2", "friction = 7.0", "law.toml"),
    ] {
        let text = read(&folder.join(file));
        assert!(text.contains(from));
        fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
        let refused = ends(&folder, &["validate", ".", "--quiet"], 2);
        assert!(stderr(&refused).contains(says), "{says}: {}", stderr(&refused));
        fs::write(folder.join(file), text).unwrap();
    }
    fs::create_dir(folder.join("empty")).unwrap();
    let refused = ends(&folder, &["validate", "empty"], 2);
    assert!(stderr(&refused).contains("holds no entry"), "{}", stderr(&refused));
    assert!(!folder.join("validation.csv").exists());
    // An editor is helped by the schema.
    let schema = done(&folder, &["schema", "--entry"]);
    assert!(schema.contains("\"full-text\"") && schema.contains("depth-rate-ratio"), "{schema}");
}
