//! A strip of a patch along the rail: pressure, shear, stick and slip.

use super::patch::Flexibilities;
use super::{Creepage, KalkerCoefficients, RollingPatch, RollingTheory};
use crate::load::{CarterContact, Contact, ContactRow, HertzianContact, TableContact, Travel};
use crate::math::OutOfRange;
use std::f64::consts::PI;

/// Traction on the rail at one point of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripPoint {
    /// x from the middle of the patch, with the travel, mm.
    pub x: f64,
    /// p, MPa.
    pub pressure: f64,
    /// q_x and q_y on the rail, MPa.
    pub shear: [f64; 2],
    /// Whether wheel and rail slip.
    pub slips: bool,
}

/// A strip along the rail.
#[derive(Debug, Clone, PartialEq)]
pub struct RollingStrip {
    /// Its distance from the middle of the patch, mm.
    pub y: f64,
    /// Half its length, mm.
    pub half_length: f64,
    /// Its points x = a_y cos θ at even distances of θ, from the leading edge to the trailing one,
    /// both without traction.
    pub points: Vec<StripPoint>,
    /// Shear whose integral is the force of the theory, MPa: in FASTSIM that within the parabola.
    pub(super) balanced: Vec<[f64; 2]>,
}

/// Points of a strip that loads the plane: the tabulated half-ellipse has 2e-4 less load.
const POINTS: usize = 160;

/// Steps of FASTSIM between two points of a strip.
const SUBSTEPS: usize = 4;

impl RollingPatch {
    /// The strip at `y` (mm) in `intervals` intervals, an even number from 2.
    ///
    /// Errors: [`RollingPatch::check`] finds none; a strip outside the patch.
    pub fn strip(&self, y: f64, intervals: usize) -> Result<RollingStrip, OutOfRange> {
        let bound = StripBound::of(self, y);
        let inside = bound.half_length > 0.0;
        OutOfRange::unless(inside, "lateral offset (mm)", y, "inside of the contact patch")?;
        let intervals = intervals.max(2).next_multiple_of(2);
        let a = bound.half_length;
        let peak = self.ellipse.peak_pressure;
        let pressure = |x: f64| peak / self.ellipse.along * ((a - x) * (a + x)).max(0.0).sqrt();
        let edge = |x: f64| StripPoint { x, pressure: 0.0, shear: [0.0; 2], slips: true };
        let mut points = vec![edge(a)];
        let mut balanced = vec![[0.0; 2]];
        let slipless = self.creepage.is_none();
        let ratio = self.linear_force().map(|force| force / self.normal_force());
        let stick = (!slipless).then(|| StickZone::of(self, y)).flatten();
        let mut fastsim = FastsimStrip::entering(self, y);
        let place = |i: usize| a * (PI * i as f64 / (SUBSTEPS * intervals) as f64).cos();
        let mut before = a;
        for i in 1..intervals {
            for step in SUBSTEPS * (i - 1) + 1..=SUBSTEPS * i {
                let x = place(step);
                fastsim.advance(x, 0.5 * (before + x), before - x, &bound);
                before = x;
            }
            let x = if 2 * i == intervals { 0.0 } else { place(SUBSTEPS * i) };
            let limit = bound.elliptic(x);
            let sliding = || fastsim.direction(x).map(|part| limit * part);
            let (shear, slips, force) = match self.theory {
                _ if slipless => ([0.0; 2], false, [0.0; 2]),
                RollingTheory::Linear => {
                    let shear = ratio.map(|ratio| ratio * pressure(x));
                    (shear, false, shear)
                }
                RollingTheory::Fastsim if fastsim.slips => (sliding(), true, fastsim.shear),
                RollingTheory::Fastsim => {
                    // Where the parabola exceeds μp, it is the limit of what is given out.
                    let size = fastsim.shear[0].hypot(fastsim.shear[1]);
                    let shear = if size > limit { sliding() } else { fastsim.shear };
                    (shear, false, fastsim.shear)
                }
                RollingTheory::FaStrip | RollingTheory::Strip => match stick.filter(|zone| zone.holds(x)) {
                    Some(zone) => (zone.shear(x), false, zone.shear(x)),
                    None => (sliding(), true, sliding()),
                },
            };
            points.push(StripPoint { x, pressure: pressure(x), shear, slips });
            balanced.push(force);
        }
        points.push(edge(-a));
        balanced.push([0.0; 2]);
        Ok(RollingStrip { y, half_length: a, points, balanced })
    }

    /// The load of the strip at `y` (mm) in the plane, of a wheel that runs towards `travel`: two
    /// half-ellipses where its shear is of that form, otherwise a table.
    ///
    /// Errors: a strip outside the patch.
    pub fn plane_contact(&self, y: f64, travel: Travel) -> Result<Contact, OutOfRange> {
        let forward = self.forward_contact(y)?;
        Ok(match travel {
            Travel::Forward => forward,
            Travel::Backward => forward.mirrored(),
        })
    }

    /// The pressure of the strip at `y` (mm), without shear.
    fn line_contact(&self, y: f64) -> Result<HertzianContact, OutOfRange> {
        if self.outline.is_none() {
            return self.ellipse.strip(y, 0.0);
        }
        let half_width = self.half_length(y);
        OutOfRange::unless(half_width > 0.0, "lateral offset (mm)", y, "inside of the contact patch")?;
        let peak_pressure = self.ellipse.peak_pressure * half_width / self.ellipse.along;
        Ok(HertzianContact { peak_pressure, half_width, friction: 0.0 })
    }

    fn forward_contact(&self, y: f64) -> Result<Contact, OutOfRange> {
        let hertz = self.line_contact(y)?;
        let sliding = |friction: f64| Contact::Hertz(HertzianContact { friction, ..hertz });
        if self.theory == RollingTheory::Linear {
            return Ok(sliding(self.linear_force()[0] / self.normal_force()));
        }
        let along = self.creepage.longitudinal;
        if self.creepage.spin == 0.0 && (along == 0.0 || self.friction == 0.0) {
            return Ok(sliding(0.0));
        }
        let only_along = self.creepage.lateral == 0.0 && self.creepage.spin == 0.0;
        if only_along && matches!(self.theory, RollingTheory::FaStrip | RollingTheory::Strip) {
            let Some(zone) = StickZone::of(self, y) else {
                return Ok(sliding(-self.friction.copysign(along)));
            };
            let stick = zone.half_length / hertz.half_width;
            return Ok(Contact::Carter(CarterContact {
                peak_pressure: hertz.peak_pressure,
                half_width: hertz.half_width,
                friction: self.friction,
                traction: -(1.0 - stick * stick).copysign(along),
                travel: Travel::Forward,
            }));
        }
        Ok(self.strip(y, POINTS)?.table().map_or(sliding(0.0), Contact::Table))
    }
}

impl RollingStrip {
    /// Pressure and shear along the rail as a table; none without pressure.
    #[must_use]
    pub fn table(&self) -> Option<TableContact> {
        let row =
            |point: &StripPoint| ContactRow { u: point.x, pressure: point.pressure, shear: point.shear[0] };
        TableContact::new(self.points.iter().rev().map(row).collect(), None).ok()
    }
}

/// The stick zone of one strip, which touches the leading edge.
///
/// With ξ′ = −2(1−ν)GC11ξ/(π²μp0), η′ = −2(1−ν)GC22η/(π²μp0), φ′ = −3GcC23φ/(2πμp0),
/// k = ξ′ − φ′y/a, and a_y half the length of the strip:
///
/// d = a/(1−ν) (η′² + k²)/(√(η′² + (1−φ′²)k²) − η′φ′),
///
/// and in the stick zone, d ± (a_y − d), the shear
///
/// q_x = μp0/a κ (e_1 − e_2),  q_y = μp0/a [λ e_1 − (λ − φ′) e_2],
/// e_1 = √(a_y² − x²),  e_2 = √((a_y−d)² − (x−d)²),
///
/// with a unit vector (κ, λ) along (k, η′ + φ′f d/a), so that the shear reaches μp where the stick
/// zone ends; for small creepage its force is that of the linear theory. FaStrip as published has
/// f = 1. Kalker's strip theory has f = 1 − ν: only then is d what makes the vector a unit one, and
/// wheel and rail do not slip in the stick zone.
/// Without a real root, with d > a_y or a denominator that is not positive the whole strip slips;
/// the direction of slip is that of FASTSIM. The denominator, not the numerator of the quadratic
/// formula, remains regular at |φ′| = 1.
///
/// Source: Kalker 1967, Int. J. Mech. Sci. 9; Sichani, Enblom, Berg 2016, Vehicle System Dynamics
/// 54, 748–764.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StickZone {
    /// d, mm: x of its middle, half the length of the slip zone.
    pub middle: f64,
    /// a_y − d, mm.
    pub half_length: f64,
    /// a_y, mm.
    strip: f64,
    /// μp0/a, N/mm³.
    scale: f64,
    /// κ, λ of the strip and κ′, λ′ of the stick zone.
    pub(super) outer: [f64; 2],
    pub(super) inner: [f64; 2],
}

impl StickZone {
    /// The stick zone of the strip at `y` (mm) of `patch`; none where the whole strip slips, or the
    /// theory of the patch knows no strips.
    pub fn of(patch: &RollingPatch, y: f64) -> Option<Self> {
        let poisson = patch.steel.poisson();
        let share = match patch.theory {
            RollingTheory::FaStrip => 1.0,
            RollingTheory::Strip => 1.0 - poisson,
            RollingTheory::Fastsim | RollingTheory::Linear => return None,
        };
        let KalkerCoefficients { c11, c22, c23 } = patch.coefficients();
        let Creepage { longitudinal, lateral, spin } = patch.creepage;
        let (a, b) = (patch.ellipse.along, patch.ellipse.across);
        let limit = patch.friction * patch.ellipse.peak_pressure;
        let (shear, rigid) = (patch.steel.shear_modulus(), 1.0 - poisson);
        let creep = -2.0 * rigid * shear / (PI * PI * limit);
        let eta = creep * c22 * lateral;
        let phi = -3.0 * shear * (a * b).sqrt() * c23 * spin / (2.0 * PI * limit);
        let k = creep * c11 * longitudinal - phi * y / a;
        let strip = patch.half_length(y);
        let square = eta * eta + (1.0 - phi * phi) * k * k;
        if square < 0.0 {
            return None;
        }
        let (over, under) = (eta * eta + k * k, square.sqrt() - eta * phi);
        let zone = |middle: f64, [kappa, lambda]: [f64; 2]| Self {
            middle,
            half_length: strip - middle,
            strip,
            scale: limit / a,
            outer: [kappa, lambda],
            inner: [kappa, lambda - phi],
        };
        if over == 0.0 {
            // Spin alone, on the middle strip: its shear changes sign and reaches no limit.
            return (phi.abs() < 1.0).then(|| zone(0.0, [0.0, phi]));
        }
        if under <= 0.0 {
            return None;
        }
        let middle = a / rigid * over / under;
        let [along, across] = [k, eta + phi * share * middle / a];
        let size = along.hypot(across);
        (middle < strip && size > 0.0).then(|| zone(middle, [along / size, across / size]))
    }

    /// Whether wheel and rail stick at `x`, mm.
    pub fn holds(&self, x: f64) -> bool {
        x > self.middle - self.half_length
    }

    /// q_x and q_y at `x` (mm) in the stick zone, MPa.
    pub fn shear(&self, x: f64) -> [f64; 2] {
        let outer = ((self.strip - x) * (self.strip + x)).max(0.0).sqrt();
        let from = x - self.middle;
        let inner = ((self.half_length - from) * (self.half_length + from)).max(0.0).sqrt();
        [0, 1].map(|i| self.scale * (self.outer[i] * outer - self.inner[i] * inner))
    }
}

/// The shear of a strip, followed from its leading edge backwards.
///
/// Displacements are proportional to the shear at the same point, u = L q. Where wheel and rail
/// stick, dq_x/dx = ξ/L1 − φ y/L3 and dq_y/dx = η/L2 + φ x/L3. Where |q| would exceed the limit
/// they slip, and q keeps its direction at the limit, μ times the parabola 2N/(πab)(1 − (x/a)² −
/// (y/b)²).
///
/// Source: Kalker 1982, Vehicle System Dynamics 11, 1–13.
#[derive(Debug, Clone, Copy)]
pub(super) struct FastsimStrip {
    creepage: Creepage,
    flexibilities: Flexibilities,
    y: f64,
    /// q_x, q_y, MPa.
    pub shear: [f64; 2],
    /// Whether wheel and rail slip.
    pub slips: bool,
}

impl FastsimStrip {
    /// The leading edge of the strip at `y` (mm), without shear.
    pub fn entering(patch: &RollingPatch, y: f64) -> Self {
        Self {
            creepage: patch.creepage,
            flexibilities: patch.flexibilities(),
            y,
            shear: [0.0; 2],
            slips: false,
        }
    }

    /// A step of the length `step` (mm) to `x`, over which the spin acts at `at`.
    pub fn advance(&mut self, x: f64, at: f64, step: f64, bound: &StripBound) {
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let Flexibilities { l1, l2, l3 } = self.flexibilities;
        let shear = [
            self.shear[0] - step * (longitudinal / l1 - spin * self.y / l3),
            self.shear[1] - step * (lateral / l2 + spin * at / l3),
        ];
        let (size, limit) = (shear[0].hypot(shear[1]), bound.parabolic(x));
        self.slips = size > limit;
        self.shear = if self.slips { shear.map(|q| q * limit / size) } else { shear };
    }

    /// The unit vector along the shear; that against the rigid slip where there is none.
    pub fn direction(&self, x: f64) -> [f64; 2] {
        let unit = |[x, y]: [f64; 2]| {
            let size = x.hypot(y);
            if size > 0.0 { [x / size, y / size] } else { [0.0; 2] }
        };
        if self.shear != [0.0; 2] {
            return unit(self.shear);
        }
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        unit([spin * self.y - longitudinal, -lateral - spin * x])
    }
}

/// Limits of the shear along the strip at y, u from its middle: μp of Hertz, and the parabola of
/// the same normal force.
#[derive(Debug, Clone, Copy)]
pub(super) struct StripBound {
    /// Half the length of the strip, mm.
    pub half_length: f64,
    along: f64,
    /// μ p0, MPa.
    limit: f64,
}

/// Peak of the parabola over that of the ellipse, at equal normal force.
const PARABOLIC_PEAK: f64 = 4.0 / 3.0;

impl StripBound {
    pub fn of(patch: &RollingPatch, y: f64) -> Self {
        Self {
            half_length: patch.half_length(y),
            along: patch.ellipse.along,
            limit: patch.friction * patch.ellipse.peak_pressure,
        }
    }

    /// μp at `x`, MPa.
    pub fn elliptic(&self, x: f64) -> f64 {
        self.limit * self.square(x).max(0.0).sqrt()
    }

    /// The parabola at `x`, MPa.
    pub fn parabolic(&self, x: f64) -> f64 {
        PARABOLIC_PEAK * self.limit * self.square(x).max(0.0)
    }

    /// 1 − (x/a)² − (y/b)².
    fn square(&self, x: f64) -> f64 {
        (self.half_length - x) * (self.half_length + x) / (self.along * self.along)
    }
}
