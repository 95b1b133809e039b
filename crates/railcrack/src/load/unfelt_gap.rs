//! The gap between wheel and rail that a contact leaves over cracks which it does not feel.

/// A part of the running surface under a contact, over which its sinking is averaged with the
/// weight of a pressure of Hertz.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePart {
    /// Abscissa of its middle beyond x_c, over a.
    pub ahead: f64,
    /// Its semi-axes over those of the contact.
    pub share: f64,
}

impl SurfacePart {
    /// The whole contact.
    pub const WHOLE: Self = Self { ahead: 0.0, share: 1.0 };
    /// Share of the parts that are compared with the whole. Each overlaps the next by a half.
    pub const SHARE: f64 = 0.25;
    /// Distance of the middles of neighbouring parts, over a.
    pub const SPACING: f64 = Self::SHARE;

    /// The middles of the parts that are compared with the whole, over a beyond x_c.
    pub fn all_ahead() -> impl Iterator<Item = f64> {
        (0..PARTS).map(|k| Self::SPACING * (k as f64 - 0.5 * (PARTS - 1) as f64))
    }
}

/// Number of the parts.
const PARTS: usize = 7;

/// The largest gap (mm) that opens between wheel and rail over cracks, to first order.
///
/// The jumps of cracks under the contact on the uncracked rail lower the surface by `sinking` (mm,
/// the mean over a part). The wheel follows its mean under the contact pressure, since the approach
/// is the derivative of the energy with respect to the load. A part of the surface that sinks
/// farther leaves the wheel by the difference, as long as the pressure stays as it is.
pub fn unfelt_gap(sinking: impl Fn(SurfacePart) -> f64) -> f64 {
    let followed = sinking(SurfacePart::WHOLE);
    let part = |ahead: f64| sinking(SurfacePart { ahead, share: SurfacePart::SHARE }) - followed;
    SurfacePart::all_ahead().map(part).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_that_sinks_evenly_is_followed() {
        assert_eq!(unfelt_gap(|_| 0.3), 0.0);
        // A sinking in proportion to the abscissa has no mean under a symmetric pressure.
        assert!((unfelt_gap(|part| 0.1 * part.ahead) - 0.075).abs() < 1e-15);
    }
}
