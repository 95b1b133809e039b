//! Damaged cases, studies and profiles: an answer in time, whatever is written.
//!
//! The damage follows a seed, so that a failure can be made again; `RAILCRACK_MUTATIONS` sets how
//! many files of each kind are tried.

use super::random::Random;
use railcrack_case::{Case, Overrides, Study, init_text};
use railcrack_run::setup::RunSize;
use std::path::Path;
use std::time::{Duration, Instant};

/// Files of each kind, unless the environment says otherwise: a second or two.
const FILES: u64 = 300;

/// Time for one file, on a machine that is busy.
const BUDGET: Duration = Duration::from_secs(10);

/// Pieces of files that are put in anywhere: the ends of what numbers, texts and lists can be.
const PIECES: &[&str] = &[
    "5e-324",
    "1e-300",
    "-0.0",
    "1e308",
    "1e400",
    "nan",
    "-inf",
    "inf",
    "9223372036854775807",
    "0",
    "-1",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    "\"",
    "'''",
    "#",
    "\n",
    "\t",
    "\r",
    "\u{1b}",
    "\u{0}",
    "\u{feff}",
    "\u{202e}",
    "é",
    ",",
    ".",
    "[[crack]]\n",
    "[rail]\n",
    "[study]\n",
    "[0.1, 0.2]",
    "[[0.0, 0.0], [1e-9, -1e-9]]",
    "true",
    "1979-05-27",
];

/// `text` with one to four changes: a value or a line exchanged, doubled or removed, a piece put
/// in.
fn damaged(text: &str, random: &mut Random) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..=random.below(4) {
        let at = random.below(lines.len());
        let piece = PIECES[random.below(PIECES.len())];
        match random.below(6) {
            0 | 1 => match lines[at].split_once('=') {
                Some((key, _)) => lines[at] = format!("{key}= {piece}"),
                None => lines[at] = piece.to_owned(),
            },
            2 => drop(lines.remove(at)),
            3 => lines.insert(random.below(at), lines[at].clone()),
            4 => {
                let other = random.below(lines.len());
                lines.swap(at, other);
            }
            _ => {
                let places: Vec<usize> = lines[at].char_indices().map(|(place, _)| place).collect();
                let place = places.get(random.below(places.len())).copied().unwrap_or_default();
                lines[at].insert_str(place, piece);
            }
        }
        if lines.is_empty() {
            lines.push(String::new());
        }
    }
    lines.join("\n")
}

fn try_many(text: &str, answer: impl Fn(&str)) {
    let files = std::env::var("RAILCRACK_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(FILES);
    for seed in 0..files {
        let changed = damaged(text, &mut Random(seed));
        let started = Instant::now();
        answer(&changed);
        assert!(started.elapsed() < BUDGET, "seed {seed}: {:?} for\n{changed}", started.elapsed());
    }
}

#[test]
fn damaged_cases_are_answered() {
    try_many(&init_text(), |text| {
        if let Ok(case) = Case::parse(text, "case.toml", Path::new("")) {
            let _ = RunSize::estimate(&case);
        }
    });
}

#[test]
fn damaged_studies_are_answered() {
    let study = "[study]\ncombine = \"zip\"\n[contact]\npeak_pressure_mpa = [845.0, 900.0]\n\
                 half_width_mm = 6.75\nfriction = [0.1, 0.2]\n[[crack]]\nmouth_mm = 0.0\n\
                 length_mm = 6.0\nangle_deg = [15.0, 30.0]\nfriction = 0.5\n";
    try_many(study, |text| {
        drop(Study::parse_with(text, "study.toml", Path::new(""), &Overrides::default()));
    });
}

#[test]
fn damaged_profiles_are_answered() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("damaged-profiles");
    std::fs::create_dir_all(&folder).unwrap();
    let case = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n\
                [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n\
                [residual_stress]\nprofile = \"p.csv\"\n";
    try_many("depth_mm,sxx_mpa,szz_mpa\n0,25,5\n1,-110,0\n2.5,10,0\n", |text| {
        std::fs::write(folder.join("p.csv"), text).unwrap();
        drop(Case::parse(case, "case.toml", &folder));
    });
}
