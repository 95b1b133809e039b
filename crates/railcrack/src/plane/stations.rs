//! Wheel positions at which a group of cracks of a long row is followed.

/// Distance of the wheel from a group, relative to a, up to which the group is followed in short
/// steps and to every output position.
const REACH: f64 = 4.0;
/// Length of these steps, relative to a. With twice this length, the error of K in rows at random
/// spacing is 0.2 to 0.5 % instead of 0.06 %.
const STEP: f64 = 0.03;
/// Beyond that distance, steps grow by this share of the distance.
const GRADING: f64 = 0.07;
/// Positions closer than this share of a step are merged.
const CLOSE: f64 = 0.2;

/// Positions (mm) between the first and the last of `outputs` for faces from `extent.0` to
/// `extent.1` under a contact of `half_width`, in the order of travel: first those at which forces
/// are exchanged, including `edges`, then all positions.
pub(super) fn stations(
    outputs: &[f64],
    edges: &[f64],
    extent: (f64, f64),
    half_width: f64,
) -> (Vec<f64>, Vec<f64>) {
    let (first, last) = (outputs[0], outputs[outputs.len() - 1]);
    let travel = (last - first).signum();
    let beyond = |x: f64| (extent.0 - x).max(x - extent.1) - REACH * half_width;
    let step = |x: f64| STEP * half_width + GRADING * beyond(x).max(0.0);
    let mut nodes = vec![first];
    loop {
        let x = nodes[nodes.len() - 1];
        let next = x + travel * step(x);
        if (last - next) * travel <= 0.5 * step(next) {
            break;
        }
        nodes.push(next);
    }
    if last != first {
        nodes.push(last);
    }
    nodes.extend(edges.iter().filter(|x| (**x - first) * travel > 0.0 && (last - **x) * travel > 0.0));
    nodes.sort_by(|a, b| (a * travel).total_cmp(&(b * travel)));
    nodes.dedup();
    let ends = [0, outputs.len() - 1];
    let near = outputs.iter().enumerate().filter(|(i, x)| ends.contains(i) || beyond(**x) <= 0.0);
    let mut all: Vec<f64> = near.map(|(_, x)| *x).collect();
    let close = CLOSE * STEP * half_width;
    let apart = |x: &&f64| edges.contains(x) || all.iter().all(|output| (output - **x).abs() > close);
    let added: Vec<f64> = nodes.iter().filter(apart).copied().collect();
    all.extend(added);
    all.sort_by(|a, b| (a * travel).total_cmp(&(b * travel)));
    all.dedup();
    (nodes, all)
}

/// Interpolation weights of the values at `stations` for the position `x`: a cubic through the four
/// stations around it, or the single station at `x`.
pub(super) fn weights(stations: &[f64], x: f64) -> Vec<(usize, f64)> {
    if let Some(hit) = stations.iter().position(|&station| station == x) {
        return vec![(hit, 1.0)];
    }
    let count = stations.len();
    let travel = stations[count - 1] - stations[0];
    let after = stations.partition_point(|station| (station - x) * travel < 0.0);
    let first = after.saturating_sub(2).min(count.saturating_sub(4));
    let chosen = first..(first + 4).min(count);
    let weight = |i: usize| {
        let others = chosen.clone().filter(|&j| j != i);
        others.map(|j| (x - stations[j]) / (stations[i] - stations[j])).product()
    };
    chosen.clone().map(|i| (i, weight(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_dense_around_the_faces_and_end_where_the_passage_does() {
        let there: Vec<f64> = (0..=100).map(|i| -50.0 + 5.0 * f64::from(i)).collect();
        let back: Vec<f64> = there.iter().rev().copied().collect();
        for outputs in [there, back] {
            let (nodes, all) = stations(&outputs, &[103.0], (100.0, 110.0), 6.0);
            for list in [&nodes, &all] {
                assert_eq!((list[0], list[list.len() - 1]), (outputs[0], outputs[100]));
            }
            let gaps = |list: &[f64], near: f64| {
                let pairs = list.windows(2).filter(|p| p.iter().all(|x| (x - 105.0).abs() < near));
                pairs.map(|p| (p[1] - p[0]).abs()).fold(0.0, f64::max)
            };
            assert!(gaps(&nodes, 29.0) < 0.181 && gaps(&all, 29.0) < 0.3);
            assert!(nodes.contains(&103.0) && all.contains(&103.0));
            assert!(nodes.len() < 480, "{}", nodes.len());
            assert!(outputs.iter().filter(|x| (**x - 105.0).abs() < 29.0).all(|x| all.contains(x)));
        }
    }

    #[test]
    fn a_cubic_is_interpolated_exactly() {
        let stations = [0.0, 1.0, 1.5, 3.0, 7.0];
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (0.5 - 0.1 * x));
        for x in [-0.5, 0.3, 1.2, 1.5, 2.0, 5.0] {
            let value: f64 = weights(&stations, x).iter().map(|(i, w)| w * cubic(stations[*i])).sum();
            assert!((value - cubic(x)).abs() < 1e-12, "{x}: {value}");
        }
    }
}
