//! Stress of the half-space under tractions that are bilinear between the nodes of a grid.
//!
//! A pyramid of traction, the product of a hat along x and a hat across, has second differences of
//! slopes at its corners alone. Its stress is therefore a sum over corners of one function: the
//! stress of a point load, integrated twice along x and twice across. With the potentials of
//! Boussinesq and Cerruti, H, F and G of pressure and of shear along x and across (ln(R + z)
//! convolved with the traction), and ψ = F_x + G_y + H_z,
//!
//!   2π σ_xx = 2ν ψ_z + 2F_xz − H_xx + 2ν ∫ψ_xx − z ψ_xx,   2π σ_zz = H_zz − z ψ_zz,
//!   2π σ_xz = F_zz − z ψ_xz,   2π σ_xy = F_yz + G_xz − H_xy + 2ν ∫ψ_xy − z ψ_xy,
//!
//! σ_yy and σ_yz with x and y, F and G exchanged; ∫ is over the depth. Every term is a logarithm,
//! an angle or R times a polynomial; polynomials up to the second degree vanish in the differences
//! and are left out. Source: Love 1929; Johnson, Contact Mechanics, 3.2.

use super::duffy::Corners;
use super::plane::Symmetric;
use super::wheel::EllipticWheel;
use crate::field::StripTraction;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Tractions of a contact on the rail, bilinear between the nodes of a grid: a fine one for points
/// just below the contact, a coarse one for points far away. Its error in the stress of a Hertz
/// ellipse is less than 1e-3 p₀ from a hundredth of a semi-axis below the surface; at a tenth of a
/// semi-axis around its edge, where the pressure has an infinite slope, up to a hundredth.
#[derive(Debug, Clone, PartialEq)]
pub struct BilinearPatch {
    below: Grid,
    near: Grid,
    far: Grid,
    /// The ellipse with the same peak pressure and extent; its frictions are mean shear over mean
    /// pressure.
    outline: EllipticWheel,
}

/// The contact of a wheel in space.
#[derive(Debug, Clone, PartialEq)]
pub enum WheelPatch {
    /// A Hertz ellipse in full sliding.
    Ellipse(EllipticWheel),
    /// Any tractions.
    Bilinear(Arc<BilinearPatch>),
    /// Several patches of one wheel, at least one, each with its x from the wheel's centre (mm).
    Several(Arc<[(f64, WheelPatch)]>),
}

/// Intervals of the grid along and across: for points below the contact, near it, and farther away
/// than [`FAR`] times the larger semi-axis.
const BELOW_INTERVALS: usize = 48;
const NEAR_INTERVALS: usize = 24;
const FAR_INTERVALS: usize = 8;
const FAR: f64 = 4.0;
/// Points are below the contact up to this depth, over the smaller semi-axis, and within so many
/// semi-axes of its middle.
const BELOW_DEPTH: f64 = 0.4;
const BELOW_REACH: f64 = 1.3;
/// Samples of the traction in each interval, along and across.
const SAMPLES: usize = 8;
/// Nodes around the patch: sharpened values reach one node beyond the averages, their second
/// differences another, and the outermost ones have no neighbour.
const AROUND: usize = 3;
/// Points are assumed to lie at least this share of the extent below the surface.
const SHALLOWEST: f64 = 1e-7;

impl From<EllipticWheel> for WheelPatch {
    fn from(wheel: EllipticWheel) -> Self {
        Self::Ellipse(wheel)
    }
}

impl WheelPatch {
    /// Its size, place and mean shear; of several patches, those of the first one.
    #[must_use]
    pub fn outline(&self) -> &EllipticWheel {
        match self {
            Self::Ellipse(wheel) => wheel,
            Self::Bilinear(patch) => &patch.outline,
            Self::Several(patches) => patches[0].1.outline(),
        }
    }

    /// Pressure (MPa) at x and lateral position `at` (mm) with the centre at the abscissa
    /// `position` (mm).
    #[must_use]
    pub fn pressure(&self, position: f64, at: [f64; 2]) -> f64 {
        match self {
            Self::Ellipse(wheel) => wheel.pressure(position, at),
            Self::Bilinear(patch) => patch.below.pressure([at[0] - position, at[1] - patch.outline.lateral]),
            Self::Several(patches) => {
                patches.iter().map(|(ahead, own)| own.pressure(position + ahead, at)).sum()
            }
        }
    }

    /// The stress (MPa) at x, lateral and depth (mm) of a contact centred at `position` (mm).
    #[must_use]
    pub fn stress(&self, position: f64, point: [f64; 3], poisson: f64) -> Symmetric {
        match self {
            Self::Ellipse(wheel) => wheel.stress(position, point, poisson),
            Self::Bilinear(patch) => patch.stress(position, point, poisson),
            Self::Several(patches) => patches.iter().fold([0.0; 6], |mut sum, (ahead, own)| {
                let stress = own.stress(position + ahead, point, poisson);
                sum.iter_mut().zip(stress).for_each(|(sum, own)| *sum += own);
                sum
            }),
        }
    }
}

impl BilinearPatch {
    /// The tractions of strips along the rail, on the extent of `outline`: `strip` gives the points
    /// of the strip at y (mm from the middle), by increasing x, linear between them; none outside.
    ///
    /// A nodal value is the traction averaged over the pyramid of the node, less a sixth of its
    /// second differences: averaging and interpolation each smooth by a twelfth of them.
    #[must_use]
    pub fn new(outline: EllipticWheel, strip: impl Fn(f64) -> Vec<StripTraction>) -> Self {
        let half = [outline.half_width, outline.lateral_half_width];
        let grid = |intervals: usize| Grid::sampled(half, intervals, &strip);
        let (below, near, far) = (grid(BELOW_INTERVALS), grid(NEAR_INTERVALS), grid(FAR_INTERVALS));
        let [pressure, along, across] = near.sums();
        let of = |shear: f64| if pressure > 0.0 { shear / pressure } else { 0.0 };
        Self {
            below,
            near,
            far,
            outline: EllipticWheel { friction: of(along), lateral_friction: of(across), ..outline },
        }
    }

    fn stress(&self, position: f64, [x, lateral, depth]: [f64; 3], poisson: f64) -> Symmetric {
        let own = &self.outline;
        let extent = own.half_width.max(own.lateral_half_width);
        let at = [x - position, lateral - own.lateral, depth.max(SHALLOWEST * extent)];
        let sides = [own.half_width, own.lateral_half_width];
        if at[2] < BELOW_DEPTH * sides[0].min(sides[1])
            && (0..2).all(|i| at[i].abs() < BELOW_REACH * sides[i])
        {
            return self.below.stress(at, poisson);
        }
        let away = at.iter().map(|c| c * c).sum::<f64>().sqrt();
        if away > FAR * extent { self.far.stress(at, poisson) } else { self.near.stress(at, poisson) }
    }
}

/// Nodal tractions of a grid and their second differences.
#[derive(Debug, Clone, PartialEq)]
struct Grid {
    /// Distance of the nodes along and across, mm.
    step: [f64; 2],
    /// Nodes along and across, those without traction around the patch included.
    nodes: usize,
    /// x and y of the first node, mm.
    first: [f64; 2],
    /// p, q_x, q_y, MPa: `[across][along]`.
    values: Vec<[f64; 3]>,
    /// Σ of the slopes that end and begin at each node, relative to the first one.
    corners: Corners,
}

impl Grid {
    fn sampled(half: [f64; 2], intervals: usize, strip: &impl Fn(f64) -> Vec<StripTraction>) -> Self {
        let step = half.map(|half| 2.0 * half / intervals as f64);
        let nodes = intervals + 1 + 2 * AROUND;
        let first = [0, 1].map(|i| -half[i] - AROUND as f64 * step[i]);
        let mut averages = vec![[0.0; 3]; nodes * nodes];
        let count = intervals * SAMPLES;
        for j in 0..count {
            let offset = (j as f64 + 0.5) / SAMPLES as f64;
            let points = strip(step[1] * offset - half[1]);
            let (row, over) = (offset.floor() as usize, offset.fract());
            for i in 0..count {
                let along = (i as f64 + 0.5) / SAMPLES as f64;
                let Some(traction) = between(&points, step[0] * along - half[0]) else { continue };
                let (column, part) = (along.floor() as usize, along.fract());
                for (row, across) in [(row, 1.0 - over), (row + 1, over)] {
                    for (column, along) in [(column, 1.0 - part), (column + 1, part)] {
                        let weight = across * along / (SAMPLES * SAMPLES) as f64;
                        let value = &mut averages[(row + AROUND) * nodes + column + AROUND];
                        value.iter_mut().zip(traction).for_each(|(sum, own)| *sum += weight * own);
                    }
                }
            }
        }
        let mut grid = Self { step, nodes, first, values: averages, corners: Corners::default() };
        let (along, across) = (grid.differences([1, 0]), grid.differences([0, 1]));
        for ((value, along), across) in grid.values.iter_mut().zip(&along).zip(&across) {
            (0..3).for_each(|k| value[k] -= (along[k] + across[k]) / 6.0);
        }
        let once = Self { values: grid.differences([1, 0]), ..grid.clone() };
        let area = step[0] * step[1];
        let jumps = once.differences([0, 1]).into_iter().map(|jump| jump.map(|own| own / area));
        let place = |node: usize| [(node % nodes) as f64 * step[0], (node / nodes) as f64 * step[1]];
        let jumping = jumps.enumerate().filter(|(_, jump)| *jump != [0.0; 3]);
        grid.corners = Corners::new(jumping.map(|(node, jump)| (place(node), jump)));
        grid
    }

    /// Second differences of the nodal values in one direction.
    fn differences(&self, [along, across]: [usize; 2]) -> Vec<[f64; 3]> {
        let apart = along + across * self.nodes;
        let inner = |place: usize, steps: usize| steps == 0 || (place > 0 && place + 1 < self.nodes);
        let at = |node: usize, k: usize| {
            let (row, column) = (node / self.nodes, node % self.nodes);
            if inner(row, across) && inner(column, along) {
                self.values[node - apart][k] - 2.0 * self.values[node][k] + self.values[node + apart][k]
            } else {
                0.0
            }
        };
        (0..self.values.len()).map(|node| [0, 1, 2].map(|k| at(node, k))).collect()
    }

    fn sums(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.values.iter().map(|value| value[k]).sum())
    }

    fn pressure(&self, at: [f64; 2]) -> f64 {
        let [along, across] = [0, 1].map(|i| (at[i] - self.first[i]) / self.step[i]);
        let last = (self.nodes - 1) as f64;
        if !(0.0..last).contains(&along) || !(0.0..last).contains(&across) {
            return 0.0;
        }
        let (column, row) = (along.floor() as usize, across.floor() as usize);
        let (part, over) = (along.fract(), across.fract());
        let value = |row: usize, column: usize| self.values[row * self.nodes + column][0];
        let mix = |row| (1.0 - part) * value(row, column) + part * value(row, column + 1);
        ((1.0 - over) * mix(row) + over * mix(row + 1)).max(0.0)
    }

    fn stress(&self, [x, y, depth]: [f64; 3], poisson: f64) -> Symmetric {
        self.corners.stress([x - self.first[0], y - self.first[1], depth], poisson).map(|value| value / TAU)
    }
}

/// The traction at `x` between `points`, which are ordered by x.
fn between(points: &[StripTraction], x: f64) -> Option<[f64; 3]> {
    let next = points.partition_point(|point| point.x < x);
    let (a, b) = (points.get(next.checked_sub(1)?)?, points.get(next)?);
    let part = if b.x > a.x { (x - a.x) / (b.x - a.x) } else { 0.0 };
    Some([0, 1, 2].map(|k| a.traction[k] + part * (b.traction[k] - a.traction[k])))
}

/// Stress of the uncracked rail under a wheel. Any function of the position and the point is one.
pub trait WheelStress: Sync {
    /// The stress (MPa) with the wheel at an abscissa (mm), at x, lateral and depth (mm).
    fn stress(&self, position: f64, point: [f64; 3]) -> Symmetric;

    /// The contact of which it is the stress, if that is all: along the rail it may then be
    /// interpolated, with nothing singular but the edge of this ellipse.
    fn contact(&self) -> Option<&EllipticWheel> {
        None
    }
}

impl<F: Fn(f64, [f64; 3]) -> Symmetric + Sync> WheelStress for F {
    fn stress(&self, position: f64, point: [f64; 3]) -> Symmetric {
        self(position, point)
    }
}

/// The contact of a wheel on a rail with this Poisson's ratio.
#[derive(Debug, Clone, Copy)]
pub struct PatchOnRail<'a> {
    /// The contact.
    pub patch: &'a WheelPatch,
    /// ν.
    pub poisson: f64,
}

impl WheelStress for PatchOnRail<'_> {
    fn stress(&self, position: f64, point: [f64; 3]) -> Symmetric {
        self.patch.stress(position, point, self.poisson)
    }

    fn contact(&self) -> Option<&EllipticWheel> {
        match self.patch {
            WheelPatch::Ellipse(wheel) => Some(wheel),
            WheelPatch::Bilinear(_) | WheelPatch::Several(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NU: f64 = 0.3;
    /// Allowed difference from the ellipse, of p₀.
    const OFF: f64 = 1e-3;

    /// A Hertz ellipse in full sliding as a bilinear patch.
    fn bilinear(wheel: EllipticWheel) -> WheelPatch {
        let strip = move |y: f64| {
            let share = (1.0 - (y / wheel.lateral_half_width).powi(2)).max(0.0).sqrt();
            let point = |i: usize| {
                let t = -(std::f64::consts::PI * i as f64 / 200.0).cos();
                let p = wheel.peak_pressure * share * (1.0 - t * t).max(0.0).sqrt();
                StripTraction {
                    x: wheel.half_width * share * t,
                    traction: [p, wheel.friction * p, wheel.lateral_friction * p],
                }
            };
            (0..=200).map(point).collect()
        };
        WheelPatch::Bilinear(Arc::new(BilinearPatch::new(wheel, strip)))
    }

    fn wheel(b: f64) -> EllipticWheel {
        EllipticWheel {
            peak_pressure: 1000.0,
            half_width: 5.0,
            lateral_half_width: b,
            lateral: 1.5,
            friction: 0.3,
            lateral_friction: -0.2,
        }
    }

    #[test]
    fn the_ellipse_in_full_sliding() {
        for b in [3.0, 5.0, 9.0] {
            let (exact, patch) = (wheel(b), bilinear(wheel(b)));
            for x in [-12.0, -4.6, -2.0, 0.0, 3.1, 5.2, 30.0] {
                for y in [-8.0, -2.0, 1.5, 3.7, 6.0] {
                    for z in [0.05, 0.3, 1.0, 3.0, 10.0] {
                        let (want, got) =
                            (exact.stress(2.0, [x + 2.0, y, z], NU), patch.stress(2.0, [x + 2.0, y, z], NU));
                        // The surface sees the grid near the edge, where the pressure is steep.
                        let edge = ((x / 5.0).powi(2) + ((y - 1.5) / b).powi(2) - 1.0).abs() < 0.4;
                        if edge && z < 0.5 {
                            continue;
                        }
                        for (want, got) in want.iter().zip(got) {
                            let off = (want - got).abs() / 1000.0;
                            assert!(off < OFF, "b {b} at {x} {y} {z}: {off} p0");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn equilibrium_and_tractions_at_the_surface() {
        let patch = bilinear(wheel(6.0));
        let entry = |i: usize, j: usize| if i == j { i } else { 6 - i - j };
        let h = 1e-3;
        for point in [[1.0, 2.0, 1.5], [6.0, 3.0, 0.7], [-9.0, 7.0, 4.0]] {
            for i in 0..3 {
                let slope = |j: usize| {
                    let at = |step: f64| {
                        let mut moved = point;
                        moved[j] += step;
                        patch.stress(0.0, moved, NU)[entry(i, j)]
                    };
                    (at(h) - at(-h)) / (2.0 * h)
                };
                let divergence: f64 = (0..3).map(slope).sum();
                assert!(divergence.abs() < 1e-4, "{point:?} {i}: {divergence}");
            }
        }
        let surface = patch.stress(0.0, [1.3, 2.0, 0.0], NU);
        let pressure = patch.pressure(0.0, [1.3, 2.0]);
        assert!((surface[2] + pressure).abs() < 1e-2 && (surface[4] + 0.3 * pressure).abs() < 1e-2);
        assert!((surface[3] - 0.2 * pressure).abs() < 1e-2, "{surface:?}");
        assert_eq!(patch.pressure(0.0, [40.0, 0.0]), 0.0);
    }

    #[test]
    fn mean_shear_of_the_outline() {
        let patch = bilinear(wheel(6.0));
        let own = patch.outline();
        assert!((own.friction - 0.3).abs() < 1e-9 && (own.lateral_friction + 0.2).abs() < 1e-9);
    }
}
