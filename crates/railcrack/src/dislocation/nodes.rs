//! Nodes of the displacement jump along a crack.

use super::junctions::Core;
use crate::crack::{End, Walk};
use crate::math::{Vec2, quantiles};

/// Resolution of the crack faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaceResolution {
    /// Elements along a straight crack, at least 4; mouth, kinks and close neighbours add further
    /// ones.
    pub elements: usize,
}

impl FaceResolution {
    /// Default for `cracks` cracks: 48 elements each give K to 0.4 % of its peak; networks share
    /// 180, but at least 28 each: in the network of nine 0.3 % from 48 each, where 24 are 0.5 % and
    /// 20 are 1.0 % away.
    pub fn for_cracks(cracks: usize) -> Self {
        Self { elements: (180 / cracks.max(1)).clamp(28, 48) }
    }
}

impl Default for FaceResolution {
    fn default() -> Self {
        Self { elements: 48 }
    }
}

/// Length (mm) of the elements of `walk` at `g` away from everything that needs shorter ones.
pub(super) fn regular_element(walk: &Walk, resolution: FaceResolution, g: f64) -> f64 {
    walk.ds(g) / base_density(walk, resolution)
}

/// Elements per unit of g.
fn base_density(walk: &Walk, resolution: FaceResolution) -> f64 {
    let (start, end) = walk.range();
    resolution.elements.max(4) as f64 / (end - start)
}

/// A place of a walk with nodes of its own, around which elements are shorter.
struct Place {
    /// Arc length, mm.
    s: f64,
    /// Length of an element there, mm.
    element: f64,
    /// The nodes, in order.
    nodes: Vec<f64>,
}

/// Nodes in g, ends included: evenly spaced in g, denser at kinks, where the jump has a corner
/// singularity, at junctions, and where there is `room` (mm, by point) for short elements only. A
/// kink that is not slight lies inside a short element, so that every node has one tangent. Where
/// there is a core at a point of the crack (`core_at`, by the index of the point), its edge, its
/// inner edge and the junction on each side are nodes.
pub(super) fn nodes<'a>(
    walk: &Walk,
    resolution: FaceResolution,
    core_at: impl Fn(usize) -> Option<&'a Core>,
    room: impl Fn(Vec2) -> f64,
) -> Vec<f64> {
    let (start, end) = walk.range();
    let vertices = walk.vertices();
    let segments = walk.segments();
    let base = base_density(walk, resolution);
    let coarseness = FaceResolution::default().elements as f64 / resolution.elements.max(4) as f64;
    let place = |i: usize| match core_at(i) {
        Some(core) => Some(core_place(walk, vertices[i], i, core)),
        None if i == 0 || i == segments => {
            Some(Place { s: walk.from_first(i), element: f64::INFINITY, nodes: vec![vertices[i]] })
        }
        None => kink_place(walk, i, regular_element(walk, resolution, vertices[i])),
    };
    let places: Vec<Place> = (0..=segments).filter_map(place).collect();
    let depth = (0..segments).map(|i| -walk.position(i, vertices[i + 1]).y).fold(0.0, f64::max);
    let flap = walk.is_surface_breaking() && depth < SHALLOW * walk.length();
    let last_segment = [end - vertices[segments - 1], vertices[1] - start];
    let density = |g: f64, segment: usize| {
        let s = walk.s(g);
        let ds = walk.ds(g);
        let mut density = base;
        for place in &places {
            density = density.max(ds / (place.element + GRADING * (s - place.s).abs()));
        }
        let point = walk.position(segment, g);
        // What needs short elements needs them as short in a coarse resolution.
        density = density.max(ds / (coarseness.min(1.0) * room(point)));
        if walk.is_surface_breaking() {
            let at_mouth = MOUTH_ELEMENT * walk.length();
            density = density.max(ds / (coarseness * (at_mouth + MOUTH_GRADING * s)));
            if flap {
                let thick = (FLAP_SHARE * -point.y).max(0.5 * at_mouth);
                density = density.max(ds / (coarseness.min(1.0) * thick));
            }
        }
        if segment == segments - 1 && walk.has_tip(End::Last) {
            density = density.max(TIP_ELEMENTS / coarseness / last_segment[0]);
        }
        if segment == 0 && walk.has_tip(End::First) {
            density = density.max(TIP_ELEMENTS / coarseness / last_segment[1]);
        }
        density
    };
    let mut nodes = places[0].nodes.clone();
    for next in &places[1..] {
        let (a, b) = (nodes[nodes.len() - 1], next.nodes[0]);
        nodes.extend(quantiles(a, b, |g| density(g, walk.segment_at(g, &vertices))));
        nodes.extend(&next.nodes);
    }
    nodes
}

/// The element across the kink at point `i`, where elements away from it are `element` (mm) long;
/// none at a slight kink.
fn kink_place(walk: &Walk, i: usize, element: f64) -> Option<Place> {
    let angle = walk.turn(i);
    (angle > SMALL_KINK).then(|| {
        let s = walk.from_first(i);
        let neighbours = (s - walk.from_first(i - 1)).min(walk.from_first(i + 1) - s);
        let across = (element * (KINK_ELEMENT / angle).min(0.5)).min(0.2 * neighbours);
        Place { s, element: across, nodes: vec![walk.g(s - 0.5 * across), walk.g(s + 0.5 * across)] }
    })
}

/// The nodes of `core` at point `i`, whose parameter is `g`.
fn core_place(walk: &Walk, g: f64, i: usize, core: &Core) -> Place {
    let s = walk.from_first(i);
    let mut nodes = Vec::new();
    if i > 0 {
        nodes.extend([walk.g(s - core.radius), walk.g(s - core.inner()), g]);
    }
    if i < walk.segments() {
        nodes.extend([g, walk.g(s + core.inner()), walk.g(s + core.radius)]);
    }
    Place { s, element: core.radius, nodes }
}

/// Kinks below this angle (radians) are smooth for the jump: their corner exponent is within 1e-3
/// of one.
const SMALL_KINK: f64 = 0.05;
/// Length of the element across a kink: this over the angle (radians), times the regular element.
const KINK_ELEMENT: f64 = 0.03;
/// Growth of elements away from a kink or a junction: length per distance.
const GRADING: f64 = 0.5;
/// Element at the mouth, over the length of the crack, at the default resolution. The edge of the
/// wheel contact passes over the mouth, and the stress there varies over its distance from the
/// surface; without this grading the error is 1 % of the peak K.
const MOUTH_ELEMENT: f64 = 0.0017;
/// Growth of elements away from the mouth: length per distance.
const MOUTH_GRADING: f64 = 0.085;
/// Depth of a surface-breaking crack over its length, below which the steel above it is a thin flap
/// that bends: elements follow its thickness. At 3° and 2° K is 0.5 % off, without this 0.9 and 3
/// %; from 4° on it is not needed.
const SHALLOW: f64 = 0.06;
/// Largest length of an element below a flap over its thickness.
const FLAP_SHARE: f64 = 0.7;
/// Least number of elements on the segment that ends at a tip, at the default resolution.
const TIP_ELEMENTS: f64 = 17.0;
