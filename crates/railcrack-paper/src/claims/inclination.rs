//! Section 5.3: inclination of the initial crack.

use crate::case_run::CrackGrowth;
use crate::claim::{Claim, Decision, falls, rises};
use crate::path_shape::{PathShape, Side};
use crate::results::SetupResults;

const CURVES: [&str; 5] = ["reference", "angle-30", "angle-45", "angle-60", "angle-75"];
const ANGLES: [&str; 5] = ["15\u{b0}", "30\u{b0}", "45\u{b0}", "60\u{b0}", "75\u{b0}"];

fn over(r: SetupResults, of: fn(&CrackGrowth) -> f64) -> Option<Vec<f64>> {
    CURVES.iter().map(|curve| Some(of(r.run(curve)?.crack()))).collect()
}

fn paths(r: SetupResults) -> Option<Vec<PathShape>> {
    CURVES.iter().map(|curve| Some(PathShape::of(r.grown(curve)?.crack()))).collect()
}

fn with_paths(mut decision: Decision, paths: &[PathShape]) -> Decision {
    for (angle, path) in ANGLES.iter().zip(paths) {
        decision = decision.with(format!("{angle} {}, depth", path.words()), path.depth);
    }
    decision
}

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "5.3-range-2",
        place: "5.3, Fig. 19b",
        figures: &[19],
        statement: "The range of K_II increases with the inclination of the crack.",
        rule: "\u{394}K_II rises with the inclination from 15\u{b0} to 30\u{b0}, 45\u{b0}, 60\u{b0}, 75\u{b0}",
        decide: |r| {
            let ranges = over(r, CrackGrowth::delta_kii)?;
            Some(Decision::of(rises(&ranges)).with_all("\u{394}K_II at", &ANGLES, &ranges))
        },
        why: "In all four main set-ups \u{394}K_II rises from 30\u{b0} on; the value at 15\u{b0} is the exception.",
    },
    Claim {
        id: "5.3-range-1",
        place: "5.3, Fig. 19a",
        figures: &[19],
        statement: "The opening of the crack decreases with its inclination.",
        rule: "\u{394}K_I falls with the inclination from 15\u{b0} to 30\u{b0}, 45\u{b0}, 60\u{b0}, 75\u{b0}",
        decide: |r| {
            let ranges = over(r, CrackGrowth::delta_ki)?;
            Some(Decision::of(falls(&ranges)).with_all("\u{394}K_I at", &ANGLES, &ranges))
        },
        why: "In the half-plane these cracks are closed, with \u{394}K_I below 0.1 MPa\u{221a}m. In the block they open most with the wheel at the ends of the passage, and steeper cracks open more.",
    },
    Claim {
        id: "5.3-down",
        place: "5.3, Fig. 20",
        figures: &[20],
        statement: "Cracks of 15\u{b0} to 60\u{b0} branch down.",
        rule: "the paths from 15\u{b0}, 30\u{b0}, 45\u{b0}, 60\u{b0} branch down",
        decide: |r| {
            let paths = paths(r)?;
            let holds = paths[..4].iter().all(|path| path.branches(Side::Down));
            Some(with_paths(Decision::of(holds), &paths[..4]))
        },
        why: "One of the sixteen paths branches down: that of 15\u{b0} in the block, along the travel, at increment 18.",
    },
    Claim {
        id: "5.3-coplanar-75",
        place: "5.3, Fig. 20",
        figures: &[20],
        statement: "The crack of 75\u{b0} grows co-planar.",
        rule: "no increment > 20\u{b0} off the initial line (listed with it: the secondary maximum of the direction criterion in the first increment, and its ratio to the main maximum)",
        decide: |r| {
            let crack = r.grown("angle-75")?.crack();
            let path = PathShape::of(crack);
            let first = crack.steps[0];
            let decision = Decision::of(path.is_coplanar())
                .with(format!("{}, first kink \u{b0}", path.words()), first.kink_deg?);
            Some(match (first.rival_deg, first.rival_ratio) {
                (Some(angle), Some(ratio)) => {
                    decision.with("secondary maximum \u{b0}", angle).with("ratio", ratio)
                }
                _ => decision,
            })
        },
        why: "In the half-plane along the travel it is a near tie of the direction criterion (ratio above 0.99), so that the path is sensitive to differences below the accuracy of the model.",
    },
    Claim {
        id: "6-same-direction",
        place: "6",
        figures: &[20],
        statement: "After branching down, cracks of all inclinations grow in the same direction.",
        rule: "for the paths that branch down (at least two), inclinations from the branch to the end within 15\u{b0}",
        decide: |r| {
            let paths = paths(r)?;
            let down = paths.iter().filter(|path| path.branches(Side::Down));
            let angles: Vec<f64> = down.filter_map(|path| path.inclination_after).collect();
            let (low, high) =
                angles.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &a| (l.min(a), h.max(a)));
            let holds = angles.len() >= 2 && high - low <= 15.0;
            let decision = Decision::of(holds).with("paths down", angles.len() as f64);
            Some(if angles.is_empty() {
                decision
            } else {
                decision.with("from \u{b0}", low).with("to \u{b0}", high)
            })
        },
        why: "At the friction of Table 1 fewer than two paths branch down.",
    },
];
