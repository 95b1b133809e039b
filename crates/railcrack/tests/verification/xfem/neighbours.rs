//! Cracks near each other and near the surface, against the other engine with fine elements.

use crate::common::{Absolute, Meshed, close, joined_body, largest, polyline, sifs_of};
use railcrack::bulk::{BottomSupport, SideSupport};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::math::{RailBox, Stress};
use railcrack::xfem::{RailEnd, XfemSettings};

const MIXED: Stress = Stress { xx: 1.0, yy: 0.8, xy: 0.4, zz: 0.0 };
/// Elements, mm.
const SIZE: f64 = 0.1;
/// Elements of the other engine along each crack.
const FINE: usize = 160;

fn network(cracks: Vec<Crack>) -> CrackNetwork {
    CrackNetwork::new(cracks).unwrap()
}

/// Two cracks whose tips overlap by 1 mm, `gap` (mm) from each other.
fn overlapping(gap: f64) -> CrackNetwork {
    network(vec![
        polyline(&[(-3.513, -3.03), (0.487, -3.03)]),
        polyline(&[(-0.513, -3.03 - gap), (3.487, -3.03 - gap)]),
    ])
}

/// A tip that approaches the side of another crack, or the surface.
fn coming(gap: f64) -> CrackNetwork {
    network(vec![polyline(&[(-3.0, -2.53), (-gap, -2.53)]), polyline(&[(0.02, -1.04), (-0.03, -4.02)])])
}

fn under_the_surface(depth: f64) -> CrackNetwork {
    network(vec![polyline(&[(0.013, -3.017), (1.013, -depth)])])
}

/// Largest difference of K from the other engine, relative to the largest K, and the remarks.
fn misfit(network: &CrackNetwork, settings: XfemSettings) -> (f64, Vec<String>) {
    let meshed = Meshed { settings, ..Meshed::of_size(SIZE) };
    let body = meshed.body_of(network);
    let other = joined_body(network.cracks(), &[], FINE);
    let (k, want) = (sifs_of(&body, |_| MIXED), sifs_of(&other, |_| MIXED));
    let off = largest(k.iter().zip(&want).map(|(a, b)| a - b)) / largest(want.iter().copied());
    (off, body.remarks.to_vec())
}

/// A name, and the cracks as a function of the distance of a tip, mm.
type Case = (&'static str, fn(f64) -> CrackNetwork);

/// The warning that names the tip and its distance.
fn warned(remarks: &[String]) -> bool {
    remarks.iter().any(|remark| remark.contains("cannot be trusted"))
}

#[test]
fn tips_near_others_and_the_surface() {
    let cases: [Case; 3] =
        [("overlapping", overlapping), ("coming", coming), ("under the surface", under_the_surface)];
    for (elements, within) in [(6.0, 1e-3), (2.7, 1e-3), (1.4, 2e-3), (0.6, 1.2e-2)] {
        for (name, of_gap) in cases {
            let (off, remarks) = misfit(&of_gap(elements * SIZE), XfemSettings::default());
            println!("{name}, {elements} elements: {:.3} %", 100.0 * off);
            close(off, 0.0, Absolute(within), "0.03, 0.03, 0.05 and 0.75 % with elements of a fortieth");
            assert_eq!(warned(&remarks), elements < 1.0, "{name}, {elements} elements: {remarks:?}");
        }
    }
}

/// Cracks that pass through the same elements all along, so that tips end in elements that the
/// other crack cuts.
#[test]
fn several_cracks_in_one_element() {
    for (gap, within) in [(0.2, 1e-3), (0.1, 1e-2)] {
        let cracks = [0.0, gap].map(|x| polyline(&[(x, 0.0), (3.0 + x, -3.1)]));
        let (off, _) = misfit(&network(cracks.to_vec()), XfemSettings::default());
        println!("parallel, {gap} mm: {:.2} %", 100.0 * off);
        close(off, 0.0, Absolute(within), "1.4 and 0.7 elements between the faces: 0.02 and 0.67 %");
    }
}

/// Tips near the bottom and a side of a block, against elements of a sixth of their distance: the
/// domain of K ends at the block, and below three elements a warning says that it is too small.
#[test]
fn tips_near_the_ends_of_a_block() {
    let end = |bottom| RailEnd::Block {
        extent: RailBox { width: 24.0, depth: 12.0, centre: 0.0 },
        bottom,
        sides: SideSupport::Free,
    };
    const GAP: f64 = 0.6;
    let down = network(vec![polyline(&[(0.0, 0.0), (0.3, -12.0 + GAP)])]);
    let aside = network(vec![polyline(&[(7.0, -4.0), (12.0 - GAP, -5.0)])]);
    for network in [&down, &aside] {
        for bottom in [BottomSupport::Clamped, BottomSupport::Rollers] {
            let of = |elements: f64| {
                let body = Meshed { end: end(bottom), ..Meshed::of_size(GAP / elements) }.body_of(network);
                (sifs_of(&body, |_| MIXED), body.remarks.to_vec())
            };
            let (want, _) = of(6.0);
            for (elements, within) in [(3.2, 0.015), (2.9, 1.0), (2.1, 1.0), (1.2, 1.0)] {
                let (k, remarks) = of(elements);
                let off = largest(k.iter().zip(&want).map(|(a, b)| a - b)) / largest(want.iter().copied());
                println!("{bottom:?}, {elements} elements: {:.2} %", 100.0 * off);
                close(off, 0.0, Absolute(within), "the weight falls within an element or two");
                assert_eq!(warned(&remarks), elements < 3.0, "{elements} elements: {remarks:?}");
            }
        }
    }
}

/// K does not depend on the size of the domain, with a neighbour inside or not.
#[test]
fn domains_over_a_neighbour() {
    let network = overlapping(2.0 * SIZE);
    let off = [3.2, 4.5, 7.0]
        .map(|domain_outer| misfit(&network, XfemSettings { domain_outer, ..XfemSettings::default() }).0);
    close(largest(off), 0.0, Absolute(1e-3), "faces of the neighbour count in the domain: 0.03 %");
}
