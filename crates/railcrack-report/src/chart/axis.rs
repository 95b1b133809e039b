//! Axes of charts.

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChartScale {
    /// Evenly.
    #[default]
    Linear,
    /// By their logarithm; values ≤ 0 are left out.
    Logarithmic,
    /// Evenly, the y axis downwards.
    Depth,
}

/// Values that an axis covers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ChartRange {
    /// The values of the curves with a margin at both ends.
    #[default]
    Around,
    /// The values of the curves and zero, with a margin.
    AroundZero,
    /// Exactly the range of the curves.
    Tight,
    /// From the first to the second.
    Exact([f64; 2]),
}

/// An axis. Its label sets indices and powers: `K_{I}`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChartAxis {
    /// The quantity: `K_{I}`.
    pub label: String,
    /// Its unit: `MPa√m`; empty for a number without one.
    pub unit: String,
    /// Layout.
    pub scale: ChartScale,
    /// Values covered.
    pub range: ChartRange,
}

impl ChartAxis {
    /// A linear axis around the values.
    pub fn linear(label: &str, unit: &str) -> Self {
        Self { label: label.to_owned(), unit: unit.to_owned(), ..Self::default() }
    }

    /// A logarithmic axis around the values.
    pub fn logarithmic(label: &str, unit: &str) -> Self {
        Self { scale: ChartScale::Logarithmic, ..Self::linear(label, unit) }
    }

    /// Depth below the running surface, mm, downwards.
    pub fn depth() -> Self {
        Self { scale: ChartScale::Depth, ..Self::linear("Depth", "mm") }
    }

    /// The same axis over other values.
    #[must_use]
    pub fn over(self, range: ChartRange) -> Self {
        Self { range, ..self }
    }

    /// Label and unit: `K_{I} (MPa√m)`.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.label.clone() } else { format!("{} ({})", self.label, self.unit) }
    }
}
