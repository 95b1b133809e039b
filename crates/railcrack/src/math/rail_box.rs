//! The rail as a rectangle.

/// A rectangle below y = 0 that represents a rail or a part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailBox {
    /// Width, mm.
    pub width: f64,
    /// Depth, mm.
    pub depth: f64,
    /// Abscissa of its centre, mm.
    pub centre: f64,
}

/// The rail of the paper: 300 mm by 172 mm around x = 0.
impl Default for RailBox {
    fn default() -> Self {
        Self { width: 300.0, depth: 172.0, centre: 0.0 }
    }
}

impl RailBox {
    /// Abscissae of its two ends, mm.
    #[must_use]
    pub fn ends(self) -> (f64, f64) {
        (self.centre - 0.5 * self.width, self.centre + 0.5 * self.width)
    }
}
