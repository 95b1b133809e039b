//! Refined region of the mesh, and its grading.

use crate::crack::{Crack, CrackNetwork, CrackTip, End};
use crate::math::{RailBox, Vec2};
use crate::mesh::{MeshError, QuadMesh};

/// Fineness of the mesh, and the expected growth of the cracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshSettings {
    /// Size of the elements at the initial cracks, mm.
    pub element_size: f64,
    /// Final over initial length of the cracks for which the refined region makes room.
    pub expected_growth: f64,
}

/// Default number of elements along the longest crack: with 60, histories of single cracks are
/// accurate to 0.6 % of the peak |K|; the documented bound is 1 %.
const ELEMENTS_PER_CRACK: f64 = 60.0;
/// The same at kinked cracks: with 60, K_II behind a kink of 45° with little friction is wrong by
/// 1.1 % of the peak, with 75 by 0.6 %.
const ELEMENTS_PER_KINKED_CRACK: f64 = 75.0;
/// Default number of elements along the longest crack at straight cracks of a network of more than
/// [`FEW`]. At kinked cracks the error of K would reach 1.5 % of its peak in random networks.
const ELEMENTS_PER_CRACK_OF_MANY: f64 = 30.0;
/// Largest number of cracks that are each resolved like a single crack.
const FEW: usize = 3;
/// Default for the least number of elements along a shorter crack.
const FEWEST_ELEMENTS_PER_CRACK: f64 = 30.0;
/// Default for the least number of elements along the part of a crack between a tip and the last
/// kink before it: with 7, K_II of closed tips behind two kinks is wrong by up to 1.2 % of the peak
/// of the crack in random networks.
const ELEMENTS_PER_TIP_SEGMENT: f64 = 10.0;
/// Angle (radians) below which a kink is ignored.
const TURN: f64 = 0.05;
/// Default for the largest number of elements along a crack: a last part shorter than this requires
/// has fewer elements.
const MOST_ELEMENTS_PER_CRACK: f64 = 250.0;

/// Default size (mm) of the elements at each crack: a sixtieth of the longest crack (a 75th at a
/// kinked crack, a thirtieth at a straight one of more than three), a thirtieth of the crack itself
/// where that is less, and a tenth of the shortest part of it that ends at a tip, beyond which the
/// domain of the SIFs should not extend far.
pub fn default_element_sizes(network: &CrackNetwork) -> Vec<f64> {
    let cracks = network.cracks();
    let longest = cracks.iter().map(|crack| crack.length()).fold(0.0, f64::max);
    let common = |crack: &Crack| {
        let elements = match (is_straight(crack), cracks.len()) {
            (false, _) => ELEMENTS_PER_KINKED_CRACK,
            (true, ..=FEW) => ELEMENTS_PER_CRACK,
            (true, _) => ELEMENTS_PER_CRACK_OF_MANY,
        };
        longest / elements
    };
    let wanted = |(index, crack): (usize, &Crack)| {
        let length = crack.length();
        let tips = network.tips_of(index).into_iter();
        let parts = tips.map(|end| tip_part(crack, end) / ELEMENTS_PER_TIP_SEGMENT);
        let size = common(crack).min(length / FEWEST_ELEMENTS_PER_CRACK);
        parts.fold(size, f64::min).max(length / MOST_ELEMENTS_PER_CRACK)
    };
    cracks.iter().enumerate().map(wanted).collect()
}

/// Length (mm) of the crack from the tip `end` back to the first kink.
fn tip_part(crack: &Crack, end: End) -> f64 {
    let mut points = crack.points().to_vec();
    if end == End::Last {
        points.reverse();
    }
    let along = segments(&points);
    let turns = along.windows(2).take_while(|pair| goes_on(pair)).count();
    along[..=turns].iter().map(|part| part.length()).sum()
}

fn is_straight(crack: &Crack) -> bool {
    segments(crack.points()).windows(2).all(goes_on)
}

fn segments(points: &[Vec2]) -> Vec<Vec2> {
    points.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Whether a segment continues in the direction of the previous one.
fn goes_on(pair: &[Vec2]) -> bool {
    pair[0].cross(pair[1]).atan2(pair[0].dot(pair[1])).abs() <= TURN
}

/// Layers of the rail that elements must resolve along its whole length: those with plastic stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResolvedLayers {
    /// Depth of the lowest layer, mm.
    pub depth: f64,
    /// Largest height of the elements down to that depth, mm.
    pub height: f64,
}

/// The refined region of the mesh, around the cracks and where they are expected to grow. The
/// element size in it increases with the distance from each initial crack, because cracks that
/// reach such places have become longer.
#[derive(Debug, Clone, PartialEq)]
pub struct RefinedRegion {
    /// Lower left corner, mm.
    pub lower: Vec2,
    /// Upper right corner, mm.
    pub upper: Vec2,
    /// The initial cracks with their element sizes.
    cracks: Vec<Resolved>,
    layers: Option<ResolvedLayers>,
}

/// An initial crack and the size of its elements.
#[derive(Debug, Clone, PartialEq)]
struct Resolved {
    /// Size of the elements in its box, mm.
    element_size: f64,
    /// Its length, mm.
    length: f64,
    /// Its box, mm.
    bounds: (Vec2, Vec2),
    /// Abscissa of its mouth, mm; none for a buried crack.
    mouth: Option<f64>,
}

/// Element size at a mouth, over the crack: the edge of the wheel contact passes over the mouth,
/// and the stress on the faces there varies over its distance from the surface.
const MOUTH_ELEMENT: f64 = 1.0 / 300.0;
/// Growth of elements away from a mouth: length per distance.
const MOUTH_GRADING: f64 = 0.35;
/// Growth of elements outside of the refined region: length per distance. Quadratic elements follow
/// the decay of the field there.
const OUTER_GRADING: f64 = 0.4;
/// Angle (radians) of the branch for which the refined region makes room: kinks at ±70.5° maximise
/// the opening of a shear crack.
const BRANCH: f64 = 1.25;
/// Largest sum over the midpoints of the cells of a [`Grading`], over the integral.
const MISSED: f64 = 1.2;
/// Margin of the refined region around the cracks, in elements.
const MARGIN: f64 = 5.0;
/// Least number of elements between a tip and the edge of the refined region.
const CLEARANCE: f64 = 3.0;

impl RefinedRegion {
    /// The refined region of `network` with room for its growth, with elements of one size at all
    /// cracks.
    pub fn new(network: &CrackNetwork, settings: MeshSettings) -> Self {
        let sizes = vec![settings.element_size; network.cracks().len()];
        Self::with_sizes(network, &sizes, settings.expected_growth)
    }

    /// [`RefinedRegion::new`] with elements of `sizes[i]` (mm) at crack i: grid lines are as close
    /// as required by the crack whose box is nearest relative to its element size.
    pub fn with_sizes(network: &CrackNetwork, sizes: &[f64], expected_growth: f64) -> Self {
        let resolved = |(crack, &element_size): (&Crack, &f64)| Resolved {
            element_size,
            length: crack.length(),
            bounds: bounds(crack.points().iter().copied()),
            mouth: crack.is_surface_breaking().then(|| crack.points()[0].x),
        };
        let cracks: Vec<Resolved> = network.cracks().iter().zip(sizes).map(resolved).collect();
        let ahead = network.tips().into_iter().flat_map(|CrackTip { crack: index, end, .. }| {
            let crack = &network.cracks()[index];
            let far = (expected_growth - 1.0).max(0.0) * crack.length();
            let (tip, angle) = (crack.tip(end), crack.ahead(end).angle());
            [-BRANCH, 0.0, BRANCH].map(|turn| (index, tip + Vec2::unit(angle + turn) * far))
        });
        let points = network.cracks().iter().enumerate();
        let points =
            points.flat_map(|(index, crack)| crack.points().iter().map(move |&point| (index, point)));
        let margin = |index: usize| {
            Vec2::new(1.0, 1.0) * (MARGIN * cracks[index].element_size * expected_growth.max(1.0))
        };
        let boxes = points.chain(ahead).flat_map(|(i, point)| [point - margin(i), point + margin(i)]);
        let (lower, upper) = bounds(boxes);
        Self { lower, upper: Vec2::new(upper.x, upper.y.min(0.0)), cracks, layers: None }
    }

    /// This region with elements that also resolve `layers`.
    pub fn resolving(self, layers: ResolvedLayers) -> Self {
        Self { layers: Some(layers), ..self }
    }

    /// This region enlarged by half its size on every side.
    pub(crate) fn enlarged(&self) -> Self {
        let size = self.upper - self.lower;
        Self {
            lower: self.lower - size * 0.5,
            upper: Vec2::new(self.upper.x + 0.5 * size.x, (self.upper.y + 0.5 * size.y).min(0.0)),
            ..self.clone()
        }
    }

    /// Whether all tips of `network` lie inside with a margin.
    pub(crate) fn holds(&self, network: &CrackNetwork) -> bool {
        network.tips().into_iter().all(|tip| self.holds_point(network.cracks()[tip.crack].tip(tip.end)))
    }

    /// Whether a tip of `network` has left the refined region with the last segment of its crack.
    pub(crate) fn was_left_by(&self, network: &CrackNetwork) -> bool {
        network.tips().into_iter().any(|CrackTip { crack, end, .. }| {
            let crack = &network.cracks()[crack];
            let points = crack.points();
            let before = match end {
                End::First => points[1],
                End::Last => points[points.len() - 2],
            };
            !self.holds_point(crack.tip(end)) && self.holds_point(before)
        })
    }

    fn holds_point(&self, point: Vec2) -> bool {
        let space = CLEARANCE * self.size_x(point.x).max(self.size_y(point.y));
        point.x - self.lower.x >= space
            && self.upper.x - point.x >= space
            && point.y - self.lower.y >= space
            && (self.upper.y == 0.0 || self.upper.y - point.y >= space)
    }

    /// Distance (mm) that quadratic elements resolve at the tips of `network`: half of the smallest
    /// element there.
    pub(crate) fn resolution(&self, network: &CrackNetwork) -> f64 {
        let tips = network.tips().into_iter().map(|tip| network.cracks()[tip.crack].tip(tip.end));
        0.5 * tips.map(|tip| self.size_x(tip.x).max(self.size_y(tip.y))).fold(f64::INFINITY, f64::min)
    }

    /// Wanted width of an element at abscissa `x`, mm.
    fn size_x(&self, x: f64) -> f64 {
        let (lower, upper) = (self.lower.x, self.upper.x);
        let inside = x.clamp(lower, upper);
        let outside = (x - inside).abs();
        let at = |crack: &Resolved| crack.size_at(distance(inside, crack.bounds.0.x, crack.bounds.1.x));
        let fine = self.cracks.iter().map(at).fold(f64::INFINITY, f64::min) + OUTER_GRADING * outside;
        let at_mouth = |crack: &Resolved| Some(crack.mouth_size((x - crack.mouth?).abs()));
        self.cracks.iter().filter_map(at_mouth).fold(fine, f64::min)
    }

    /// Wanted height of an element at ordinate `y`, mm.
    fn size_y(&self, y: f64) -> f64 {
        let inside = y.clamp(self.lower.y, self.upper.y);
        let outside = (y - inside).abs();
        let at = |crack: &Resolved| crack.size_at(distance(inside, crack.bounds.0.y, crack.bounds.1.y));
        let fine = self.cracks.iter().map(at).fold(f64::INFINITY, f64::min) + OUTER_GRADING * outside;
        let at_mouth = |crack: &Resolved| crack.mouth.map(|_| crack.mouth_size(-y));
        let fine = self.cracks.iter().filter_map(at_mouth).fold(fine, f64::min);
        self.layers
            .map_or(fine, |layers| fine.min(layers.height + OUTER_GRADING * (-y - layers.depth).max(0.0)))
    }

    /// The mesh of `extent` that is refined in this region.
    ///
    /// Errors: more than [`MOST_MESH_UNKNOWNS`]; grid lines that coincide by round-off.
    pub fn mesh(&self, extent: RailBox) -> Result<QuadMesh, MeshError> {
        let (x, y) = self.gradings(extent);
        let unknowns = mesh_unknowns(&x, &y);
        if unknowns.is_nan() || unknowns > MOST_MESH_UNKNOWNS {
            return Err(MeshError::TooManyUnknowns { unknowns, most: MOST_MESH_UNKNOWNS });
        }
        QuadMesh::new(x.lines(), y.lines())
    }

    /// Displacement unknowns of the mesh of `extent`, computed without making it; infinite on
    /// overflow.
    pub fn mesh_unknowns(&self, extent: RailBox) -> f64 {
        let (x, y) = self.gradings(extent);
        mesh_unknowns(&x, &y)
    }

    /// A number of displacement unknowns that the mesh of `extent` does not exceed, in closed form:
    /// one over the smallest of several element sizes is at most the sum of one over each.
    pub fn most_mesh_unknowns(&self, extent: RailBox) -> f64 {
        // ∫ ds/(size + grading s) on both sides.
        let beside =
            |size: f64, grading: f64, length: f64| 2.0 / grading * (1.0 + grading * length / size).ln();
        let elements = |length: f64, width: fn(Vec2) -> f64| {
            let of = |crack: &Resolved| {
                let (size, width) = (crack.element_size, width(crack.bounds.1 - crack.bounds.0));
                let grading = (size / crack.length).min(OUTER_GRADING);
                let at_mouth =
                    crack.mouth.map_or(0.0, |_| beside(crack.mouth_size(0.0), MOUTH_GRADING, length));
                width / size + beside(size, grading, length) + at_mouth
            };
            MISSED * self.cracks.iter().map(of).sum::<f64>() + 2.0
        };
        let layers = self.layers.map_or(0.0, |layers| MISSED * extent.depth / layers.height);
        6.0 * elements(extent.width, |size| size.x) * (elements(extent.depth, |size| size.y) + layers)
    }

    fn gradings(&self, extent: RailBox) -> (Grading, Grading) {
        let (left, right) = extent.ends();
        (
            Grading::new(left, right, self.breaks(true), |x| self.size_x(x)),
            Grading::new(-extent.depth, 0.0, self.breaks(false), |y| self.size_y(y)),
        )
    }

    /// Coordinates at which the grading of the elements changes, with geometric steps away from
    /// them.
    fn breaks(&self, along_x: bool) -> Vec<f64> {
        let pick = |v: Vec2| if along_x { v.x } else { v.y };
        let mut origins = vec![pick(self.lower), pick(self.upper)];
        for crack in &self.cracks {
            origins.extend([pick(crack.bounds.0), pick(crack.bounds.1)]);
        }
        if along_x {
            origins.extend(self.cracks.iter().filter_map(|crack| crack.mouth));
        } else {
            origins.push(0.0);
            origins.extend(self.layers.map(|layers| -layers.depth));
        }
        origins.sort_by(f64::total_cmp);
        origins.dedup();
        let shortest = self.cracks.iter().map(|crack| crack.length).fold(f64::INFINITY, f64::min);
        let mut breaks = origins.clone();
        for origin in origins {
            let mut step = MOUTH_ELEMENT * shortest;
            while step < 1e6 * shortest {
                breaks.push(origin - step);
                breaks.push(origin + step);
                step *= 3.0;
            }
        }
        breaks
    }
}

impl Resolved {
    /// Size (mm) of the elements at this distance (mm) from its box; it increases because cracks
    /// that reach such places have become longer.
    fn size_at(&self, from_crack: f64) -> f64 {
        self.element_size * (1.0 + from_crack / self.length)
    }

    fn mouth_size(&self, from_mouth: f64) -> f64 {
        (MOUTH_ELEMENT * self.length).min(self.element_size) + MOUTH_GRADING * from_mouth
    }
}

fn bounds(points: impl Iterator<Item = Vec2>) -> (Vec2, Vec2) {
    let infinite = Vec2::new(f64::INFINITY, f64::INFINITY);
    points.fold((infinite, -infinite), |(lower, upper), p| {
        (Vec2::new(lower.x.min(p.x), lower.y.min(p.y)), Vec2::new(upper.x.max(p.x), upper.y.max(p.y)))
    })
}

fn distance(at: f64, from: f64, to: f64) -> f64 {
    (from - at).max(at - to).max(0.0)
}

/// Largest number of displacement unknowns of a mesh. Their factor has some 8e9 entries, or 60 GB,
/// the memory of a large workstation.
pub const MOST_MESH_UNKNOWNS: f64 = 5e7;

/// Two displacements at the three nodes that each rectangle of a large mesh adds.
fn mesh_unknowns(x: &Grading, y: &Grading) -> f64 {
    6.0 * x.elements() * y.elements()
}

/// Cumulative number of elements from an end of the mesh to each of the points `at`.
struct Grading {
    at: Vec<f64>,
    sums: Vec<f64>,
}

impl Grading {
    /// The grading from `from` to `to` for elements of `size`.
    fn new(from: f64, to: f64, mut breaks: Vec<f64>, size: impl Fn(f64) -> f64) -> Self {
        const CELLS: usize = 24;
        breaks.retain(|&b| b > from && b < to);
        breaks.extend([from, to]);
        breaks.sort_by(f64::total_cmp);
        let mut at = vec![from];
        let mut sums = vec![0.0];
        for pair in breaks.windows(2) {
            let step = (pair[1] - pair[0]) / CELLS as f64;
            if step <= 0.0 {
                continue;
            }
            for cell in 0..CELLS {
                let middle = pair[0] + (cell as f64 + 0.5) * step;
                sums.push(sums[sums.len() - 1] + step / size(middle));
                at.push(if cell + 1 == CELLS { pair[1] } else { pair[0] + (cell + 1) as f64 * step });
            }
        }
        Self { at, sums }
    }

    fn elements(&self) -> f64 {
        self.sums[self.sums.len() - 1].ceil().max(2.0)
    }

    /// The grid lines, ends included.
    fn lines(&self) -> Vec<f64> {
        let Self { at, sums } = self;
        let total = sums[sums.len() - 1];
        let count = self.elements() as usize;
        let mut lines = vec![at[0]];
        lines.extend((1..count).map(|k| {
            let want = total * k as f64 / count as f64;
            let cell = sums.partition_point(|&sum| sum <= want).clamp(1, sums.len() - 1) - 1;
            at[cell] + (at[cell + 1] - at[cell]) * ((want - sums[cell]) / (sums[cell + 1] - sums[cell]))
        }));
        lines.push(at[at.len() - 1]);
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_that_no_machine_holds_is_refused_before_it_is_made() {
        let network = CrackNetwork::from(Crack::surface_breaking(0.0, 1.0, 0.5).unwrap());
        let outline = RailBox { depth: 150.0, ..RailBox::default() };
        for element_size in [1e-300, 1e-12, 1e-9, 1e-5] {
            let refined = RefinedRegion::new(&network, MeshSettings { element_size, expected_growth: 1.0 });
            assert!(refined.mesh_unknowns(outline) > MOST_MESH_UNKNOWNS);
            assert!(matches!(refined.mesh(outline), Err(MeshError::TooManyUnknowns { .. })));
        }
        for (length, element_size) in [(1.0, 0.05), (1e-3, 1e-4), (100.0, 0.3), (0.1, 5.0)] {
            let network = CrackNetwork::from(Crack::surface_breaking(0.0, length, 0.5).unwrap());
            let refined = RefinedRegion::new(&network, MeshSettings { element_size, expected_growth: 1.5 });
            let (exact, most) = (refined.mesh_unknowns(outline), refined.most_mesh_unknowns(outline));
            assert!(exact <= most && most < 50.0 * exact, "{exact} {most}");
        }
        let refined = RefinedRegion::new(&network, MeshSettings { element_size: 0.05, expected_growth: 1.0 });
        let made = 2.0 * refined.mesh(outline).unwrap().node_count() as f64;
        assert!((refined.mesh_unknowns(outline) / made - 1.0).abs() < 0.05);
    }
}
