//! Shares of the wheels of a mix in growth.

use serde::{Deserialize, Serialize};

/// The largest number of wheels of a mix.
pub const MOST_WHEELS: usize = 32;

/// Shares of the wheels of a mix in the growth of a tip; empty where there is only one wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WheelShares {
    count: usize,
    values: [f64; MOST_WHEELS],
}

impl WheelShares {
    /// The shares of `rates` in their sum; zero where nothing grows.
    pub fn of(rates: &[f64]) -> Self {
        let mut shares = Self { count: rates.len().min(MOST_WHEELS), ..Self::default() };
        let sum: f64 = rates.iter().sum();
        for (share, rate) in shares.values.iter_mut().zip(rates) {
            *share = if sum > 0.0 { rate / sum } else { 0.0 };
        }
        shares
    }

    /// The shares `values`, as stored.
    pub fn from_values(values: &[f64]) -> Self {
        let mut shares = Self { count: values.len().min(MOST_WHEELS), ..Self::default() };
        shares.values.iter_mut().zip(values).for_each(|(share, value)| *share = *value);
        shares
    }

    /// The shares, one per wheel.
    pub fn values(&self) -> &[f64] {
        &self.values[..self.count]
    }
}
