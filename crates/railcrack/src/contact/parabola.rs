//! Parabolas of quantities along a load step.

/// c0 + c1 δ + c2 δ².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parabola {
    pub(super) c0: f64,
    pub(super) c1: f64,
    pub(super) c2: f64,
}

impl Parabola {
    /// The parabola of a quantity with the value `now` at share `share` of the step and the
    /// coefficients `first` and `second` of τ and τ²; δ is measured from `share`.
    pub(super) fn of(now: f64, first: f64, second: f64, share: f64) -> Self {
        Self { c0: now, c1: first + 2.0 * share * second, c2: second }
    }

    /// The parabola of a quantity with this present rate and second derivative.
    pub(super) fn along(now: f64, rate: f64, bend: f64) -> Self {
        Self { c0: now, c1: rate, c2: 0.5 * bend }
    }

    pub(super) fn constant(value: f64) -> Self {
        Self { c0: value, c1: 0.0, c2: 0.0 }
    }

    /// The value at δ = 0.
    pub(super) fn value(self) -> f64 {
        self.c0
    }

    /// The rate at δ = 0.
    pub(super) fn rate(self) -> f64 {
        self.c1
    }

    /// The second derivative.
    pub(super) fn bend(self) -> f64 {
        2.0 * self.c2
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Self { c0: factor * self.c0, c1: factor * self.c1, c2: factor * self.c2 }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self { c0: self.c0 + other.c0, c1: self.c1 + other.c1, c2: self.c2 + other.c2 }
    }

    /// The first δ < `span` at which the value falls by more than `small` below zero; a value below
    /// zero at δ = 0 counts as zero.
    pub(super) fn first_fall(self, small: f64, span: f64) -> Option<f64> {
        let Self { c0, c1, c2 } = self;
        let c0 = c0.max(0.0) + small;
        if c0 + span * (c1 + span * c2) >= 0.0 {
            // The parabola may fall below zero in between.
            let dips = c1 < 0.0 && c2 > 0.0 && -c1 < 2.0 * c2 * span && c1 * c1 > 4.0 * c2 * c0;
            if !dips {
                return None;
            }
        }
        let root = (c1 * c1 - 4.0 * c0 * c2).max(0.0).sqrt();
        let after = if c1 < 0.0 { 2.0 * c0 / (root - c1) } else { (c1 + root) / (-2.0 * c2) };
        (after < span).then_some(after)
    }

    /// The first δ < `span` at which the rate is below zero, if the value then falls by more than
    /// `small` in a step.
    pub(super) fn rate_falls(self, small: f64, span: f64) -> Option<f64> {
        let Self { c1, c2, .. } = self;
        if c1 < -small {
            return Some(0.0);
        }
        let rate_at_end = c1 + 2.0 * c2 * span;
        if rate_at_end >= -small {
            return None;
        }
        let after = (c1 + small) / (-2.0 * c2);
        (after < span).then_some(after)
    }
}
