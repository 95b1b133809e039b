//! A wheel that feels the cracks, on the faces of a body: gap, shear and forces of its contact.

use super::compliance::compliance;
use super::grid::{NodeSpacing, SurfaceGrid};
use crate::body::FaceMesh;
use crate::contact::{SurfaceNode, UnevenShear, WheelSurface, ratio_at};
use crate::field::{HertzWheel, SegmentEnd, SegmentStress, Wheel};
use crate::load::{CarterContact, Contact, HertzianContact, SurfacePart, uncoupled_gap};
use crate::material::IsotropicElastic;
use crate::math::{Matrix, OutOfRange, Stress, Vec2, dot};
use std::f64::consts::PI;

/// Contact of a wheel that feels the cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledContact {
    /// The pressure on the uncracked rail, and as friction the ratio Q′/P′ of its forces.
    pub contact: HertzianContact,
    /// The steel of wheel and rail.
    pub steel: IsotropicElastic,
    /// q/p − Q′/P′ on the uncracked rail by u = x − x_c (mm), increasing; empty in full sliding.
    pub uneven_shear: Vec<(f64, f64)>,
}

impl CoupledContact {
    /// The contact of a wheel and a rail of `steel` that is `contact` on the uncracked rail: its
    /// pressure is a half-ellipse.
    #[must_use]
    pub fn new(contact: &Contact, steel: &IsotropicElastic) -> Self {
        let pressure = HertzianContact {
            peak_pressure: contact.peak_pressure(),
            half_width: contact.half_width(),
            friction: contact.adhesion(),
        };
        Self { contact: pressure, steel: *steel, uneven_shear: uneven_shear(contact) }
    }

    /// E* = E/(2 (1 − ν²)) of wheel and rail of equal steel, MPa.
    fn modulus(&self) -> f64 {
        0.5 * self.steel.plane_strain_modulus()
    }

    /// q/p at `u` = x − x_c (mm).
    pub(crate) fn shear_ratio(&self, u: f64) -> f64 {
        self.contact.friction + ratio_at(&self.uneven_shear, u)
    }
}

/// Settings of the coupling.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelCoupling {
    /// The contact.
    pub contact: CoupledContact,
    /// Number of surface nodes per half-width a: the spacing is half of a over this number at a
    /// mouth, twice a over it away from the mouths, and up to eight times a over it farther than
    /// 1.2 a away.
    pub nodes_per_half_width: f64,
    /// Distance of x_c from a mouth, over a, within which the wheel feels the cracks.
    pub within: f64,
}

impl WheelCoupling {
    /// The default number of surface nodes per half-width.
    pub const NODES_PER_HALF_WIDTH: f64 = 40.0;
    /// The default range of the coupling over a. The change of a nodal pressure over p0 is 1e-5 at
    /// 3 a, 5e-7 at 6 a and 2e-8 at 12 a.
    pub const WITHIN: f64 = 3.0;

    /// The running surface under the wheel, with the `faces` of cracks; `None` for cracks without a
    /// mouth.
    pub fn on(&self, faces: &FaceMesh) -> Option<WheelSurface> {
        let HertzianContact { peak_pressure, half_width, friction } = self.contact.contact;
        let at_surface = faces.points.iter().filter(|point| point.position.y == 0.0);
        let mut mouths: Vec<f64> = at_surface.map(|point| point.position.x).collect();
        mouths.sort_by(f64::total_cmp);
        mouths.dedup();
        let (first, last) = (*mouths.first()?, *mouths.last()?);
        let (coupled, reach) = (self.within * half_width, (self.within + BEYOND) * half_width);
        let mean = half_width / self.nodes_per_half_width;
        let spacing = NodeSpacing { at_mouth: AT_MOUTH * mean, away: AWAY * mean, near: NEAR * half_width };
        let grid = SurfaceGrid::new((first - reach, last + reach), &mouths, spacing);
        let mut nodes: Vec<SurfaceNode> =
            grid.nodes.iter().zip(grid.moments()).map(|(&x, moments)| SurfaceNode { x, moments }).collect();
        nodes.shrink_to_fit();
        let of_hats = forces(&grid, faces);
        let loading = Matrix::from_fn(nodes.len(), 2 * faces.points.len(), |i, k| {
            of_hats.pressure[(i, k)] + friction * of_hats.shear[(i, k)]
        });
        let ratios = self.contact.uneven_shear.clone();
        let uneven = (!ratios.is_empty()).then_some(UnevenShear { forces: of_hats.shear, ratios });
        Some(WheelSurface {
            nodes,
            compliance: compliance(&grid, self.contact.modulus()),
            measuring: of_hats.pressure,
            loading,
            uneven,
            line_load: self.contact.contact.line_load(),
            peak_pressure,
            half_width,
            radius: 0.5 * half_width * self.contact.modulus() / peak_pressure,
            coupled: (first - coupled, last + coupled),
            mouths,
        })
    }
}

/// Spacing of the nodes at a mouth and away from the mouths, over the mean.
const AT_MOUTH: f64 = 0.5;
const AWAY: f64 = 2.0;
/// Distance from the mouths over a beyond which the spacing grows.
const NEAR: f64 = 1.2;
/// Extent of the surface beyond the last coupled x_c, over a: the contact, which the crack may
/// widen.
const BEYOND: f64 = 1.3;

/// Nodal forces on the faces for a unit traction of each surface node; row i belongs to node i and
/// has 2p entries, N/mm per MPa.
pub(super) struct SurfaceForces {
    /// Of a unit pressure.
    pub pressure: Matrix,
    /// Of a unit shear along +x on the rail.
    pub shear: Matrix,
}

/// The forces of the hats of `grid` on `faces`.
pub(super) fn forces(grid: &SurfaceGrid, faces: &FaceMesh) -> SurfaceForces {
    let none = || Matrix::zeros(grid.nodes.len(), 2 * faces.points.len());
    let (mut pressure, mut shear) = (none(), none());
    let mut ends: Vec<SegmentEnd> = Vec::with_capacity(grid.nodes.len());
    let mut hats = Vec::with_capacity(grid.nodes.len());
    for sample in &faces.graded {
        ends.clear();
        ends.extend(grid.nodes.iter().map(|&x| SegmentEnd::of(sample.point, x)));
        hats.clear();
        hats.resize(grid.nodes.len(), [Stress::default(); 2]);
        for segment in &grid.segments {
            let [start, end] = segment.nodes.map(|node| &ends[node]);
            let stress = SegmentStress::between(start, end);
            for (end, &node) in segment.nodes.iter().enumerate() {
                let [pressure, shear] = &mut hats[node];
                *pressure = *pressure + stress.pressure[end];
                *shear = *shear + stress.shear[end];
            }
        }
        for (node, stresses) in hats.iter().enumerate() {
            for (forces, stress) in [&mut pressure, &mut shear].into_iter().zip(stresses) {
                let traction = stress.traction(sample.normal);
                let row = forces.row_mut(node);
                for (point, length) in sample.shares {
                    row[2 * point] += length * traction.x;
                    row[2 * point + 1] += length * traction.y;
                }
            }
        }
    }
    for forces in [&mut pressure, &mut shear] {
        for node in 0..grid.nodes.len() {
            for (force, point) in forces.row_mut(node).chunks_exact_mut(2).zip(&faces.points) {
                let sum = Vec2::new(force[0], force[1]);
                (force[0], force[1]) = (sum.dot(point.tangent), sum.dot(point.tangent.left()));
            }
        }
    }
    SurfaceForces { pressure, shear }
}

/// Number of intervals between the edges of a contact.
const INTERVALS: usize = 800;
/// Distance from an edge, over a, at which pressure and shear are so small that their ratio is that
/// at the edge.
const AT_EDGE: f64 = 1e-6;

/// q/p − Q′/P′ of `contact` by u = x − x_c (mm), increasing; empty where shear and pressure are
/// proportional.
pub(super) fn uneven_shear(contact: &Contact) -> Vec<(f64, f64)> {
    let mean = contact.adhesion();
    let beyond_mean = |(u, p, q): (f64, f64, f64)| (u, q / p - mean);
    match contact {
        Contact::Hertz(_) => Vec::new(),
        Contact::Carter(carter) if carter.edges().len() == 2 => Vec::new(),
        Contact::Carter(carter) => {
            places(carter).map(|u| beyond_mean((u, carter.pressure(u), carter.shear(u)))).collect()
        }
        Contact::Table(table) => {
            let pressed = table.rows().iter().filter(|row| row.pressure > 0.0);
            pressed.map(|row| beyond_mean((row.u, row.pressure, row.shear))).collect()
        }
    }
}

/// Places between the edges, dense at these.
fn places(contact: &CarterContact) -> impl Iterator<Item = f64> {
    let reach = (1.0 - AT_EDGE) * contact.half_width;
    (0..=INTERVALS).map(move |k| -reach * (PI * k as f64 / INTERVALS as f64).cos())
}

/// The largest gap (mm) between rail and wheel with its centre at `xc` (mm), whose `contact` is
/// that on the uncracked rail, by the `jumps` (mm, 2p) of the faces. By Betti's theorem the nodal
/// forces of a pressure on the faces do the work on the jumps that it does on the sinking.
///
/// Errors: a contact without extent.
pub fn gap_in_plane(
    faces: &FaceMesh,
    jumps: &[f64],
    contact: &HertzianContact,
    steel: &IsotropicElastic,
    xc: f64,
) -> Result<f64, OutOfRange> {
    let measure = |half_width: f64| {
        let unit = HertzianContact { peak_pressure: 1.0, half_width, friction: 0.0 };
        Ok((HertzWheel::new(&unit, steel)?, unit.line_load()))
    };
    let a = contact.half_width;
    let (whole, part) = (measure(a)?, measure(SurfacePart::SHARE * a)?);
    Ok(uncoupled_gap(|of: SurfacePart| {
        let (wheel, load) = if of == SurfacePart::WHOLE { &whole } else { &part };
        let forces = faces.nodal_forces(|point| wheel.stress(point, xc + of.ahead * a));
        dot(&forces, jumps) / load
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Travel;

    #[test]
    fn partial_slip_has_the_friction_of_the_slip_zone_and_less_where_it_sticks() {
        let carter = CarterContact {
            peak_pressure: 845.0,
            half_width: 6.75,
            friction: 0.3,
            traction: -0.75,
            travel: Travel::Forward,
        };
        let ratios = uneven_shear(&Contact::Carter(carter));
        let (trailing, leading) = (ratios[0], ratios[INTERVALS]);
        // c = a/2: slip in the rear half, and μ (1 − √(c/a)) at the leading edge.
        let mean = -0.75 * 0.3;
        assert!((trailing.1 - (-0.3 - mean)).abs() < 1e-12);
        assert!((leading.1 - (-0.3 * (1.0 - 0.5f64.sqrt()) - mean)).abs() < 1e-5);
        let sliding = CarterContact { traction: 1.0, ..carter };
        assert!(uneven_shear(&Contact::Carter(sliding)).is_empty());
    }
}
