//! Output positions of a passage; where the rail bends, also far from the cracks.

use crate::load::{Bending, Passage};
use std::f64::consts::{FRAC_PI_2, PI};

/// Step of the beam coordinate βs between positions: e^(−βs) changes by a tenth.
const STEP: f64 = PI / 32.0;
/// βs of the outermost axles at which the passage begins and ends: bending has then decayed to 2e-3
/// of its maximum.
const REACH: f64 = 2.0 * PI;
/// Adjacent to the passage of the contact, whose field decays as 1/r, positions are spaced by this
/// fraction of r.
const GRADING: f64 = 0.25;
/// Positions closer than this share of [`STEP`] to the position of an extreme are omitted.
const CLOSE: f64 = 0.3;

/// The output positions of `passage` over cracks at `places` (mm along the rail, in any order), in
/// the order of travel; without bending, the positions of the passage itself.
///
/// Bending adds positions that resolve it up to 2π/β ahead of and behind every axle, and the
/// positions at which each axle, and the tension maxima on either side of it (βs = π/2), lie above
/// a place.
pub fn output_positions(passage: &Passage, bending: Option<&Bending>, places: &[f64]) -> Vec<f64> {
    let near = passage.abscissae();
    let Some(bending) = bending else { return near };
    let (low, high) = (passage.from.min(passage.to), passage.from.max(passage.to));
    let beyond = |x: f64| x < low || x > high;
    let length = bending.length();
    let step = STEP * length;
    let axles = || bending.track().axles.iter().map(|axle| axle.at);
    let extremes = |place: f64| {
        axles().flat_map(move |at| [-1.0, 0.0, 1.0].map(|side| place - at + side * FRAC_PI_2 * length))
    };
    let mut chosen: Vec<f64> = places.iter().copied().flat_map(extremes).filter(|x| beyond(*x)).collect();
    chosen.sort_by(f64::total_cmp);
    chosen.dedup_by(|next, kept| *next - *kept < 1e-3 * step);
    let apart = |chosen: &[f64], x: f64| {
        let next = chosen.partition_point(|other| *other < x);
        let neighbours = [next.checked_sub(1), Some(next)].into_iter().flatten();
        neighbours.filter_map(|i| chosen.get(i)).all(|other| (other - x).abs() > CLOSE * step)
    };
    let middle =
        if places.is_empty() { 0.5 * (low + high) } else { places.iter().sum::<f64>() / places.len() as f64 };
    // Graded away from the contact until the spacing reaches that of the beam.
    let mut graded = Vec::new();
    for (end, side) in [(low, -1.0), (high, 1.0)] {
        let mut distance = (end - middle).abs();
        while distance > 0.0 && GRADING * distance < step {
            distance *= 1.0 + GRADING;
            graded.push(middle + side * distance);
        }
    }
    let reach = REACH * length;
    let count = (2.0 * reach / step).round() as i32;
    let along = axles().flat_map(|at| (0..=count).map(move |i| middle - at - reach + step * f64::from(i)));
    let mut others: Vec<f64> = along.filter(|x| beyond(*x)).collect();
    others.sort_by(f64::total_cmp);
    for (positions, closest) in [(graded, 0.0), (others, CLOSE * step)] {
        for x in positions {
            if apart(&chosen, x) && (x < low - closest || x > high + closest) {
                chosen.insert(chosen.partition_point(|other| *other < x), x);
            }
        }
    }
    chosen.extend(near);
    chosen.sort_by(f64::total_cmp);
    if passage.to < passage.from {
        chosen.reverse();
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::{Axle, NamedSection, Track};
    use crate::material::IsotropicElastic;

    fn bending(axles: &[f64]) -> Bending {
        let section = NamedSection::of("60E1").unwrap().section();
        let axles = axles.iter().map(|&at| Axle { at, wheel_load: 100e3 }).collect();
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        Track { section, foundation: 50.0, axles }.bending(&steel).unwrap()
    }

    #[test]
    fn without_bending_those_of_the_passage() {
        let passage = Passage::default();
        assert_eq!(output_positions(&passage, None, &[0.0]), passage.abscissae());
    }

    #[test]
    fn the_beam_is_resolved_to_where_it_has_decayed() {
        let passage = Passage::default();
        for axles in [&[0.0][..], &[0.0, -1800.0, -13_000.0], &[0.0, 2500.0]] {
            let bending = bending(axles);
            let length = bending.length();
            let xc = output_positions(&passage, Some(&bending), &[0.0, 3.0]);
            assert!(xc.windows(2).all(|pair| pair[1] > pair[0]), "{axles:?}");
            let own: Vec<f64> = xc.iter().copied().filter(|x| x.abs() <= 40.5).collect();
            assert_eq!(own, passage.abscissae());
            let outermost =
                axles.iter().fold((0.0f64, 0.0f64), |(low, high), at| (low.min(*at), high.max(*at)));
            assert!((xc[0] + outermost.1 + 2.0 * PI * length).abs() < 2.0, "{}", xc[0]);
            assert!((xc[xc.len() - 1] + outermost.0 - 2.0 * PI * length).abs() < 2.0);
            for &at in axles {
                for extreme in [-FRAC_PI_2 * length - at, FRAC_PI_2 * length - at] {
                    assert!(xc.contains(&extreme), "{axles:?}: π/2 of the axle at {at}");
                }
                let covered = |x: f64| (x + at).abs() < 6.0 * length;
                let gaps = xc.windows(2).filter(|pair| covered(pair[0]) && covered(pair[1]));
                let widest = gaps.map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
                assert!(widest < 1.7 * STEP * length, "{axles:?}: {widest}");
            }
            assert!(xc.len() < 241 + 170 * axles.len(), "{}", xc.len());
        }
    }

    #[test]
    fn the_return_passage_has_the_mirrored_positions() {
        let there = output_positions(&Passage::default(), Some(&bending(&[0.0, -1800.0])), &[0.0]);
        let back = Passage { from: 40.5, to: -40.5, positions: 241 };
        let mut mirrored = output_positions(&back, Some(&bending(&[0.0, 1800.0])), &[0.0]);
        mirrored.iter_mut().for_each(|x| *x = -*x);
        assert_eq!(there.len(), mirrored.len());
        assert!(there.iter().zip(&mirrored).all(|(one, other)| (one - other).abs() < 1e-9));
    }
}
