//! Slip behind the stick zone of a strip: the shear opposes it.

use super::patch::Flexibilities;
use super::stick::Regime;
use super::{Creepage, RollingPatch, RollingTheory};
use std::f64::consts::PI;

/// The shear of a strip, followed from its leading edge backwards.
///
/// Displacements are proportional to the shear at the same point, u = L q. The slip is the rigid
/// slip less the elastic one,
///
/// w = (ξ − φ y − L1 dq_x/dx, η + φ x − L2 dq_y/dx),
///
/// zero where wheel and rail stick. Where the shear would exceed the limit g they slip, and q =
/// −g w/|w|. Over a step h from the shear q0, the shear without slip is t_i = q0_i − h s_i/L_i with
/// the rigid slip s, and that with slip q_i = t_i/(1 + κ/L_i), with κ = h |w|/g such that |q| = g.
/// In full slip h s is large beside L q, and q opposes s, whatever L1 and L2 are. Published FASTSIM
/// and FaStrip keep the direction of t instead, in full slip that of (s_x/L1, s_y/L2).
///
/// FASTSIM sticks by dq_x/dx = ξ/L1 − φ y/L3 and dq_y/dx = η/L2 + φ x/L3 up to the parabola μ
/// 2N/(πab)(1 − (x/a)² − (y/b)²). Strips of elliptic shear stick where strip theory says so
/// ([`Regime`]) and slip everywhere else; where it has no answer, they slip where t is above μp.
///
/// Source: Kalker 1982, Vehicle System Dynamics 11, 1–13.
#[derive(Debug, Clone, Copy)]
pub(super) struct FollowedShear {
    creepage: Creepage,
    stick: StickRule,
    flexibilities: Flexibilities,
    /// L1 and L2 of the elastic slip, mm³/N.
    elastic: [f64; 2],
    y: f64,
    /// x of the shear, mm.
    x: f64,
    /// q_x, q_y, MPa.
    pub shear: [f64; 2],
    /// Whether wheel and rail slip.
    pub slips: bool,
}

/// Where wheel and rail stick.
#[derive(Debug, Clone, Copy)]
enum StickRule {
    /// Below the parabola, by the flexibilities of FASTSIM.
    Fastsim,
    /// By strip theory.
    Strip(Regime),
}

/// L1 and L2 of the slip over those of FASTSIM, behind the stick zone of FaStrip.
///
/// The strip under the shear μp0/a √(a_y² − x²) that bounds the stick zone has the displacement π²
/// μp0/(4GC) (a_y² − x²)/a; with this factor L μp has the same mean over the ellipse. The strip
/// theory, whose stick zone is shorter under spin, is closer to CONTACT with 1.
const MEAN_DISPLACEMENT: f64 = 9.0 * PI * PI / 128.0;

impl FollowedShear {
    /// The leading edge of the strip at `y` (mm), without shear.
    pub fn entering(patch: &RollingPatch, y: f64) -> Self {
        let strip = || StickRule::Strip(Regime::of(patch, y));
        let (stick, share) = match patch.theory {
            RollingTheory::Fastsim | RollingTheory::Linear => (StickRule::Fastsim, 1.0),
            RollingTheory::FaStrip => (strip(), MEAN_DISPLACEMENT),
            RollingTheory::Strip => (strip(), 1.0),
        };
        let flexibilities = patch.flexibilities();
        Self {
            creepage: patch.creepage,
            stick,
            elastic: [flexibilities.l1, flexibilities.l2].map(|l| share * l),
            flexibilities,
            y,
            x: patch.half_length(y),
            shear: [0.0; 2],
            slips: false,
        }
    }

    /// A step back to `x`, mm.
    pub fn advance(&mut self, x: f64, bound: &StripBound) {
        let (step, middle) = (self.x - x, 0.5 * (self.x + x));
        self.x = x;
        match self.stick {
            StickRule::Strip(Regime::Sticks(zone)) if zone.holds(x) => {
                (self.shear, self.slips) = (zone.shear(x), false);
            }
            StickRule::Strip(regime) => {
                let (t, limit) = (self.without_slip(step, middle), bound.elliptic(x));
                self.slips = regime != Regime::Unknown || t[0].hypot(t[1]) > limit;
                self.shear = if self.slips { opposed(t, self.elastic, limit) } else { t };
            }
            StickRule::Fastsim => {
                let (sticking, limit) = (self.fastsim(step, middle), bound.parabolic(x));
                self.slips = sticking[0].hypot(sticking[1]) > limit;
                self.shear = match self.slips {
                    true => opposed(self.without_slip(step, middle), self.elastic, limit),
                    false => sticking,
                };
            }
        }
    }

    /// t after a `step` (mm) about x = `middle`.
    fn without_slip(&self, step: f64, middle: f64) -> [f64; 2] {
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let rigid = [longitudinal - spin * self.y, lateral + spin * middle];
        [0, 1].map(|i| self.shear[i] - step * rigid[i] / self.elastic[i])
    }

    /// The shear of FASTSIM after a `step` (mm) about x = `middle` in which wheel and rail stick.
    fn fastsim(&self, step: f64, middle: f64) -> [f64; 2] {
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let Flexibilities { l1, l2, l3 } = self.flexibilities;
        [
            self.shear[0] - step * (longitudinal / l1 - spin * self.y / l3),
            self.shear[1] - step * (lateral / l2 + spin * middle / l3),
        ]
    }
}

/// Newton's steps for κ; five do for L1/L2 of the most slender ellipses.
const NEWTON_STEPS: usize = 20;

/// The shear of the size `limit` that opposes the slip of a step, t_i/(1 + κ/L_i) with L the
/// `elastic` flexibilities; along `t` where that is smaller.
///
/// 1/|q| is nearly linear in κ and concave, so that Newton's method converges from κ = 0.
fn opposed(t: [f64; 2], elastic: [f64; 2], limit: f64) -> [f64; 2] {
    let size = t[0].hypot(t[1]);
    if size == 0.0 {
        return t;
    }
    if size <= limit || limit <= 0.0 {
        return t.map(|t| t * limit / size);
    }
    let (mut kappa, mut q) = (0.0, t);
    for _ in 0..NEWTON_STEPS {
        let size = q[0].hypot(q[1]);
        if (size / limit - 1.0).abs() < 1e-12 {
            break;
        }
        // d(1/|q|)/dκ = Σ q_i²/(L_i + κ)/|q|³.
        let slope = [0, 1].map(|i| q[i] * q[i] / (elastic[i] + kappa)).iter().sum::<f64>() / size.powi(3);
        kappa += (1.0 / limit - 1.0 / size) / slope;
        q = [0, 1].map(|i| t[i] / (1.0 + kappa / elastic[i]));
    }
    let size = q[0].hypot(q[1]);
    q.map(|q| q * limit / size)
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
