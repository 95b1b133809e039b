//! Nodes of the displacement jump along a crack.

use super::junctions::Core;
use crate::crack::{CrackCurve, End};
use crate::math::{Vec2, quantiles};

/// Resolution of the crack faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaceResolution {
    /// Elements along a straight crack, at least 4; mouth, tips, kinks and close neighbours add
    /// further ones.
    pub elements: usize,
}

impl FaceResolution {
    /// The default for `cracks` cracks: 28 elements each; networks share 132, but at least 22 each.
    /// Their errors stand in `docs/dev/numerics.md`.
    pub fn for_cracks(cracks: usize) -> Self {
        let elements = (NETWORK_ELEMENTS / cracks.max(1)).clamp(LEAST_ELEMENTS, Self::default().elements);
        Self { elements }
    }
}

/// Total number of elements of the cracks of a network, and the least number of each crack.
const NETWORK_ELEMENTS: usize = 132;
const LEAST_ELEMENTS: usize = 22;

impl Default for FaceResolution {
    fn default() -> Self {
        Self { elements: 28 }
    }
}

/// Length (mm) of the elements of `curve` at `g` away from everything that needs shorter ones.
pub(super) fn regular_element(curve: &CrackCurve, resolution: FaceResolution, g: f64) -> f64 {
    curve.ds(g) / base_density(curve, resolution)
}

/// Elements per unit of g.
fn base_density(curve: &CrackCurve, resolution: FaceResolution) -> f64 {
    let (start, end) = curve.range();
    resolution.elements.max(4) as f64 / (end - start)
}

/// A point of a crack curve that has nodes of its own and shorter elements around it.
struct GradingCentre {
    /// Arc length, mm.
    s: f64,
    /// Length of an element there, mm.
    element: f64,
    /// The nodes, in order.
    nodes: Vec<f64>,
}

/// Nodes in g, ends included: evenly spaced in g, denser at the mouth, at tips, at kinks, where the
/// jump has a corner singularity, at junctions, and where there is `room` (mm, by point) for short
/// elements only. A kink that is not slight lies inside a short element, so that every node has one
/// tangent. Where there is a core at a point of the crack (`core_at`, by the index of the point),
/// its edge, its inner edge and the junction on each side are nodes.
pub(super) fn nodes<'a>(
    curve: &CrackCurve,
    resolution: FaceResolution,
    core_at: impl Fn(usize) -> Option<&'a Core>,
    room: impl Fn(Vec2) -> f64,
) -> Vec<f64> {
    let (start, end) = curve.range();
    let vertices = curve.vertices();
    let segments = curve.segments();
    let base = base_density(curve, resolution);
    let coarseness = FaceResolution::default().elements as f64 / resolution.elements.max(4) as f64;
    let places = grading_centres(curve, resolution, core_at);
    let depth = (0..segments).map(|i| -curve.position(i, vertices[i + 1]).y).fold(0.0, f64::max);
    let flap = curve.is_surface_breaking() && depth < SHALLOW * curve.length();
    let kinks = |i: usize| i > 0 && i < segments && curve.turn(i) > SMALL_KINK;
    let tips = [
        (End::First, vertices[1] - start, kinks(1)),
        (End::Last, end - vertices[segments - 1], kinks(segments - 1)),
    ];
    let density = |g: f64, segment: usize| {
        let s = curve.s(g);
        let ds = curve.ds(g);
        let mut density = base;
        for place in &places {
            density = density.max(ds / (place.element + GRADING * (s - place.s).abs()));
        }
        let point = curve.position(segment, g);
        // Points that need short elements need equally short ones at a coarse resolution.
        density = density.max(ds / (coarseness.min(1.0) * room(point)));
        if curve.is_surface_breaking() {
            let below = (-point.y / depth).max(0.0).powf(MOUTH_POWER);
            let longest = (MOUTH_ELEMENT + MOUTH_GRADING * below) * depth;
            density = density.max(ds / (coarseness * longest));
            if flap {
                let thick = (FLAP_SHARE * -point.y).max(0.5 * MOUTH_ELEMENT * depth);
                density = density.max(ds / (coarseness.min(1.0) * thick));
            }
        }
        for (tip, last_segment, kinks) in tips.into_iter().filter(|(tip, ..)| curve.has_tip(*tip)) {
            let (distance, own) = match tip {
                End::First => (g - start, 0),
                End::Last => (end - g, segments - 1),
            };
            let longest = TIP_ELEMENT * (end - start) + TIP_GRADING * distance;
            density = density.max(1.0 / (coarseness * longest));
            if kinks && segment == own {
                density = density.max(TIP_ELEMENTS / coarseness / last_segment);
            }
        }
        density
    };
    let mut nodes = places[0].nodes.clone();
    for next in &places[1..] {
        let (a, b) = (nodes[nodes.len() - 1], next.nodes[0]);
        nodes.extend(quantiles(a, b, |g| density(g, curve.segment_at(g, &vertices))));
        nodes.extend(&next.nodes);
    }
    nodes
}

/// The places of `curve` around which elements are shorter, ends included.
fn grading_centres<'a>(
    curve: &CrackCurve,
    resolution: FaceResolution,
    core_at: impl Fn(usize) -> Option<&'a Core>,
) -> Vec<GradingCentre> {
    let (vertices, segments) = (curve.vertices(), curve.segments());
    let place = |i: usize| match core_at(i) {
        Some(core) => Some(core_place(curve, vertices[i], i, core)),
        None if i == 0 || i == segments => Some(GradingCentre {
            s: curve.arc_length_at(i),
            element: f64::INFINITY,
            nodes: vec![vertices[i]],
        }),
        None => kink_place(curve, i, regular_element(curve, resolution, vertices[i])),
    };
    (0..=segments).filter_map(place).collect()
}

/// The element across the kink at point `i`, where elements away from it are `element` (mm) long;
/// none at a slight kink.
fn kink_place(curve: &CrackCurve, i: usize, element: f64) -> Option<GradingCentre> {
    let angle = curve.turn(i);
    (angle > SMALL_KINK).then(|| {
        let s = curve.arc_length_at(i);
        let neighbours = (s - curve.arc_length_at(i - 1)).min(curve.arc_length_at(i + 1) - s);
        let across = (element * (KINK_ELEMENT / angle).min(0.5)).min(0.2 * neighbours);
        GradingCentre {
            s,
            element: across,
            nodes: vec![curve.g(s - 0.5 * across), curve.g(s + 0.5 * across)],
        }
    })
}

/// The nodes of `core` at point `i`, whose parameter is `g`.
fn core_place(curve: &CrackCurve, g: f64, i: usize, core: &Core) -> GradingCentre {
    let s = curve.arc_length_at(i);
    let mut nodes = Vec::new();
    if i > 0 {
        nodes.extend([curve.g(s - core.radius), curve.g(s - core.inner()), g]);
    }
    if i < curve.segments() {
        nodes.extend([g, curve.g(s + core.inner()), curve.g(s + core.radius)]);
    }
    GradingCentre { s, element: core.radius, nodes }
}

/// Kinks below this angle (radians) are smooth for the jump: their corner exponent is within 1e-3
/// of one.
const SMALL_KINK: f64 = 0.05;
/// Length of the element across a kink over that of the regular element, times the angle of the
/// kink (radians).
const KINK_ELEMENT: f64 = 0.01;
/// Growth of elements away from a kink or a junction: length per distance.
const GRADING: f64 = 0.35;
/// Longest element near the mouth, over the depth of the crack and at the default resolution: at
/// the mouth, and its increase with this power of the relative depth. The edge of the wheel contact
/// passes over the mouth, the stress there varies over its distance from the surface, and the
/// locked slip there affects the tip, so that half of all elements are there. Powers of 0.5 and 1
/// need more elements for the same error.
const MOUTH_ELEMENT: f64 = 0.002;
const MOUTH_GRADING: f64 = 0.27;
const MOUTH_POWER: f64 = 0.75;
/// Depth of a surface-breaking crack over its length, below which the steel above it is a thin flap
/// that bends: elements follow its thickness.
const SHALLOW: f64 = 0.06;
/// Largest length of an element below a flap over its thickness.
const FLAP_SHARE: f64 = 0.7;
/// Element at a tip in g, over the range of g, at the default resolution, and its increase per
/// distance in g. Slip ceases last at the tip: with elements of one size the locked K_II is 0.4 %
/// too small; half as many elements that grow away from the tip give the same error.
const TIP_ELEMENT: f64 = 0.004;
const TIP_GRADING: f64 = 0.35;
/// Least number of elements on the segment between a kink that is not slight and a tip, at the
/// default resolution.
const TIP_ELEMENTS: f64 = 14.0;
