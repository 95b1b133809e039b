//! A path of growth as numbers that vary smoothly from run to run.

use crate::decision::{GrowthPath, PathPoint};
use crate::run_folder::RepresentativeTip;

/// Lengths at which a path is described, its ends among them, at equal distances.
const NODES: usize = 17;

/// Numbers that describe a path: logarithms of its first length and of its growth, then depths
/// over lengths, logarithms of ΔK_eq, and logarithms of the axles per mm between the nodes.
pub(super) const NUMBERS: usize = 2 + NODES + NODES + (NODES - 1);

/// The path of the tip in a run; none if it does not grow.
pub(super) fn path_of_tip(tip: &RepresentativeTip) -> Option<GrowthPath> {
    let points: Vec<PathPoint> = tip
        .rows
        .iter()
        .map(|row| PathPoint {
            axles: row.load_cycles,
            length: row.length,
            depth: row.depth.unwrap_or(-row.place[1]),
            rate: row.rate,
            delta_keq: row.delta_keq,
            shares: row.shares,
            ..PathPoint::default()
        })
        .collect();
    let grows = points.len() > 1
        && points.windows(2).all(|pair| pair[1].length > pair[0].length && pair[1].axles > pair[0].axles);
    let tip = (tip.first.crack, tip.first.tip);
    grows.then_some(GrowthPath { tip, points, breaks: false, is_worn_away: false })
}

/// The numbers that describe `path`, which grows over its whole length.
pub(super) fn numbers_of(path: &GrowthPath) -> Option<Vec<f64>> {
    let (first, last) = (path.points.first()?, path.points.last()?);
    let depths: Vec<f64> = path.points.iter().map(|point| point.depth).collect();
    let keqs: Vec<f64> = path.points.iter().map(|point| point.delta_keq.max(f64::MIN_POSITIVE)).collect();
    let axles = path.axles();
    let lengths = lengths(first.length, last.length);
    let end = (path.points.len() - 1, 0.0);
    let places: Option<Vec<(usize, f64)>> = lengths
        .iter()
        .enumerate()
        .map(
            |(j, length)| {
                if j + 1 == NODES { Some(end) } else { path.reaches(|point| point.length, *length) }
            },
        )
        .collect();
    let places = places?;
    let mut numbers = vec![first.length.ln(), (last.length - first.length).ln()];
    numbers
        .extend(places.iter().zip(&lengths).map(|(place, length)| GrowthPath::at(*place, &depths) / length));
    numbers.extend(places.iter().map(|place| GrowthPath::at(*place, &keqs).ln()));
    let between = (lengths[1] - lengths[0]).recip();
    let slowness =
        |pair: &[(usize, f64)]| between * (GrowthPath::at(pair[1], &axles) - GrowthPath::at(pair[0], &axles));
    numbers.extend(places.windows(2).map(|pair| slowness(pair).ln()));
    numbers.iter().all(|number| number.is_finite()).then_some(numbers)
}

/// The path described by `numbers`; it ends with fracture if it `breaks`.
pub(super) fn path_of(numbers: &[f64], breaks: bool) -> GrowthPath {
    let first = numbers[0].exp();
    let lengths = lengths(first, first + numbers[1].exp());
    let (depths, rest) = numbers[2..].split_at(NODES);
    let (keqs, slowness) = rest.split_at(NODES);
    let slowness: Vec<f64> = slowness.iter().map(|ln| ln.exp()).collect();
    let mut axles = 0.0;
    let points = (0..NODES).map(|j| {
        if j > 0 {
            axles += slowness[j - 1] * (lengths[j] - lengths[j - 1]);
        }
        PathPoint {
            axles,
            length: lengths[j],
            depth: depths[j] * lengths[j],
            rate: slowness[j.min(NODES - 2)].recip(),
            delta_keq: keqs[j].exp(),
            ..PathPoint::default()
        }
    });
    GrowthPath { tip: (1, 1), points: points.collect(), breaks, is_worn_away: false }
}

fn lengths(first: f64, last: f64) -> [f64; NODES] {
    std::array::from_fn(|j| first + (last - first) * j as f64 / (NODES - 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_describe_a_path() {
        let points = (0..=40).map(|i| {
            let length = 4.0 + 0.1 * f64::from(i);
            PathPoint {
                axles: 1e6 * f64::from(i).sqrt(),
                length,
                depth: 0.4 * length + 0.01 * length * length,
                rate: 1e-7,
                delta_keq: 5.0 * length.sqrt(),
                ..PathPoint::default()
            }
        });
        let path = GrowthPath { tip: (1, 1), points: points.collect(), breaks: true, is_worn_away: false };
        let numbers = numbers_of(&path).unwrap();
        assert_eq!(numbers.len(), NUMBERS);
        let again = path_of(&numbers, true);
        // To round-off at those nodes that are points of the path.
        for (node, point) in [(0, 0), (4, 10), (8, 20), (16, 40)] {
            let (found, exact) = (again.points[node], path.points[point]);
            for (found, exact) in [
                (found.axles, exact.axles),
                (found.length, exact.length),
                (found.depth, exact.depth),
                (found.delta_keq, exact.delta_keq),
            ] {
                assert!((found - exact).abs() <= 1e-9 * exact.abs(), "{node}: {found} and {exact}");
            }
        }
    }
}
