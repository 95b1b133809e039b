//! A strip of a patch along the rail: pressure, shear, stick and slip.

use super::slip::{FollowedShear, StripBound};
use super::stick::Regime;
use super::{RollingPatch, RollingTheory};
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

/// Steps between two points of a strip.
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
        let mut followed = FollowedShear::entering(self, y);
        let place = |i: usize| a * (PI * i as f64 / (SUBSTEPS * intervals) as f64).cos();
        for i in 1..intervals {
            for step in SUBSTEPS * (i - 1) + 1..=SUBSTEPS * i {
                followed.advance(place(step), &bound);
            }
            let x = if 2 * i == intervals { 0.0 } else { place(SUBSTEPS * i) };
            let limit = bound.elliptic(x);
            let (shear, slips, force) = match self.theory {
                _ if slipless => ([0.0; 2], false, [0.0; 2]),
                RollingTheory::Linear => {
                    let shear = ratio.map(|ratio| ratio * pressure(x));
                    (shear, false, shear)
                }
                // Where the parabola exceeds μp, μp is the limit of what is given out.
                RollingTheory::Fastsim => {
                    let size = followed.shear[0].hypot(followed.shear[1]);
                    let at_limit = followed.slips || size > limit;
                    let given =
                        followed.shear.map(|q| if at_limit && size > 0.0 { q * limit / size } else { q });
                    (given, followed.slips, followed.shear)
                }
                RollingTheory::FaStrip | RollingTheory::Strip => {
                    (followed.shear, followed.slips, followed.shear)
                }
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
            let Regime::Sticks(zone) = Regime::of(self, y) else {
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
