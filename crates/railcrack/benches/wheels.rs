//! Passages of the default settings over the crack of Table 1 under every kind of wheel, and tables
//! of more and more rows: one of 200 rows may cost a passage twice of what full sliding does. A
//! growth step under one wheel and under three: on two cores, three wheels of equal cost are two
//! passages after one another beside each other. A growth step of fifteen cracks under two wheels
//! of opposite directions, the first one with fluid in the cracks.

use divan::Bencher;
use railcrack::contact::{CrackFluid, FluidModel, PressureProfile};
use railcrack::dislocation::cracked_body;
use railcrack::load::{ContactRow, HertzEllipse};
use railcrack::plane::PlaneWheel;
use railcrack::prelude::*;
use railcrack::rolling::{Creepage, PlacedPatch, RollingPatch, RollingTheory};

fn main() {
    divan::main();
}

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

fn rolling() -> CarterContact {
    CarterContact {
        peak_pressure: 845.0,
        half_width: 6.75,
        friction: 0.3,
        traction: 0.5,
        travel: Travel::Forward,
    }
}

fn table(rows: usize) -> TableWheel {
    let row = |i: usize| {
        let u = -6.75 * (std::f64::consts::PI * i as f64 / (rows - 1) as f64).cos();
        let inside = f64::from(u8::from(i > 0 && i + 1 < rows));
        ContactRow { u, pressure: inside * rolling().pressure(u), shear: inside * rolling().shear(u) }
    };
    TableWheel::new(&TableContact::new((0..rows).map(row).collect(), None).unwrap(), &steel())
}

fn passage(bencher: Bencher, wheel: &dyn Wheel) {
    let crack = Crack::surface_breaking(0.0, 6.0, 15f64.to_radians()).unwrap();
    let body = cracked_body(&crack.into(), &steel(), FaceResolution::default()).unwrap();
    let faces = FaceProblem::new(&body, &[0.5]).unwrap();
    let load = RailLoad { wheel, residual: None };
    let settings = PassageSettings::default();
    bencher.bench_local(|| {
        stabilised_passage(&faces, &Newton::default(), load, &settings, &Unobserved).unwrap()
    });
}

/// Increments of the mixes.
const STEPS: usize = 5;

/// Growth under a mix of so many wheels, with dislocations.
#[divan::bench(sample_count = 10, args = [1, 2, 3])]
fn mix(bencher: Bencher, wheels: usize) {
    growth_steps(bencher, wheels, |_| DislocationEngine {
        steel: steel(),
        resolution: FaceResolution::default(),
    });
}

/// The same with finite elements.
#[divan::bench(sample_count = 10, args = [1, 2, 3])]
fn mix_with_elements(bencher: Bencher, wheels: usize) {
    growth_steps(bencher, wheels, |crack| {
        let end = RailEnd::HalfPlane { centre: 0.0 };
        let mesh = MeshSettings { element_size: 0.1, expected_growth: 1.04f64.powi(STEPS as i32) };
        XfemEngine::new(crack, steel(), mesh, end, XfemSettings::default())
    });
}

fn growth_steps<E: BodyEngine + 'static>(
    bencher: Bencher,
    wheels: usize,
    engine: impl Fn(&CrackNetwork) -> E + Sync,
) {
    let contacts = [(1000.0, 6.75, 0.1), (800.0, 5.5, 0.3), (950.0, 6.5, -0.35)];
    let share = 1.0 / wheels as f64;
    let of = |(peak_pressure, half_width, friction)| {
        HertzWheel::new(&HertzianContact { peak_pressure, half_width, friction }, &steel()).unwrap()
    };
    let crack: CrackNetwork = Crack::surface_breaking(0.0, 4.0, 30f64.to_radians()).unwrap().into();
    bencher.bench_local(|| {
        let wheel =
            |&contact: &(f64, f64, f64)| PlaneWheel { share, ..PlaneWheel::new(Box::new(of(contact))) };
        let wheels = contacts[..wheels].iter().map(wheel).collect();
        let mut problem = PlaneRail::under(Box::new(engine(&crack)), wheels, vec![0.3]);
        problem.growth.steps = STEPS;
        let mut growth = Growth::new(problem, GrowthState::initial(&crack));
        for _ in 0..=STEPS {
            growth.next_step(&Unobserved).unwrap();
        }
    });
}

/// A growth step of fifteen cracks under two wheels. RAYON_NUM_THREADS = 1 gives processor time.
#[divan::bench(sample_count = 3, sample_size = 1, args = ["dry", "trapped", "mouth"])]
fn fifteen_cracks(bencher: Bencher, fluid: &str) {
    let (cap, leak, bulk_modulus) = (100.0, true, f64::INFINITY);
    let model = match fluid {
        "trapped" => Some(FluidModel::Trapped { bulk_modulus, leak }),
        "mouth" => Some(FluidModel::Mouth { cap }),
        _ => None,
    };
    let of = |(peak_pressure, half_width, friction)| {
        HertzWheel::new(&HertzianContact { peak_pressure, half_width, friction }, &steel()).unwrap()
    };
    let crack = |i: usize| Crack::surface_breaking(4.0 * i as f64, 4.0, 25f64.to_radians()).unwrap();
    let network = CrackNetwork::new((0..15).map(crack).collect()).unwrap();
    bencher.bench_local(|| {
        let engine = DislocationEngine { steel: steel(), resolution: FaceResolution::default() };
        let wheel = |contact, share, (from, to)| PlaneWheel {
            share,
            passages: PassageSettings {
                passage: Passage { from, to, positions: 241 },
                ..PassageSettings::default()
            },
            ..PlaneWheel::new(Box::new(of(contact)))
        };
        let fluid =
            model.map(|model| CrackFluid { model, profile: PressureProfile::default(), cracks: None });
        let wheels = vec![
            PlaneWheel { fluid, ..wheel((1000.0, 6.0, 0.25), 0.6, (-36.0, 92.0)) },
            wheel((850.0, 5.5, -0.2), 0.4, (92.0, -36.0)),
        ];
        let mut problem = PlaneRail::under(Box::new(engine), wheels, vec![0.4; 15]);
        problem.growth.steps = 0;
        Growth::new(problem, GrowthState::initial(&network)).next_step(&Unobserved).unwrap()
    });
}

#[divan::bench(sample_count = 10)]
fn full_sliding(bencher: Bencher) {
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.15 };
    passage(bencher, &HertzWheel::new(&contact, &steel()).unwrap());
}

#[divan::bench(sample_count = 10)]
fn partial_slip(bencher: Bencher) {
    passage(bencher, &CarterWheel::new(&rolling(), &steel()).unwrap());
}

#[divan::bench(sample_count = 10, args = [50, 200, 2000])]
fn contact_table(bencher: Bencher, rows: usize) {
    passage(bencher, &table(rows));
}

#[divan::bench(sample_count = 10, args = [200, 2000])]
fn preparing_a_table(bencher: Bencher, rows: usize) {
    bencher.bench_local(|| table(rows));
}

/// Rows of a table of wheels: pressures, creepages with spin and frictions of a curve.
fn rows() -> Vec<PlacedPatch> {
    let row = |i: usize| {
        let t = |step: f64| (step * i as f64).fract() - 0.5;
        let ellipse = HertzEllipse { peak_pressure: 1100.0 + 600.0 * t(0.618), along: 6.5, across: 4.5 };
        let creepage =
            Creepage { longitudinal: 4e-3 * t(0.414), lateral: 6e-3 * t(0.732), spin: 1e-3 * t(0.236) };
        let theory = RollingTheory::FaStrip;
        let friction = 0.3 + 0.2 * t(0.162);
        let patch = RollingPatch { ellipse, outline: None, friction, creepage, steel: steel(), theory };
        PlacedPatch { patch, y: 4.0 * t(0.871), x: 0.0 }
    };
    (0..1000).map(row).collect()
}

/// A thousand rows of a table of wheels become loads of the plane: less than 50 ms on one thread.
#[divan::bench(sample_count = 10)]
fn thousand_strips(bencher: Bencher) {
    let rows = rows();
    let of = |row: &PlacedPatch| PlacedPatch::plane_contact(std::slice::from_ref(row), Travel::Forward);
    bencher.bench_local(|| rows.iter().filter_map(of).count());
}

/// Mean shear of a thousand whole patches, by so many strips and intervals of each.
#[divan::bench(sample_count = 5, args = ["15 x 20", "30 x 40", "60 x 80"])]
fn thousand_patches(bencher: Bencher, grid: &str) {
    let (strips, intervals) = grid.split_once(" x ").unwrap();
    let grid = [strips, intervals].map(|count| count.parse::<usize>().unwrap());
    let rows = rows();
    bencher.bench_local(|| rows.iter().map(|row| row.patch.mean_shear(grid)[0]).sum::<f64>());
}
