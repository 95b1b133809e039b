//! Cracks of different lengths: the elements of each follow its own, and nothing depends on the
//! unit of length.

use crate::common::{
    Absolute, Meshed, Of, Rolling, close, joined_body, largest, polyline, sifs_of, surface_crack,
};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::fracture::Sif;
use railcrack::math::Stress;

const MIXED: Stress = Stress { xx: 1.0, yy: 0.8, xy: 0.4, zz: 0.0 };
/// Allowed difference between the engines, relative to the largest K of the crack.
const DIFFERENCE: f64 = 0.015;
/// Elements of the other engine along each crack.
const FINE: usize = 96;

/// The cracks of `cases/junction.toml`, the short one buried, and a short one on the surface behind
/// the mouth of the long one.
fn pairs() -> [(&'static str, Vec<Crack>); 2] {
    let long = surface_crack(0.0, 6.0, 15.0);
    [
        ("buried", vec![long.clone(), polyline(&[(6.3, -1.1), (6.3, -2.6)])]),
        ("on the surface", vec![long, surface_crack(2.0, 1.5, 30.0)]),
    ]
}

#[test]
fn a_short_crack_beside_a_long_one() {
    let alone = Meshed::still().body(&[surface_crack(0.0, 6.0, 15.0)]).dofs as f64;
    for (name, cracks) in pairs() {
        let meshed = Meshed::still().body(&cracks);
        let other = joined_body(&cracks, &[], FINE);
        let mut off = Vec::new();
        let (k, want) = (sifs_of(&meshed, |_| MIXED), sifs_of(&other, |_| MIXED));
        for (k, want) in k.chunks(2).zip(want.chunks(2)) {
            off.push(largest([k[0] - want[0], k[1] - want[1]]) / largest([want[0], want[1]]));
        }
        let rolling = Rolling::over(cracks.clone(), 0.1, 0.025);
        let histories = |body: &CrackedBody| -> Vec<Vec<Sif>> {
            let passages =
                rolling.on(&FaceProblem::new(body, &[0.1; 2]).unwrap(), &Newton::default()).passages;
            passages[passages.len() - 1].sifs.clone()
        };
        for (k, want) in histories(&meshed).iter().zip(histories(&other)) {
            let most = largest(k.iter().zip(&want).flat_map(|(a, b)| [a.ki - b.ki, a.kii - b.kii]));
            off.push(most / largest(want.iter().flat_map(|k| [k.ki, k.kii])));
        }
        println!("{name}: {off:.4?} of its own peak; {:.2} of the unknowns", meshed.dofs as f64 / alone);
        for off in off {
            close(off, 0.0, Absolute(DIFFERENCE), "thirty elements along the short crack");
        }
        // Elements of the short crack everywhere would be four to sixteen times as many.
        assert!((meshed.dofs as f64) < 2.5 * alone, "{name}: {} unknowns, {alone} alone", meshed.dofs);
    }
}

/// C is independent of the unit of length, K under a stress grows with the root of the size. A
/// power of two as factor changes no digits.
#[test]
fn unit_of_length() {
    let scaled = |crack: &[(f64, f64)], by: f64| {
        polyline(&crack.iter().map(|&(x, y)| (x * by, y * by)).collect::<Vec<_>>())
    };
    let body = |by: f64| {
        let cracks = [&[(0.0, 0.0), (3.0, -2.0)][..], &[(3.5, -1.2), (3.9, -2.8), (4.8, -3.1)]];
        let network = CrackNetwork::new(cracks.map(|crack| scaled(crack, by)).to_vec()).unwrap();
        Meshed::of_size(0.25 * by).body_of(&network)
    };
    let unit = body(1.0);
    let want = sifs_of(&unit, |_| MIXED);
    for by in [0.125f64, 16.0] {
        let body = body(by);
        let (c, other) = (&unit.compliance, &body.compliance);
        assert_eq!(c.rows(), other.rows(), "{by}: the number of face points depends on the unit");
        let entries = || (0..c.rows()).flat_map(|i| (0..c.rows()).map(move |j| (i, j)));
        let most = largest(entries().map(|at| c[at]));
        let off = largest(entries().map(|at| c[at] - other[at])) / most;
        close(off, 0.0, Absolute(1e-9), "round-off, compliance");
        let k = sifs_of(&body, |_| MIXED);
        let off = largest(k.iter().zip(&want).map(|(k, want)| k / by.sqrt() - want));
        close(off, 0.0, Of(1e-9, largest(want.iter().copied())), "round-off, K");
    }
}
