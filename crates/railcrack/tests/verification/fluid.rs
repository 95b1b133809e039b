//! Water in the cracks: pressure and volume against closed forms, the engines and the solvers
//! against each other.

use crate::common::{
    Absolute, Of, Relative, Rolling, RollingEngine, StepControl as Fixed, body, buried_crack, close,
    default_elements, joined_body, junction, largest, polyline, surface_crack,
};
use railcrack::body::CrackedBody;
use railcrack::contact::{
    ContactSolver, CrackFluid, FaceFluid, FaceProblem, FaceSolution, FluidModel, Latin, LoadPath, Newton,
    PressureProfile, StepControl, Stepper,
};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::dislocation::{FaceResolution, cracked_body};
use railcrack::field::Uniform;
use railcrack::growth::StabilisedPassage;
use railcrack::material::IsotropicElastic;
use railcrack::math::{Stress, Vec2};
use std::f64::consts::PI;

const LENGTH: f64 = 6.0;
/// K_I of an edge crack over σ √(πl).
const EDGE: f64 = 1.121_52;
/// The same of the face pressure σ s/l.
const EDGE_LINEAR: f64 = 0.682_7;

fn fluid(model: FluidModel, profile: PressureProfile) -> CrackFluid {
    CrackFluid { model, profile, cracks: None }
}

fn mouth(profile: PressureProfile) -> CrackFluid {
    fluid(FluidModel::Mouth { cap: f64::INFINITY }, profile)
}

fn on(body: &CrackedBody, cracks: &[Crack], fluid: &CrackFluid) -> FaceFluid {
    fluid.on(&CrackNetwork::new(cracks.to_vec()).unwrap(), &body.faces)
}

/// The passage of `rolling` with `fluid` in its cracks.
fn wet(rolling: &Rolling, fluid: &CrackFluid, solver: &dyn ContactSolver) -> StabilisedPassage {
    let body = rolling.body();
    let problem = FaceProblem::new(&body, &vec![rolling.crack_friction; rolling.cracks.len()]).unwrap();
    rolling.on(&problem.with_fluid(Some(on(&body, &rolling.cracks, fluid))), solver)
}

/// K_I, K_II and the pressure at the output positions of the stabilised passage; MPa√m, MPa.
fn history(result: &StabilisedPassage) -> Vec<[f64; 3]> {
    let record = &result.passages[result.passages.len() - 1];
    let k = record.sifs[0].iter().zip(&record.fluid[0]);
    k.map(|(k, fluid)| [k.ki_mpa_sqrt_m(), k.kii_mpa_sqrt_m(), fluid.pressure]).collect()
}

/// Largest difference of K over the largest |K|, and of the pressure over the largest pressure.
fn apart(one: &StabilisedPassage, other: &StabilisedPassage) -> [f64; 2] {
    let (one, other) = (history(one), history(other));
    assert_eq!(one.len(), other.len());
    let over = |of: &[usize]| {
        let difference = one.iter().zip(&other).flat_map(|(a, b)| of.iter().map(move |&i| a[i] - b[i]));
        let peak = largest(one.iter().flat_map(|k| of.iter().map(move |&i| k[i])));
        if peak == 0.0 { 0.0 } else { largest(difference) / peak }
    };
    [over(&[0, 1]), over(&[2])]
}

#[test]
fn pressure_and_volume_of_open_cracks() {
    let modulus = 210e3 / (1.0 - 0.09);
    let edge = [surface_crack(0.0, LENGTH, 90.0)];
    let half = 3.0;
    let buried = [buried_crack(Vec2::new(0.0, -500.0), half, 30.0)];
    for meshed in [false, true] {
        let rolling = Rolling::over(edge.to_vec(), 0.0, 0.0);
        let engine =
            if meshed { Rolling::meshed(edge.to_vec(), 0.0, 0.0).engine } else { RollingEngine::Dislocation };
        let whole = Rolling { engine, ..rolling }.body();
        let pocket = &on(&whole, &edge, &mouth(PressureProfile::Constant)).pockets[0];
        let k = whole.sif_influence.times(&pocket.unit)[0];
        let volume = pocket.volume(&whole.compliance.times(&pocket.unit));
        let limit = if meshed { 5e-3 } else { 1e-3 };
        close(k, EDGE * (PI * LENGTH).sqrt(), Relative(limit), "a unit pressure is a remote tension");
        let falling = &on(&whole, &edge, &mouth(PressureProfile::Linear)).pockets[0];
        let k = whole.sif_influence.times(&falling.profile)[0];
        let want = (EDGE - EDGE_LINEAR) * (PI * LENGTH).sqrt();
        close(k, want, Relative(limit.max(2e-3)), "1 - s/l, the references have four decimals");
        let want = EDGE * EDGE * PI * LENGTH * LENGTH / modulus;
        close(volume, want, Relative(2.0 * limit), "V from the energy release, twice the error of K");
    }
    let deep = body(&buried, default_elements());
    let pocket = &on(&deep, &buried, &mouth(PressureProfile::Constant)).pockets[0];
    assert!(pocket.mouth.is_none());
    let k = deep.sif_influence.times(&pocket.unit);
    close(k[0], (PI * half).sqrt(), Relative(1e-3), "half-length over depth 0.006");
    let volume = pocket.volume(&deep.compliance.times(&pocket.unit));
    close(volume, 2.0 * PI * half * half / modulus, Relative(1e-3), "ellipse of 2 a p/E'");
}

#[test]
fn pressure_from_the_mouth_adds_to_an_open_crack() {
    let cracks = vec![surface_crack(0.0, LENGTH, 60.0)];
    let open = Uniform::along_rail(4000.0);
    let rolling = Rolling { residual: Some(&open), ..Rolling::over(cracks.clone(), 0.0, 0.1) };
    let whole = rolling.body();
    let dry = rolling.solve();
    for profile in [PressureProfile::Linear, PressureProfile::Constant] {
        let pocket = &on(&whole, &cracks, &mouth(profile)).pockets[0];
        let unit = whole.sif_influence.times(&pocket.profile);
        let wet = wet(&rolling, &mouth(profile), &Newton::default());
        let (dry, wet) = (&dry.passages[0], &wet.passages[0]);
        let peak = largest(wet.sifs[0].iter().map(|k| k.ki));
        let mut most = 0.0f64;
        for (i, fluid) in wet.fluid[0].iter().enumerate() {
            let (one, other) = (dry.sifs[0][i], wet.sifs[0][i]);
            let u = wet.xc[i] / Rolling::HALF_WIDTH;
            let pressure = 845.0 * (1.0 - u * u).max(0.0).sqrt();
            close(fluid.pressure, pressure, Absolute(1e-9), "that of the contact over the mouth");
            most = most.max((other.ki - one.ki - pressure * unit[0]).abs());
            most = most.max((other.kii - one.kii - pressure * unit[1]).abs());
        }
        close(most / peak, 0.0, Absolute(1e-10), "superposition, round-off");
    }
}

#[test]
fn pressure_from_the_mouth_in_both_engines() {
    for (degrees, wheel_friction) in [(15.0, -0.1), (30.0, -0.4), (60.0, 0.2)] {
        let cracks = vec![surface_crack(0.0, LENGTH, degrees)];
        let capped = fluid(FluidModel::Mouth { cap: 300.0 }, PressureProfile::Linear);
        let one = wet(&Rolling::over(cracks.clone(), 0.1, wheel_friction), &capped, &Newton::default());
        let other = wet(&Rolling::meshed(cracks, 0.1, wheel_friction), &capped, &Newton::default());
        println!("{degrees}: {:?}", apart(&one, &other));
        close(apart(&one, &other)[0], 0.0, Absolute(1e-2), "both engines, of the peak");
    }
}

#[test]
fn mirrored_travel() {
    let there = Rolling::over(vec![surface_crack(0.0, LENGTH, 30.0)], 0.2, -0.2);
    let back = Rolling { travel: -1.0, ..Rolling::over(vec![surface_crack(0.0, LENGTH, 150.0)], 0.2, 0.2) };
    let trapped = [(f64::INFINITY, false), (2200.0, false), (f64::INFINITY, true), (2200.0, true)]
        .map(|(bulk_modulus, leak)| trapped(bulk_modulus, leak));
    for fluid in [mouth(PressureProfile::Linear)].into_iter().chain(trapped) {
        let (one, other) = (wet(&there, &fluid, &Newton::default()), wet(&back, &fluid, &Newton::default()));
        let (one, other) = (history(&one), history(&other));
        let peak = largest(one.iter().flat_map(|k| [k[0], k[1]]));
        let difference = largest(one.iter().zip(&other).flat_map(|(a, b)| [a[0] - b[0], a[1] + b[1]])) / peak;
        close(difference, 0.0, Absolute(1e-9), "round-off, and events that it shifts");
    }
}

/// Remote tension along the rail that goes from one value to the next along the path, with a
/// pressure outside of the mouth.
struct Tension<'a> {
    body: &'a CrackedBody,
    outside: f64,
}

impl LoadPath for Tension<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        self.body.faces.nodal_forces(|_| Stress { xx: at, ..Stress::ZERO })
    }

    fn over_mouths(&self, _: f64) -> Vec<f64> {
        vec![self.outside]
    }
}

fn trapped(bulk_modulus: f64, leak: bool) -> CrackFluid {
    fluid(FluidModel::Trapped { bulk_modulus, leak }, PressureProfile::Linear)
}

/// A crack that is sealed at a tension of 100 MPa with a pressure `outside` then on and loaded by
/// other tensions: pressure and K_I at each. Without such a pressure nothing leaks.
fn sealed(
    bulk_modulus: f64,
    outside: Option<f64>,
    tensions: &[f64],
    solver: &dyn ContactSolver,
    meshed: bool,
) -> Vec<[f64; 2]> {
    let cracks = vec![surface_crack(0.0, LENGTH, 90.0)];
    let rolling = if meshed {
        Rolling::meshed(cracks.clone(), 0.0, 0.0)
    } else {
        Rolling::over(cracks.clone(), 0.0, 0.0)
    };
    let whole = rolling.body();
    let problem = FaceProblem::new(&whole, &[0.0]).unwrap();
    let problem = problem.with_fluid(Some(on(&whole, &cracks, &trapped(bulk_modulus, outside.is_some()))));
    let mut stepper = Stepper::new(&problem, solver, 1e-3, &vec![0.0; problem.points()]);
    let path = |outside: f64| Tension { body: &whole, outside };
    stepper.begin(0.0);
    stepper.advance(&path(0.0), 100.0, &mut |_, _| {}).unwrap();
    stepper.seal(0);
    let path = path(outside.unwrap_or(0.0));
    let mut results = Vec::new();
    for &tension in tensions {
        let mut last = [0.0; 2];
        let mut take = |solution: &FaceSolution, forces: &[f64]| {
            last = [solution.fluid[0].pressure, solution.sifs(&whole, forces)[0].ki];
        };
        stepper.advance(&path, tension, &mut take).unwrap();
        results.push(last);
    }
    assert!(stepper.counts().violation_max < 1e-8, "{:?}", stepper.counts());
    results
}

#[test]
fn a_sealed_crack_keeps_its_volume() {
    let tensions = [60.0, 0.0, -50.0, 0.0, 99.0, 130.0, 200.0, 80.0];
    let (newton, latin) = (Newton::default(), Latin::default());
    let solvers: [(&dyn ContactSolver, bool); 3] = [(&newton, false), (&newton, true), (&latin, false)];
    for (solver, meshed) in solvers {
        for (&s, [pressure, ki]) in
            tensions.iter().zip(sealed(f64::INFINITY, None, &tensions, solver, meshed))
        {
            close(pressure, (100.0 - s).max(0.0), Of(1e-6, 100.0), "p = max(0, 100 - s)");
            let want = EDGE * s.max(100.0) * (PI * LENGTH).sqrt();
            close(ki, want, Relative(if meshed { 5e-3 } else { 1e-3 }), "K_I of max(100, s)");
        }
        let bulk = 2200.0;
        for (&s, [p, _]) in tensions.iter().zip(sealed(bulk, None, &tensions, solver, meshed)) {
            close(p, compressed(100.0, s, bulk), Of(1e-6, 100.0), "(p + s)/100 = e^(-p/B)");
        }
    }
}

/// The pressure of a fluid that fills the crack at the tension `content` without pressure, at the
/// tension `s`: (p + s)/content = e^(−p/B), or none.
fn compressed(content: f64, s: f64, bulk: f64) -> f64 {
    let mut pressure: f64 = 0.0;
    for _ in 0..60 {
        let curve = (-pressure / bulk).exp();
        pressure -= ((pressure + s) / content - curve) / (1.0 / content + curve / bulk);
    }
    pressure.max(0.0)
}

#[test]
fn a_leaking_crack_keeps_what_is_left() {
    // Fluid leaves at the pressure outside as the crack is pressed to 0, and at 60 MPa of pressure
    // the crack is shut and empty.
    let (outside, bulk) = (30.0, 2200.0f64);
    let tensions = [90.0, 60.0, 0.0, 20.0, 0.0, 40.0, 10.0, -10.0, 5.0, -60.0, 10.0, -20.0, 50.0];
    let (newton, latin) = (Newton::default(), Latin::default());
    let solvers: [(&dyn ContactSolver, bool); 3] = [(&newton, false), (&newton, true), (&latin, false)];
    for (solver, meshed) in solvers {
        for bulk in [f64::INFINITY, bulk] {
            let mut content: f64 = 100.0;
            let results = sealed(bulk, Some(outside), &tensions, solver, meshed);
            for (&s, [pressure, ki]) in tensions.iter().zip(results) {
                let kept = if content == 0.0 {
                    0.0
                } else if bulk.is_finite() {
                    compressed(content, s, bulk)
                } else {
                    (content - s).max(0.0)
                };
                let want = if kept > outside { outside } else { kept };
                if kept > outside {
                    content = (s + outside).max(0.0) * (outside / bulk).exp();
                }
                let want = if content == 0.0 { 0.0 } else { want };
                close(pressure, want, Of(1e-6, 100.0), "p = min(outside, that of the fluid left)");
                let want = EDGE * (s + want).max(0.0) * (PI * LENGTH).sqrt();
                close(ki, want, Of(if meshed { 5e-3 } else { 1e-3 }, 500.0), "K_I of s + p");
            }
        }
    }
}

/// A crack in two pieces that are joined below the mouth, across which there is one pocket, against
/// the crack in one piece.
#[test]
fn one_pocket_in_joined_cracks() {
    for (degrees, crack_friction, fluid) in [
        (25.0, 0.1, trapped(f64::INFINITY, true)),
        (15.0, 0.1, trapped(2200.0, false)),
        (30.0, 0.3, fluid(FluidModel::Mouth { cap: 300.0 }, PressureProfile::Linear)),
    ] {
        let rolling = Rolling::over(vec![surface_crack(0.0, LENGTH, degrees)], crack_friction, -0.4);
        let whole = wet(&rolling, &fluid, &Newton::default());
        let along = Vec2::unit(-degrees.to_radians());
        let (at, tip) = (along * (0.6 * LENGTH), along * LENGTH);
        let cracks = [vec![Vec2::default(), at], vec![at, tip]].map(|p| Crack::polyline(p).unwrap());
        let junctions = [junction(1, End::First, 0)];
        let body = joined_body(&cracks, &junctions, default_elements());
        let network = CrackNetwork::joined(cracks.to_vec(), junctions.to_vec()).unwrap();
        let faces = fluid.on(&network, &body.faces);
        assert_eq!((faces.pockets.len(), &faces.pockets[0].cracks[..]), (1, &[0, 1][..]));
        let problem = FaceProblem::new(&body, &[crack_friction; 2]).unwrap();
        let pieces = rolling.on(&problem.with_fluid(Some(faces)), &Newton::default());
        for error in apart(&whole, &pieces) {
            close(error, 0.0, Absolute(5e-3), "discretisation error of either");
        }
    }
}

/// The faces of a kinked crack that is closed everywhere have a volume where they slip along the
/// kink, by the interpolation there. No fluid is in it.
#[test]
fn closed_faces_hold_no_fluid() {
    let cracks = vec![polyline(&[(0.0, 0.0), (5.437847, -2.53571), (5.655221, -2.637437)])];
    let rolling = Rolling { travel: -1.0, ..Rolling::over(cracks, 0.1, -0.2) };
    let dry = rolling.solve();
    let dry = &dry.passages[dry.passages.len() - 1];
    let wet = wet(&rolling, &trapped(2200.0, true), &Newton::default());
    assert!(wet.counts.complementarity_max < 1e-8, "{:?}", wet.counts);
    let wet = &wet.passages[wet.passages.len() - 1];
    assert!(wet.fluid[0].iter().all(|fluid| fluid.pressure == 0.0 && fluid.volume >= 0.0));
    assert!(wet.fluid[0].iter().any(|fluid| fluid.volume == 0.0), "closed under the wheel");
    let apart = wet.sifs[0].iter().zip(&dry.sifs[0]).flat_map(|(a, b)| [a.ki - b.ki, a.kii - b.kii]);
    let peak = largest(dry.sifs[0].iter().map(|k| k.kii));
    close(largest(apart) / peak, 0.0, Absolute(1e-6), "load steps end elsewhere");
}

/// Where the faces have just closed, the interpolated jumps enclose less than nothing.
#[test]
fn volumes_of_fluid_are_not_negative() {
    let kinked = polyline(&[(0.0, 0.0), (5.196152, -3.0), (5.755, -3.4)]);
    for crack in [surface_crack(0.0, LENGTH, 30.0), kinked] {
        let wet =
            wet(&Rolling::over(vec![crack], 0.1, -0.3), &trapped(f64::INFINITY, true), &Newton::default());
        for passage in &wet.passages {
            let volumes = || passage.fluid[0].iter().map(|fluid| fluid.volume);
            assert!(volumes().all(|volume| volume >= 0.0), "{:?}", volumes().reduce(f64::min));
            assert!(volumes().any(|volume| volume > 1e-3));
        }
    }
}

/// Cracks far apart have pockets of their own, and only those of the list have fluid.
#[test]
fn cracks_with_and_without_fluid() {
    let cracks: Vec<Crack> = [0.0, 800.0].map(|mouth| surface_crack(mouth, LENGTH, 30.0)).to_vec();
    let rolling = Rolling::over(cracks, 0.2, -0.2);
    let trapped = trapped(f64::INFINITY, true);
    let both = wet(&rolling, &trapped, &Newton::default());
    let second = wet(&rolling, &CrackFluid { cracks: Some(vec![1]), ..trapped }, &Newton::default());
    let dry = rolling.solve();
    let of = |passage: &StabilisedPassage, tip: usize| {
        let record = &passage.passages[passage.passages.len() - 1];
        record.sifs[tip].iter().map(|k| [k.ki, k.kii]).collect::<Vec<_>>()
    };
    let peak = largest(of(&both, 0).into_iter().flatten());
    let apart = |one: Vec<[f64; 2]>, other: Vec<[f64; 2]>| {
        largest(one.iter().zip(&other).flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]])) / peak
    };
    close(apart(of(&second, 1), of(&both, 1)), 0.0, Absolute(1e-3), "130 lengths apart");
    close(apart(of(&second, 0), of(&dry, 0)), 0.0, Absolute(1e-3), "dry beside a wet one");
    assert!(apart(of(&both, 0), of(&dry, 0)) > 0.5);
}

const HISTORIES: [(f64, f64, f64); 6] = [
    (15.0, -0.4, 0.1),
    (15.0, -0.1, 0.1),
    (25.0, -0.4, 0.1),
    (30.0, -0.4, 0.3),
    (45.0, -0.3, 0.1),
    (60.0, 0.2, 0.0),
];

/// The rule of the leak as a code with small fixed steps has it: at the end of a step fluid that
/// has found its way out at too high a pressure leaves. Such a step takes the pressure to that over
/// the mouth at once, where the adaptive one follows the faces meanwhile. With friction that is not
/// the same, by 0.5 % of the largest K at 15° and 25° and 3 % at 60°.
#[test]
fn a_leak_by_small_fixed_steps() {
    let fine = Fixed { positions: 12001, tolerance: 2e-3, control: StepControl::Fixed };
    for (degrees, crack_friction) in [(15.0, 0.1), (25.0, 0.1), (45.0, 0.0), (60.0, 0.0)] {
        for bulk_modulus in [f64::INFINITY, 2200.0] {
            let cracks = vec![surface_crack(0.0, LENGTH, degrees)];
            let rolling = Rolling::over(cracks, crack_friction, -0.4);
            let fluid = trapped(bulk_modulus, true);
            let adaptive = wet(&rolling, &fluid, &Newton::default());
            let fixed = wet(&Rolling { steps: fine, ..rolling.clone() }, &fluid, &Newton::default());
            let (one, every) = (history(&adaptive), history(&fixed));
            let peaks = [0, 1, 2].map(|i| largest(every.iter().map(|k| k[i])));
            let peaks = [peaks[0].max(peaks[1]), peaks[0].max(peaks[1]), peaks[2]];
            let mut worst = [0.0f64; 3];
            for (k, of) in one.iter().enumerate() {
                // The leak itself is somewhere within a step.
                let about = every[(50 * k).saturating_sub(1)..(50 * k + 2).min(every.len())].iter();
                for i in 0..3 {
                    let nearest = about.clone().map(|k| (k[i] - of[i]).abs()).fold(f64::INFINITY, f64::min);
                    worst[i] = worst[i].max(nearest / peaks[i]);
                }
            }
            println!("{degrees} {crack_friction} B {bulk_modulus}: {worst:?}");
            for error in worst {
                close(
                    error,
                    0.0,
                    Absolute(5e-3),
                    "a tenth of it at 15 and 25 degrees is the way of the leak",
                );
            }
        }
    }
}

#[test]
fn trapped_fluid_in_both_engines_and_by_both_solvers() {
    trapped_fluid(&HISTORIES[..1]);
}

#[test]
#[ignore = "extra: a minute; other angles and frictions"]
fn trapped_fluid_in_both_engines_and_by_both_solvers_in_full() {
    trapped_fluid(&HISTORIES[1..]);
}

fn trapped_fluid(histories: &[(f64, f64, f64)]) {
    let mut errors = Vec::new();
    for &(degrees, wheel_friction, crack_friction) in histories {
        for (bulk_modulus, leak) in [(f64::INFINITY, false), (f64::INFINITY, true), (2200.0, true)] {
            let cracks = vec![surface_crack(0.0, LENGTH, degrees)];
            let fluid = trapped(bulk_modulus, leak);
            let rolling = Rolling::over(cracks.clone(), crack_friction, wheel_friction);
            let one = wet(&rolling, &fluid, &Newton::default());
            let h = history(&one);
            let most = |i: usize| h.iter().fold(0.0f64, |m, k| m.max(k[i]));
            let meshed = Rolling::meshed(cracks, crack_friction, wheel_friction);
            let other = wet(&meshed, &fluid, &Newton::default());
            let latin = wet(&rolling, &fluid, &Latin::default());
            println!(
                "{degrees} {wheel_friction} {crack_friction} B {bulk_modulus} {leak}: K_I {:.2}, p {:.1}, engines {:?}, solvers {:?}, {:?}",
                most(0),
                most(2),
                apart(&one, &other),
                apart(&one, &latin),
                one.counts
            );
            errors.push((apart(&one, &other), apart(&one, &latin)));
            assert!(one.counts.complementarity_max < 1e-8, "{:?}", one.counts);
        }
    }
    for (engines, solvers) in errors {
        for error in engines {
            close(error, 0.0, Absolute(1e-2), "both engines, of the peak");
        }
        for error in solvers {
            close(error, 0.0, Absolute(1e-6), "both solvers, of the peak");
        }
    }
}

#[test]
fn trapped_fluid_does_not_feel_the_modulus_of_the_steel() {
    let cracks = vec![surface_crack(0.0, LENGTH, 15.0)];
    let network = CrackNetwork::new(cracks.clone()).unwrap();
    let rolling = Rolling::over(cracks.clone(), 0.1, -0.4);
    let histories = [210e3, 70e3].map(|young| {
        let steel = IsotropicElastic::new(young, 0.3).unwrap();
        let whole = cracked_body(&network, &steel, FaceResolution::default()).unwrap();
        let wet = |problem: FaceProblem, leak: bool| {
            let fluid = on(&whole, &cracks, &trapped(f64::INFINITY, leak));
            rolling.on(&problem.with_fluid(Some(fluid)), &Newton::default())
        };
        [false, true].map(|leak| wet(FaceProblem::new(&whole, &[0.1]).unwrap(), leak))
    });
    for leak in [0, 1] {
        for error in apart(&histories[0][leak], &histories[1][leak]) {
            close(error, 0.0, Absolute(1e-8), "an incompressible fluid knows volumes only");
        }
    }
}
