//! The walk along one crack: arc length, the square-root parameter of its tips, and the nodes.

use crate::crack::Crack;
use crate::math::Vec2;

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

/// A crack walked in the parameter g in which a jump that vanishes like √r at a tip is linear.
///
/// Surface crack of length L: s = L − g², g from −√L at the mouth to 0 at the tip. Buried crack: s = L sin²(g/2), g
/// from 0 at the first tip to π at the last.
#[derive(Debug, Clone)]
pub(super) struct Walk {
    points: Vec<Vec2>,
    tangents: Vec<Vec2>,
    /// Arc length from the first point, for each point.
    from_first: Vec<f64>,
    /// Arc length from the last point, for each point: exact near the tip.
    from_last: Vec<f64>,
    surface_breaking: bool,
}

impl Walk {
    pub(super) fn new(crack: &Crack) -> Self {
        let points = crack.points().to_vec();
        let lengths: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).length()).collect();
        let tangents = points.windows(2).map(|p| (p[1] - p[0]).normalised()).collect();
        let mut from_first = vec![0.0];
        for length in &lengths {
            from_first.push(from_first[from_first.len() - 1] + length);
        }
        let mut from_last = vec![0.0];
        for length in lengths.iter().rev() {
            from_last.push(from_last[from_last.len() - 1] + length);
        }
        from_last.reverse();
        Self { points, tangents, from_first, from_last, surface_breaking: crack.is_surface_breaking() }
    }

    pub(super) fn is_surface_breaking(&self) -> bool {
        self.surface_breaking
    }

    pub(super) fn first_point(&self) -> Vec2 {
        self.points[0]
    }

    pub(super) fn length(&self) -> f64 {
        self.from_last[0]
    }

    /// The range of g.
    pub(super) fn range(&self) -> (f64, f64) {
        if self.surface_breaking { (-self.length().sqrt(), 0.0) } else { (0.0, std::f64::consts::PI) }
    }

    /// dg/d√r at a tip.
    pub(super) fn root_slope(&self) -> f64 {
        if self.surface_breaking { 1.0 } else { 2.0 / self.length().sqrt() }
    }

    /// Arc length from the first point.
    pub(super) fn s(&self, g: f64) -> f64 {
        if self.surface_breaking { self.length() - g * g } else { self.length() * (0.5 * g).sin().powi(2) }
    }

    /// ds/dg, not negative.
    pub(super) fn ds(&self, g: f64) -> f64 {
        if self.surface_breaking { -2.0 * g } else { 0.5 * self.length() * g.sin() }
    }

    /// The parameter at arc length `s` from the first point.
    fn g(&self, s: f64) -> f64 {
        if self.surface_breaking {
            -(self.length() - s).max(0.0).sqrt()
        } else {
            2.0 * (s / self.length()).clamp(0.0, 1.0).sqrt().asin()
        }
    }

    pub(super) fn tangent(&self, segment: usize) -> Vec2 {
        self.tangents[segment]
    }

    /// The parameter at the start of each segment, and at the end of the last.
    pub(super) fn vertices(&self) -> Vec<f64> {
        let (start, end) = self.range();
        let n = self.points.len();
        (0..n)
            .map(|i| match i {
                0 => start,
                i if i == n - 1 => end,
                i if self.surface_breaking => -self.from_last[i].sqrt(),
                i => self.g(self.from_first[i]),
            })
            .collect()
    }

    /// The point at `g`, which lies on `segment`.
    pub(super) fn position(&self, segment: usize, g: f64) -> Vec2 {
        let tangent = self.tangents[segment];
        if self.surface_breaking {
            self.points[segment + 1] - tangent * (g * g - self.from_last[segment + 1])
        } else if g < 0.5 * std::f64::consts::PI {
            self.points[segment] + tangent * (self.s(g) - self.from_first[segment])
        } else {
            let r = self.length() * (0.5 * g).cos().powi(2);
            self.points[segment + 1] - tangent * (r - self.from_last[segment + 1])
        }
    }

    /// Nodes in g, ends included: evenly spaced in g, closer at kinks, where the jump has a corner singularity, and
    /// where `clearance` (mm, distance at a point to the nearest other crack) is small. A kink that matters lies
    /// inside a short element, so that every node has one tangent.
    pub(super) fn nodes(&self, resolution: FaceResolution, clearance: impl Fn(Vec2) -> f64) -> Vec<f64> {
        let (start, end) = self.range();
        let vertices = self.vertices();
        let segments = self.tangents.len();
        let base = resolution.elements.max(4) as f64 / (end - start);
        let coarseness = FaceResolution::default().elements as f64 / resolution.elements.max(4) as f64;
        // (s of the kink, length of the element across it)
        let kinks: Vec<(f64, f64)> = (1..segments)
            .filter_map(|i| {
                let angle = self.tangents[i - 1].cross(self.tangents[i]).asin().abs();
                let turned_back = self.tangents[i - 1].dot(self.tangents[i]) < 0.0;
                let angle = if turned_back { std::f64::consts::PI - angle } else { angle };
                let g = vertices[i];
                let element = self.ds(g) / base;
                (angle > SMALL_KINK).then(|| {
                    let neighbours = self.from_first[i] - self.from_first[i - 1];
                    let neighbours = neighbours.min(self.from_first[i + 1] - self.from_first[i]);
                    let across = element * (KINK_ELEMENT / angle).min(0.5);
                    (self.from_first[i], across.min(0.2 * neighbours))
                })
            })
            .collect();
        let last_segment = [end - vertices[segments - 1], vertices[1] - start];
        let density = |g: f64, segment: usize| {
            let s = self.s(g);
            let ds = self.ds(g);
            let mut density = base;
            for &(at, across) in &kinks {
                density = density.max(ds / (across + KINK_GRADING * (s - at).abs()));
            }
            density = density.max(ds / (NEIGHBOUR_SHARE * clearance(self.position(segment, g))));
            if self.surface_breaking {
                density =
                    density.max(ds / (coarseness * (MOUTH_ELEMENT * self.length() + MOUTH_GRADING * s)));
            }
            if segment == segments - 1 {
                density = density.max(TIP_ELEMENTS / coarseness / last_segment[0]);
            }
            if segment == 0 && !self.surface_breaking {
                density = density.max(TIP_ELEMENTS / coarseness / last_segment[1]);
            }
            density
        };
        let mut fixed = vec![start];
        for &(at, across) in &kinks {
            fixed.push(self.g(at - 0.5 * across));
            fixed.push(self.g(at + 0.5 * across));
        }
        fixed.push(end);
        let mut nodes = vec![start];
        for (k, pair) in fixed.windows(2).enumerate() {
            let (a, b) = (pair[0], pair[1]);
            if k % 2 == 0 {
                nodes.extend(quantiles(a, b, |g| density(g, self.segment_at(g, &vertices))));
            }
            nodes.push(b);
        }
        nodes
    }

    /// The segment on which g lies.
    pub(super) fn segment_at(&self, g: f64, vertices: &[f64]) -> usize {
        vertices[1..vertices.len() - 1].partition_point(|&v| v < g)
    }
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

/// Interior points that divide [a, b] into equal integrals of `density`, their number its rounded integral.
fn quantiles(a: f64, b: f64, density: impl Fn(f64) -> f64) -> Vec<f64> {
    const CELLS: usize = 400;
    let step = (b - a) / CELLS as f64;
    let mut sums = vec![0.0];
    for i in 0..CELLS {
        sums.push(sums[i] + step * density(a + (i as f64 + 0.5) * step));
    }
    let total = sums[CELLS];
    // A hair below the ceiling so that a uniform density gives exactly its own number.
    let count = (total - 1e-6).ceil().max(1.0) as usize;
    (1..count)
        .map(|k| {
            let want = total * k as f64 / count as f64;
            let cell = sums.partition_point(|&sum| sum <= want).clamp(1, CELLS) - 1;
            a + step * (cell as f64 + (want - sums[cell]) / (sums[cell + 1] - sums[cell]))
        })
        .collect()
}
