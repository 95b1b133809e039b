//! Writes docs/dev/verification.md from what the verification tests measured last.
//!
//! `cargo test --release --test verification && cargo run --release --example verification_page`

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

const HEAD: &str = "# Verification\n\n\
    What is required of the numbers, the test that holds it, what it measured when this page was made, and what it allows. Made by\n\
    `cargo run --release --example verification_page` from a run of the tests; a test checks that nothing is missing. Of tests with many\n\
    measurements, the row has the one that comes closest to what is allowed. Errors are relative where no unit is given. Tests are in\n\
    `tests/verification` of `crates/railcrack` and `crates/railcrack-run`; unit tests beside the code hold the pieces: kernels, quadrature, cells, factor, Williams fields on a patch (1e-3) and the\n\
    superposition of a discrete field (1e-10).\n\n\
    | requirement | test | measured | allowed | because |\n|---|---|---|---|---|\n";

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), Into::into);
    let mut rows: Vec<_> = std::fs::read_dir(target.join("tmp/verification"))?.collect::<Result<_, _>>()?;
    rows.sort_by_key(|row| row.file_name());
    let mut page = HEAD.to_owned();
    for row in &rows {
        let text = std::fs::read_to_string(row.path())?;
        // A bar would end the cell.
        let text = text.replace('|', "\\|");
        let fields: Vec<&str> = text.trim_end().split('\t').collect();
        let [says, test, measured, allowed, reason] = fields[..] else {
            return Err(format!("{} is not a row", row.path().display()).into());
        };
        writeln!(page, "| {says} | `{test}` | {measured} | {allowed} | {reason} |")?;
    }
    std::fs::write(root.join("docs/dev/verification.md"), page)?;
    println!("{} requirements in docs/dev/verification.md", rows.len());
    Ok(())
}
