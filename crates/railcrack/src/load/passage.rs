//! The passage of one wheel.

use crate::math::OutOfRange;
use crate::words::{Choice, Word};

/// Direction of travel of a wheel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Travel {
    /// Towards +x.
    #[default]
    Forward,
    /// Towards −x.
    Backward,
}

impl Choice for Travel {
    const WORDS: &'static [(Self, Word)] =
        &[(Self::Forward, Word::now("+x", "towards +x")), (Self::Backward, Word::now("-x", "towards -x"))];
}

impl Travel {
    /// +1 towards +x, −1 towards −x.
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }

    /// The opposite direction.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }
}

/// Wheel positions of one passage at which results are output: `positions` abscissae evenly spaced
/// from `from` to `to` (mm). With `from` > `to` the wheel runs towards −x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// First abscissa of the Hertz centre, mm.
    pub from: f64,
    /// Last abscissa, mm.
    pub to: f64,
    /// Number of output positions, at least 2.
    pub positions: usize,
}

/// The passage of Trollé et al. 2014, Table 1: ±6 a around a mouth at x = 0, a = 6.75 mm.
impl Default for Passage {
    fn default() -> Self {
        Self { from: -40.5, to: 40.5, positions: 241 }
    }
}

impl Passage {
    /// Rejects fewer than two positions, and abscissae that are not finite.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_finite("first wheel position (mm)", self.from)?;
        OutOfRange::unless_finite("last wheel position (mm)", self.to)?;
        let positions = self.positions as f64;
        OutOfRange::unless(self.positions >= 2, "output positions of a passage", positions, "at least 2")
    }

    /// Direction of travel of the wheel.
    pub fn travel(&self) -> Travel {
        if self.to < self.from { Travel::Backward } else { Travel::Forward }
    }

    /// The abscissae x_c in the order of travel, mm.
    #[must_use]
    pub fn abscissae(&self) -> Vec<f64> {
        let last = self.positions.saturating_sub(1).max(1) as f64;
        (0..self.positions).map(|i| self.from + (self.to - self.from) * (i as f64 / last)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Passage;

    #[test]
    fn a_passage_that_is_none_is_refused() {
        let refused = |passage: Passage| passage.check().unwrap_err().to_string();
        let default = Passage::default();
        assert!(default.check().is_ok());
        let text = "output positions of a passage = 0: must be at least 2";
        assert_eq!(refused(Passage { positions: 0, ..default }), text);
        assert!(refused(Passage { to: f64::NAN, ..default }).contains("must be finite"));
    }
}
