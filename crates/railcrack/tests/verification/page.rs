//! The page docs/dev/verification.md lists every requirement that a test checks.

use crate::common::REQUIREMENTS;
use std::path::Path;

#[test]
fn lists_every_requirement() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/dev/verification.md");
    let page = std::fs::read_to_string(page).unwrap();
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| ")).collect();
    for requirement in REQUIREMENTS {
        let row = rows.iter().find(|row| {
            row.contains(&requirement.says.replace('|', "\\|")) && row.contains(requirement.test)
        });
        assert!(
            row.is_some(),
            "`{}` of {} is not on the page: see CONTRIBUTING.md",
            requirement.says,
            requirement.test
        );
    }
    // A header row, and no requirement without a test.
    assert_eq!(rows.len(), REQUIREMENTS.len() + 1, "rows of the page");
}
