//! Quadrature of products of two cells that touch.
//!
//! In the coordinates of Duffy (1982), a kernel that grows as 1/r where two points meet becomes
//! smooth. They are applied to pairs of cells as in Sauter & Schwab (2011, 5.2).

/// Two points in their unit squares and the weight of the pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairPoint {
    pub first: [f64; 2],
    pub second: [f64; 2],
    pub weight: f64,
}

/// The rules of `order` points per direction for pairs of the same cell, of cells with a common
/// edge (q = 0 in both, p in the same sense) and of cells with a common corner (p = q = 0 in both),
/// and for a cell with its own edge q = 0 or an edge from its corner p = q = 0 (the second point
/// has q = 0).
#[derive(Debug, Clone)]
pub(super) struct DuffyRules {
    pub same: Vec<PairPoint>,
    pub edge: Vec<PairPoint>,
    pub corner: Vec<PairPoint>,
    pub own_line: Vec<PairPoint>,
    pub corner_line: Vec<PairPoint>,
}

/// Points and weights on the pyramids of the N-dimensional unit cube with apex at the origin.
fn pyramids<const N: usize>(rule: &[(f64, f64)]) -> Vec<([f64; N], f64)> {
    let mut points = Vec::new();
    for largest in 0..N {
        for index in 0..rule.len().pow(N as u32) {
            let mut rest = index;
            let digits: [usize; N] = std::array::from_fn(|_| {
                let digit = rest % rule.len();
                rest /= rule.len();
                digit
            });
            let scale = rule[digits[largest]].0;
            let point = std::array::from_fn(|c| if c == largest { scale } else { scale * rule[digits[c]].0 });
            let weight: f64 = digits.iter().map(|&d| rule[d].1).product();
            points.push((point, weight * scale.powi(N as i32 - 1)));
        }
    }
    points
}

impl DuffyRules {
    pub fn new(order: usize) -> Self {
        let rule = crate::math::gauss_legendre(order);
        // Two points on one line at the distance t, in either order.
        let pair = |t: f64, x: f64, after: bool| {
            let from = (1.0 - t) * x;
            if after { [from + t, from] } else { [from, from + t] }
        };
        let mut rules = Self {
            same: Vec::new(),
            edge: Vec::new(),
            corner: Vec::new(),
            own_line: Vec::new(),
            corner_line: Vec::new(),
        };
        for ([t, q], weight) in pyramids(&rule) {
            for (x, wx) in &rule {
                for after in [false, true] {
                    let p = pair(t, *x, after);
                    let weight = weight * wx * (1.0 - t);
                    rules.own_line.push(PairPoint { first: [p[0], q], second: [p[1], 0.0], weight });
                    for (y, wy) in &rule {
                        for up in [false, true] {
                            let r = pair(q, *y, up);
                            let weight = weight * wy * (1.0 - q);
                            rules.same.push(PairPoint { first: [p[0], r[0]], second: [p[1], r[1]], weight });
                        }
                    }
                }
            }
        }
        for ([t, q, other], weight) in pyramids(&rule) {
            rules.corner_line.push(PairPoint { first: [t, q], second: [other, 0.0], weight });
            for (x, wx) in &rule {
                for after in [false, true] {
                    let p = pair(t, *x, after);
                    let weight = weight * wx * (1.0 - t);
                    rules.edge.push(PairPoint { first: [p[0], q], second: [p[1], other], weight });
                }
            }
        }
        for ([a, b, c, d], weight) in pyramids(&rule) {
            rules.corner.push(PairPoint { first: [a, b], second: [c, d], weight });
        }
        rules
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_measure_their_cubes() {
        let rules = DuffyRules::new(4);
        for (rule, name) in [
            (&rules.same, "same"),
            (&rules.edge, "edge"),
            (&rules.corner, "corner"),
            (&rules.own_line, "own line"),
            (&rules.corner_line, "corner line"),
        ] {
            let volume: f64 = rule.iter().map(|p| p.weight).sum();
            let mean: f64 = rule.iter().map(|p| p.weight * (p.first[0] + p.second[0])).sum();
            assert!((volume - 1.0).abs() < 1e-13 && (mean - 1.0).abs() < 1e-13, "{name} {volume} {mean}");
        }
        // ∫∫ 1/r over the unit square with itself is 2.973209612 (4 (ln(1 + √2) + (1 − √2)/3) · 1).
        let rules = DuffyRules::new(8);
        let potential: f64 = rules
            .same
            .iter()
            .map(|p| p.weight / (p.first[0] - p.second[0]).hypot(p.first[1] - p.second[1]))
            .sum();
        let want = 4.0 * ((1.0 + 2f64.sqrt()).ln() + (1.0 - 2f64.sqrt()) / 3.0);
        assert!((potential - want).abs() < 1e-8, "{potential} {want}");
    }
}
