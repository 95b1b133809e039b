//! A list of cracks from an inspection, computed.

use super::common::{DISLOCATION_CASE, done, folder, read};
use std::fs;

/// The run of a list has the stress intensity factors of the same cracks written out, also where it
/// starts from the folder of its first run, and replaces it.
#[test]
fn a_list_is_computed_as_its_cracks_written_out() {
    let place = folder("inspection-list", "same");
    fs::write(place.join("inspection.csv"), "mouth_mm;depth_mm;angle_deg\n0;0,5\u{2013}1,0;\n20;1,5;30\n")
        .unwrap();
    let (before, crack_and_after) = DISLOCATION_CASE.split_once("[[crack]]").unwrap();
    let rest = format!("{before}{}", &crack_and_after[crack_and_after.find("[passage]").unwrap()..]);
    let listed = format!("{rest}[[crack]]\ntable = \"inspection.csv\"\nangle_deg = 25.0\nfriction = 0.3\n");
    let crack = |mouth: f64, depth: f64, angle: f64| {
        format!("[[crack]]\nmouth_mm = {mouth}\ndepth_mm = {depth}\nangle_deg = {angle}\nfriction = 0.3\n")
    };
    fs::write(place.join("listed.toml"), listed).unwrap();
    fs::write(
        place.join("written.toml"),
        format!("{rest}{}{}", crack(0.0, 1.0, 25.0), crack(20.0, 1.5, 30.0)),
    )
    .unwrap();
    done(&place, &["run", "written.toml", "--quiet", "--out", "written"]);
    let sif = read(&place.join("written/sif.csv"));
    for case in ["listed.toml", "listed/case.toml"] {
        let (out, force) = (if case == "listed.toml" { "listed" } else { "again" }, "--force");
        done(&place, &["run", case, "--quiet", "--out", out, force]);
        assert_eq!(read(&place.join(out).join("sif.csv")), sif);
    }
    let told = done(&place, &["verify", "listed"]);
    assert!(place.join("listed/inputs/cracks").is_file() && !told.contains("damaged"), "{told}");
}
