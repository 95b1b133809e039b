//! Probability of detection over depth.

/// Probability of detection by depth.
#[derive(Debug, Clone, PartialEq)]
pub struct DetectionTable {
    rows: Vec<(f64, f64)>,
}

impl DetectionTable {
    /// The table of `rows`, whose depths ascend and whose probabilities do not descend.
    pub(super) fn of(rows: Vec<(f64, f64)>) -> Self {
        Self { rows }
    }

    /// Depth (mm) and probability of each row, the shallowest first.
    #[must_use]
    pub fn rows(&self) -> &[(f64, f64)] {
        &self.rows
    }
}
