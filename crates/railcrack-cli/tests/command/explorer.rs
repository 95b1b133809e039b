//! Pages that compute: where their engine comes from, what they hold, what is refused. What they
//! compute, `.ci/run web` compares with the program.

use crate::common::{DISLOCATION_CASE, QUICK_CASE, command, folder, read, stderr, stdout};
use std::path::Path;
use std::process::Output;

/// A file that is named and begins as the module of a page.
const MODULE: &[u8] = b"\0asm\x01\0\0\0module of a test";

fn name() -> String {
    format!("railcrack-{}.wasm", env!("CARGO_PKG_VERSION"))
}

/// The program in `folder` with the engine in the file `engine`.
#[track_caller]
fn ends(folder: &Path, engine: Option<&str>, arguments: &[&str], code: i32) -> Output {
    let mut command = command(folder, arguments);
    command.env_remove("RAILCRACK_ENGINE");
    if let Some(engine) = engine {
        command.env("RAILCRACK_ENGINE", engine);
    }
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
    output
}

#[test]
fn the_explorer_is_a_page_with_case_and_engine() {
    let folder = folder("explorer", "page");
    std::fs::write(folder.join(name()), MODULE).unwrap();
    std::fs::write(folder.join("case.toml"), &*DISLOCATION_CASE).unwrap();
    let engine = name();
    let said = stdout(&ends(&folder, Some(&engine), &["explorer", "case.toml", "--out", "own.html"], 0));
    assert!(said.starts_with("wrote own.html, "), "{said}");
    let page = read(&folder.join("own.html"));
    for part in ["what-if-data", "what-if-case", "angle_deg = 40.0", "function openEngine"] {
        assert!(page.contains(part), "{part}");
    }
    // Nothing is loaded from anywhere, nor could it be.
    assert!(
        page.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "),
        "{page:.500}"
    );
    assert!(!page.contains("src=\"http") && !page.contains("<link rel=\"stylesheet"));
    // Without a case, that of the program; an existing page is replaced on demand alone.
    ends(&folder, Some(&engine), &["explorer"], 0);
    assert!(read(&folder.join("explorer.html")).contains("A head check under traffic"));
    let said = stderr(&ends(&folder, Some(&engine), &["explorer"], 4));
    assert!(said.contains("explorer.html"), "{said}");
    ends(&folder, Some(&engine), &["explorer", "--force"], 0);
}

#[test]
fn a_run_with_an_explorer_has_it_in_its_report() {
    let folder = folder("explorer", "run");
    std::fs::write(folder.join(name()), MODULE).unwrap();
    std::fs::write(folder.join("case.toml"), format!("{}\n[output]\nexplorer = true\n", &*DISLOCATION_CASE))
        .unwrap();
    let engine = name();
    ends(&folder, Some(&engine), &["run", "case.toml", "--steps", "1", "--out", "run", "--quiet"], 0);
    let page = read(&folder.join("run/report.html"));
    assert!(page.contains("Recomputed here and now") && page.contains("what-if-data"));
    std::fs::remove_file(folder.join("run/report.html")).unwrap();
    ends(&folder, Some(&engine), &["report", "run"], 0);
    assert!(read(&folder.join("run/report.html")) == page, "the same page again");
}

#[test]
fn without_its_engine_nothing_is_computed() {
    let folder = folder("explorer", "none");
    std::fs::write(folder.join("case.toml"), format!("{}\n[output]\nexplorer = true\n", &*DISLOCATION_CASE))
        .unwrap();
    for arguments in [&["check", "case.toml"][..], &["run", "case.toml", "--out", "run"], &["explorer"]] {
        let said = stderr(&ends(&folder, None, arguments, 2)).replace('\n', " ");
        assert!(said.contains(&name()) && said.contains("RAILCRACK_ENGINE"), "{said}");
    }
    assert!(!folder.join("run").exists());
    // A file of another name is one of another version; another file is no module.
    std::fs::write(folder.join("other.wasm"), MODULE).unwrap();
    let said = stderr(&ends(&folder, Some("other.wasm"), &["explorer"], 4));
    assert!(said.contains(&format!("must be called {}", name())), "{said}");
    std::fs::write(folder.join(name()), "text").unwrap();
    let said = stderr(&ends(&folder, Some(&name()), &["explorer"], 4));
    assert!(said.contains("is no WebAssembly module"), "{said}");
}

/// A device without end and a pipe without a writer are refused at once.
#[cfg(unix)]
#[test]
fn the_engine_is_a_regular_file() {
    let folder = folder("explorer", "regular");
    std::process::Command::new("mkfifo").arg(folder.join(name())).status().unwrap();
    for engine in ["/dev/zero", &name()] {
        let started = std::time::Instant::now();
        let said = stderr(&ends(&folder, Some(engine), &["explorer"], 4));
        assert!(said.contains(engine), "{said}");
        assert!(started.elapsed().as_secs() < 5 && !folder.join("explorer.html").exists());
    }
}

#[test]
fn what_a_page_cannot_compute_is_refused() {
    let folder = folder("explorer", "refused");
    std::fs::write(folder.join(name()), MODULE).unwrap();
    std::fs::write(folder.join("xfem.toml"), QUICK_CASE).unwrap();
    let engine = name();
    let said = stderr(&ends(&folder, Some(&engine), &["explorer", "xfem.toml"], 2));
    assert!(said.contains("a page computes with \"dislocation\" only"), "{said}");
    std::fs::write(folder.join("asked.toml"), format!("{QUICK_CASE}\n[output]\nexplorer = true\n")).unwrap();
    let said = stderr(&ends(&folder, Some(&engine), &["check", "asked.toml"], 2));
    assert!(said.contains("output.explorer") && said.contains("asked.toml:"), "{said}");
    let whole = format!("{}\n[output]\nexplorer = true\nreport = false\n", &*DISLOCATION_CASE);
    std::fs::write(folder.join("no-page.toml"), whole).unwrap();
    let said = stderr(&ends(&folder, Some(&engine), &["check", "no-page.toml"], 2));
    assert!(said.contains("report is false"), "{said}");
}
