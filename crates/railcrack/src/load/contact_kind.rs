//! Kinds of contact of wheel and rail, and what each of them has to say.

use crate::math::OutOfRange;
use crate::words::{Choice, Word};

/// A kind of contact of wheel and rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactKind {
    /// [`HertzianContact`](super::HertzianContact).
    Hertz,
    /// [`CarterContact`](super::CarterContact).
    Carter,
    /// [`TableContact`](super::TableContact).
    Table,
    /// A strip of [`RollingPatch`](crate::rolling::RollingPatch).
    Rolling,
}

impl Choice for ContactKind {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Hertz,
            Word::now(
                "hertz",
                "pressure p0 sqrt(1 - (x - xc)^2 / a^2) and a shear proportional to it: full sliding",
            ),
        ),
        (
            Self::Carter,
            Word::now(
                "carter",
                "the same pressure in partial slip, with a stick zone behind the leading edge",
            ),
        ),
        (Self::Table, Word::now("table", "pressure and shear from a table, measured or computed")),
        (
            Self::Rolling,
            Word::now("rolling", "a Hertz ellipse in rolling contact, from normal force, creepages and spin"),
        ),
    ];
}

impl ContactKind {
    /// Pressure and shear, in words: of a patch, or of a strip of it as a line contact.
    #[must_use]
    pub fn described(self, is_patch: bool) -> &'static str {
        match (self, is_patch) {
            (Self::Hertz, false) => "Hertzian line contact in full sliding",
            (Self::Hertz, true) => "Hertz ellipse in full sliding",
            (Self::Carter, false) => "Hertzian line contact in partial slip (Carter)",
            (Self::Carter, true) => "Hertz ellipse in partial slip, strip by strip (Carter)",
            (Self::Table, _) => "contact from a table",
            (Self::Rolling, false) => "strip of a patch in rolling contact",
            (Self::Rolling, true) => "patch in rolling contact",
        }
    }
}

/// A contact of one kind.
pub(super) trait LineContact {
    /// Its kind.
    fn kind(&self) -> ContactKind;

    /// Refuses a contact without pressure or extent, and shear beyond friction.
    fn checked(&self) -> Result<(), OutOfRange>;

    /// The largest pressure, MPa.
    fn highest_pressure(&self) -> f64;

    /// a, mm: half of the extent along the rail.
    fn half_extent(&self) -> f64;

    /// The middle of the contact, mm from x_c.
    fn offset(&self) -> f64 {
        0.0
    }

    /// P′ = ∫ p du, N/mm.
    fn normal_force(&self) -> f64;

    /// Q′/P′.
    fn force_ratio(&self) -> f64;

    /// The largest |q|/p.
    fn shear_ratio(&self) -> f64;
}
