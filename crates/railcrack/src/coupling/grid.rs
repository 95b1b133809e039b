//! Nodes of the running surface, graded towards the mouths of the cracks.

use crate::math::quantiles;

/// The running surface as parts between nodes, on which the pressure is linear. Each mouth has two
/// nodes, one for each lip, because the lips sink by different amounts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SurfaceGrid {
    /// Abscissae of the nodes, mm, increasing; the two nodes of a mouth have the same.
    pub nodes: Vec<f64>,
    /// The parts between nodes.
    pub segments: Vec<SurfaceSegment>,
}

/// A part of the running surface between two nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SurfaceSegment {
    /// Its ends, mm.
    pub range: (f64, f64),
    /// The nodes at its ends.
    pub nodes: [usize; 2],
}

impl SurfaceSegment {
    pub fn length(&self) -> f64 {
        self.range.1 - self.range.0
    }

    pub fn middle(&self) -> f64 {
        0.5 * (self.range.0 + self.range.1)
    }
}

/// Spacing of the nodes, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NodeSpacing {
    /// At a mouth.
    pub at_mouth: f64,
    /// Away from the mouths.
    pub away: f64,
    /// Distance from the mouths up to which `away` is the largest spacing.
    pub near: f64,
}

impl NodeSpacing {
    /// The spacing at a `distance` (mm) from the nearest mouth where `longest` is the largest near
    /// the mouths.
    fn at(&self, distance: f64, longest: f64) -> f64 {
        let beyond = GROWTH * (distance - self.near).max(0.0);
        longest.min(self.at_mouth + GROWTH * distance) + beyond.min(FAR * self.away)
    }
}

/// Growth of the spacing with the distance from a mouth.
const GROWTH: f64 = 0.15;
/// Spacing added far away from the mouths, over that away from them. The nodes carry only what
/// differs from the pressure on the uncracked rail, which is little there.
const FAR: f64 = 3.0;
/// Number of parts between two mouths, at least.
const BETWEEN_MOUTHS: f64 = 8.0;

impl SurfaceGrid {
    /// The surface over `range` (mm) with `mouths` (mm, increasing) inside it.
    pub fn new(range: (f64, f64), mouths: &[f64], spacing: NodeSpacing) -> Self {
        let mut ends = vec![range.0];
        ends.extend(mouths);
        ends.push(range.1);
        let mut grid = Self { nodes: Vec::new(), segments: Vec::new() };
        for (k, pair) in ends.windows(2).enumerate() {
            let (from, to) = (pair[0], pair[1]);
            let flap = k > 0 && k + 2 < ends.len();
            let longest = if flap { spacing.away.min((to - from) / BETWEEN_MOUTHS) } else { spacing.away };
            let density = |x: f64| {
                let distance = mouths.iter().map(|mouth| (x - mouth).abs()).fold(f64::INFINITY, f64::min);
                1.0 / spacing.at(distance, longest)
            };
            let first = grid.nodes.len();
            grid.nodes.push(from);
            grid.nodes.extend(quantiles(from, to, density));
            grid.nodes.push(to);
            for node in first..grid.nodes.len() - 1 {
                let range = (grid.nodes[node], grid.nodes[node + 1]);
                grid.segments.push(SurfaceSegment { range, nodes: [node, node + 1] });
            }
        }
        grid
    }

    /// ∫ψ dx, ∫ψ (x − x_i) dx and ∫ψ (x − x_i)² dx (mm, mm², mm³) of each node.
    pub fn moments(&self) -> Vec<[f64; 3]> {
        let mut moments = vec![[0.0; 3]; self.nodes.len()];
        for segment in &self.segments {
            let h = segment.length();
            for (node, side) in segment.nodes.into_iter().zip([1.0, -1.0]) {
                let [length, first, second] = &mut moments[node];
                *length += h / 2.0;
                *first += side * h * h / 6.0;
                *second += h * h * h / 12.0;
            }
        }
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: NodeSpacing = NodeSpacing { at_mouth: 0.1, away: 0.4, near: 5.0 };

    #[test]
    fn nodes_are_dense_at_mouths_and_between_them() {
        let grid = SurfaceGrid::new((-10.0, 12.0), &[0.0, 1.0], SPACING);
        let mouths: Vec<usize> =
            (1..grid.nodes.len()).filter(|&i| grid.nodes[i] == grid.nodes[i - 1]).collect();
        assert_eq!(mouths.iter().map(|&i| grid.nodes[i]).collect::<Vec<f64>>(), [0.0, 1.0]);
        assert!(mouths[1] - mouths[0] > 6);
        let longest = |from: f64, to: f64| {
            let inside = grid.segments.iter().filter(|part| from <= part.range.0 && part.range.1 <= to);
            inside.map(SurfaceSegment::length).fold(0.0, f64::max)
        };
        assert!((0.95..1.01).contains(&(longest(-5.0, 6.0) / SPACING.away)), "{grid:?}");
        // Growth over the 5 mm between the end of the fine part and that of the surface.
        let far = longest(-10.0, -5.0) / (SPACING.away + 5.0 * GROWTH);
        assert!((0.8..1.0).contains(&far), "{far}");
        let next = grid.segments.iter().find(|segment| segment.range.0 == 1.0).unwrap();
        assert!(next.length() < 1.2 * SPACING.at_mouth, "{next:?}");
    }

    #[test]
    fn moments_add_up_to_those_of_the_whole_surface() {
        let grid = SurfaceGrid::new((-2.0, 3.0), &[0.5], SPACING);
        let (mut length, mut second) = (0.0, 0.0);
        for (x, [m0, m1, m2]) in grid.nodes.iter().zip(grid.moments()) {
            length += m0;
            second += m0 * x * x + 2.0 * m1 * x + m2;
        }
        assert!((length - 5.0).abs() < 1e-13);
        assert!((second - 35.0 / 3.0).abs() < 1e-12);
    }
}
