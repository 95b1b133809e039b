//! Section 5.1: friction between wheel and rail.

use crate::case_run::SifCurve;
use crate::claim::{Claim, Decision, rises};
use crate::path_shape::{PathShape, Side};
use crate::results::SetupResults;

const BRAKING: [&str; 3] = ["reference", "wheel+0.1", "wheel+0.4"];
const DRIVING: [&str; 3] = ["wheel-0.025", "wheel-0.1", "wheel-0.4"];
const SIZES: [&str; 3] = ["0.025", "0.1", "0.4"];

fn ranges(r: SetupResults, curves: [&str; 3]) -> Option<Vec<f64>> {
    curves.iter().map(|curve| Some(r.run(curve)?.crack().delta_kii())).collect()
}

fn widens(r: SetupResults, curves: [&str; 3]) -> Option<Decision> {
    let ranges = ranges(r, curves)?;
    Some(Decision::of(rises(&ranges)).with_all("\u{394}K_II at", &SIZES, &ranges))
}

/// The first increment off the line, for growing friction; one more than there are where there is
/// none.
fn branches_earlier(r: SetupResults, curves: [&str; 3]) -> Option<Decision> {
    let first: Option<Vec<f64>> = curves
        .iter()
        .map(|curve| Some(PathShape::of(r.grown(curve)?.crack()).coplanar_increments() as f64))
        .collect();
    let first = first?;
    let earlier = first[2] < first[0] && first.windows(2).all(|pair| pair[1] <= pair[0]);
    Some(Decision::of(earlier).with_all("branches in increment", &SIZES, &first))
}

/// How far K at the wheel positions rises and falls when the friction goes from `from` to `to`,
/// MPa√m.
fn rise_and_fall(from: &SifCurve, to: &SifCurve, which: usize) -> [f64; 2] {
    let changes = to.minus(from).into_iter().map(|difference| {
        let size = |curve: &SifCurve| curve.at(difference[0]).map_or(0.0, |k| k[which].abs());
        size(to) - size(from)
    });
    changes.fold([0.0, 0.0], |[up, down]: [f64; 2], change| [up.max(change), down.min(change)])
}

fn adds_or_subtracts(r: SetupResults, which: usize) -> Option<Decision> {
    let of = |curve: &str| Some(&r.run(curve)?.crack().sif);
    let [up, down] = rise_and_fall(of("reference")?, of("wheel+0.4")?, which);
    let [up_driving, down_driving] = rise_and_fall(of("wheel-0.025")?, of("wheel-0.4")?, which);
    let share = 0.05 * of("wheel+0.4")?.peak();
    let both = [up, -down, up_driving, -down_driving].iter().filter(|change| **change >= share).count();
    let decision = Decision::of(both >= 3).with("braking rises", up).with("falls", down);
    Some(decision.with("driving rises", up_driving).with("falls", down_driving))
}

fn sides(r: SetupResults, braking: Side, driving: Side) -> Option<Decision> {
    let brake = PathShape::of(r.grown("wheel+0.4")?.crack());
    let drive = PathShape::of(r.grown("wheel-0.4")?.crack());
    let holds = brake.branches(braking) && drive.branches(driving);
    let decision = Decision::of(holds).with(format!("+0.4 {}, depth", brake.words()), brake.depth);
    Some(decision.with(format!("\u{2212}0.4 {}, depth", drive.words()), drive.depth))
}

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "5.1-superposition",
        place: "5.1, Figs 14b, 15b",
        figures: &[14, 15],
        statement: "The contributions of wheel pressure and shear traction to K_II add or subtract, depending on the sign of the wheel–rail friction and on the wheel position.",
        rule: "from |\u{3bc}| = 0.025 to 0.4, |K_II| rises somewhere and falls somewhere by >= 5 % of the peak, in three of the four cases",
        decide: |r| adds_or_subtracts(r, 1),
        why: "",
    },
    Claim {
        id: "5.1-opening",
        place: "5.1, Figs 14a, 15a",
        figures: &[14, 15],
        statement: "Wheel–rail friction of either sign opens the crack, at different wheel positions.",
        rule: "max K_I at friction +0.4 and at \u{2212}0.4 >= 1 MPa\u{221a}m, at wheel positions >= a apart",
        decide: |r| {
            let top = |curve: &str| {
                let sif = &r.run(curve)?.crack().sif;
                let top = (0..sif.ki.len()).max_by(|&i, &j| sif.ki[i].total_cmp(&sif.ki[j]))?;
                Some((sif.position[top], sif.ki[top]))
            };
            let ((at, brake), (at_driving, drive)) = (top("wheel+0.4")?, top("wheel-0.4")?);
            let holds = brake >= 1.0 && drive >= 1.0 && (at - at_driving).abs() >= 1.0;
            let decision = Decision::of(holds).with("K_I +0.4", brake).with("at x_c/a", at);
            Some(decision.with("K_I \u{2212}0.4", drive).with("at x_c/a", at_driving))
        },
        why: "",
    },
    Claim {
        id: "5.1-range-braking",
        place: "5.1, Fig. 14b",
        figures: &[14],
        statement: "Higher friction of a braking wheel increases the range of K_II.",
        rule: "\u{394}K_II rises from 0.025 to 0.1 to 0.4",
        decide: |r| widens(r, BRAKING),
        why: "For cracks that lean along the travel, low friction reduces the shear due to the pressure alone, so that \u{394}K_II is smallest at 0.1. For cracks that lean against the travel, friction adds to that shear at every value.",
    },
    Claim {
        id: "5.1-range-driving",
        place: "5.1, Fig. 15b",
        figures: &[15],
        statement: "Higher friction of a driven wheel increases the range of K_II.",
        rule: "\u{394}K_II rises from \u{2212}0.025 to \u{2212}0.1 to \u{2212}0.4",
        decide: |r| widens(r, DRIVING),
        why: "For cracks that lean against the travel, \u{394}K_II is smallest at \u{2212}0.1.",
    },
    Claim {
        id: "5.1-earlier-braking",
        place: "5.1, Fig. 16a; 6",
        figures: &[16],
        statement: "With higher friction of a braking wheel the crack branches earlier.",
        rule: "first increment > 20\u{b0} off the initial line: not later from 0.025 to 0.1 to 0.4, and earlier at 0.4",
        decide: |r| branches_earlier(r, BRAKING),
        why: "A crack that leans against the travel branches up in the first increment at every friction.",
    },
    Claim {
        id: "5.1-earlier-driving",
        place: "5.1, Fig. 16b; 6",
        figures: &[16],
        statement: "With higher friction of a driven wheel the crack branches earlier.",
        rule: "first increment > 20\u{b0} off the initial line: not later from \u{2212}0.025 to \u{2212}0.1 to \u{2212}0.4, and earlier at \u{2212}0.4",
        decide: |r| branches_earlier(r, DRIVING),
        why: "At \u{2212}0.4 the crack branches earlier than at \u{2212}0.1 in every main set-up; from \u{2212}0.025 to \u{2212}0.1 it branches later, except along the travel in the half-plane, where neither path branches.",
    },
    Claim {
        id: "5.1-sides-caption",
        place: "5.1, caption of Fig. 16",
        figures: &[16],
        statement: "Under a braking wheel the crack branches up, under a driven wheel down (caption and text of Fig. 16 read together).",
        rule: "at +0.4 the path branches up, at \u{2212}0.4 down",
        decide: |r| sides(r, Side::Up, Side::Down),
        why: "For cracks that lean against the travel the caption holds; with the drag reversed the conclusion holds: the two differ by the sign of the friction. For cracks that lean along the travel both paths branch down.",
    },
    Claim {
        id: "5.1-sides-conclusion",
        place: "6",
        figures: &[16],
        statement: "Under a driven wheel the crack branches up, under a braking wheel down.",
        rule: "at \u{2212}0.4 the path branches up, at +0.4 down",
        decide: |r| sides(r, Side::Down, Side::Up),
        why: "The caption of Fig. 16 states the opposite. For cracks that lean against the travel the caption holds; with the drag reversed this statement holds: the two differ by the sign of the friction.",
    },
];
