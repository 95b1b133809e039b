//! A run in which a surface crack coalesces with a buried one, beyond the junction and the spall.

use crate::common::{Absolute, Of, Relative, Rolling, close, default_elements, joined_body, largest};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::growth::{GrowthState, PieceKind, StepRecord, TipStop, Unobserved};
use railcrack_case::{Case, Overrides};
use railcrack_run::setup::PreparedRun;
use std::path::{Path, PathBuf};

/// The shipped case by whole kinks, for which the numbers below were found.
fn kinking(engine: Option<&str>) -> Case {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../cases/junction.toml");
    let text = std::fs::read_to_string(&path).unwrap() + "\n[growth]\nturning = \"kink\"\n";
    let overrides = Overrides { engine: engine.map(Into::into), ..Overrides::default() };
    Case::parse_with(&text, "junction.toml", Path::new(""), &overrides).unwrap()
}

fn case() -> Case {
    kinking(None)
}

/// The growth steps from `state` on until `last`, and the state after each.
fn steps(case: &Case, state: Option<GrowthState>, last: usize) -> Vec<(StepRecord, GrowthState)> {
    let mut growth = PreparedRun::new(case, None).unwrap().growth(state);
    let mut records = Vec::new();
    while let Some(record) = growth.next_step(&Unobserved).unwrap() {
        let step = record.step;
        records.push((record, growth.state().clone()));
        if step == last {
            break;
        }
    }
    records
}

/// Area with 96 elements along each crack, mm².
const SPALL: f64 = 5.351;

/// Crack 1 joins in one of the first steps, the two tips of crack 2 grow on, the upper one breaks
/// out; and a run that is resumed in between is the same run.
#[test]
fn area_of_the_spall() {
    let case = case();
    let records = steps(&case, None, 10);
    let joins =
        records.iter().position(|(record, _)| record.tips[0].stop == Some(TipStop::Coalescence)).unwrap();
    let (before, after) = (&records[joins].0, &records[joins + 1].0);
    assert_eq!([before.tips.len(), after.tips.len(), after.junctions().len()], [3, 2, 1]);
    assert_eq!(
        after.cracks()[1].vertex_at(after.cracks()[0].tip(railcrack::crack::End::Last)),
        Some(before.cracks()[1].points().len() / 2 + 1)
    );
    let spalls: Vec<_> = records.iter().flat_map(|(record, _)| &record.pieces).collect();
    assert_eq!(
        spalls.iter().map(|piece| (piece.kind, piece.crack)).collect::<Vec<_>>(),
        [(PieceKind::Spall, 1)]
    );
    close(spalls[0].area, SPALL, Relative(2e-3), "paths differ by a hundredth of a millimetre");
    assert!(records[10].0.tips[1].increment > 0.0, "the lower tip grows on");
    // Through the bytes of a checkpoint.
    let stored = postcard::to_stdvec(&records[joins].1).unwrap();
    let again = steps(&case, Some(postcard::from_bytes(&stored).unwrap()), joins + 2);
    for (one, two) in again.iter().zip(&records[joins + 1..]) {
        assert_eq!((&one.0.tips, one.0.cracks(), &one.1), (&two.0.tips, two.0.cracks(), &two.1));
    }
    assert_eq!(again.len(), 2);
}

/// K of both tips after the junction, at every position of the wheel.
#[test]
fn against_a_finer_mesh() {
    let case = case();
    let records = steps(&case, None, 4);
    let record = &records[4].0;
    assert_eq!(record.junctions().len(), 1);
    let mut rolling = Rolling::over(vec![record.cracks()[0].clone()], 0.1, 0.025);
    // Steps as fine as the mesh is to be judged.
    rolling.steps.tolerance = 5e-4;
    let histories = |elements: usize| {
        let body = joined_body(record.cracks(), record.junctions(), elements);
        let result = rolling.on(&FaceProblem::new(&body, &[0.1; 2]).unwrap(), &Newton::default());
        let passage = &result.passages[result.passages.len() - 1];
        passage.sifs.iter().flatten().flat_map(|k| [k.ki, k.kii]).collect::<Vec<f64>>()
    };
    let (k, fine) = (histories(default_elements()), histories(4 * default_elements()));
    let difference = largest(k.iter().zip(&fine).map(|(a, b)| a - b)) / largest(fine.iter().copied());
    close(
        difference,
        0.0,
        Absolute(5e-3),
        "required of the engine; 3.2e-3, K_I of the upper tip as it closes",
    );
}

/// The largest K_I lies where a face point changes its status, between output positions: a run has
/// it as eight times as many positions have it, in the other engine.
#[test]
fn ranges_between_output_positions() {
    let case = kinking(Some("xfem"));
    let record = &steps(&case, None, 3)[3].0;
    let mut rolling = Rolling::over(vec![record.cracks()[0].clone()], 0.1, 0.025);
    rolling.steps.positions = 1921;
    let body = joined_body(record.cracks(), record.junctions(), default_elements());
    let result = rolling.on(&FaceProblem::new(&body, &[0.1; 2]).unwrap(), &Newton::default());
    let upper = &result.histories[0];
    let largest_ki = upper.samples.iter().map(|k| k.ki).fold(0.0, f64::max);
    let reason = "the engines; 1.7 % at output positions and held points alone";
    close(record.tips[0].ki_max, largest_ki, Of(7e-3, upper.peak()), reason);
}

/// The whole run by the other engine: the same final tips, and the same spall.
#[test]
fn by_finite_elements() {
    let case = kinking(Some("xfem"));
    let records = steps(&case, None, 10);
    let stops = |tip: usize| records.iter().filter_map(move |(record, _)| record.tips.get(tip)?.stop).next();
    assert_eq!(stops(0), Some(TipStop::Coalescence));
    let spalls: Vec<_> = records.iter().flat_map(|(record, _)| &record.pieces).collect();
    assert_eq!(spalls.len(), 1);
    close(spalls[0].area, SPALL, Relative(1e-2), "0.03 %; paths of different engines");
    assert!(records[10].0.tips[1].increment > 0.0, "the lower tip grows on");
}
