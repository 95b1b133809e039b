//! Mirrored cracks, cracks far apart, number of threads, and bodies computed after others.

use crate::common::{
    Absolute, Meshed, Of, Rolling, TENSION, close, largest, sifs_under, steel, surface_crack,
};
use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::bulk::{Boundary, BulkRail};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::growth::StabilisedPassage;
use railcrack::math::Matrix;
use railcrack::math::RailBox;
use railcrack::xfem::{MeshSettings, RefinedRegion, XfemSettings, cracked_body};
use std::sync::Arc;

fn samples(result: &StabilisedPassage) -> Vec<(f64, f64)> {
    let passage = &result.passages[result.passages.len() - 1];
    passage.sifs.iter().flatten().map(|k| (k.ki, k.kii)).collect()
}

/// Difference of K of mirrored cases over its peak: round-off.
const MIRROR: f64 = 2e-11;

/// Mirrored cracks, wheel–rail friction and travel: the same history with the other sign of K_II.
/// The mesh is mirrored to round-off.
#[test]
fn mirrored_passage() {
    for (degrees, friction, wheel) in [(15.0, 0.5, 0.025), (45.0, 0.8, -0.4)] {
        let mut rolling = Rolling::meshed(vec![surface_crack(0.0, 6.0, degrees)], friction, wheel);
        rolling.engine = crate::common::RollingEngine::Xfem(Meshed::still());
        let mut mirrored = rolling.clone();
        mirrored.cracks = vec![surface_crack(0.0, 6.0, 180.0 - degrees)];
        mirrored.wheel_friction = -wheel;
        mirrored.travel = -1.0;
        let (k, m) = (samples(&rolling.solve()), samples(&mirrored.solve()));
        let peak = largest(k.iter().flat_map(|k| [k.0, k.1]));
        let difference = largest(k.iter().zip(&m).flat_map(|(a, b)| [a.0 - b.0, a.1 + b.1])) / peak;
        println!("{degrees}°: {difference:.1e}");
        close(difference, 0.0, Absolute(MIRROR), "round-off");
    }
}

/// Effect on K of a crack 20 lengths away, relative to K_I.
const APART: f64 = 1e-2;

/// The single crack is computed on the mesh of the pair.
#[test]
fn far_apart() {
    const LENGTH: f64 = 6.0;
    for degrees in [15.0, 90.0] {
        let crack = surface_crack(0.0, LENGTH, degrees);
        let pair = CrackNetwork::new(vec![crack.clone(), crack.moved(20.0 * LENGTH)]).unwrap();
        let settings = MeshSettings { element_size: LENGTH / 12.0, expected_growth: 1.0 };
        let outline = RailBox { width: 6000.0, depth: 3000.0, centre: 0.0 };
        let mesh = RefinedRegion::new(&pair, settings).mesh(outline).unwrap();
        let rail = Arc::new(BulkRail::new(mesh, &steel(), Boundary::HalfPlane).unwrap());
        let sifs = |network: &CrackNetwork| {
            sifs_under(&cracked_body(&rail, network, XfemSettings::default()).unwrap(), |_| TENSION)
        };
        let (single, pair) = (sifs(&crack.into()), sifs(&pair));
        let difference = largest((0..4).map(|i| pair[i] - single[i % 2])) / single[0];
        println!("{degrees}°: {:.3} %", 100.0 * difference);
        close(difference, 0.0, Of(APART, 1.0), "twenty lengths apart");
    }
}

fn matrices(body: &CrackedBody) -> (Matrix, Matrix, Matrix) {
    (body.compliance.clone(), body.stiffness.clone(), body.sif_influence.clone())
}

fn kinked(kink: f64) -> Crack {
    surface_crack(0.0, 5.0, 30.0).extended(End::Last, kink, -0.9).unwrap()
}

#[test]
fn same_bits_with_any_number_of_threads() {
    let with_threads = |number: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(number).build().unwrap();
        let cracks = [kinked(1.0), surface_crack(-1.0, 4.0, 150.0)];
        pool.install(|| matrices(&Meshed::of_size(0.15).body(&cracks)))
    };
    assert!(with_threads(1) == with_threads(3), "a body depends on the number of threads");
}

/// An engine that has computed other bodies gives the next one like a fresh engine.
#[test]
fn same_bits_after_other_cracks() {
    let meshed = Meshed { element_size: Some(0.15), expected_growth: 1.5, ..Meshed::default() };
    let first = vec![kinked(1.0)];
    let later: Vec<Crack> = vec![first[0].extended(End::Last, 0.3, 0.4).unwrap()];
    let network = |cracks: &[Crack]| CrackNetwork::new(cracks.to_vec()).unwrap();
    let mut warm = meshed.engine(&first);
    for cracks in [&first, &vec![first[0].extended(End::Last, 0.3, -0.2).unwrap()], &first] {
        warm.body(&network(cracks)).unwrap();
    }
    let mut cold = meshed.engine(&first);
    let bodies = [warm.body(&network(&later)).unwrap(), cold.body(&network(&later)).unwrap()];
    assert!(matrices(&bodies[0]) == matrices(&bodies[1]), "a body depends on those before");
}
