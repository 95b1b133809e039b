//! The tables of docs/dev/networks.md: K of every crack of the networks in `cases` beside the
//! single crack.
//!
//! `cargo run --release --example network_tables`

use railcrack::growth::{StepRecord, TipRecord, Unobserved};
use railcrack_case::{Case, Overrides};
use railcrack_run::setup::PreparedRun;
use std::error::Error;
use std::path::{Path, PathBuf};

type Failure = Box<dyn Error>;

/// The case files.
fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases")
}

/// The initial cracks of a case text by finite elements.
fn initial(text: &str) -> Result<StepRecord, Failure> {
    let overrides = Overrides { engine: Some("xfem".into()), steps: Some(0), ..Overrides::default() };
    let case = Case::parse_with(text, "case.toml", &cases(), &overrides)?;
    let mut growth = PreparedRun::new(&case, None)?.growth(None);
    growth.next_step(&Unobserved)?.ok_or_else(|| "a run without steps".into())
}

/// The text with the friction of its crack faces replaced.
fn with_friction(text: &str, friction: &str) -> String {
    let line = |line: &str| match line {
        "friction = 0.5" => format!("friction = {friction}\n"),
        other => format!("{other}\n"),
    };
    text.lines().map(line).collect()
}

/// Change in per cent; none where there is nothing to compare with.
fn change(value: f64, single: f64, scale: f64) -> String {
    if single.abs() < 1e-2 * scale {
        "–".to_owned()
    } else {
        format!("{:+.0}", 100.0 * (value / single - 1.0))
    }
}

fn row(name: &str, tip: &TipRecord, single: &TipRecord) {
    let scale = single.delta_ki.max(single.delta_kii);
    // MPa √mm in one MPa √m.
    let unit = 1000f64.sqrt();
    println!(
        "| {name} | {:.2} | {} | {:.2} | {} | {:.2} | {} |",
        tip.ki_max / unit,
        change(tip.ki_max, single.ki_max, scale),
        tip.delta_kii / unit,
        change(tip.delta_kii, single.delta_kii, scale),
        tip.delta_keq / unit,
        change(tip.delta_keq, single.delta_keq, scale),
    );
}

/// The network of `file`; `singles` are its cracks alone, by the index of the crack.
fn table(file: &str, friction: &str, single_of: impl Fn(usize, &str) -> String) -> Result<(), Failure> {
    let text = with_friction(&std::fs::read_to_string(cases().join(file))?, friction);
    println!("\n`{file}`, friction of the faces {friction}\n");
    println!("| crack | max K_I | % | ΔK_II | % | ΔK_eq | % |\n|---|---|---|---|---|---|---|");
    let network = initial(&text)?;
    let mut before: Option<(String, StepRecord)> = None;
    for (i, tip) in network.tips.iter().enumerate() {
        let single = single_of(i, &text);
        if before.as_ref().is_none_or(|(text, _)| *text != single) {
            before = Some((single.clone(), initial(&single)?));
            if let Some((_, alone)) = &before {
                row("single", &alone.tips[0], &alone.tips[0]);
            }
        }
        if let Some((_, alone)) = &before {
            row(&format!("{}", i + 1), tip, &alone.tips[0]);
        }
    }
    Ok(())
}

fn main() -> Result<(), Failure> {
    println!("K in MPa√m; per cent: change from the single crack.");
    for file in ["squat-pair.toml", "squat-pair-block.toml"] {
        for friction in ["0.5", "0.01"] {
            table(file, friction, |crack, text| {
                // Text up to the first crack, and the one that is wanted; the block stays where it
                // is.
                let parts: Vec<&str> = text.split("[[crack]]").collect();
                let head = parts[0].replace("boundary = \"block\"", "boundary = \"block\"\ncentre_mm = -0.5");
                format!("{head}[[crack]]{}", parts[crack + 1])
            })?;
        }
    }
    for file in ["network-nine.toml", "network-nine-block.toml"] {
        table(file, "0.5", |_, text| {
            let text = text.replace("boundary = \"block\"", "boundary = \"block\"\ncentre_mm = 0.0");
            text.lines()
                .filter(|line| !line.starts_with("count") && !line.starts_with("spacing_mm"))
                .map(|line| format!("{line}\n"))
                .collect()
        })?;
    }
    Ok(())
}
