//! Times of the chain from cracks to increments: the body, one geometry under the wheel, one growth
//! step.

use divan::{Bencher, black_box};
use railcrack::body::CrackedBody;
use railcrack::contact::{
    ContactSolver, CrackFluid, FaceProblem, FluidModel, Latin, Newton, PressureProfile,
};
use railcrack::dislocation;
use railcrack::field::HertzWheel;
use railcrack::growth::{StabilisedPassage, StepRecord, StepSource, Unobserved};
use railcrack::load::HertzianContact;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack_case::{Case, Overrides};
use railcrack_run::setup::{PreparedRun, wheel_field};
use std::path::{Path, PathBuf};

const REFERENCE: &str = "reference.toml";
const NINE_CRACKS: &str = "network-nine.toml";

fn main() {
    divan::main();
}

fn path(case: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(case)
}

fn read(case: &str) -> Case {
    Case::read(&path(case)).unwrap()
}

fn body(case: &Case) -> CrackedBody {
    dislocation::cracked_body(&case.cracks, &case.steel, case.plane().unwrap().face_resolution(&case.cracks))
        .unwrap()
}

/// C and S: assembly of the energy of the jumps, and its inverse.
#[divan::bench(args = [REFERENCE, NINE_CRACKS], sample_count = 10, sample_size = 1)]
fn cracked_body(bencher: Bencher, case: &str) {
    let case = read(case);
    bencher.bench(|| body(black_box(&case)).dofs);
}

/// All passages of the reference case until the history repeats, on a body that is there.
fn passages(bencher: Bencher, solver: &dyn ContactSolver) {
    let case = read(REFERENCE);
    let body = body(&case);
    let problem = FaceProblem::new(&body, &case.crack_friction).unwrap();
    let wheel = wheel_field(&case.first_wheel().wheel, &case.steel).unwrap();
    let load = RailLoad { wheel: wheel.as_ref(), residual: None };
    bencher.bench_local(|| -> StabilisedPassage {
        stabilised_passage(&problem, solver, load, &case.first_wheel().passages, &Unobserved).unwrap()
    });
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn stabilised_passage_newton(bencher: Bencher) {
    passages(bencher, &Newton::default());
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn stabilised_passage_latin(bencher: Bencher) {
    passages(bencher, &Latin::default());
}

/// The first growth step of the reference case as a run computes it: body, passages, direction,
/// increment.
#[divan::bench(args = ["newton", "latin"], sample_count = 3, sample_size = 1)]
fn growth_step(bencher: Bencher, solver: &str) {
    let overrides = Overrides { contact: Some(solver.into()), ..Overrides::default() };
    let case = Case::read_with(&path(REFERENCE), &overrides).unwrap();
    bencher.with_inputs(|| PreparedRun::new(&case, None).unwrap().growth(None)).bench_local_values(
        |mut run: Box<dyn StepSource>| -> Option<StepRecord> { run.next_step(&Unobserved).unwrap() },
    );
}

/// The passages of the reference case over a lubricated crack under a driven wheel: dry, with the
/// pressure of the contact over the mouth, and with trapped fluid that leaks or does not.
#[divan::bench(args = ["dry", "mouth", "sealed", "leaking"], sample_count = 20, sample_size = 1)]
fn passages_with_fluid(bencher: Bencher, fluid: &str) {
    let case = read(REFERENCE);
    let body = body(&case);
    let trapped = |leak| FluidModel::Trapped { bulk_modulus: 2200.0, leak };
    let model = match fluid {
        "mouth" => Some(FluidModel::Mouth { cap: 300.0 }),
        "sealed" => Some(trapped(false)),
        "leaking" => Some(trapped(true)),
        _ => None,
    };
    let profile = PressureProfile::Linear;
    let fluid = model.map(|model| CrackFluid { model, profile, cracks: None }.on(&case.cracks, &body.faces));
    let problem = FaceProblem::new(&body, &[0.1]).unwrap().with_fluid(fluid);
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: -0.4 };
    let wheel = HertzWheel::new(&contact, &case.steel).unwrap();
    let load = RailLoad { wheel: &wheel, residual: None };
    bencher.bench_local(|| {
        stabilised_passage(&problem, &Newton::default(), load, &case.first_wheel().passages, &Unobserved)
            .unwrap()
    });
}
