//! Spin against the radius of the wheel.

use super::loads::three_digits;
use super::usual::rounded;

/// Radius of the smallest wheels, mm, where it is not given.
const SMALLEST_RADIUS: f64 = 165.0;

/// The remark on a `spin` (1/mm) beyond one over the `radius` (mm), that of a contact angle of 90
/// degrees.
pub(super) fn too_much_spin(spin: f64, radius: Option<f64>) -> Option<String> {
    let limit = radius.unwrap_or(SMALLEST_RADIUS).recip();
    if spin.abs() <= limit {
        return None;
    }
    let of = radius
        .map_or_else(|| "of the smallest wheels".to_owned(), |radius| format!("of {} mm", rounded(radius)));
    let in_metres = (1e-3 * spin.abs() <= limit).then(|| {
        let spin = rounded(spin);
        format!("; {spin} 1/m = {} 1/mm?", rounded(1e-3 * spin.parse::<f64>().unwrap_or_default()))
    });
    Some(format!(
        "spin_per_mm = {} is beyond {} 1/mm, one over the radius {of}, which a vertical contact would have{}",
        rounded(spin),
        three_digits(limit),
        in_metres.unwrap_or_default()
    ))
}
