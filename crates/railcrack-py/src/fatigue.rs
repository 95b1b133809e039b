//! Fatigue criteria evaluated on histories.

use crate::errors::bad_input;
use crate::judge::history_of;
use crate::limits;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use railcrack::fatigue::{
    DirectionCriterion, EquivalentRange, GrowthLaw, HourlierPineau, KinkFunctions, Paris, RateLaw,
};
use railcrack::math::MPA_SQRT_MM;
use railcrack::words::Choice;

/// Angle (degrees), rate (mm per cycle), Δk1 and Δk2 (MPa√m) of the kink, and angle and ratio of
/// the best secondary maximum.
type FoundKink = (f64, f64, f64, f64, Option<(f64, f64)>);

/// The kink of the criterion for a history of K_I and K_II (MPa√m), shape (samples, 2);
/// `thresholds` of ΔK_eq and of ΔK_II, MPa√m.
#[pyfunction]
#[pyo3(signature = (history, *, c, m, mode_2_weight, thresholds, criterion, kink_friction))]
pub fn hourlier_pineau(
    py: Python<'_>,
    history: PyReadonlyArray2<'_, f64>,
    c: f64,
    m: f64,
    mode_2_weight: f64,
    thresholds: (f64, f64),
    criterion: &str,
    kink_friction: f64,
) -> PyResult<Option<FoundKink>> {
    let Some(criterion) = DirectionCriterion::of_word(criterion) else {
        let accepted = DirectionCriterion::accepted();
        return Err(bad_input(py, format!("criterion \"{criterion}\": must be {accepted}")));
    };
    let (threshold, threshold_2) = thresholds;
    for (name, value, key) in [
        ("c", c, "paris_c"),
        ("m", m, "paris_m"),
        ("mode_2_weight", mode_2_weight, "mode_2_weight"),
        ("threshold_mpa_sqrt_m", threshold, "threshold_mpa_sqrt_m"),
        ("threshold_2_mpa_sqrt_m", threshold_2, "threshold_2_mpa_sqrt_m"),
        ("kink_friction", kink_friction, "kink_friction"),
    ] {
        limits::number(py, name, value, ("growth", key))?;
    }
    let law = GrowthLaw {
        rate: RateLaw::Paris(Paris { c, m, threshold }),
        equivalent: EquivalentRange::HourlierPineau { mode_2_weight },
        threshold_2,
    };
    limits::finite(py, "history", history.as_array().iter().copied())?;
    let history = history_of(&history)?;
    let kink = py.detach(|| HourlierPineau { law, criterion, kink_friction }.kink(&history));
    Ok(kink.map(|kink| {
        let secondary = kink.secondary.map(|other| (other.angle.to_degrees(), other.ratio));
        let (k1, k2) = (kink.delta_k1 / MPA_SQRT_MM, kink.delta_k2 / MPA_SQRT_MM);
        (kink.angle.to_degrees(), kink.rate, k1, k2, secondary)
    }))
}

/// F11, F12, F21 and F22 at a kink `angle`, degrees.
#[pyfunction]
pub fn kink_functions(py: Python<'_>, angle: f64) -> PyResult<[[f64; 2]; 2]> {
    if angle.is_nan() || angle.abs() > 180.0 {
        return Err(bad_input(py, format!("angle_deg = {angle}: must be a number in [-180, 180] degrees")));
    }
    let KinkFunctions { f11, f12, f21, f22 } = KinkFunctions::at(angle.to_radians());
    Ok([[f11, f12], [f21, f22]])
}
