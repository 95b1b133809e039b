//! Cracks in a rail with plastic stress, balanced on the mesh of the rail.

use crate::common::{measured, measured_as};
use railcrack::growth::{StepRecord, Unobserved};
use railcrack::math::{Stress, Vec2};
use railcrack::mesh::{Array, CellBlock, CellShape, UnstructuredGrid};
use railcrack::residual::PlasticField;
use railcrack::shakedown::stabilise;
use railcrack_case::{Case, Overrides};
use railcrack_run::setup::{PreparedRun, RolledStress, rolled_rail, stabilisation};
use std::path::Path;

/// Accuracy of the finite-element engine as promised to users, relative to the largest |K|.
const ENGINES: f64 = 0.01;

/// The layers of Trollé et al. 2014, Fig. 21.
const LAYERS: &str = "depth_mm,sxx_mpa\n0,25\n0.3,25\n0.8,-110\n2,-110\n3,50\n4.5,50\n6,-50\n14,-50\n20,0\n";

/// The crack of 6 mm at 15° under a wheel, with further `sections` of a case file.
fn case(engine: &str, pressure: f64, friction: f64, sections: &str) -> Case {
    // A folder for each test: one must not read the file that another one is writing.
    let test = format!("plastic-layers-{:?}", std::thread::current().id());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join(format!("{engine}.csv")), LAYERS).unwrap();
    let text = format!(
        "[contact]\npeak_pressure_mpa = {pressure:?}\nhalf_width_mm = 6.75\nfriction = {friction:?}\n\
         [passage]\npositions = 61\n[growth]\nsteps = 0\n\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n{}",
        sections.replace("LAYERS", &format!("{engine}.csv"))
    );
    let overrides = Overrides { engine: Some(engine.into()), ..Overrides::default() };
    Case::parse_with(&text, "case.toml", &folder, &overrides).unwrap()
}

fn first_step(case: &Case, rolled: Option<&RolledStress>) -> StepRecord {
    PreparedRun::new(case, rolled).unwrap().growth(None).next_step(&Unobserved).unwrap().unwrap()
}

/// The largest difference of the last passages, relative to the largest |K|.
fn difference(one: &StepRecord, other: &StepRecord) -> f64 {
    let last = |record: &StepRecord| record.passages.last().unwrap().sifs[0].clone();
    let (mut apart, mut peak) = (0.0f64, 0.0f64);
    for (a, b) in last(one).iter().zip(&last(other)) {
        apart = apart.max((a.ki - b.ki).abs()).max((a.kii - b.kii).abs());
        peak = peak.max(a.ki.abs()).max(a.kii.abs());
    }
    apart / peak
}

/// Balanced layers in both engines, and the same layers as a plastic stress, which is balanced on
/// the mesh for both.
#[test]
fn engines_agree() {
    for (name, sections) in [
        ("balanced", "[residual_stress]\nprofile = \"LAYERS\"\n"),
        ("to balance", "[plastic_stress]\nprofile = \"LAYERS\"\n"),
    ] {
        let [elements, dislocations] =
            ["xfem", "dislocation"].map(|engine| first_step(&case(engine, 845.0, 0.025, sections), None));
        let error = difference(&elements, &dislocations);
        println!("{name}: {error:.5}");
        measured(error, ENGINES, "of the largest |K|, at every position; promised to users");
        assert!(error < ENGINES, "{name}: {error}");
    }
}

/// Layers given as cells by the steady state and balanced by finite elements, against the residual
/// stress of that state itself.
const ROLLED: f64 = 0.01;

/// The stabilised state of a load beyond yield: its plastic stress, projected and balanced, gives
/// its own residual stress.
#[test]
fn rolled_rail_balances_to_its_own_residual_stress() {
    let case = case("dislocation", 1100.0, 0.3, "[plastic_stress]\n");
    let rail = rolled_rail(&case);
    let state = stabilise(&rail, &stabilisation(&case), |_| ()).unwrap();
    let depths = state.layers.interfaces();
    let points = depths.iter().flat_map(|&d| [-200.0, 200.0].map(|x| Vec2::new(x, -d))).collect();
    let connectivity = (0..depths.len() - 1).flat_map(|i| [2 * i + 2, 2 * i + 3, 2 * i + 1, 2 * i]).collect();
    let twice = 2.0 * case.steel.shear_modulus();
    let stresses: Vec<Stress> = state
        .profile
        .iter()
        .map(|layer| Stress {
            xx: twice * layer.strain.xx,
            yy: twice * layer.strain.yy,
            zz: twice * layer.strain.zz,
            xy: twice * layer.strain.xy,
        })
        .collect();
    let grid = UnstructuredGrid {
        z: Vec::new(),
        points,
        cells: vec![CellBlock { shape: CellShape::Quad, connectivity }],
        point_data: vec![],
        cell_data: vec![Array::stresses("plastic_stress_mpa", &stresses)],
    };
    let plastic = PlasticField::from_grid(&grid).unwrap();
    let prepared = PreparedRun::new(&case, Some(&RolledStress::Plastic(plastic))).unwrap();
    let carried = prepared.residual();
    let field = carried.field.as_ref().unwrap();
    let peak = state.profile.iter().map(|layer| layer.stress.xx.abs()).fold(0.0, f64::max);
    // Of layers by their thickness.
    let (mut squares, mut depth) = (0.0, 0.0);
    for (layer, between) in state.profile.iter().zip(depths.windows(2)) {
        let thickness = between[1] - between[0];
        let error = (field.stress(Vec2::new(0.0, -layer.depth)) - layer.stress).xx;
        squares += thickness * error * error;
        depth += thickness;
    }
    let worst = f64::sqrt(squares / depth);
    println!("peak {peak:.1} MPa, rms {:.5} of it; {:?}", worst / peak, carried.projection);
    measured_as(
        "stress",
        worst / peak,
        ROLLED,
        "rms, of the largest residual stress: cells to nodes, nodes to mesh",
    );
    assert!(worst < ROLLED * peak, "{worst} of {peak} MPa");
    let recovery = carried.projection.unwrap().recovery.unwrap();
    let loss = (recovery.norm_ratio - 1.0).abs();
    measured_as("norm", loss, 1e-3, "of the L2 norm of the plastic stress, from cells to nodes");
    assert!(loss < 1e-3, "{recovery:?}");
}
