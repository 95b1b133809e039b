//! Section 5.2: friction of the crack faces.

use crate::case_run::CrackGrowth;
use crate::claim::{Claim, Decision, falls, rises};
use crate::path_shape::{PathShape, Side};
use crate::results::SetupResults;

/// In increasing order; the paper's text does not give the values of its Figs 17 and 18.
const CURVES: [&str; 4] = ["faces-0.1", "faces-0.2", "reference", "faces-0.8"];
const SIZES: [&str; 4] = ["0.1", "0.2", "0.5", "0.8"];

fn over(r: SetupResults, of: fn(&CrackGrowth) -> f64) -> Option<Vec<f64>> {
    CURVES.iter().map(|curve| Some(of(r.run(curve)?.crack()))).collect()
}

fn paths(r: SetupResults) -> Option<Vec<PathShape>> {
    CURVES.iter().map(|curve| Some(PathShape::of(r.grown(curve)?.crack()))).collect()
}

fn with_branches(mut decision: Decision, paths: &[PathShape]) -> Decision {
    for (size, path) in SIZES.iter().zip(paths) {
        decision = decision.with(format!("{size} {}, depth", path.words()), path.depth);
    }
    decision
}

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "5.2-range",
        place: "5.2, Fig. 17b",
        figures: &[17],
        statement: "Higher crack-face friction reduces the range of K_II.",
        rule: "\u{394}K_II falls with the crack-face friction, from 0.1 to 0.2 to 0.5 to 0.8",
        decide: |r| {
            let ranges = over(r, CrackGrowth::delta_kii)?;
            Some(Decision::of(falls(&ranges)).with_all("\u{394}K_II at", &SIZES, &ranges))
        },
        why: "",
    },
    Claim {
        id: "5.2-opening",
        place: "5.2, Fig. 17a",
        figures: &[17],
        statement: "Crack-face friction does not affect the opening and \u{394}K_I.",
        rule: "\u{394}K_I at the crack-face frictions 0.1 to 0.8 within 5 % of the largest of them",
        decide: |r| {
            let ranges = over(r, CrackGrowth::delta_ki)?;
            let (low, high) = ranges.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &k| (l.min(k), h.max(k)));
            Some(Decision::of(high - low <= 0.05 * high).with_all("\u{394}K_I at", &SIZES, &ranges))
        },
        why: "In the block the statement holds for friction from 0.2 on, where the crack opens most while the wheel is far away. At 0.1 the crack opens through slip of its faces under the wheel, near |x_c| = 0.5 a, by an amount that depends on friction; in the half-plane this is nearly all of the opening.",
    },
    Claim {
        id: "5.2-antagonists",
        place: "5.2; 6",
        figures: &[17],
        statement: "Crack-face friction slows growth, wheel–rail friction accelerates it.",
        rule: "\u{394}K_eq falls with the crack-face friction from 0.1 to 0.8 and rises with the wheel–rail friction from 0.025 to 0.1 to 0.4",
        decide: |r| {
            let faces = over(r, CrackGrowth::delta_keq)?;
            let wheel: Option<Vec<f64>> = ["reference", "wheel+0.1", "wheel+0.4"]
                .iter()
                .map(|curve| Some(r.run(curve)?.crack().delta_keq()))
                .collect();
            let wheel = wheel?;
            let decision =
                Decision::of(falls(&faces) && rises(&wheel)).with_all("\u{394}K_eq, faces", &SIZES, &faces);
            Some(decision.with_all("\u{394}K_eq, wheel", &["0.025", "0.1", "0.4"], &wheel))
        },
        why: "The statement on crack-face friction holds; that on wheel–rail friction fails between 0.025 and 0.1 for cracks that lean along the travel.",
    },
    Claim {
        id: "5.2-coplanar-first",
        place: "5.2, Fig. 18",
        figures: &[18],
        statement: "At every crack-face friction, growth is co-planar at first.",
        rule: "at least 3 increments within 20\u{b0} of the initial line at each friction from 0.1 to 0.8",
        decide: |r| {
            let paths = paths(r)?;
            let holds = paths.iter().all(|path| path.coplanar_increments() > 3);
            Some(with_branches(Decision::of(holds), &paths))
        },
        why: "Cracks that lean against the travel turn upwards in the first increment from the crack-face friction 0.2 on.",
    },
    Claim {
        id: "5.2-paths-differ",
        place: "5.2, Fig. 18",
        figures: &[18],
        statement: "After co-planar growth, the crack paths differ with the crack-face friction.",
        rule: "depths of the ends of the paths at least 1 mm apart",
        decide: |r| {
            let paths = paths(r)?;
            let ends =
                paths.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), p| (l.min(p.depth), h.max(p.depth)));
            Some(
                Decision::of(ends.1 - ends.0 >= 1.0)
                    .with("least depth", ends.0)
                    .with("largest depth", ends.1),
            )
        },
        why: "",
    },
    Claim {
        id: "5.2-earlier",
        place: "5.2, Fig. 18",
        figures: &[18],
        statement: "With higher crack-face friction the crack branches earlier.",
        rule: "first increment > 20\u{b0} off the line: not later from 0.1 to 0.8, and earlier at 0.8 than at 0.1",
        decide: |r| {
            let paths = paths(r)?;
            let first: Vec<usize> = paths.iter().map(PathShape::coplanar_increments).collect();
            let holds = first[3] < first[0] && first.windows(2).all(|pair| pair[1] <= pair[0]);
            Some(with_branches(Decision::of(holds), &paths))
        },
        why: "In the block with cracks that lean along the travel it holds from 0.2 to 0.8, where all paths branch down; but the path at 0.1 branches earlier than that at 0.2.",
    },
    Claim {
        id: "5.2-sides",
        place: "5.2, Fig. 18",
        figures: &[18],
        statement: "With low crack-face friction the crack branches up, with high friction it branches down.",
        rule: "at 0.1 the path branches up, at 0.8 down",
        decide: |r| {
            let paths = paths(r)?;
            let holds = paths[0].branches(Side::Up) && paths[3].branches(Side::Down);
            Some(with_branches(Decision::of(holds), &paths))
        },
        why: "For cracks that lean against the travel, those with high friction branch up. Where negative k1 counts, the paths at 0.1 and 0.2 branch up and those at 0.5 and 0.8 down, all of them in the first increment.",
    },
];
