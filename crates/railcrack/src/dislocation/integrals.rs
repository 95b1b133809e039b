//! Double integrals of the dislocation interaction over pairs of straight pieces.

use super::interaction::{
    Interaction, Split, collinear_constant, split_image_interaction, split_interaction,
};
use crate::body::FacePiece as Piece;
use crate::crack::{CrackCurve, End, from_nearest};
use crate::math::{Vec2, gauss_legendre};

/// Relative error of the integral over a pair of pieces. The flap above a crack at 1° is a million
/// times more compliant in bending than in shear: with 1e-6 its energy is not positive.
const ACCURACY: f64 = 1e-8;
/// Largest number of points of a rule, needed for pieces at the distance [`APART`].
const MOST_POINTS: usize = 8;
/// Largest number of distinct weights of a rule.
const MOST_CLASSES: usize = MOST_POINTS.div_ceil(2);

/// Gauss rules on [0, 1].
pub(super) struct PairRules {
    by_points: Vec<Vec<(f64, f64)>>,
    /// For each number of points, the distance of the pieces over the longer one from which it
    /// suffices.
    from: Vec<f64>,
}

impl PairRules {
    /// The error of a rule of n points is ρ^(−2n), where ρ is the parameter of the ellipse around
    /// the piece that passes through the nearest singularity.
    pub(super) fn new() -> Self {
        let from = |points: usize| {
            let rho = ACCURACY.powf(-0.5 / points as f64);
            0.25 * (rho - 1.0 / rho)
        };
        Self {
            by_points: (0..=MOST_POINTS).map(gauss_legendre).collect(),
            from: (0..MOST_POINTS).map(from).collect(),
        }
    }

    /// The rule for pieces at a distance of `ratio` times the longer one.
    fn at(&self, ratio: f64) -> &[(f64, f64)] {
        let points = (2..MOST_POINTS).find(|&points| ratio >= self.from[points]);
        &self.by_points[points.unwrap_or(MOST_POINTS)]
    }
}

/// ∬ E dg dg′ over two pieces.
pub(super) fn pair_integral(curves: &[CrackCurve], a: &Piece, b: &Piece, rules: &PairRules) -> Interaction {
    let mut sum = [0.0; 4];
    if a.crack == b.crack && a.segment == b.segment {
        let curve = &curves[a.crack];
        let area = (a.range.1 - a.range.0) * (b.range.1 - b.range.0);
        sum = collinear_constant(curve.tangent(a.segment)).map(|e| e * area);
        let log = -2.0 * log_integral(curve, a.range, b.range, rules);
        sum[0] += log;
        sum[3] += log;
        subdivided(curves, (a, b), rules, split_image_interaction, image_distance, 0, &mut sum);
    } else {
        subdivided(curves, (a, b), rules, split_interaction, distance, 0, &mut sum);
    }
    sum
}

fn distance(a: &Piece, b: &Piece) -> f64 {
    let (p, q) = (midpoint(a), midpoint(b));
    let reach = 0.5 * (length(a) + length(b));
    let centres = square(p - q).sqrt();
    // Far apart, the bound through the midpoints suffices; close by, the distance between the ends
    // is the sharper bound.
    if centres > 4.0 * reach { centres - reach } else { end_distance(a, b).min(image_distance(a, b)) }
}

fn end_distance(a: &Piece, b: &Piece) -> f64 {
    let from = |p: Vec2, piece: &Piece| square(from_nearest(p, piece.ends.0, piece.ends.1));
    from(a.ends.0, b).min(from(a.ends.1, b)).min(from(b.ends.0, a)).min(from(b.ends.1, a)).sqrt()
}

fn image_distance(a: &Piece, b: &Piece) -> f64 {
    let mirror = |p: Vec2| Vec2::new(p.x, -p.y);
    end_distance(a, &Piece { ends: (mirror(b.ends.0), mirror(b.ends.1)), ..*b })
}

/// This distance serves the choice of rules only. Its last bit does not matter, and
/// [`Vec2::length`] would take longer than the integral.
fn length(a: &Piece) -> f64 {
    square(a.ends.1 - a.ends.0).sqrt()
}

fn square(v: Vec2) -> f64 {
    v.dot(v)
}

fn midpoint(a: &Piece) -> Vec2 {
    (a.ends.0 + a.ends.1) * 0.5
}

/// Distance of two pieces over the longer one, below which that one is halved.
const APART: f64 = 0.8;
/// Halvings before a pair that touches at a corner is integrated as it is: the remaining error is
/// 4^(−depth/2) of the whole times a logarithm.
const DEPTH: usize = 20;

fn subdivided(
    curves: &[CrackCurve],
    (a, b): (&Piece, &Piece),
    rules: &PairRules,
    kernel: impl Fn(Vec2, Vec2) -> Split + Copy,
    apart: impl Fn(&Piece, &Piece) -> f64 + Copy,
    depth: usize,
    sum: &mut Interaction,
) {
    let (la, lb) = (length(a), length(b));
    let ratio = apart(a, b) / la.max(lb);
    if ratio < APART && depth < DEPTH {
        let halve = |piece: &Piece| {
            let curve = &curves[piece.crack];
            let middle = 0.5 * (piece.range.0 + piece.range.1);
            let point = curve.position(piece.segment, middle);
            let first = Piece { range: (piece.range.0, middle), ends: (piece.ends.0, point), ..*piece };
            let second = Piece { range: (middle, piece.range.1), ends: (point, piece.ends.1), ..*piece };
            [first, second]
        };
        if la >= lb {
            for half in &halve(a) {
                subdivided(curves, (half, b), rules, kernel, apart, depth + 1, sum);
            }
        } else {
            for half in &halve(b) {
                subdivided(curves, (a, half), rules, kernel, apart, depth + 1, sum);
            }
        }
        return;
    }
    let rule = rules.at(ratio);
    let count = rule.len();
    let mut points_b = [(Vec2::default(), 0.0); MOST_POINTS];
    for (slot, (point, weight)) in points_b.iter_mut().zip(samples(&curves[b.crack], b, rule)) {
        *slot = (point, weight);
    }
    // Points that are symmetric about the middle have equal weights; logarithms with one weight are
    // combined into that of a product.
    let class = |i: usize| i.min(count - 1 - i);
    let mut products = [[1.0; MOST_CLASSES]; MOST_CLASSES];
    for (i, (z, weight_a)) in samples(&curves[a.crack], a, rule).enumerate() {
        for (j, &(z0, weight_b)) in points_b[..count].iter().enumerate() {
            let weight = weight_a * weight_b;
            let Split { rational, of_log } = kernel(z, z0);
            for k in 0..4 {
                sum[k] += weight * rational[k];
            }
            let (one, other) = (class(i), class(j));
            products[one.max(other)][one.min(other)] *= of_log;
        }
    }
    let area = (a.range.1 - a.range.0) * (b.range.1 - b.range.0);
    for (i, products) in products[..count.div_ceil(2)].iter().enumerate() {
        for (j, product) in products[..=i].iter().enumerate() {
            let log = area * rule[i].1 * rule[j].1 * product.ln();
            sum[0] += log;
            sum[3] += log;
        }
    }
}

fn samples<'a>(
    curve: &'a CrackCurve,
    piece: &'a Piece,
    rule: &'a [(f64, f64)],
) -> impl Iterator<Item = (Vec2, f64)> + 'a {
    let (start, width) = (piece.range.0, piece.range.1 - piece.range.0);
    rule.iter().map(move |&(t, w)| (curve.position(piece.segment, start + t * width), w * width))
}

/// ∬ log|s − s′| dg dg′ on one straight segment.
///
/// No tip: s − s′ = g − g′. One tip: |s − s′| = |g′ − g| |g′ + g|. Two tips: s − s′ = L
/// sin((g + g′)/2) sin((g − g′)/2), where the logarithms of the zeros at g = g′, at g = g′ = 0 and
/// at g = g′ = π are split off and integrated exactly.
fn log_integral(curve: &CrackCurve, a: (f64, f64), b: (f64, f64), rules: &PairRules) -> f64 {
    let mirrored = (-b.1, -b.0);
    match (curve.has_tip(End::First), curve.has_tip(End::Last)) {
        (false, false) => return log_difference(a, b),
        (true, false) | (false, true) => return log_difference(a, b) + log_difference(a, mirrored),
        (true, true) => {}
    }
    let sum = log_difference(a, b) + log_difference(a, mirrored);
    let turn = std::f64::consts::TAU;
    let beyond = (turn - b.1, turn - b.0);
    let smooth = |x: f64| if x.abs() < 1e-4 { -x * x / 24.0 } else { (2.0 * (0.5 * x).sin() / x).abs().ln() };
    let mut rest = 0.0;
    for &(ta, wa) in &rules.by_points[6] {
        for &(tb, wb) in &rules.by_points[6] {
            let g = a.0 + ta * (a.1 - a.0);
            let h = b.0 + tb * (b.1 - b.0);
            // |sin(x/2)| = x/2 · smooth; near x = 2π the factor (2π − x) is split off as well.
            let sum_angle = g + h;
            let both = ((0.5 * sum_angle).sin() / (sum_angle * (turn - sum_angle))).abs().ln();
            rest += wa * wb * (smooth(g - h) - std::f64::consts::LN_2 + both + curve.length().ln());
        }
    }
    sum + log_difference(a, beyond) + rest * (a.1 - a.0) * (b.1 - b.0)
}

/// ∬ log|u − v| du dv over [a] × [b], by the second antiderivative x²/2 log|x| − 3x²/4 of log|x|.
fn log_difference(a: (f64, f64), b: (f64, f64)) -> f64 {
    let second = |x: f64| if x == 0.0 { 0.0 } else { x * x * (0.5 * x.abs().ln() - 0.75) };
    second(a.0 - b.1) + second(a.1 - b.0) - second(a.1 - b.1) - second(a.0 - b.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_of_differences() {
        // ∬ log|u − v| over the unit square is −3/2; over [0,1] × [−1,0] it is 2 ln 2 − 3/2.
        assert!((log_difference((0., 1.), (0., 1.)) + 1.5).abs() < 1e-15);
        assert!((log_difference((0., 1.), (-1., 0.)) - (4f64.ln() - 1.5)).abs() < 1e-15);
    }
}
