//! The load step is part of the answer: the error of a frictional passage falls with the tolerance, and faces without
//! memory do not pay for it.

use crate::common::{Rolling, StepControl, largest, surface_crack};
use railcrack::growth::StabilisedPassage;

/// K at the 241 output positions of the stabilised passage; `every` tells finer output apart.
fn sifs(result: &StabilisedPassage, every: usize) -> Vec<f64> {
    let passage = &result.passages[result.passages.len() - 1];
    passage.sifs[0].iter().step_by(every).flat_map(|k| [k.k1, k.k2]).collect()
}

#[test]
fn error_falls_with_the_tolerance() {
    for (degrees, friction, wheel) in [(15.0, 0.5, 0.025), (15.0, 0.8, 0.025), (165.0, 0.5, 0.025), (45.0, 0.8, -0.4)] {
        let mut rolling = Rolling::over(vec![surface_crack(0.0, 6.0, degrees)], friction, wheel);
        rolling.steps = StepControl { positions: 2401, tolerance: 1e-4 };
        let reference = sifs(&rolling.solve(), 10);
        let peak = largest(reference.iter().copied());
        let errors: Vec<(f64,usize)> = [8e-3, 4e-3, 2e-3, 1e-3, 5e-4]
            .into_iter()
            .map(|tolerance| {
                rolling.steps = StepControl { positions: 241, tolerance };
                let result = rolling.solve();
                let got = sifs(&result, 1);
                (largest(got.iter().zip(&reference).map(|(a, b)| a - b)) / peak, result.counts.substeps)
            })
            .collect();
        println!("{degrees} {friction}: {:?}", errors.iter().map(|e| format!("{:.2e} {}", e.0, e.1)).collect::<Vec<_>>());
    }
}

#[test]
fn faces_without_memory_take_no_substeps() {
    for degrees in [15.0, 90.0, 165.0] {
        let rolling = Rolling::over(vec![surface_crack(0.0, 6.0, degrees)], 0.0, 0.1);
        let result = rolling.solve();
        assert_eq!((result.counts.substeps, result.counts.passages), (0, 1), "{degrees}°");
    }
}
