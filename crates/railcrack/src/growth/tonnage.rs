//! Traffic, counted in axles or in million gross tonnes.

/// A unit in which traffic is counted.
pub trait Traffic: Copy {
    /// So much traffic.
    fn of(amount: f64) -> Self;

    /// The number of units.
    fn amount(self) -> f64;
}

/// Million gross tonnes.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Mgt(pub f64);

/// Axles, each of which is a load cycle.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Axles(pub f64);

impl Mgt {
    /// The axles of `tonnes` in the mean that weigh as much.
    #[must_use]
    pub fn axles(self, tonnes: f64) -> Axles {
        Axles(1e6 * self.0 / tonnes)
    }
}

impl Axles {
    /// Their weight, where they have `tonnes` in the mean.
    #[must_use]
    pub fn mgt(self, tonnes: f64) -> Mgt {
        Mgt(1e-6 * tonnes * self.0)
    }
}

impl Traffic for Mgt {
    fn of(amount: f64) -> Self {
        Self(amount)
    }

    fn amount(self) -> f64 {
        self.0
    }
}

impl Traffic for Axles {
    fn of(amount: f64) -> Self {
        Self(amount)
    }

    fn amount(self) -> f64 {
        self.0
    }
}
