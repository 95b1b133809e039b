//! The passage of one wheel.

/// Wheel positions of one passage at which results are wanted: `positions` abscissae evenly spaced from `from` to
/// `to` (mm). `from` > `to` is a wheel that runs towards −x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// First abscissa of the Hertz centre, mm.
    pub from: f64,
    /// Last abscissa, mm.
    pub to: f64,
    /// Number of output positions, at least 2.
    pub positions: usize,
}

impl Passage {
    /// The abscissae x_c in the order of travel, mm.
    pub fn abscissae(&self) -> Vec<f64> {
        let last = self.positions.saturating_sub(1).max(1) as f64;
        (0..self.positions).map(|i| self.from + (self.to - self.from) * (i as f64 / last)).collect()
    }
}
