//! Agreement of the two condensations, by dense border and by one factorisation.

use super::{Condensed, Elimination, System};
use crate::crack::{Crack, CrackNetwork};
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use crate::math::Matrix;
use crate::xfem::basis::Elasticity;
use crate::xfem::body::Discretisation;
use crate::xfem::border::{Border, face_jumps};
use crate::xfem::columns::ColumnStore;
use crate::xfem::sif::{SifContext, SifDomain, SifFunctional};
use crate::xfem::{MeshSettings, RailEnd, XfemEngine, XfemSettings};

/// A kinked crack, one that passes near it and a buried one.
fn network() -> CrackNetwork {
    let kinked = Crack::surface_breaking(0.0, 6.0, 0.3).unwrap();
    let kinked = kinked.extended(crate::crack::End::Last, 2.0, -0.6).unwrap();
    let beside = Crack::surface_breaking(0.7, 5.0, 0.3).unwrap();
    let inside = Crack::polyline(vec![crate::math::Vec2::new(9.0, -2.0), crate::math::Vec2::new(11.0, -2.6)]);
    CrackNetwork::new(vec![kinked, beside, inside.unwrap()]).unwrap()
}

fn largest_difference(a: &Matrix, b: &Matrix) -> f64 {
    let entries = || (0..a.rows()).flat_map(|i| a.row(i).iter().zip(b.row(i)));
    let peak = entries().fold(0.0f64, |m, (x, _)| m.max(x.abs()));
    entries().fold(0.0f64, |m, (x, y)| m.max((x - y).abs())) / peak
}

#[test]
fn dense_border_and_one_factorisation_agree() {
    // Measured 3e-9: functions that are linearly dependent to round-off amplify it.
    const ROUND_OFF: f64 = 5e-8;
    let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
    let (network, settings) = (network(), XfemSettings::default());
    let mesh = MeshSettings { element_size: 0.25, expected_growth: 1.0 };
    let mut engine = XfemEngine::new(&network, steel, mesh, RailEnd::HalfPlane { centre: 0.0 }, settings);
    let rail = engine.background(&network).unwrap();
    let Discretisation { cuts, sizes, space, interface } =
        Discretisation::new(rail.mesh(), &network, &settings).unwrap();
    let elasticity = Elasticity::new(steel);
    let border = Border::new(&cuts, &space, &elasticity, Interruption::NEVER).unwrap();
    let mesh = rail.mesh();
    let context =
        SifContext { mesh, cuts: &cuts, space: &space, interface: &interface, elasticity: &elasticity };
    let domain = |size: f64| SifDomain { inner: 1.5 * size, outer: 4.5 * size };
    let functionals: Vec<SifFunctional> =
        (0..sizes.len()).flat_map(|tip| context.functionals(tip, domain(sizes[tip]))).collect();
    let jumps = face_jumps(rail, &cuts, &space, &interface);
    let duality = interface.duality();
    let system = System {
        rail,
        space: &space,
        border: &border,
        jumps: &jumps,
        functionals: &functionals,
        duality: &duality,
    };
    let Condensed { compliance, sif_influence, elimination } =
        system.by_border(&mut ColumnStore::default(), Interruption::NEVER).unwrap();
    let together = system.together(Interruption::NEVER).unwrap();
    let c = largest_difference(&compliance, &together.compliance);
    let s = largest_difference(&sif_influence, &together.sif_influence);
    println!("C {c:.1e}, S {s:.1e}");
    assert!(c < ROUND_OFF && s < ROUND_OFF, "C {c:.1e}, S {s:.1e}");
    assert_eq!(sif_influence.rows(), 8, "two K of four tips");

    let tractions: Vec<f64> = (0..jumps.len()).map(|i| 100.0 + (i as f64).sin()).collect();
    let tractions = [tractions];
    let standard = |elimination: &Elimination| {
        let nodes = 0..rail.mesh().node_count();
        let unknowns = elimination.unknowns(rail, &tractions, nodes).unwrap();
        unknowns.standard.row(0)[..rail.order()].to_vec()
    };
    let (one, other) = (standard(&elimination), standard(&together.elimination));
    let u = largest_difference(
        &Matrix::from_fn(1, one.len(), |_, i| one[i]),
        &Matrix::from_fn(1, one.len(), |_, i| other[i]),
    );
    println!("u {u:.1e}");
    assert!(u < ROUND_OFF, "displacements {u:.1e}");
}
