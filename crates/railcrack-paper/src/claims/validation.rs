//! Section 4: the method against another one.

use crate::claim::{Claim, Decision};

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "4-agreement",
        place: "4, Fig. 13",
        figures: &[13],
        statement: "Finite elements and distributed dislocations in a half-plane give nearly the same K_I and K_II.",
        rule: "largest |K \u{2212} K of the dislocations in the half-plane| <= 5 % of the peak",
        decide: |r| {
            let parent =
                if r.setup().name.ends_with("against") { "half-plane, against" } else { "half-plane, along" };
            if r.setup().name == parent {
                return None;
            }
            let reference = r.elsewhere(parent, "fig13")?.crack();
            let difference = 100.0 * r.run("fig13")?.crack().sif.difference(&reference.sif);
            Some(
                Decision::of(difference <= 5.0)
                    .with("difference %", difference)
                    .with("peak", reference.sif.peak()),
            )
        },
        why: "",
    },
    Claim {
        id: "4-locked",
        place: "4, Fig. 13",
        figures: &[13],
        statement: "While the whole crack sticks, K_II from the displacement jumps is constant, and K_II from a domain integral \
                    varies a little.",
        rule: "largest change of K_II between two positions at which the whole crack sticks >= 0.1 % of the peak",
        decide: |r| {
            let change = 100.0 * r.run("fig13")?.crack().sif.change_while_stuck()?;
            Some(Decision::of(change >= 0.1).with("change %", change))
        },
        why: "K depends on the displacement jumps alone, which do not change while the faces stick: a variation is an error of the \
              integral. It vanishes once the integral includes the tractions on the crack faces.",
    },
];
