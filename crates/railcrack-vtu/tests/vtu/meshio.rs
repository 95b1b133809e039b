//! Files read by meshio, an independent program.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Python with meshio.
const PYTHON: &str = "RAILCRACK_PYTHON";

fn verification() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/vtu")
}

/// The content of a file as meshio reads it.
pub fn read_back(path: &Path) -> Value {
    let python = std::env::var_os(PYTHON)
        .unwrap_or_else(|| panic!("{PYTHON} must name a Python with meshio: .ci/run provides one"));
    let output = Command::new(python).arg(verification().join("read_back.py")).arg(path).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut read: Value = serde_json::from_slice(&output.stdout).unwrap();
    read[0].take()
}
