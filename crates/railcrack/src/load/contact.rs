//! Wheel–rail contact in any of its descriptions, and the gap that a wheel leaves over open cracks.

use super::contact_kind::{ContactKind, LineContact};
use super::{CarterContact, HertzianContact, TableContact, Temperature, Track};
use crate::math::OutOfRange;

/// Contact of wheel on rail.
#[derive(Debug, Clone, PartialEq)]
pub enum Contact {
    /// Hertzian pressure, and the shear of full sliding.
    Hertz(HertzianContact),
    /// Hertzian pressure, and the shear of partial slip.
    Carter(CarterContact),
    /// Pressure and shear of a table.
    Table(TableContact),
}

impl Contact {
    fn of_its_kind(&self) -> &dyn LineContact {
        match self {
            Self::Hertz(contact) => contact,
            Self::Carter(contact) => contact,
            Self::Table(contact) => contact,
        }
    }

    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> ContactKind {
        self.of_its_kind().kind()
    }

    /// Refuses a contact without pressure or extent, and shear beyond friction.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.of_its_kind().checked()
    }

    /// a, mm: half of the extent along the rail.
    pub fn half_width(&self) -> f64 {
        self.of_its_kind().half_extent()
    }

    /// The largest distance of the contact from x_c, mm.
    pub fn reach(&self) -> f64 {
        self.half_width() + self.middle().abs()
    }

    /// The largest pressure, MPa.
    pub fn peak_pressure(&self) -> f64 {
        self.of_its_kind().highest_pressure()
    }

    /// P′ = ∫ p du, N/mm.
    pub fn line_load(&self) -> f64 {
        self.of_its_kind().normal_force()
    }

    /// Q′/P′, positive where the wheel drags the rail along +x.
    pub fn adhesion(&self) -> f64 {
        self.of_its_kind().force_ratio()
    }

    /// The largest |q|/p: friction that slides somewhere.
    #[must_use]
    pub fn largest_friction(&self) -> f64 {
        self.of_its_kind().shear_ratio()
    }

    /// ∫ u q du with u from the middle of the contact, N: where its shear acts.
    #[must_use]
    pub fn shear_moment(&self) -> f64 {
        match self {
            Self::Hertz(_) => 0.0,
            Self::Carter(contact) => contact.shear_moment(),
            Self::Table(contact) => contact.shear_moment(),
        }
    }

    /// The middle of the contact, mm from x_c; other than 0 only for a table that is not centred on
    /// x_c.
    pub(crate) fn middle(&self) -> f64 {
        self.of_its_kind().offset()
    }

    /// The mirror image, which is the contact of a wheel that runs in the opposite direction.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        match self {
            Self::Hertz(contact) => Self::Hertz(contact.mirrored()),
            Self::Carter(contact) => Self::Carter(contact.mirrored()),
            Self::Table(contact) => Self::Table(contact.mirrored()),
        }
    }

    /// The Hertzian contact in full sliding; none for other contacts.
    pub fn sliding(&self) -> Option<&HertzianContact> {
        match self {
            Self::Hertz(contact) => Some(contact),
            _ => None,
        }
    }
}

impl From<HertzianContact> for Contact {
    fn from(contact: HertzianContact) -> Self {
        Self::Hertz(contact)
    }
}

/// The load of one wheel: its contact, the bending of the rail under the axles of its train, and
/// the temperature of the rail.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelLoad {
    /// Wheel on rail.
    pub contact: Contact,
    /// The track on which the rail bends; none for a rail without bending.
    pub track: Option<Track>,
    /// The temperature of a rail that cannot lengthen; none for a rail at its neutral temperature.
    pub temperature: Option<Temperature>,
}

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
pub fn uncoupled_gap(sinking: impl Fn(SurfacePart) -> f64) -> f64 {
    let followed = sinking(SurfacePart::WHOLE);
    let part = |ahead: f64| sinking(SurfacePart { ahead, share: SurfacePart::SHARE }) - followed;
    SurfacePart::all_ahead().map(part).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::{ContactRow, Travel};
    use super::*;

    #[test]
    fn three_descriptions_of_one_contact_agree() {
        let hertz = HertzianContact { peak_pressure: 800.0, half_width: 6.0, friction: -0.15 };
        let carter = CarterContact {
            peak_pressure: 800.0,
            half_width: 6.0,
            friction: 0.3,
            traction: -0.5,
            travel: Travel::Forward,
        };
        let row = |i: i32| {
            let u = 6.0 * f64::from(i) / 1000.0;
            let pressure = if i.abs() == 1000 { 0.0 } else { 800.0 * (1.0 - (u / 6.0).powi(2)).sqrt() };
            ContactRow { u, pressure, shear: -0.15 * pressure }
        };
        let table = TableContact::new((-1000..=1000).map(row).collect(), None).unwrap();
        let all = [Contact::Hertz(hertz), Contact::Carter(carter), Contact::Table(table)];
        for contact in &all {
            assert_eq!((contact.half_width(), contact.reach(), contact.peak_pressure()), (6.0, 6.0, 800.0));
            // The chords of an ellipse enclose less: (step)^(3/2).
            assert!((contact.line_load() / hertz.line_load() - 1.0).abs() < 2e-5, "{contact:?}");
            assert!((contact.adhesion() + 0.15).abs() < 1e-12);
            assert!(contact.check().is_ok());
        }
        assert_eq!(all.iter().filter_map(Contact::sliding).count(), 1);
    }

    #[test]
    fn a_surface_that_sinks_evenly_is_followed() {
        assert_eq!(uncoupled_gap(|_| 0.3), 0.0);
        // A sinking in proportion to the abscissa has no mean under a symmetric pressure.
        assert!((uncoupled_gap(|part| 0.1 * part.ahead) - 0.075).abs() < 1e-15);
    }
}
