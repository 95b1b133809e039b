//! Fixtures of the command tests.

// Each test file is a program of its own and uses a part of this.
#![allow(dead_code)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// A quick case: few positions, few elements, frictional faces, a kink in the path.
pub const QUICK_CASE: &str = r#"
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.3

[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 40.0
friction = 0.2

[passage]
positions = 61

[mesh]
interface_elements = 16

[growth]
steps = 2
"#;

/// The same by dislocations, with fewer positions.
pub static DISLOCATION_CASE: LazyLock<String> = LazyLock::new(|| {
    QUICK_CASE.replace("positions = 61", "positions = 41") + "\n[solver]\nengine = \"dislocation\"\n"
});

/// An empty folder for the test `name` of the file `tests`.
pub fn folder(tests: &str, name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(tests).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The program, to be started in `folder`.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_railcrack"));
    command.args(arguments).current_dir(folder);
    command
}

/// The program, run in `folder`.
pub fn railcrack(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

/// The program, run in `folder`, must end with `code`.
#[track_caller]
pub fn ends(folder: &Path, arguments: &[&str], code: i32) -> Output {
    let output = railcrack(folder, arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
    output
}

/// The program, run in `folder`, must succeed; what it prints.
#[track_caller]
pub fn done(folder: &Path, arguments: &[&str]) -> String {
    stdout(&ends(folder, arguments, 0))
}

/// `railcrack run CASE --out OUT`, killed once `growth.csv` has so many rows.
pub fn killed_run(folder: &Path, (case, out): (&str, &str), at_rows: usize) {
    let mut child = command(folder, &["run", case, "--out", out, "--quiet"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let growth = folder.join(out).join("growth.csv");
    let rows = || {
        let text = std::fs::read_to_string(&growth).unwrap_or_default();
        text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).count()
    };
    let started = Instant::now();
    while rows() < at_rows && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Standard output.
pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Standard error.
pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The text of a file.
#[track_caller]
pub fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The fields of the column `name` of a table. None of its fields has a comma.
#[track_caller]
pub fn column(path: &Path, name: &str) -> Vec<String> {
    let text = read(path);
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let at = lines.next().unwrap().split(',').position(|column| column == name).unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().to_owned()).collect()
}

/// The numbers of the column `name` of a table; empty fields are left out.
#[track_caller]
pub fn numbers(path: &Path, name: &str) -> Vec<f64> {
    column(path, name).iter().filter_map(|field| field.parse().ok()).collect()
}

/// The names of what is in `folder`, in order.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
