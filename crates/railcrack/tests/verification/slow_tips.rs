//! Tips that are much slower than the fastest: the second crack of a squat, which turns up at once.

use crate::common::{Absolute, Rolling, close, joined_body, largest};
use railcrack::body::CrackedBody;
use railcrack::case::{Case, Overrides};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::Crack;
use railcrack::fracture::Sif;
use railcrack::growth::{GrowthState, StepRecord, Unobserved};
use railcrack::math::Vec2;
use std::path::PathBuf;

fn squat(engine: &str) -> Case {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../cases/squat-pair.toml");
    let overrides = Overrides { engine: Some(engine.into()), steps: Some(12), ..Overrides::default() };
    Case::read_with(&path, &overrides).unwrap()
}

/// The steps from `state` on until `last`, and the state after each.
fn steps(case: &Case, state: Option<GrowthState>, last: usize) -> Vec<(StepRecord, GrowthState)> {
    let mut growth = case.prepare(None).unwrap().growth(state);
    let mut records = Vec::new();
    while records.last().is_none_or(|(record, _): &(StepRecord, _)| record.step < last) {
        let record = growth.next_step(&Unobserved).unwrap().unwrap();
        records.push((record, growth.state().clone()));
    }
    records
}

/// K of both tips through the passage.
fn histories(body: &CrackedBody, cracks: &[Crack]) -> Vec<Vec<Sif>> {
    let rolling = Rolling::over(cracks.to_vec(), 0.5, 0.025);
    rolling.on(&FaceProblem::new(body, &[0.5; 2]).unwrap(), &Newton::default()).passages.pop().unwrap().sifs
}

/// By fine elements of the engine without a mesh.
fn wanted(cracks: &[Crack]) -> Vec<Vec<Sif>> {
    const FINE: usize = 120;
    histories(&joined_body(cracks, &[], FINE), cracks)
}

/// The largest difference of K of the second tip at any position, over its largest |K|.
fn misfit(k: &[Vec<Sif>], want: &[Vec<Sif>]) -> f64 {
    let off = largest(k[1].iter().zip(&want[1]).flat_map(|(a, b)| [a.ki - b.ki, a.kii - b.kii]));
    off / largest(want[1].iter().flat_map(|k| [k.ki, k.kii]))
}

/// K of the slow tip on the way of a run by finite elements at the defaults.
#[test]
fn k_of_the_slow_tip_of_a_squat() {
    let records = steps(&squat("xfem"), None, 7);
    for (record, _) in &records {
        let sifs = &record.passages[record.passages.len() - 1].sifs;
        let off = misfit(sifs, &wanted(&record.cracks));
        println!(
            "step {}: {:.2} %, {:.3} mm waiting",
            record.step,
            100.0 * off,
            record.tips[1].deferred.length
        );
        close(off, 0.0, Absolute(0.04), "2.5 elements behind a turn of 76 degrees");
        assert_eq!(record.warnings, []);
    }
    let turned = &records[7].0.cracks[1];
    let (from, to) = turned.segment(turned.segment_count() - 1);
    assert!((to - from).length() > 0.24, "a whole increment: {turned:?}");
}

/// A run that is taken up while a tip waits goes on to the same bits, in either engine; and both engines wait at the same steps.
#[test]
fn taken_up_while_a_tip_waits() {
    let waits = ["dislocation", "xfem"].map(|engine| {
        let case = squat(engine);
        let records = steps(&case, None, 7);
        let state = &records[2].1;
        assert!(state.deferred[1][0].length > 0.1, "{:?}", state.deferred);
        // Through the bytes of a checkpoint.
        let stored = postcard::to_stdvec(state).unwrap();
        let again = steps(&case, Some(postcard::from_bytes(&stored).unwrap()), 7);
        assert_eq!(again.len(), 5);
        for (one, two) in again.iter().zip(&records[3..]) {
            assert_eq!((&one.0.tips, &one.0.cracks, &one.1), (&two.0.tips, &two.0.cracks, &two.1));
        }
        let tip = records[7].0.tips[1];
        assert!(tip.y > records[0].0.tips[1].y, "put in");
        let lengths =
            records.iter().map(|(record, _)| (record.tips[1].length, record.tips[1].deferred.length));
        (lengths.collect::<Vec<_>>(), Vec2::new(tip.x, tip.y))
    });
    let [(dislocations, at), (finite, also_at)] = &waits;
    for ((length, waiting), (other, also)) in dislocations.iter().zip(finite) {
        close(*length, *other, Absolute(0.01), "rates of two engines");
        assert_eq!(*waiting > 0.0, *also > 0.0, "{waits:?}");
    }
    close((*at - *also_at).length(), 0.0, Absolute(0.02), "where one increment of 0.25 mm leads");
}
