//! Section 5.5.1: two cracks that lean away from each other.

use crate::case_run::{CrackGrowth, SifCurve};
use crate::claim::{Claim, Decision};
use crate::path_shape::PathShape;
use crate::results::SetupResults;

/// Cracks 1 and 2 of the pair, then each alone.
fn cracks<'a>(r: SetupResults<'a>) -> Option<([&'a CrackGrowth; 2], [&'a CrackGrowth; 2])> {
    let pair = &r.run("pair")?.cracks;
    Some(([&pair[0], &pair[1]], [r.run("reference")?.crack(), r.run("crack-2-alone")?.crack()]))
}

fn grown<'a>(r: SetupResults<'a>) -> Option<[&'a CrackGrowth; 2]> {
    let pair = &r.grown("pair")?.cracks;
    Some([&pair[0], &pair[1]])
}

/// Where K_I gains most by the neighbour, and how much.
fn gain(pair: &SifCurve, alone: &SifCurve) -> (f64, f64) {
    pair.minus(alone).iter().fold((0.0, 0.0), |best, &[x, ki, _]| if ki > best.1 { (x, ki) } else { best })
}

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "5.5.1-mode-2",
        place: "5.5.1, Fig. 24b",
        figures: &[24],
        statement: "The neighbouring crack hardly changes K_II.",
        rule: "\u{394}K_II of each crack of the pair within 10 % of that of the single crack",
        decide: |r| {
            let (pair, alone) = cracks(r)?;
            let change = [0, 1].map(|i| 100.0 * (pair[i].delta_kii() / alone[i].delta_kii() - 1.0));
            let holds = change.iter().all(|change| change.abs() <= 10.0);
            Some(Decision::of(holds).with_all("change of \u{394}K_II %, crack", &["1", "2"], &change))
        },
        why: "",
    },
    Claim {
        id: "5.5.1-mode-1",
        place: "5.5.1, Fig. 24a",
        figures: &[24],
        statement: "The neighbouring crack mainly increases the opening, and thus \u{394}K_I, of both cracks.",
        rule: "\u{394}K_I of each crack changes by a larger share than its \u{394}K_II, and grows",
        decide: |r| {
            let (pair, alone) = cracks(r)?;
            let share = |of: fn(&CrackGrowth) -> f64, i: usize| 100.0 * (of(pair[i]) / of(alone[i]) - 1.0);
            let opening = [0, 1].map(|i| share(CrackGrowth::delta_ki, i));
            let sliding = [0, 1].map(|i| share(CrackGrowth::delta_kii, i));
            let holds = (0..2).all(|i| opening[i] > sliding[i].abs());
            Some(Decision::of(holds).with_all("change of \u{394}K_I %, crack", &["1", "2"], &opening))
        },
        why: "The crack-face friction decides: at 0.2 \u{394}K_I of both cracks grows by about a quarter, at 0.5 both cracks are nearly closed, alone and together, and at 0.01 each opens under the wheel by slip that the neighbour hardly changes.",
    },
    Claim {
        id: "5.5.1-opening-1",
        place: "5.5.1, Fig. 24a",
        figures: &[24],
        statement: "Crack 2 increases the opening of crack 1 while the wheel is at x_c/a < \u{2212}2.",
        rule: "the largest gain of K_I of crack 1 is at x_c/a < \u{2212}2 and >= 10 % of the largest K_I of the single crack",
        decide: |r| {
            let (pair, alone) = cracks(r)?;
            let (at, gain) = gain(&pair[0].sif, &alone[0].sif);
            let enough = 0.1 * alone[0].sif.ki.iter().copied().fold(0.0, f64::max);
            Some(Decision::of(at < -2.0 && gain >= enough).with("gain of K_I", gain).with("at x_c/a", at))
        },
        why: "Crack 2 opens crack 1 further before the wheel has passed it, as stated, but within 2 a of its mouth; farther away both cracks are closed in the half-plane.",
    },
    Claim {
        id: "5.5.1-opening-2",
        place: "5.5.1, Fig. 24a",
        figures: &[24],
        statement: "Crack 1 increases the opening of crack 2 while the wheel is at x_c/a > 2.",
        rule: "the largest gain of K_I of crack 2 is at x_c/a > 2 and >= 10 % of the largest K_I of the single crack",
        decide: |r| {
            let (pair, alone) = cracks(r)?;
            let (at, gain) = gain(&pair[1].sif, &alone[1].sif);
            let enough = 0.1 * alone[1].sif.ki.iter().copied().fold(0.0, f64::max);
            Some(Decision::of(at > 2.0 && gain >= enough).with("gain of K_I", gain).with("at x_c/a", at))
        },
        why: "The increase occurs behind the wheel, as stated; at the crack-face friction 0.01 and 0.2 it is largest slightly before x_c/a = 2.",
    },
    Claim {
        id: "5.5.1-parallel",
        place: "5.5.1, Fig. 25",
        figures: &[25],
        statement: "Crack 1 of the pair branches and then grows parallel to the running surface.",
        rule: "the path of crack 1 branches and then runs within 10\u{b0} of the direction of the surface",
        decide: |r| {
            let path = PathShape::of(grown(r)?[0]);
            let decision =
                Decision::of(path.runs_parallel()).with(format!("{}, depth", path.words()), path.depth);
            Some(match path.inclination_after {
                Some(angle) => decision.with("below the surface \u{b0}", angle),
                None => decision,
            })
        },
        why: "The direction criterion has two maxima, near the plane of the crack and about 75\u{b0} above it: a crack of 15\u{b0} continues in its plane or turns to 60\u{b0} upwards, never along the surface.",
    },
    Claim {
        id: "5.5.1-coplanar",
        place: "5.5.1, Fig. 25",
        figures: &[25],
        statement: "Crack 2 of the pair grows co-planar, as it does alone.",
        rule: "no increment of crack 2 > 20\u{b0} off its line",
        decide: |r| {
            let path = PathShape::of(grown(r)?[1]);
            Some(Decision::of(path.is_coplanar()).with(format!("{}, depth", path.words()), path.depth))
        },
        why: "Of the two cracks one leans along the travel and one against it. The one that leans against it turns upwards at once; this is crack 2 if crack 1 leans along the travel.",
    },
    Claim {
        id: "5.5.1-slower",
        place: "5.5.1",
        figures: &[25],
        statement: "After some increments \u{394}K_eq of crack 1 of the pair decreases.",
        rule: "\u{394}K_eq of crack 1 in the last step is smaller than at first",
        decide: |r| {
            let steps = &grown(r)?[0].steps;
            let (first, last) = (steps.first()?.delta_keq, steps.last()?.delta_keq);
            Some(Decision::of(last < first).with("first", first).with("last", last))
        },
        why: "At the crack-face friction 0.5 \u{394}K_eq of crack 1 grows with its length.",
    },
    Claim {
        id: "5.5.1-deeper",
        place: "5.5.1, Fig. 25",
        figures: &[25],
        statement: "Crack 2 of the pair grows deeper than crack 1.",
        rule: "the end of the path of crack 2 is deeper than that of crack 1",
        decide: |r| {
            let depth = grown(r)?.map(|crack| PathShape::of(crack).depth);
            Some(Decision::of(depth[1] > depth[0]).with_all("depth of crack", &["1", "2"], &depth))
        },
        why: "In the half-plane the crack that leans against the travel branches up and the other one grows into the rail: crack 1 branches up only where it leans against the travel.",
    },
];
