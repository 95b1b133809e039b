//! A patch in rolling contact: its outline, its strips and its place on the rail.

use super::{Creepage, KalkerCoefficients, RollingTheory};
use crate::load::{Contact, ContactRow, HertzEllipse, TableContact, Travel};
use crate::material::IsotropicElastic;
use crate::math::OutOfRange;
use std::f64::consts::PI;
use thiserror::Error;

/// A Hertz ellipse, or a patch that is compared with one, on which a wheel rolls with creepage. x
/// runs with the travel, y across; tractions and forces act on the rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingPatch {
    /// Pressure and semi-axes: a along the rail, b across. With an outline, p0 and a are those of
    /// the longest strip, and b gives the normal force; Kalker's coefficients are those of a/b.
    pub ellipse: HertzEllipse,
    /// Lengths of the strips where the patch is no ellipse; their pressure is p0/a √(a_y² − x²).
    pub outline: Option<StripOutline>,
    /// μ, not negative.
    pub friction: f64,
    /// ξ, η, φ.
    pub creepage: Creepage,
    /// Elasticity of wheel and rail.
    pub steel: IsotropicElastic,
    /// The theory of the shear.
    pub theory: RollingTheory,
}

/// A patch that cannot roll as described.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PatchError {
    /// A number out of range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// Creepage without friction.
    #[error(
        "friction = 0 with creepage: creepage without friction gives no force; friction must be positive"
    )]
    NoFriction,
    /// More force than friction allows.
    #[error(
        "the linear theory gives {ratio:.3} times the friction force: it holds for small creepage only; \
         use theory = \"fastrip\" or \"fastsim\""
    )]
    Saturated {
        /// |F|/(μN).
        ratio: f64,
    },
}

/// Flexibilities of the simplified theory, mm³/N.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flexibilities {
    pub l1: f64,
    pub l2: f64,
    pub l3: f64,
}

impl RollingPatch {
    /// Rejects a patch without extent or pressure, a negative friction, creepage without friction,
    /// and with the linear theory more force than friction allows.
    pub fn check(&self) -> Result<(), PatchError> {
        OutOfRange::unless_positive("peak pressure p0 (MPa)", self.ellipse.peak_pressure)?;
        OutOfRange::unless_positive("semi-axis a of the patch (mm)", self.ellipse.along)?;
        OutOfRange::unless_positive("semi-axis b of the patch (mm)", self.ellipse.across)?;
        let fine = self.friction >= 0.0 && self.friction.is_finite();
        OutOfRange::unless(fine, "wheel\u{2013}rail friction", self.friction, "zero or more")?;
        self.creepage.check()?;
        if self.friction == 0.0 && !self.creepage.is_none() {
            return Err(PatchError::NoFriction);
        }
        if self.theory == RollingTheory::Linear && !self.creepage.is_none() {
            let [along, across] = self.linear_force();
            let ratio = along.hypot(across) / (self.friction * self.normal_force());
            if ratio > 1.0 {
                return Err(PatchError::Saturated { ratio });
            }
        }
        Ok(())
    }

    /// N = 2π a b p0/3, N.
    #[must_use]
    pub fn normal_force(&self) -> f64 {
        self.ellipse.load()
    }

    /// Kalker's coefficients of the ellipse.
    #[must_use]
    pub fn coefficients(&self) -> KalkerCoefficients {
        KalkerCoefficients::of(self.ellipse.along / self.ellipse.across, self.steel.poisson())
    }

    /// F_x and F_y (N) of the linear theory: −G c² C11 ξ and −G c² (C22 η + c C23 φ), c² = a b.
    #[must_use]
    pub fn linear_force(&self) -> [f64; 2] {
        let KalkerCoefficients { c11, c22, c23 } = self.coefficients();
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let area = self.ellipse.along * self.ellipse.across;
        let stiffness = self.steel.shear_modulus() * area;
        [-stiffness * c11 * longitudinal, -stiffness * (c22 * lateral + area.sqrt() * c23 * spin)]
    }

    /// φ′ = −3GcC23φ/(2πμp0), c² = a b: the spin of strip theory, which at |φ′| = 1 alone brings
    /// the shear to its limit.
    pub(super) fn relative_spin(&self) -> f64 {
        let (size, limit) =
            ((self.ellipse.along * self.ellipse.across).sqrt(), self.friction * self.ellipse.peak_pressure);
        -3.0 * self.steel.shear_modulus() * size * self.coefficients().c23 * self.creepage.spin
            / (2.0 * PI * limit)
    }

    /// The mirror image across the rail: of the other rail under the same vehicle.
    #[must_use]
    pub fn mirrored_across(&self) -> Self {
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let outline = self.outline.map(|own| {
            let [from, to] = own.ends();
            StripOutline::new([-to, -from], |y| own.half_length(-y))
        });
        Self { creepage: Creepage { longitudinal, lateral: -lateral, spin: -spin }, outline, ..*self }
    }

    /// y of the ends of the patch, mm.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        self.outline.map_or([-self.ellipse.across, self.ellipse.across], |outline| outline.ends())
    }

    /// a_y = a √(1 − (y/b)²), or that of the outline, mm: half the length of the strip at `y` (mm);
    /// 0 outside.
    #[must_use]
    pub fn half_length(&self, y: f64) -> f64 {
        if let Some(outline) = &self.outline {
            return outline.half_length(y);
        }
        let t = y / self.ellipse.across;
        self.ellipse.along * ((1.0 - t) * (1.0 + t)).max(0.0).sqrt()
    }

    /// L1 = 8a/(3GC11), L2 = 8a/(3GC22), L3 = πa√(a/b)/(4GC23) (Kalker 1982).
    pub(super) fn flexibilities(&self) -> Flexibilities {
        let KalkerCoefficients { c11, c22, c23 } = self.coefficients();
        let (a, b, shear) = (self.ellipse.along, self.ellipse.across, self.steel.shear_modulus());
        let l3 = PI * a * (a / b).sqrt() / (4.0 * shear * c23);
        Flexibilities { l1: 8.0 * a / (3.0 * shear * c11), l2: 8.0 * a / (3.0 * shear * c22), l3 }
    }
}

/// Half the lengths of the strips of a patch, at even distances across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripOutline {
    /// y of the ends of the patch, mm.
    ends: [f64; 2],
    /// Squares of half the lengths, mm².
    squares: [f64; STRIPS],
}

/// Strips whose lengths are kept. Squares are linear in between: those of an ellipse are a
/// parabola, which this reproduces to 3e-4 of the longest.
const STRIPS: usize = 61;

impl StripOutline {
    /// The outline between `ends` (y, mm) with half the length (mm) that `half_length` gives at y.
    #[must_use]
    pub fn new(ends: [f64; 2], half_length: impl Fn(f64) -> f64) -> Self {
        let place = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / (STRIPS - 1) as f64;
        let mut squares = [0.0; STRIPS];
        squares.iter_mut().enumerate().for_each(|(i, square)| *square = half_length(place(i)).powi(2));
        Self { ends, squares }
    }

    /// y of the ends, mm.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Half the length of the strip at `y` (mm), mm; 0 outside.
    #[must_use]
    pub fn half_length(&self, y: f64) -> f64 {
        let place = (y - self.ends[0]) / (self.ends[1] - self.ends[0]) * (STRIPS - 1) as f64;
        if !(0.0..=(STRIPS - 1) as f64).contains(&place) {
            return 0.0;
        }
        let below = (place.floor() as usize).min(STRIPS - 2);
        let part = place - below as f64;
        ((1.0 - part) * self.squares[below] + part * self.squares[below + 1]).sqrt()
    }
}

/// A patch, and where a crack lies in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedPatch {
    /// The patch.
    pub patch: RollingPatch,
    /// y of the crack in the patch, mm.
    pub y: f64,
    /// x of the middle of the patch from the wheel's centre, with the travel, mm.
    pub x: f64,
}

/// Intervals of each strip where several are added.
const INTERVALS: usize = 160;

impl PlacedPatch {
    /// The load of all `patches` of a wheel that runs towards `travel` over a crack: one contact,
    /// whose centre is that of the wheel; of a single patch, the middle of the patch. None where
    /// the patches miss the crack.
    #[must_use]
    pub fn plane_contact(patches: &[Self], travel: Travel) -> Option<Contact> {
        let over: Vec<&Self> = patches.iter().filter(|own| own.patch.half_length(own.y) > 0.0).collect();
        match over[..] {
            [] => None,
            [one] => one.patch.plane_contact(one.y, travel).ok(),
            _ => Self::sum(&over, travel),
        }
    }

    /// Strips added between all their points, in which each is linear.
    fn sum(patches: &[&Self], travel: Travel) -> Option<Contact> {
        let strip = |own: &&Self| {
            let rows = own.patch.strip(own.y, INTERVALS).ok()?.table()?;
            let shifted = |row: &ContactRow| ContactRow { u: row.u + own.x, ..*row };
            Some(rows.rows().iter().map(shifted).collect::<Vec<_>>())
        };
        let strips: Vec<Vec<ContactRow>> = patches.iter().map(strip).collect::<Option<_>>()?;
        let mut places: Vec<f64> = strips.iter().flatten().map(|row| row.u).collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|next, before| *next - *before < 1e-9);
        let row = |&u: &f64| {
            let all = strips.iter().map(|strip| at(strip, u));
            let (pressure, shear) = all.fold((0.0, 0.0), |sum, own| (sum.0 + own.0, sum.1 + own.1));
            ContactRow { u, pressure, shear }
        };
        let mut rows: Vec<ContactRow> = places.iter().map(row).collect();
        // The outermost points carry nothing but what rounding of their places leaves.
        let last = rows.len() - 1;
        for end in [0, last] {
            (rows[end].pressure, rows[end].shear) = (0.0, 0.0);
        }
        let sum = Contact::Table(TableContact::new(rows, None).ok()?);
        Some(match travel {
            Travel::Forward => sum,
            Travel::Backward => sum.mirrored(),
        })
    }
}

/// Pressure and shear of a strip at `u`, linear between its rows.
fn at(strip: &[ContactRow], u: f64) -> (f64, f64) {
    let next = strip.partition_point(|row| row.u < u);
    let (Some(b), true) = (strip.get(next), next > 0 || strip.first().is_some_and(|row| row.u == u)) else {
        return (0.0, 0.0);
    };
    let a = strip[next.saturating_sub(1)];
    let part = if b.u > a.u { (u - a.u) / (b.u - a.u) } else { 1.0 };
    (a.pressure + part * (b.pressure - a.pressure), a.shear + part * (b.shear - a.shear))
}
