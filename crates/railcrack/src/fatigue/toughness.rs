//! Fracture toughness of rail steels.

use super::{EquivalentRange, GrowthLaw, Paris, RateLaw};
use crate::math::OutOfRange;
use thiserror::Error;

/// K_Ic by temperature: linear between rows, constant beyond the first and the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Toughness {
    /// (temperature °C, K_Ic MPa√m), temperatures increasing.
    rows: Vec<(f64, f64)>,
}

/// An invalid toughness table.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ToughnessError {
    /// No rows.
    #[error("rows = 0: a toughness needs at least one")]
    Empty,
    /// A value outside its admissible range.
    #[error("row {row}: {reason}")]
    Row {
        /// Row, from 1.
        row: usize,
        /// The quantity, its value and its admissible range.
        reason: OutOfRange,
    },
}

impl Toughness {
    /// K_Ic = `toughness` (MPa√m) at all temperatures.
    pub fn constant(toughness: f64) -> Result<Self, OutOfRange> {
        OutOfRange::unless_positive("toughness_mpa_sqrt_m", toughness)?;
        Ok(Self { rows: vec![(0.0, toughness)] })
    }

    /// K_Ic of `rows` (temperature °C, K_Ic MPa√m).
    ///
    /// Errors: no rows; temperatures that do not increase; values that are not positive and finite.
    pub fn by_temperature(rows: Vec<(f64, f64)>) -> Result<Self, ToughnessError> {
        if rows.is_empty() {
            return Err(ToughnessError::Empty);
        }
        for (i, &(temperature, toughness)) in rows.iter().enumerate() {
            let before = if i == 0 { f64::NEG_INFINITY } else { rows[i - 1].0 };
            let increases = temperature > before && temperature.is_finite();
            OutOfRange::unless(
                increases,
                "temperature_c",
                temperature,
                "finite and greater than in the row before",
            )
            .and_then(|()| OutOfRange::unless_positive("toughness_mpa_sqrt_m", toughness))
            .map_err(|reason| ToughnessError::Row { row: i + 1, reason })?;
        }
        Ok(Self { rows })
    }

    /// K_Ic at `temperature` (°C), MPa√m.
    pub fn at(&self, temperature: f64) -> f64 {
        let next = self.rows.partition_point(|row| row.0 < temperature);
        match (next.checked_sub(1).map(|i| self.rows[i]), self.rows.get(next)) {
            (Some(before), Some(after)) => {
                before.1 + (after.1 - before.1) * (temperature - before.0) / (after.0 - before.0)
            }
            (Some(only), None) => only.1,
            (None, first) => first.map_or(f64::NAN, |first| first.1),
        }
    }
}

/// Requirements of EN 13674-1 on a rail steel, with its toughness at −20 °C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailSteel {
    /// The name of the steel in EN 13674-1.
    pub name: &'static str,
    /// Least single value of K_Ic, MPa√m.
    pub least_toughness: f64,
    /// Least mean of K_Ic, MPa√m.
    pub mean_toughness: f64,
    /// Typical 0.2 % proof stress, MPa; the standard does not specify one. R260: grades of 880 MPa
    /// have at least 460 MPa (catalogue of Indian rails). R350HT: 800 MPa are guaranteed of
    /// differentially hardened rails of 1180 MPa and 352 HB (category DTO350, NPP TEK).
    pub yield_stress: f64,
    /// Fatigue crack growth at ΔK = 10 and 13.5 MPa√m, R = 0.5, accepted at most, m per 1e9 cycles.
    pub accepted_growth: [f64; 2],
    /// Standard deviation of ln C from rail to rail: an estimate.
    pub c_log_std: f64,
}

/// The steels that are known by name. Source: EN 13674-1, K_Ic at −20 °C and growth at R = 0.5,
/// quoted from memory. Its rates correspond to an exponent of 3.91; the measurements behind the
/// requirements found a mean exponent close to 4 (European project SMT4-CT98-2240, summary in
/// CORDIS).
pub const RAIL_STEELS: &[RailSteel] = &[
    RailSteel {
        name: "R260",
        least_toughness: 26.0,
        mean_toughness: 29.0,
        yield_stress: 480.0,
        accepted_growth: [17.0, 55.0],
        c_log_std: 0.3,
    },
    RailSteel {
        name: "R350HT",
        least_toughness: 30.0,
        mean_toughness: 32.0,
        yield_stress: 800.0,
        accepted_growth: [17.0, 55.0],
        c_log_std: 0.3,
    },
];

/// ΔK (MPa√m) at which EN 13674-1 limits the growth, at R = 0.5.
pub const ACCEPTANCE_RANGES: [f64; 2] = [10.0, 13.5];

impl RailSteel {
    /// The steel whose toughness a rail is taken to have where neither that nor its steel is given:
    /// R260, the first of [`RAIL_STEELS`].
    pub const USUAL: &'static Self = &RAIL_STEELS[0];

    /// The steel called `name`, regardless of case.
    pub fn of(name: &str) -> Option<&'static Self> {
        RAIL_STEELS.iter().find(|steel| steel.name.eq_ignore_ascii_case(name.trim()))
    }

    /// Paris' law through the two largest accepted rates, with the equivalent range of the paper.
    /// It is an upper bound, since the standard limits the rate and measures it at R = 0.5.
    pub fn growth_law(&self) -> GrowthLaw {
        let [slow, fast] = self.accepted_growth.map(|metres| 1e-6 * metres);
        let [low, high] = ACCEPTANCE_RANGES;
        let m = (fast / slow).ln() / (high / low).ln();
        let rate = RateLaw::Paris(Paris { c: slow / low.powf(m), m, threshold: 0.0 });
        GrowthLaw { rate, equivalent: EquivalentRange::RAIL_STEEL, threshold_2: 0.0 }
    }

    /// The required mean K_Ic at −20 °C, used at all temperatures, which is conservative at higher
    /// ones.
    pub fn toughness(&self) -> Toughness {
        Toughness { rows: vec![(-20.0, self.mean_toughness)] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_between_rows_and_constant_beyond() {
        let table = Toughness::by_temperature(vec![(-40.0, 20.0), (0.0, 30.0), (20.0, 40.0)]).unwrap();
        assert_eq!(
            [-60.0, -40.0, -20.0, 0.0, 10.0, 50.0].map(|t| table.at(t)),
            [20., 20., 25., 30., 35., 40.]
        );
        assert_eq!(Toughness::constant(29.0).unwrap().at(-300.0), 29.0);
        assert_eq!(RailSteel::of("r260").unwrap().toughness().at(5.0), 29.0);
        assert!(RailSteel::of("R220").is_none());
    }

    #[test]
    fn the_law_of_a_steel_has_the_rates_that_are_accepted() {
        let law = RailSteel::of("R260").unwrap().growth_law().rate;
        // 17 m in 1e9 cycles.
        assert!((law.rate(10.0, 0.5) / 17e-6 - 1.0).abs() < 1e-12);
        assert!((law.rate(13.5, 0.5) / 55e-6 - 1.0).abs() < 1e-12);
        // The steel of the paper is within the limits.
        let paper = RateLaw::Paris(Paris::RAIL_STEEL);
        assert!(ACCEPTANCE_RANGES.iter().all(|&range| paper.rate(range, 0.5) < law.rate(range, 0.5)));
    }

    #[test]
    fn refused_with_row_and_value() {
        let message = |rows| Toughness::by_temperature(rows).unwrap_err().to_string();
        assert!(message(vec![]).starts_with("rows = 0"));
        assert!(
            message(vec![(0.0, 29.0), (0.0, 30.0)])
                .starts_with("row 2: temperature_c = 0: must be finite and")
        );
        assert!(message(vec![(0.0, -1.0)]).starts_with("row 1: toughness_mpa_sqrt_m = -1: must be positive"));
        assert!(Toughness::constant(0.0).is_err());
    }
}
