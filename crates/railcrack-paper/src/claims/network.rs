//! Sections 5.5.2 and 5.5.3: nine parallel cracks.

use crate::case_run::CrackGrowth;
use crate::claim::{Claim, Decision};
use crate::path_shape::{PathShape, Side};
use crate::results::SetupResults;
use crate::setup::Travel;

const NAMES: [&str; 9] = ["1", "2", "3", "4", "5", "6", "7", "8", "9"];

/// Change in per cent of `of` for each crack of `network` with respect to the curve `single`.
fn changes(r: SetupResults, network: &str, single: &str, of: fn(&CrackGrowth) -> f64) -> Option<Vec<f64>> {
    let alone = of(r.run(single)?.crack());
    Some(r.run(network)?.cracks.iter().map(|crack| 100.0 * (of(crack) / alone - 1.0)).collect())
}

fn paths(r: SetupResults, network: &str) -> Option<Vec<PathShape>> {
    Some(r.grown(network)?.cracks.iter().map(PathShape::of).collect())
}

fn with_paths(mut decision: Decision, paths: &[PathShape]) -> Decision {
    for (name, path) in NAMES.iter().zip(paths) {
        let angle = path.inclination_after.or(path.inclination).unwrap_or(0.0);
        decision = decision.with(format!("{name} {}, below surface \u{b0}", path.words()), angle);
    }
    decision
}

fn top(crack: &CrackGrowth) -> f64 {
    crack.sif.ki.iter().copied().fold(0.0, f64::max)
}

pub(super) const NINE: &[Claim] = &[
    Claim {
        id: "5.5.2-opening",
        place: "5.5.2, Fig. 27a; 6",
        figures: &[27],
        statement: "Every crack of the network of nine opens more than a single crack.",
        rule: "\u{394}K_I of each of the nine larger than that of the single crack",
        decide: |r| {
            let changes = changes(r, "nine", "wheel+0.1", CrackGrowth::delta_ki)?;
            let holds = changes.iter().all(|change| *change > 0.0);
            Some(Decision::of(holds).with_all("\u{394}K_I %, crack", &NAMES, &changes))
        },
        why: "The crack-face friction decides. At 0.01, as in the captions of Figs 24 and 25, all nine cracks open more where they lean against the travel, by 39 % to 104 %, and \u{394}K_II of cracks 1 to 8 is 18 % to 20 % smaller: nearly both statements on Fig. 27. At 0.5 neighbours keep the cracks closed. Interchanged labels of K_I and K_II would not explain it: \u{394}K_II grows by 30 % at most, not by 150 %.",
    },
    Claim {
        id: "5.5.2-opening-150",
        place: "5.5.2, Fig. 27a",
        figures: &[27],
        statement: "The network of nine increases \u{394}K_I by up to 150 %.",
        rule: "largest increase of \u{394}K_I between 100 % and 200 %",
        decide: |r| {
            let changes = changes(r, "nine", "wheel+0.1", CrackGrowth::delta_ki)?;
            let (i, most) = changes.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
            let holds = (100.0..=200.0).contains(most);
            Some(Decision::of(holds).with("largest %", *most).with("crack", (i + 1) as f64))
        },
        why: "At the crack-face friction 0.5 only the crack that the wheel meets first has a larger value, by 111 % in the half-plane; at 0.01 the others have values larger by 89 % to 146 %.",
    },
    Claim {
        id: "5.5.2-shielding",
        place: "5.5.2, Fig. 27b",
        figures: &[27],
        statement: "The cracks of the network shield each other in mode II: \u{394}K_II is 0 to 25 % smaller than that of a single crack.",
        rule: "change of \u{394}K_II of each crack between \u{2212}30 % and 0, of one at least beyond \u{2212}10 %",
        decide: |r| {
            let changes = changes(r, "nine", "wheel+0.1", CrackGrowth::delta_kii)?;
            let within = changes.iter().all(|change| (-30.0..=0.0).contains(change));
            let holds = within && changes.iter().any(|change| *change <= -10.0);
            Some(Decision::of(holds).with_all("\u{394}K_II %, crack", &NAMES, &changes))
        },
        why: "Where the cracks lean against the travel, \u{394}K_II of cracks 1 to 8 is smaller at every crack-face friction, by 18 % to 20 % at 0.01; that of crack 9, which the wheel meets first, is up to 6 % larger.",
    },
    Claim {
        id: "6-shielding-centre",
        place: "6",
        figures: &[27],
        statement: "Shielding in mode II acts on the cracks in the middle of the network.",
        rule: "mean change of \u{394}K_II of cracks 3 to 6 below zero and below the mean of 1, 2, 8, 9",
        decide: |r| {
            let changes = changes(r, "nine", "wheel+0.1", CrackGrowth::delta_kii)?;
            let mean = |of: &[usize]| of.iter().map(|&i| changes[i - 1]).sum::<f64>() / of.len() as f64;
            let (middle, outer) = (mean(&[3, 4, 5, 6]), mean(&[1, 2, 8, 9]));
            Some(Decision::of(middle < 0.0 && middle < outer).with("middle %", middle).with("outer %", outer))
        },
        why: "Along the travel, at the crack-face friction 0.5, neighbours increase the sliding in the middle of the network.",
    },
    Claim {
        id: "5.5.2-single-down",
        place: "5.5.2, Fig. 18",
        figures: &[28],
        statement: "A single crack at the wheel–rail friction of the network (0.1) grows co-planar at first, then branches down.",
        rule: "at least 3 increments within 20\u{b0} of the line, then a branch down",
        decide: |r| {
            let path = PathShape::of(r.grown("wheel+0.1")?.crack());
            let holds = path.coplanar_increments() > 3 && path.branches(Side::Down);
            Some(Decision::of(holds).with(format!("{}, depth", path.words()), path.depth))
        },
        why: "A crack that leans against the travel turns upwards in the first increment.",
    },
    Claim {
        id: "5.5.2-outer",
        place: "5.5.2, Fig. 28",
        figures: &[28],
        statement: "Cracks 1, 2, 8 and 9 of the network grow as a single crack does.",
        rule: "within five increments each of the four branches to the same side as the single crack, or does not branch if the single crack does not",
        decide: |r| {
            let paths = paths(r, "nine")?;
            let alone = PathShape::of(r.grown("wheel+0.1")?.crack());
            let side = |path: &PathShape| {
                path.branch.filter(|branch| branch.increment <= 5).map(|branch| branch.side)
            };
            let holds = [1, 2, 8, 9].iter().all(|&i| side(&paths[i - 1]) == side(&alone));
            Some(with_paths(Decision::of(holds), &paths))
        },
        why: "",
    },
    Claim {
        id: "5.5.2-middle",
        place: "5.5.2, Fig. 28; 6",
        figures: &[28],
        statement: "Cracks 3, 4, 5 and 7 of the network branch and then grow parallel to the running surface.",
        rule: "the four paths branch and then run within 10\u{b0} of the direction of the surface",
        decide: |r| {
            let paths = paths(r, "nine")?;
            let holds = [3, 4, 5, 7].iter().all(|&i| paths[i - 1].runs_parallel());
            Some(with_paths(Decision::of(holds), &paths))
        },
        why: "No crack turns parallel to the surface: along the travel all stay within 20\u{b0} of their line at the friction 0.5 and turn down, if at all, at 0.01; against it the first kink is 72\u{b0} to 75\u{b0} upwards, towards the surface rather than along it.",
    },
    Claim {
        id: "5.5.2-both",
        place: "5.5.2, Fig. 28; 6",
        figures: &[28],
        statement: "Some cracks of the network are about to form a spall, others grow into the rail.",
        rule: "at least one path branches up or runs parallel, at least one is co-planar or branches down",
        decide: |r| {
            let paths = paths(r, "nine")?;
            let up = paths.iter().any(|path| path.branches(Side::Up) || path.runs_parallel());
            let down = paths.iter().any(|path| path.is_coplanar() || path.branches(Side::Down));
            Some(with_paths(Decision::of(up && down), &paths))
        },
        why: "At the friction 0.5 the nine cracks do the same: along the travel none turns upwards, against it all do.",
    },
];

pub(super) const NINE_WITH_STRESS: &[Claim] = &[
    Claim {
        id: "5.5.3-closed",
        place: "5.5.3, Fig. 29a",
        figures: &[29],
        statement: "With the residual stress of Fig. 21, cracks 1 to 8 of the network stay closed.",
        rule: "max K_I of each <= 0.1 MPa\u{221a}m",
        decide: |r| {
            let tops: Vec<f64> = r.run("nine-stress")?.cracks.iter().map(top).collect();
            let holds = tops[..8].iter().all(|top| *top <= 0.1);
            Some(Decision::of(holds).with_all("max K_I, crack", &NAMES, &tops))
        },
        why: "",
    },
    Claim {
        id: "5.5.3-crack-9",
        place: "5.5.3, Fig. 29a",
        figures: &[29],
        statement: "With the residual stress of Fig. 21, crack 9, at the edge of the network, opens.",
        rule: "max K_I of crack 9 > 0.1 MPa\u{221a}m",
        decide: |r| {
            let top = top(&r.run("nine-stress")?.cracks[8]);
            Some(Decision::of(top > 0.1).with("max K_I", top))
        },
        why: "If the cracks lean against the travel, the wheel meets crack 9 first.",
    },
    Claim {
        id: "5.5.3-range",
        place: "5.5.3, Fig. 29b",
        figures: &[29],
        statement: "The residual stress of Fig. 21 reduces the range of K_II of every crack of the network.",
        rule: "\u{394}K_II of each crack smaller than without the residual stress",
        decide: |r| {
            let (with, without) = (r.run("nine-stress")?, r.run("nine")?);
            let change = |(a, b): (&CrackGrowth, &CrackGrowth)| 100.0 * (a.delta_kii() / b.delta_kii() - 1.0);
            let changes: Vec<f64> = with.cracks.iter().zip(&without.cracks).map(change).collect();
            let holds = changes.iter().all(|change| *change < 0.0);
            Some(Decision::of(holds).with_all("\u{394}K_II %, crack", &NAMES, &changes))
        },
        why: "",
    },
    Claim {
        id: "5.5.3-parallel",
        place: "5.5.3, Fig. 30",
        figures: &[30],
        statement: "With the residual stress of Fig. 21, all cracks of the network branch and then grow parallel to the running surface, in the direction of the moving load.",
        rule: "all nine paths branch and then run within 10\u{b0} of the direction of the surface, along the travel",
        decide: |r| {
            let paths = paths(r, "nine-stress")?;
            let travel = if r.setup().travel == Travel::Along { 1.0 } else { -1.0 };
            let along = |path: &PathShape| path.along_after.is_some_and(|way| way * travel > 0.0);
            let holds = paths.iter().all(|path| path.runs_parallel() && along(path));
            Some(with_paths(Decision::of(holds), &paths))
        },
        why: "The paths that branch rise at 61\u{b0} to 69\u{b0} to the surface. Along the travel cracks 1 to 8 are kept closed by the residual stress and continue in their planes.",
    },
    Claim {
        id: "5.5.3-crack-9-path",
        place: "5.5.3, Fig. 30",
        figures: &[30],
        statement: "With the residual stress of Fig. 21, crack 9 grows differently from the other cracks of the network.",
        rule: "its side of branching, or whether it branches, differs from that of most of the others",
        decide: |r| {
            let paths = paths(r, "nine-stress")?;
            let side = |path: &PathShape| path.branch.map(|branch| branch.side);
            let same = paths[..8].iter().filter(|path| side(path) == side(&paths[8])).count();
            Some(with_paths(Decision::of(same < 4), &paths))
        },
        why: "Against the travel all nine cracks turn upwards.",
    },
];
