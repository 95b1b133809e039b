//! Theories of rolling contact against the exact theory.

use crate::common::{column, measured, rows};
use railcrack::load::HertzEllipse;
use railcrack::material::IsotropicElastic;
use railcrack::rolling::{Creepage, RollingPatch, RollingTheory};
use std::f64::consts::PI;

/// CONTACT's examples have G = 82 000 MPa and ν = 0.28.
fn steel() -> IsotropicElastic {
    IsotropicElastic::new(2.0 * 82e3 * 1.28, 0.28).unwrap()
}

/// A patch in rolling contact, and F_x and F_y of CONTACT over μN.
struct Output {
    patch: RollingPatch,
    force: [f64; 2],
}

impl Output {
    /// The error of the force of `theory` over μN, by so many strips and intervals of each.
    fn error(&self, theory: RollingTheory, points: [usize; 2]) -> f64 {
        let patch = RollingPatch { theory, ..self.patch };
        let [fx, fy] = patch.mean_shear(points).map(|share| share / patch.friction);
        (fx - self.force[0]).hypot(fy - self.force[1])
    }

    /// Row and column of the table: creepage alone or with spin; up to 0.9 μN and above.
    fn class(&self) -> usize {
        let slides = self.force[0].hypot(self.force[1]) > 0.9;
        2 * usize::from(self.patch.creepage.spin != 0.0) + usize::from(slides)
    }
}

fn outputs(file: &str) -> Vec<Output> {
    let table = rows(&format!("rolling-forces/{file}"));
    let names = ["a_mm", "b_mm", "normal_n", "friction", "creepage_x", "creepage_y", "spin_per_mm"];
    let [a, b, normal, friction, x, y, spin] = names.map(|name| column(&table, name));
    let [fx, fy] = ["fx_n", "fy_n"].map(|name| column(&table, name));
    let output = |i: usize| {
        let peak_pressure = 1.5 * normal[i] / (PI * a[i] * b[i]);
        let patch = RollingPatch {
            ellipse: HertzEllipse { peak_pressure, along: a[i], across: b[i] },
            outline: None,
            friction: friction[i],
            creepage: Creepage { longitudinal: x[i], lateral: y[i], spin: spin[i] },
            steel: steel(),
            theory: RollingTheory::FaStrip,
        };
        Output { patch, force: [fx[i], fy[i]].map(|force| force / (friction[i] * normal[i])) }
    };
    (0..a.len()).map(output).collect()
}

/// Mean and largest error of `theory` in each class of `outputs`.
fn errors(outputs: &[Output], theory: RollingTheory) -> [[f64; 2]; 4] {
    let mut all: [Vec<f64>; 4] = Default::default();
    for output in outputs {
        all[output.class()].push(output.error(theory, [30, 30]));
    }
    all.map(|errors| {
        [errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max)]
    })
}

/// A theory and its errors on the page docs/how-to/vehicle.md, in hundredths of μN.
struct Stated {
    theory: RollingTheory,
    /// Means of the classes of the coarse outputs.
    coarse: [f64; 4],
    /// Of the fine outputs: mean of the curve of longitudinal creepage, then two with spin.
    fine: [f64; 3],
}

const STATED: [Stated; 3] = [
    Stated { theory: RollingTheory::FaStrip, coarse: [2.6, 0.8, 3.8, 1.7], fine: [0.1, 2.5, 3.9] },
    Stated { theory: RollingTheory::Strip, coarse: [2.6, 0.6, 3.7, 1.0], fine: [0.1, 0.8, 4.1] },
    Stated { theory: RollingTheory::Fastsim, coarse: [4.8, 1.4, 6.5, 1.3], fine: [1.0, 5.3, 3.0] },
];

#[test]
fn forces_on_a_coarse_grid() {
    let outputs = outputs("coarse.csv");
    for Stated { theory, coarse, .. } in STATED {
        let found = errors(&outputs, theory);
        for ([mean, largest], stated) in found.into_iter().zip(coarse) {
            measured(mean, stated / 100.0, "mean of a class, of μN; 41 elements of CONTACT");
            assert!(100.0 * mean <= stated && largest < 0.25, "{theory:?} {found:.4?}");
        }
    }
}

#[test]
fn forces_on_a_fine_grid() {
    let outputs = outputs("outputs.csv");
    for Stated { theory, fine, .. } in STATED {
        let errors: Vec<f64> = outputs.iter().map(|output| output.error(theory, [60, 80])).collect();
        let (curve, spin) = errors.split_at(30);
        let found = [curve.iter().sum::<f64>() / 30.0, spin[0], spin[1]];
        for (error, stated) in found.into_iter().zip(fine) {
            measured(error, stated / 100.0, "of μN; 360 to 1380 elements of CONTACT");
            assert!(100.0 * error <= stated, "{theory:?} {found:.4?}");
        }
    }
}
