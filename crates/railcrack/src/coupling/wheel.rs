//! A wheel that feels the cracks, on the faces of a body.

use super::compliance::compliance;
use super::grid::{NodeSpacing, SurfaceGrid};
use super::loads::forces;
use super::uneven_shear::uneven_shear;
use crate::body::FaceMesh;
use crate::contact::{SurfaceNode, UnevenShear, WheelSurface, ratio_at};
use crate::load::{Contact, HertzianContact};
use crate::material::IsotropicElastic;
use crate::math::Matrix;

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
