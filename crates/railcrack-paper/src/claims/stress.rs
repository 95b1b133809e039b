//! Section 5.4: the stress of Fig. 21.

use crate::claim::{Claim, Decision};
use crate::path_shape::{PathShape, Side};

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "5.4-closed",
        place: "5.4.2, Fig. 22a",
        figures: &[22],
        statement: "With the residual stress of Fig. 21 the crack stays closed during the whole passage.",
        rule: "max K_I <= 0.1 MPa\u{221a}m",
        decide: |r| {
            let top = |curve: &str| Some(r.run(curve)?.crack().sif.ki.iter().copied().fold(0.0, f64::max));
            let (with, without) = (top("stress")?, top("reference")?);
            Some(Decision::of(with <= 0.1).with("max K_I", with).with("without", without))
        },
        why: "In the half-plane the crack is closed without the residual stress as well.",
    },
    Claim {
        id: "5.4-range",
        place: "5.4.2, Fig. 22b; 6",
        figures: &[22],
        statement: "The residual stress of Fig. 21 reduces the range of K_II.",
        rule: "\u{394}K_II is smaller with the residual stress than without",
        decide: |r| {
            let range = |curve: &str| Some(r.run(curve)?.crack().delta_kii());
            let (with, without) = (range("stress")?, range("reference")?);
            Some(Decision::of(with < without).with("\u{394}K_II with", with).with("without", without))
        },
        why: "The residual stress of the rolled steels lies deeper than the tip of the initial crack and does not affect it.",
    },
    Claim {
        id: "5.4-rate",
        place: "5.4.2",
        figures: &[23],
        statement: "The residual stress of Fig. 21 slows growth.",
        rule: "with the residual stress \u{394}K_eq of the initial crack is smaller, and more cycles are needed to a length of 7 mm",
        decide: |r| {
            let (with, without) = (r.grown("stress")?.crack(), r.grown("reference")?.crack());
            let cycles = (with.cycles_to(7.0), without.cycles_to(7.0));
            let slower = matches!(cycles, (Some(with), Some(without)) if with > without);
            let decision = Decision::of(with.delta_keq() < without.delta_keq() && slower)
                .with("\u{394}K_eq with", with.delta_keq())
                .with("without", without.delta_keq());
            Some(match cycles {
                (Some(with), Some(without)) => decision.with("cycles to 7 mm, times", with / without),
                _ => decision,
            })
        },
        why: "",
    },
    Claim {
        id: "5.4-longer-coplanar",
        place: "5.4.2, Fig. 23; 6",
        figures: &[23],
        statement: "With the residual stress of Fig. 21, co-planar growth lasts longer.",
        rule: "with the residual stress the first increment > 20\u{b0} off the initial line comes later",
        decide: |r| {
            let first = |curve: &str| Some(PathShape::of(r.grown(curve)?.crack()).coplanar_increments());
            let (with, without) = (first("stress")?, first("reference")?);
            let decision = Decision::of(with > without).with("branches in increment, with", with as f64);
            Some(decision.with("without", without as f64))
        },
        why: "With the residual stress the crack branches up in the first increment in all four main set-ups.",
    },
    Claim {
        id: "5.4-up",
        place: "5.4.2, Fig. 23",
        figures: &[23],
        statement: "With the residual stress of Fig. 21 the crack branches up, without it down.",
        rule: "the path with the residual stress branches up, that without it down",
        decide: |r| {
            let path = |curve: &str| Some(PathShape::of(r.grown(curve)?.crack()));
            let (with, without) = (path("stress")?, path("reference")?);
            let holds = with.branches(Side::Up) && without.branches(Side::Down);
            let decision = Decision::of(holds).with(format!("with {}, depth", with.words()), with.depth);
            Some(decision.with(format!("without {}, depth", without.words()), without.depth))
        },
        why: "With the residual stress the crack branches up in all four main set-ups; without it, it branches down in the block along the travel only.",
    },
];
