//! Outlines of patches that are no ellipses.

/// Half the lengths of the strips of a patch, at even distances across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripOutline {
    /// y of the ends of the patch, mm.
    ends: [f64; 2],
    /// Squares of half the lengths, mm².
    squares: [f64; STRIPS],
}

/// Strips whose lengths are kept. Squares are linear in between: those of an ellipse are a
/// parabola, which this reproduces to 3e-4 of the longest.
const STRIPS: usize = 61;

impl StripOutline {
    /// The outline between `ends` (y, mm) with half the length (mm) that `half_length` gives at y.
    #[must_use]
    pub fn new(ends: [f64; 2], half_length: impl Fn(f64) -> f64) -> Self {
        let place = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / (STRIPS - 1) as f64;
        let mut squares = [0.0; STRIPS];
        squares.iter_mut().enumerate().for_each(|(i, square)| *square = half_length(place(i)).powi(2));
        Self { ends, squares }
    }

    /// y of the ends, mm.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Half the length of the strip at `y` (mm), mm; 0 outside.
    #[must_use]
    pub fn half_length(&self, y: f64) -> f64 {
        let place = (y - self.ends[0]) / (self.ends[1] - self.ends[0]) * (STRIPS - 1) as f64;
        if !(0.0..=(STRIPS - 1) as f64).contains(&place) {
            return 0.0;
        }
        let below = (place.floor() as usize).min(STRIPS - 2);
        let part = place - below as f64;
        ((1.0 - part) * self.squares[below] + part * self.squares[below + 1]).sqrt()
    }
}
