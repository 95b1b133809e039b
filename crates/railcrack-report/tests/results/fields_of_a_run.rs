//! The field file of a run, read by meshio.

use super::meshio::read_back;
use super::support::Scratch;
use railcrack::contact::FaceState;
use railcrack::growth::Unobserved;
use railcrack_case::Case;
use railcrack_report::Pages;
use railcrack_run::setup::PreparedRun;
use railcrack_run::{CaseFiles, Existing, Recorder, RunInfo};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Of the crack below the surface, degrees.
const ANGLE: f64 = 15.0;
/// Of the jump: at the mouth, where it is largest, cells and face points are not the same.
const TOLERANCE: f64 = 0.01;

/// A crack that is open where the wheel has not come yet.
const CASE: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n\
    [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.1\n\
    [passage]\npositions = 25\n[growth]\nsteps = 0\n[mesh]\nelement_size_mm = 0.2\n[solver]\nengine = \"xfem\"\n\
    [output]\nfields_over_a = [-1.0]\n";

#[test]
#[ignore = "extra: needs RAILCRACK_PYTHON, a Python with meshio; .ci/run provides it"]
fn meshio_reads_the_fields_of_a_run() {
    let scratch = Scratch::new("fields-of-a-run");
    let folder = scratch.path().join("run");
    let case = Case::parse(CASE, "case.toml", Path::new("")).unwrap();
    let info = RunInfo {
        title: case.title.clone(),
        engine: case.engine(),
        contact: case.contact_solver(),
        boundary: case.boundary(),
        output: case.output,
        ..RunInfo::idle(case.half_width())
    };
    let files = CaseFiles { toml: case.to_toml(), ..CaseFiles::default() };
    let mut recorder = Recorder::start(&folder, files, info, Existing::Refuse, &Pages).unwrap();
    let mut growth = PreparedRun::new(&case, None).unwrap().growth(None);
    let record = growth.next_step(&Unobserved).unwrap().unwrap();
    recorder.record(&record, growth.state()).unwrap();

    let read = read_back(&folder.join("fields/step-0000-position-0011.vtu"));
    let grid = &record.fields.as_ref().unwrap().grid;
    let points = read["points"].as_array().unwrap();
    assert_eq!(points.len(), grid.points.len());
    let cells: Vec<(&str, usize)> = read["cells"]
        .as_array()
        .unwrap()
        .iter()
        .map(|block| (block["type"].as_str().unwrap(), block["nodes"].as_array().unwrap().len()))
        .collect();
    let (quads, triangles, lines) = (grid.quads.len(), grid.triangles.len(), grid.lines.len());
    assert_eq!(cells, [("quad8", quads), ("triangle", triangles), ("line", lines)]);
    let arrays: Vec<&String> = read["point_data"].as_object().unwrap().keys().collect();
    assert_eq!(arrays, ["displacement_mm", "stress_mpa", "von_mises_mpa", "traction", "traction_mpa"]);
    assert_eq!(read["point_data"]["stress_mpa"][0].as_array().unwrap().len(), 6);

    // Points at one place that move differently: the crack.
    let number = |value: &Value| f64::from_bits(value.as_u64().unwrap());
    let mut places: BTreeMap<String, (f64, f64)> = BTreeMap::new();
    for (point, moved) in points.iter().zip(read["point_data"]["displacement_mm"].as_array().unwrap()) {
        let up = number(&moved[1]);
        let range = places.entry(point.to_string()).or_insert((up, up));
        *range = (range.0.min(up), range.1.max(up));
    }
    let jump = places.values().map(|range| range.1 - range.0).fold(0.0, f64::max);
    let (along, across) = ANGLE.to_radians().sin_cos();
    let vertical = |state: &FaceState| across * state.opening - along * state.slip;
    let of_faces = record.faces.states[10].iter().map(vertical).fold(0.0, f64::max);
    println!("largest vertical jump {jump} mm, at the face points {of_faces} mm");
    assert!(of_faces > 1e-3 && (jump / of_faces - 1.0).abs() < TOLERANCE, "{jump} mm, faces {of_faces} mm");
}
