//! Cracks of an inspection: the case of a list is that of the same cracks written out.

use railcrack_case::Case;
use std::path::{Path, PathBuf};

const REST: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n";

/// As an instrument exports it, in no order.
const LIST: &str = "crack;position_m;depth_mm;surface_length_mm;angle_deg\n-;[m];[mm];[mm];[deg]\n\
    A;1200,020;0,5\u{2013}1,0;8,0;25\nB;1200,000;1,5;;\nC;1200,012;1,2;6;\n";

const OF_LIST: &str =
    "[[crack]]\ntable = \"inspection.csv\"\nangle_deg = 30.0\nfriction = 0.3\nsurface_half_length_mm = 5.0\n";

fn folder(name: &str, list: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crack-table").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("inspection.csv"), list).unwrap();
    folder
}

fn case(text: &str, folder: &Path) -> Case {
    Case::parse(text, "case.toml", folder).unwrap_or_else(|errors| panic!("{errors}"))
}

fn written_out() -> String {
    // Positions to the rounding of their differences.
    let at = |position: f64| 1e3 * (position - 1200.0);
    let crack = |position: f64, depth: f64, half_length: f64, angle: f64| {
        format!(
            "[[crack]]\nmouth_mm = {:?}\ndepth_mm = {depth}\nangle_deg = {angle}\nfriction = 0.3\n\
             surface_half_length_mm = {half_length}\n",
            at(position)
        )
    };
    let rows = [(1200.02, 1.0, 4.0, 25.0), (1200.0, 1.5, 5.0, 30.0), (1200.012, 1.2, 3.0, 30.0)];
    rows.map(|(position, depth, half_length, angle)| crack(position, depth, half_length, angle)).concat()
}

#[test]
fn the_cracks_of_a_list_are_those_written_out() {
    let folder = folder("same", LIST);
    for engine in ["", "[solver]\nengine = \"space\"\n"] {
        let rest = match engine {
            "" => REST.to_owned(),
            space => format!("{REST}lateral_half_width_mm = 5.0\n{space}"),
        };
        let listed = case(&format!("{rest}{OF_LIST}"), &folder);
        let written = case(&format!("{rest}{}", written_out()), &folder);
        assert_eq!(listed.cracks, written.cracks);
        assert_eq!(listed.crack_friction, written.crack_friction);
        assert_eq!(listed.geometry, written.geometry);
        assert_eq!((listed.rail, &listed.wheels), (written.rail, &written.wheels));
    }
}

#[test]
fn a_stored_case_has_its_list() {
    let folder = folder("stored", LIST);
    let listed = case(
        &format!("{REST}{OF_LIST}[[crack]]\nmouth_mm = 40\ndepth_mm = 1\nangle_deg = 30\nfriction = 0.2\n"),
        &folder,
    );
    assert_eq!(listed.cracks.cracks().len(), 4);
    let [list] = listed.companions().try_into().unwrap();
    assert_eq!(
        (list.name, list.given, list.unused),
        ("inputs/cracks", "inspection.csv", &["crack".to_owned()][..])
    );
    let copy = folder.join("copy");
    std::fs::create_dir_all(copy.join("inputs")).unwrap();
    std::fs::write(copy.join(list.name), list.text).unwrap();
    assert_eq!(case(&listed.to_toml(), &copy), listed);
}

#[test]
fn refused_with_the_key_or_the_row() {
    let of = |name: &str, list: &str, text: &str| {
        let folder = folder(name, list);
        Case::parse(&format!("{REST}{text}"), "case.toml", &folder).unwrap_err().to_string()
    };
    let near = "mouth_mm,depth_mm\n0,1\n20,1.5\n20,1\n";
    let says = of("near", near, OF_LIST);
    assert!(says.contains("`crack[1].row[2]` and `crack[1].row[3]` cross, touch or overlap"), "{says}");
    let says = of("row", "mouth_mm,depth_mm\n0,1\n20,deep\n", OF_LIST);
    assert!(
        says.contains("row 2: `depth_mm = deep`: must be a number") && says.contains("inspection.csv:3"),
        "{says}"
    );
    let says = of("copies", near, &format!("{OF_LIST}count = 2\nspacing_mm = 4.0\n"));
    assert!(says.contains("`crack[1].count = 2`: applies to the copies of a crack"), "{says}");
    let says = of("angle", near, &OF_LIST.replace("angle_deg = 30.0\n", ""));
    assert!(says.contains("row 1 has no angle_deg, and neither has the section"), "{says}");
    let says = of("two", LIST, &format!("{OF_LIST}{OF_LIST}"));
    assert!(says.contains("is the second list of cracks of a case"), "{says}");
    let says = of("both", near, &format!("{OF_LIST}mouth_mm = 3.0\n"));
    assert!(says.contains("says the same thing as `table`"), "{says}");
    let says = of("none", near, &OF_LIST.replace("inspection.csv", "inspections.csv"));
    assert!(says.contains("there is no such file"), "{says}");
    assert!(
        case(
            &format!("{REST}{}", OF_LIST.replace("angle_deg = 30.0\n", "")),
            &folder("own", "mouth_mm,depth_mm,angle_deg\n0,1,25\n")
        )
        .cracks
        .cracks()
        .len()
            == 1
    );
}
