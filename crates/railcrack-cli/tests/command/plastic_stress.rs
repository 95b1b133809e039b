//! Runs in a rail with plastic stress: computed first, from a file, from a file of another program.

use super::common;
use super::common::{ends, numbers as column, railcrack, read, stderr};
use std::path::Path;

/// A load that yields, a short passage, the cheaper engine.
const CASE: &str = "\
title = \"Rolled\"
[contact]
peak_pressure_mpa = 1100.0
half_width_mm = 6.75
friction = 0.1
[passage]
from_over_a = -2.0
to_over_a = 2.0
positions = 9
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.5
[growth]
steps = 2
[solver]
engine = \"dislocation\"
";

/// Standard error of a command that succeeds.
#[track_caller]
fn succeeds(folder: &Path, arguments: &[&str]) -> String {
    stderr(&ends(folder, arguments, 0))
}

fn summary(run: &Path) -> serde_json::Value {
    serde_json::from_str(&read(&run.join("summary.json"))).unwrap()
}

#[test]
fn one_run_computes_the_plastic_state_and_the_crack_in_it() {
    let folder = common::folder("plastic-stress-command", "plastic-chain");
    std::fs::write(folder.join("chain.toml"), format!("{CASE}[plastic_stress]\n")).unwrap();
    let said = succeeds(&folder, &["run", "chain.toml"]);
    let order = ["plastic state, passage 1:", "projecting and balancing", "step 0/2", "step 2/2"];
    let places: Vec<usize> =
        order.iter().map(|text| said.find(text).unwrap_or_else(|| panic!("{said}"))).collect();
    assert!(places.is_sorted(), "{said}");
    let run = folder.join("chain");
    let told = &summary(&run)["residual_stress"];
    assert_eq!(
        (&told["plastic_source"], &told["rolled"]["state"]),
        (&"rolled".into(), &"elastic shakedown".into())
    );
    assert!(told["projection"]["mesh_difference"].as_f64().unwrap() < 0.01, "{told}");
    assert!(summary(&run)["phases_s"]["residual"].as_f64().unwrap() > 0.0);

    // What the crack mesh carries is what the stage left: by depth, to a fiftieth of the largest.
    let (depths, stresses) =
        (column(&run.join("residual.csv"), "depth_mm"), column(&run.join("residual.csv"), "szz_mpa"));
    let stage = run.join("shakedown/profile.csv");
    let (known, residual) = (column(&stage, "depth_mm"), column(&stage, "szz_mpa"));
    let peak = residual.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    for (depth, stress) in depths.iter().zip(&stresses).filter(|(depth, _)| **depth < known[known.len() - 1])
    {
        let i = known.partition_point(|d| d <= depth).clamp(1, known.len() - 1);
        let t = (depth - known[i - 1]) / (known[i] - known[i - 1]);
        let want = residual[i - 1] + t * (residual[i] - residual[i - 1]);
        assert!((stress - want).abs() < 0.02 * peak, "depth {depth}: {stress} for {want} MPa");
    }

    // Two steps by two commands are the same run.
    let file = format!("{CASE}[plastic_stress]\nfield = \"chain/shakedown/plastic.vtu\"\n");
    std::fs::write(folder.join("file.toml"), file).unwrap();
    succeeds(&folder, &["run", "file.toml", "--quiet"]);
    for table in ["sif.csv", "growth.csv", "faces.csv", "residual.csv"] {
        assert!(read(&run.join(table)) == read(&folder.join("file").join(table)), "{table}");
    }

    // And it matters: without the plastic stress the history is another one.
    std::fs::write(folder.join("without.toml"), CASE).unwrap();
    succeeds(&folder, &["run", "without.toml", "--quiet"]);
    let largest = |run: &str| {
        let k = column(&folder.join(run).join("sif.csv"), "kii_mpa_sqrt_m");
        k.into_iter().fold(0.0f64, |m, v| m.max(v.abs()))
    };
    assert!(
        (largest("chain") / largest("without") - 1.0).abs() > 0.01,
        "{} {}",
        largest("chain"),
        largest("without")
    );
    assert!(!folder.join("without/residual.csv").exists());
}

#[test]
fn a_run_folder_is_complete_and_a_replaced_one_clean() {
    let folder = common::folder("plastic-stress-command", "plastic-folder");
    std::fs::write(folder.join("chain.toml"), format!("{CASE}[plastic_stress]\n")).unwrap();
    succeeds(&folder, &["run", "chain.toml", "--quiet", "--steps", "0"]);
    // The case of the folder, run from there, and the file that another case names.
    std::fs::write(
        folder.join("file.toml"),
        format!("{CASE}[plastic_stress]\nfield = \"chain/shakedown/plastic.vtu\"\n"),
    )
    .unwrap();
    succeeds(&folder, &["run", "file.toml", "--quiet", "--steps", "0"]);
    succeeds(&folder, &["run", "file/case.toml", "--quiet", "--out", "again"]);
    assert!(read(&folder.join("file/sif.csv")) == read(&folder.join("again/sif.csv")));
    succeeds(&folder, &["run", "file.toml", "--quiet", "--steps", "0", "--resume"]);
    // A finished run knows what it carried.
    assert_eq!(summary(&folder.join("file"))["residual_stress"]["plastic_source"], "field");
    std::fs::write(folder.join("plain.toml"), CASE).unwrap();
    succeeds(&folder, &["run", "plain.toml", "--quiet", "--steps", "0", "--out", "chain", "--force"]);
    assert!(!folder.join("chain/shakedown").exists() && !folder.join("chain/residual.csv").exists());
}

#[test]
fn a_field_of_another_program_on_triangles_that_vary_along_the_rail() {
    let folder = common::folder("plastic-stress-command", "plastic-foreign");
    // Two triangles over x = -30 to 30 mm and down to 12 mm, decimal, as other programs write it.
    let field = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n\
        <Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<PointData>\n\
        <DataArray type=\"Float64\" Name=\"plastic_stress_mpa\" NumberOfComponents=\"6\" format=\"ascii\">\n\
        -40 20 20 0 0 0  80 -40 -40 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0\n</DataArray>\n</PointData>\n<Points>\n\
        <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n\
        -30 0 0  30 0 0  30 -12 0  -30 -12 0\n</DataArray>\n</Points>\n<Cells>\n\
        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 3 2</DataArray>\n\
        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6</DataArray>\n\
        <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5</DataArray>\n</Cells>\n</Piece>\n\
        </UnstructuredGrid>\n</VTKFile>\n";
    std::fs::write(folder.join("field.vtu"), field).unwrap();
    std::fs::write(folder.join("c.toml"), format!("{CASE}[plastic_stress]\nfield = \"field.vtu\"\n"))
        .unwrap();
    for (engine, out) in [("xfem", "x"), ("dislocation", "d")] {
        let said = succeeds(&folder, &["run", "c.toml", "--steps", "0", "--engine", engine, "--out", out]);
        assert!(said.contains("given from x = -30 to 30 mm and to a depth of 12 mm"), "{said}");
    }
    let k = |run: &str| column(&folder.join(run).join("sif.csv"), "kii_mpa_sqrt_m");
    let (one, other) = (k("x"), k("d"));
    let peak = other.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    // What users are promised of the finite-element engine.
    assert!(one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 0.01 * peak), "{one:?} {other:?}");
}

#[test]
fn what_cannot_be_used_is_said_before_anything_is_written() {
    let folder = common::folder("plastic-stress-command", "plastic-bad");
    let no_array = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\">\
        </Piece></UnstructuredGrid></VTKFile>";
    std::fs::write(folder.join("empty.vtu"), no_array).unwrap();
    std::fs::write(folder.join("text.vtu"), "not a field").unwrap();
    std::fs::write(folder.join("p.csv"), "depth_mm,sxx_mpa\n0,-100\n1,0\n").unwrap();
    for (name, sections, says) in [
        ("empty", "[plastic_stress]\nfield = \"empty.vtu\"\n", "no array `plastic_stress_mpa`"),
        ("text", "[plastic_stress]\nfield = \"text.vtu\"\n", "is not XML"),
        (
            "both",
            "[plastic_stress]\nfield = \"empty.vtu\"\nprofile = \"p.csv\"\n",
            "says the same thing as `field`",
        ),
        ("twice", "[plastic_stress]\n[residual_stress]\nprofile = \"p.csv\"\n", "is already the total"),
    ] {
        std::fs::write(folder.join("bad.toml"), format!("{CASE}{sections}")).unwrap();
        let output = railcrack(&folder, &["run", "bad.toml", "--out", name]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains(says), "{name}: {said}");
        assert!(!folder.join(name).exists(), "{name} wrote a folder");
    }
}

#[test]
fn free_sides_of_a_block_release_a_part_and_the_run_says_so() {
    let folder = common::folder("plastic-stress-command", "plastic-block");
    std::fs::write(folder.join("p.csv"), "depth_mm,sxx_mpa\n0,-200\n10,-200\n10.1,0\n").unwrap();
    let block = CASE.replace("engine = \"dislocation\"", "engine = \"xfem\"");
    for (name, section, carried) in
        [("given", "residual_stress", false), ("balanced", "plastic_stress", true)]
    {
        let case = format!("{block}[rail]\nboundary = \"block\"\n[{section}]\nprofile = \"p.csv\"\n");
        std::fs::write(folder.join("block.toml"), case).unwrap();
        let said = succeeds(&folder, &["run", "block.toml", "--steps", "0", "--out", name]);
        assert!(said.contains("the free sides of the block release the residual stress"), "{said}");
        let release = &summary(&folder.join(name))["residual_stress"]["release"];
        assert_eq!(release["carried"], carried);
        let [held, free] = ["held_sxx_mpa", "free_sxx_mpa"].map(|key| release[key].as_f64().unwrap());
        // A bar of 172 mm that sheds N = 2000 N/mm at 81 mm above its middle: N/h
        // (1 + 12 · 81²/h²...) at the surface, half of it for the clamped bottom: of the order of
        // 12 to 45 MPa.
        let shed = (held - free).abs();
        assert!(shed > 5.0 && shed < 60.0, "{name}: {held} {free}");
    }
}

/// A wheel with a patch, and a short passage over a crack in the plane or in space.
const PATCH_CASE: &str = "\
[contact]
peak_pressure_mpa = 1300.0
half_width_mm = 6.0
lateral_half_width_mm = 6.0
friction = 0.1
[passage]
from_over_a = -2.0
to_over_a = 2.0
positions = 9
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
surface_half_length_mm = 6.0
angle_deg = 15.0
friction = 0.5
[growth]
steps = 1
[shakedown]
max_passes = 2
";

/// Under a patch the stress of the run is that of the state in space, in the plane of the cracks;
/// progress is shown by passage.
#[test]
fn a_real_wheel_leaves_its_stress_in_the_plane_and_in_space() {
    let folder = common::folder("plastic-stress-command", "plastic-patch");
    for (engine, mesh) in [("dislocation", ""), ("space", "[mesh]\nspace_cells = 4\n")] {
        let solver = format!("{mesh}[solver]\nengine = \"{engine}\"\n");
        let with = format!("{PATCH_CASE}{solver}[plastic_stress]\nfrom = \"passages\"\n");
        std::fs::write(folder.join(format!("{engine}.toml")), with).unwrap();
        let said = succeeds(&folder, &["run", &format!("{engine}.toml")]);
        let order = ["plastic state, passage 1:", "plastic state, passage 2:", "step 1/1"];
        let places: Vec<usize> =
            order.iter().map(|text| said.find(text).unwrap_or_else(|| panic!("{said}"))).collect();
        assert!(places.is_sorted(), "{said}");
        let run = folder.join(engine);
        let stage = run.join("shakedown");
        for stress in ["sxx_mpa", "syy_mpa", "szz_mpa", "sxy_mpa"] {
            let both =
                [&run.join("residual.csv"), &stage.join("profile.csv")].map(|path| column(path, stress));
            let peak = both[1].iter().fold(0.0f64, |m, v| m.max(v.abs()));
            // The run reports every layer; digits of the tables.
            let pairs = both[0].iter().zip(&both[1]);
            let most = pairs.fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(most < 1e-6 * peak.max(1.0), "{engine} {stress}: {most} of {peak}");
        }
        std::fs::write(folder.join("without.toml"), format!("{PATCH_CASE}{solver}")).unwrap();
        succeeds(&folder, &["run", "without.toml", "--quiet", "--force"]);
        let largest = |run: &str| {
            let k = column(&folder.join(run).join("sif.csv"), "kii_mpa_sqrt_m");
            k.into_iter().fold(0.0f64, |m, v| m.max(v.abs()))
        };
        let change = largest(engine) / largest("without") - 1.0;
        assert!(change.abs() > 0.01, "{engine}: {change}");
    }
}
