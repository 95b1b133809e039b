//! Patch tests: cancellation of polynomial fields, and of the half-plane field of a wheel outside
//! the block.

use super::{BottomSupport, Boundary, BulkRail, ElasticField, SideSupport, StressAtPoints};
use crate::field::{HertzDisplacement, HertzField};
use crate::load::HertzianContact;
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
use crate::mesh::QuadMesh;

pub(super) const CONTACT: HertzianContact =
    HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };

pub(super) fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

/// All combinations of supports.
pub(super) fn boundaries() -> Vec<Boundary> {
    let bottoms = [BottomSupport::Clamped, BottomSupport::Rollers];
    let sides = [SideSupport::Free, SideSupport::Rollers, SideSupport::Clamped];
    let blocks = bottoms.into_iter().flat_map(|bottom| sides.map(|sides| Boundary::Block { bottom, sides }));
    blocks.chain([Boundary::HalfPlane]).collect()
}

/// The block of 300 × 172 mm with `columns` elements along it, slightly uneven.
pub(super) fn block(columns: usize) -> QuadMesh {
    let lines = |from: f64, to: f64, n: usize| {
        let at = |i: usize| i as f64 / n as f64;
        (0..=n)
            .map(|i| from + (to - from) * (at(i) + 0.05 * (6.0 * at(i)).sin() * at(i) * (1.0 - at(i))))
            .collect()
    };
    QuadMesh::new(lines(-150.0, 150.0, columns), lines(-172.0, 0.0, columns / 2)).unwrap()
}

/// σ_xx = tension + bending y + 2 shear x, σ_xy = −2 shear y: no tractions on the surface,
/// quadratic displacements.
struct Quadratic {
    tension: f64,
    bending: f64,
    shear: f64,
}

impl ElasticField for Quadratic {
    fn stress(&self, p: Vec2) -> Stress {
        let xx = self.tension + self.bending * p.y + 2.0 * self.shear * p.x;
        Stress { xx, yy: 0.0, zz: steel().poisson() * xx, xy: -2.0 * self.shear * p.y }
    }

    fn displacement(&self, p: Vec2) -> Vec2 {
        let (modulus, nu) = (steel().plane_strain_modulus(), steel().poisson());
        let across = nu / (1.0 - nu);
        let Self { tension, bending, shear } = *self;
        let sliding = across - modulus / steel().shear_modulus();
        let ux = tension * p.x + bending * p.x * p.y + shear * (p.x * p.x + sliding * p.y * p.y);
        let uy = -across * (tension * p.y + 0.5 * bending * p.y * p.y + 2.0 * shear * p.x * p.y);
        Vec2::new(ux, uy - 0.5 * bending * p.x * p.x) * (1.0 / modulus)
    }

    fn smooth_within(&self, _: Vec2) -> f64 {
        f64::INFINITY
    }
}

fn largest(stress: Stress) -> f64 {
    stress.xx.abs().max(stress.yy.abs()).max(stress.zz.abs()).max(stress.xy.abs())
}

fn some_points() -> Vec<Vec2> {
    let xs = [-149.0, -80.0, -6.0, 0.0, 0.3, 12.0, 77.0, 150.0];
    let ys = [-171.0, -95.0, -13.0, -2.0, 0.0];
    xs.into_iter().flat_map(|x| ys.map(|y| Vec2::new(x, y))).collect()
}

#[test]
fn quadratic_fields_are_cancelled_exactly() {
    // Round-off of the factor, whose condition number is of the order of 1e5.
    const TOLERANCE: f64 = 1e-9;
    let field = Quadratic { tension: 100.0, bending: 3.0, shear: -0.7 };
    let largest_stress = 900.0;
    for boundary in boundaries() {
        let rail = BulkRail::new(block(6), &steel(), boundary).unwrap();
        let displacements = rail.cancel(&[&field]).unwrap().remove(0);
        let sums = displacements.iter().enumerate().map(|(node, u)| {
            let exact = field.displacement(rail.mesh().node_position(node));
            ((*u + exact).length(), exact.length())
        });
        let (error, size) = sums.fold((0.0, 0.0), |(e, s): (f64, f64), (f, t)| (e.max(f), s.max(t)));
        assert!(error < TOLERANCE * size, "{boundary:?}: {error:e} mm of {size}");
        let points = some_points();
        let stresses = StressAtPoints::new(&rail, &points).unwrap().stress(&displacements);
        for (point, stress) in points.into_iter().zip(stresses) {
            let error = largest(stress + field.stress(point));
            assert!(error < TOLERANCE * largest_stress, "{boundary:?} at {point:?}: {error:e} MPa");
        }
    }
}

/// The half-plane under a wheel outside the block.
struct HertzOutside(f64);

impl ElasticField for HertzOutside {
    fn stress(&self, point: Vec2) -> Stress {
        HertzField::new(&CONTACT, steel().poisson()).stress(point, self.0)
    }

    fn displacement(&self, point: Vec2) -> Vec2 {
        HertzDisplacement::new(&CONTACT, &steel()).displacement(point, self.0)
    }

    fn smooth_within(&self, point: Vec2) -> f64 {
        (point - Vec2::new(self.0, 0.0)).length() - CONTACT.half_width
    }
}

#[test]
fn a_wheel_beside_the_block_is_cancelled_with_the_order_of_the_elements() {
    let field = HertzOutside(230.0);
    let points = some_points();
    let size = points.iter().fold(0.0, |size: f64, &p| size.max(largest(field.stress(p))));
    for boundary in boundaries() {
        let errors = |columns| {
            let rail = BulkRail::new(block(columns), &steel(), boundary).unwrap();
            let displacements = rail.cancel(&[&field]).unwrap().remove(0);
            let stresses = StressAtPoints::new(&rail, &points).unwrap().stress(&displacements);
            let mut near_ends = 0.0_f64;
            let mut near_cracks = 0.0_f64;
            for (&point, stress) in points.iter().zip(stresses) {
                let error = largest(stress + field.stress(point)) / size;
                let near =
                    if point.x.abs() < 20.0 && point.y > -20.0 { &mut near_cracks } else { &mut near_ends };
                *near = near.max(error);
            }
            [near_ends, near_cracks]
        };
        let errors = [8, 16, 32, 64].map(errors);
        // Quadratic elements: third order at Gauss points inside, less near the ends, where the
        // stress is extrapolated by cubics.
        for (k, (place, order, last)) in [("ends", 1.9, 3e-3), ("cracks", 2.6, 2e-5)].into_iter().enumerate()
        {
            let errors = errors.map(|e| e[k]);
            let measured = (errors[0] / errors[3]).log2() / 3.0;
            println!("{boundary:?}, {place}: {errors:?}, order {measured:.2}");
            assert!(measured > order && errors[3] < last, "{boundary:?}, {place}: {errors:?}");
        }
    }
}
