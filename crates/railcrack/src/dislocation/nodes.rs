//! The nodes of the jumps along one crack.

use crate::crack::Walk;
use crate::math::{Vec2, quantiles};

/// How finely the faces are resolved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaceResolution {
    /// Elements along a straight crack, at least 4; mouth, kinks and close neighbours add their own.
    pub elements: usize,
}

impl FaceResolution {
    /// The default for `cracks` cracks: 48 elements each give K to 0.4 % of its peak; networks share 180, but at least 20
    /// each, which gives 0.8 % in the network of nine.
    pub fn for_cracks(cracks: usize) -> Self {
        Self { elements: (180 / cracks.max(1)).clamp(20, 48) }
    }
}

impl Default for FaceResolution {
    fn default() -> Self {
        Self { elements: 48 }
    }
}

/// Nodes in g, ends included: evenly spaced in g, closer at kinks, where the jump has a corner singularity, and
/// where `clearance` (mm, distance at a point to the nearest other crack) is small. A kink that matters lies
/// inside a short element, so that every node has one tangent.
pub(super) fn nodes(walk: &Walk, resolution: FaceResolution, clearance: impl Fn(Vec2) -> f64) -> Vec<f64> {
    let (start, end) = walk.range();
    let vertices = walk.vertices();
    let segments = walk.segments();
    let base = resolution.elements.max(4) as f64 / (end - start);
    let coarseness = FaceResolution::default().elements as f64 / resolution.elements.max(4) as f64;
    // (s of the kink, length of the element across it)
    let kinks: Vec<(f64, f64)> = (1..segments)
        .filter_map(|i| {
            let angle = walk.turn(i);
            let g = vertices[i];
            let element = walk.ds(g) / base;
            (angle > SMALL_KINK).then(|| {
                let neighbours = walk.from_first(i) - walk.from_first(i - 1);
                let neighbours = neighbours.min(walk.from_first(i + 1) - walk.from_first(i));
                let across = element * (KINK_ELEMENT / angle).min(0.5);
                (walk.from_first(i), across.min(0.2 * neighbours))
            })
        })
        .collect();
    let last_segment = [end - vertices[segments - 1], vertices[1] - start];
    let density = |g: f64, segment: usize| {
        let s = walk.s(g);
        let ds = walk.ds(g);
        let mut density = base;
        for &(at, across) in &kinks {
            density = density.max(ds / (across + KINK_GRADING * (s - at).abs()));
        }
        density = density.max(ds / (NEIGHBOUR_SHARE * clearance(walk.position(segment, g))));
        if walk.is_surface_breaking() {
            density = density.max(ds / (coarseness * (MOUTH_ELEMENT * walk.length() + MOUTH_GRADING * s)));
        }
        if segment == segments - 1 {
            density = density.max(TIP_ELEMENTS / coarseness / last_segment[0]);
        }
        if segment == 0 && !walk.is_surface_breaking() {
            density = density.max(TIP_ELEMENTS / coarseness / last_segment[1]);
        }
        density
    };
    let mut fixed = vec![start];
    for &(at, across) in &kinks {
        fixed.push(walk.g(at - 0.5 * across));
        fixed.push(walk.g(at + 0.5 * across));
    }
    fixed.push(end);
    let mut nodes = vec![start];
    for (k, pair) in fixed.windows(2).enumerate() {
        let (a, b) = (pair[0], pair[1]);
        if k % 2 == 0 {
            nodes.extend(quantiles(a, b, |g| density(g, walk.segment_at(g, &vertices))));
        }
        nodes.push(b);
    }
    nodes
}

/// Kinks below this angle (radians) are smooth for the jump: their corner exponent is within 1e-3 of one.
const SMALL_KINK: f64 = 0.05;
/// The element across a kink is this over the angle (radians), times the regular element.
const KINK_ELEMENT: f64 = 0.03;
/// Growth of elements away from a kink: length per distance.
const KINK_GRADING: f64 = 0.5;
/// Element at the mouth, over the length of the crack, at the default resolution. The edge of the wheel contact passes over the mouth, and the stress
/// there varies over its distance from the surface; mouths without this grading cost 1 % of the peak K.
const MOUTH_ELEMENT: f64 = 0.0017;
/// Growth of elements away from the mouth: length per distance.
const MOUTH_GRADING: f64 = 0.085;
/// Elements are shorter than this times the distance to another crack.
const NEIGHBOUR_SHARE: f64 = 1.0;
/// Elements, at least, on the segment that ends at a tip, at the default resolution.
const TIP_ELEMENTS: f64 = 17.0;
