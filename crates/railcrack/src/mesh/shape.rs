//! Shape functions of the 8-node (serendipity) rectangle.

/// Nodes of an element: corners 0 to 3 counter-clockwise from the lower left, then the midpoints of
/// the bottom, right, top and left side.
pub(crate) const NODES: usize = 8;

/// Reference coordinates of the four corners.
pub(crate) const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// A side of an element, in the order of its midside nodes 4 to 7.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Edge {
    /// y smallest.
    Bottom,
    /// x largest.
    Right,
    /// y largest.
    Top,
    /// x smallest.
    Left,
}

impl Edge {
    /// The four sides.
    pub const ALL: [Self; 4] = [Self::Bottom, Self::Right, Self::Top, Self::Left];

    /// The three nodes on the side: its two corners and its midside node.
    pub(crate) fn nodes(self) -> [usize; 3] {
        let i = self as usize;
        [i, (i + 1) % 4, 4 + i]
    }
}

/// Values, ∂/∂ξ and ∂/∂η of the eight shape functions at (ξ, η) in [−1, 1]² (Zienkiewicz & Taylor,
/// serendipity family).
pub(crate) fn shape_functions(xi: f64, eta: f64) -> [[f64; 3]; NODES] {
    let mut values = [[0.0; 3]; NODES];
    for (value, [a, b]) in values.iter_mut().zip(CORNERS) {
        let (p, q) = (1.0 + a * xi, 1.0 + b * eta);
        let r = a * xi + b * eta - 1.0;
        *value = [0.25 * p * q * r, 0.25 * a * q * (r + p), 0.25 * b * p * (r + q)];
    }
    for (node, b) in [(4, -1.0), (6, 1.0)] {
        let (p, q) = (1.0 - xi * xi, 1.0 + b * eta);
        values[node] = [0.5 * p * q, -xi * q, 0.5 * b * p];
    }
    for (node, a) in [(5, 1.0), (7, -1.0)] {
        let (p, q) = (1.0 + a * xi, 1.0 - eta * eta);
        values[node] = [0.5 * p * q, 0.5 * a * q, -eta * p];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIDDLES: [[f64; 2]; 4] = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];

    #[test]
    fn are_one_at_their_own_node_and_zero_at_the_others() {
        for (i, [xi, eta]) in CORNERS.into_iter().chain(MIDDLES).enumerate() {
            for (j, value) in shape_functions(xi, eta).into_iter().enumerate() {
                assert_eq!(value[0], f64::from(i == j), "function {j} at node {i}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_values() {
        const STEP: f64 = 1e-6;
        let (xi, eta) = (0.3, -0.7);
        let at = shape_functions(xi, eta);
        let (right, left) = (shape_functions(xi + STEP, eta), shape_functions(xi - STEP, eta));
        let (up, down) = (shape_functions(xi, eta + STEP), shape_functions(xi, eta - STEP));
        for j in 0..NODES {
            assert!((at[j][1] - (right[j][0] - left[j][0]) / (2.0 * STEP)).abs() < 1e-9, "d/dxi of {j}");
            assert!((at[j][2] - (up[j][0] - down[j][0]) / (2.0 * STEP)).abs() < 1e-9, "d/deta of {j}");
        }
        assert!((at.iter().map(|v| v[0]).sum::<f64>() - 1.0).abs() < 1e-15);
    }
}
