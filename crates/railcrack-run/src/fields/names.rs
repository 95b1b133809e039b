//! Names of the field files of a run.

/// The name of the file of a step and a position, which counts from 1.
pub(crate) fn name(step: usize, position: usize) -> String {
    format!("step-{step:04}-position-{position:04}.vtu")
}

/// Step and position (from 1) of the field file of this name; none where it is not one that a run
/// writes.
pub(crate) fn step_and_position(file: &str) -> Option<(usize, usize)> {
    let (step, position) = file.strip_prefix("step-")?.strip_suffix(".vtu")?.split_once("-position-")?;
    let (step, position) = (step.parse().ok()?, position.parse().ok()?);
    (name(step, position) == file).then_some((step, position))
}

/// Begins the name of the file of a crack in space, which is the same otherwise.
const IN_SPACE: &str = "crack-";

/// The name of the file of a crack in space at a step and a position, which counts from 1.
pub(crate) fn name_in_space(step: usize, position: usize) -> String {
    format!("{IN_SPACE}{}", name(step, position))
}

/// Whether a file of this name is one that a run writes.
pub(crate) fn is_field_file(file: &str) -> bool {
    step_and_position(file.strip_prefix(IN_SPACE).unwrap_or(file)).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_that_a_run_writes_are_field_files() {
        assert!(is_field_file(&name(0, 101)) && is_field_file(&name(12_345, 100_000)));
        assert!(is_field_file(&name_in_space(3, 7)) && step_and_position(&name_in_space(3, 7)).is_none());
        for other in ["mine.vtu", "step-1-position-1.vtu", "step-0001-position-0001.vtu.bak", "step-0001.vtu"]
        {
            assert!(!is_field_file(other), "{other}");
        }
    }
}
