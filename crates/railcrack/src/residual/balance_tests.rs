use super::{BalancedStress, PlasticField, projection_loss};
use crate::bulk::{BottomSupport, Boundary, BulkRail, SideSupport};
use crate::field::{DepthProfile, StressField};
use crate::material::IsotropicElastic;
use crate::math::{RailBox, Stress, Vec2};
use crate::mesh::{Array, CellBlock, CellShape, QuadMesh, UnstructuredGrid};

const POISSON: f64 = 0.3;

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, POISSON).unwrap()
}

/// A rail of 40 × 20 mm in elements of 1 mm.
fn rail(boundary: Boundary) -> BulkRail {
    let lines = |from: f64, count: usize| (0..=count).map(|i| from + i as f64).collect();
    BulkRail::new(QuadMesh::new(lines(-20.0, 40), lines(-20.0, 20)).unwrap(), &steel(), boundary).unwrap()
}

const HELD_ALONG_X: Boundary =
    Boundary::Block { bottom: BottomSupport::Rollers, sides: SideSupport::Rollers };
const FREE_IN_THE_PLANE: Boundary =
    Boundary::Block { bottom: BottomSupport::Rollers, sides: SideSupport::Free };

/// 𝕂ε_p, MPa.
fn elastic_stress_of(strain: Stress) -> Stress {
    let in_plane = steel().plane_strain_stress(strain.xx, strain.yy, 2.0 * strain.xy);
    // The out-of-plane strain contributes λ tr and 2 μ ε_zz.
    let (mu, nu) = (steel().shear_modulus(), POISSON);
    let lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
    let add = lambda * strain.zz;
    Stress { xx: add, yy: add, zz: add + 2.0 * mu * strain.zz, xy: 0.0 } + in_plane
}

fn largest_difference(one: Stress, other: Stress) -> f64 {
    let d = one - other;
    [d.xx, d.yy, d.zz, d.xy].into_iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// Two uniform plastic strains: one of incompressible flow, and one that changes the volume.
const STRAINS: [Stress; 2] = [
    Stress { xx: 1e-3, yy: -1.4e-3, zz: 0.4e-3, xy: 0.0 },
    Stress { xx: 0.7e-3, yy: 0.2e-3, zz: -0.3e-3, xy: 0.0 },
];

#[test]
fn a_plastic_strain_held_along_x_and_free_along_y_gives_the_opposite_stress() {
    // σ_xx = −E′ (ε_xx + ν ε_zz), σ_yy = 0: opposite in sign to the plastic stress.
    for strain in STRAINS {
        let balanced = BalancedStress::new(&rail(HELD_ALONG_X), |_| elastic_stress_of(strain)).unwrap();
        let modulus = steel().plane_strain_modulus();
        let xx = -modulus * (strain.xx + POISSON * strain.zz);
        let zz = -modulus * (strain.zz + POISSON * strain.xx);
        let want = Stress { xx, zz, ..Stress::ZERO };
        for point in [Vec2::new(0.0, -0.0), Vec2::new(13.3, -7.7), Vec2::new(-20.0, -20.0)] {
            let error = largest_difference(balanced.stress(point), want);
            assert!(error < 1e-8 * xx.abs(), "{strain:?} at {point:?}: {error}"); // round-off of the factor
        }
    }
}

#[test]
fn a_plastic_strain_free_in_the_plane_leaves_only_out_of_plane_stress() {
    for strain in STRAINS {
        let balanced = BalancedStress::new(&rail(FREE_IN_THE_PLANE), |_| elastic_stress_of(strain)).unwrap();
        let want = Stress { zz: -steel().young() * strain.zz, ..Stress::ZERO };
        for point in [Vec2::new(0.0, -0.0), Vec2::new(13.3, -7.7), Vec2::new(-20.0, -20.0)] {
            let error = largest_difference(balanced.stress(point), want);
            assert!(error < 1e-8 * want.zz.abs(), "{strain:?} at {point:?}: {error}"); // round-off of the factor
        }
    }
}

#[test]
fn layers_converge_to_the_closed_form() {
    // A profile with kinks: σ_xx = −σ_p,xx without displacement along x.
    let rows = vec![(0.0, 25.0, 10.0), (1.1, -110.0, 0.0), (2.7, 50.0, -20.0), (6.3, 0.0, 0.0)];
    let profile = DepthProfile::new(rows).unwrap();
    let plastic = PlasticField::layers(&profile).unwrap();
    let error = |per_mm: usize| {
        let lines = |from: f64, length: usize| {
            (0..=length * per_mm).map(|i| from + i as f64 / per_mm as f64).collect::<Vec<f64>>()
        };
        let mesh = QuadMesh::new(lines(-4.0, 8), lines(-10.0, 10)).unwrap();
        let balanced = BalancedStress::new(&BulkRail::new(mesh, &steel(), HELD_ALONG_X).unwrap(), |p| {
            plastic.plastic_stress(p)
        })
        .unwrap();
        let at = |i: usize| {
            let point = Vec2::new(0.3, -0.01 * i as f64);
            let stress = balanced.stress(point);
            assert!(
                stress.yy.abs().max(stress.xy.abs()) < 1e-7,
                "traction on a layer at {point:?}: {stress:?}"
            );
            let given = profile.stress(point);
            // Without σ_p,yy: σ_zz = −σ_p,zz.
            (stress.xx + given.xx).abs().max((stress.zz + given.zz).abs())
        };
        let errors: Vec<f64> = (0..=800).map(at).collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    };
    let errors = [error(2), error(4), error(8)];
    assert!(errors[2] < 0.1, "mean error in MPa: {errors:?}"); // a thousandth of the largest stress
    // Elements with a kink have first-order errors, and they cover a part of the depth that is
    // itself of first order.
    let order = (errors[0] / errors[2]).log2() / 2.0;
    assert!(order > 1.7, "order {order}, {errors:?}");
}

#[test]
fn losses_vanish_for_linear_fields() {
    let linear = |p: Vec2| Stress { xx: 3.0 + p.x - 2.0 * p.y, yy: p.y, zz: -p.x, xy: 0.5 * p.x + p.y };
    let points: Vec<Vec2> = (0..=4)
        .flat_map(|j| (0..=6).map(move |i| Vec2::new(-30.0 + 10.0 * i as f64, -24.0 + 6.0 * j as f64)))
        .collect();
    let cell = |i: usize, j: usize| [7 * j + i, 7 * j + i + 1, 7 * j + i + 8, 7 * j + i + 7];
    let connectivity = (0..4).flat_map(|j| (0..6).flat_map(move |i| cell(i, j))).collect();
    let values: Vec<Stress> = points.iter().map(|&p| linear(p)).collect();
    let grid = UnstructuredGrid {
        z: Vec::new(),
        points,
        cells: vec![CellBlock { shape: CellShape::Quad, connectivity }],
        point_data: vec![Array::stresses("plastic_stress_mpa", &values)],
        cell_data: vec![],
    };
    let plastic = PlasticField::from_grid(&grid).unwrap();
    let part = RailBox { width: 30.0, depth: 20.0, centre: 0.0 };
    let loss = projection_loss(&rail(HELD_ALONG_X), &plastic, part);
    assert!(loss.norm > 0.0 && (loss.norm_ratio - 1.0).abs() < 1e-12 && loss.difference < 1e-7, "{loss:?}"); // reference coordinates to 1e-12
}

/// Triangles on rings around (0, `y`): a disc of radius 2 mm with a plastic expansion, in a ring
/// without.
fn grown_disc(y: f64, plastic: Stress) -> PlasticField {
    let (rings, around, radius) = (40, 48, 2.0);
    let centre = Vec2::new(0.0, y);
    let mut points = vec![centre];
    for ring in 1..=rings {
        let r = 2.0 * radius * ring as f64 / rings as f64;
        points.extend((0..around).map(|i| {
            centre
                + Vec2::unit(std::f64::consts::TAU * (i as f64 + 0.5 * (ring % 2) as f64) / around as f64) * r
        }));
    }
    let node = |ring: usize, i: usize| if ring == 0 { 0 } else { 1 + (ring - 1) * around + i % around };
    let mut connectivity = Vec::new();
    for ring in 0..rings {
        let shift = usize::from(ring % 2 == 1);
        for i in 0..around {
            let (a, b) = (node(ring, i), node(ring, i + 1));
            let (c, d) = (node(ring + 1, i + shift), node(ring + 1, i + shift + 1));
            if ring > 0 {
                connectivity.extend([a, b, if shift == 1 { c } else { node(ring + 1, i) }]);
                connectivity.extend(if shift == 1 {
                    [b, d, c]
                } else {
                    [b, node(ring + 1, i + 1), node(ring + 1, i)]
                });
            } else {
                connectivity.extend([0, node(1, i), node(1, i + 1)]);
            }
        }
    }
    let stresses: Vec<Stress> = connectivity
        .chunks(3)
        .map(|t: &[usize]| {
            let middle = t.iter().fold(Vec2::default(), |sum, &n| sum + points[n]) * (1.0 / 3.0);
            if (middle - centre).length() < radius { plastic } else { Stress::ZERO }
        })
        .collect();
    let grid = UnstructuredGrid {
        z: Vec::new(),
        points,
        cells: vec![CellBlock { shape: CellShape::Triangle, connectivity }],
        point_data: vec![],
        cell_data: vec![Array::stresses("plastic_stress_mpa", &stresses)],
    };
    PlasticField::from_grid(&grid).unwrap()
}

/// Fraction of the stress inside: elements of a quarter of the radius, cells that smear the edge
/// over a tenth of the radius, and (2/20)² for the surface and the ends of the mesh.
const DISC: f64 = 0.04;

/// A disc with the free in-plane expansion e is restrained by its surroundings: −μ e/(1 − ν) inside
/// in all directions of the plane; outside, −μ e/(1 − ν) (a/r)² radially and +μ e/(1 − ν) (a/r)²
/// circumferentially (Eshelby 1957, for a cylinder).
#[test]
fn a_field_on_foreign_triangles_balances_like_eshelbys_cylinder() {
    let growth = 1e-3;
    let plastic = elastic_stress_of(Stress { xx: growth, yy: growth, ..Stress::ZERO });
    let lines = |from: f64, count: usize| (0..=count).map(|i| from + 0.5 * i as f64).collect();
    let mesh = QuadMesh::new(lines(-20.0, 80), lines(-40.0, 80)).unwrap();
    let rail = BulkRail::new(mesh, &steel(), Boundary::HalfPlane).unwrap();
    let field = grown_disc(-20.0, plastic);
    let balanced = BalancedStress::new(&rail, |p| field.plastic_stress(p)).unwrap();
    let inside = -steel().shear_modulus() * growth / (1.0 - POISSON);
    let centre = Vec2::new(0.0, -20.0);
    let at = |x: f64, y: f64| balanced.stress(centre + Vec2::new(x, y));
    for (stress, xx, yy) in [
        (at(0.0, 0.0), inside, inside),
        (at(0.8, -0.7), inside, inside),
        (at(4.0, 0.0), 0.25 * inside, -0.25 * inside),
        (at(0.0, 3.0), -inside * 4.0 / 9.0, inside * 4.0 / 9.0),
    ] {
        let error = (stress.xx - xx).abs().max((stress.yy - yy).abs()) / inside.abs();
        println!("{stress:?}: {error:.4}");
        assert!(error < DISC, "{stress:?} for {xx}, {yy}");
    }
}
