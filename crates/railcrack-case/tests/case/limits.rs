//! Sizes, ranges and files that are refused before anything is made of them.

use railcrack_case::{Case, CaseErrors, Input, Overrides};
use std::fmt::Write;
use std::path::Path;
use std::time::{Duration, Instant};

const WHEEL: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n";

/// Time that reading any case may take: a hundred times what it does, on a machine that is busy.
const BUDGET: Duration = Duration::from_secs(5);

fn read(text: &str) -> Result<Case, CaseErrors> {
    let started = Instant::now();
    let case = Case::parse(text, "case.toml", Path::new(""));
    assert!(started.elapsed() < BUDGET, "{:?} for\n{:.300}", started.elapsed(), text);
    case
}

fn cracks(points: &[&str], rest: &str) -> String {
    let mut text = WHEEL.to_owned();
    for points in points {
        let _ = write!(text, "[[crack]]\npoints_mm = {points}\nfriction = 0.5\n");
    }
    text + rest
}

fn one(crack: &str, rest: &str) -> String {
    format!("{WHEEL}[[crack]]\nfriction = 0.5\n{crack}\n{rest}")
}

const SHORT: &str = "mouth_mm = 0.0\nlength_mm = 1.0\nangle_deg = 15.0";

#[track_caller]
fn refused(text: &str, key: &str) {
    let errors = read(text).expect_err(text);
    let keys: Vec<_> = errors.errors().iter().filter_map(|e| e.key()).collect();
    assert_eq!(keys, [key], "{errors}");
}

#[test]
fn sizes_beyond_every_machine_name_the_key_that_makes_them() {
    for size in ["1e-300", "1e-12", "1e-9", "1e-5"] {
        refused(&one(SHORT, &format!("[mesh]\nelement_size_mm = {size}\n")), "mesh.element_size_mm");
    }
    for spacing in ["1e-300", "1e-9"] {
        refused(
            &one(SHORT, &format!("[mesh]\ninterface_spacing_mm = {spacing}\n")),
            "mesh.interface_spacing_mm",
        );
    }
    let rows = "[growth]\nsteps = 10000\n[passage]\npositions = 100000\n[solver]\nengine = \"dislocation\"\n";
    refused(&one(SHORT, rows), "passage.positions");
    assert!(read(&one(SHORT, "[mesh]\nelement_size_mm = 0.01\n")).is_ok());
}

#[test]
fn face_points_closer_than_elements_follow() {
    let mesh = |spacing: &str, rest: &str| format!("[mesh]\ninterface_spacing_mm = {spacing}\n{rest}");
    let size = "element_size_mm = 0.1\n";
    refused(&one(SHORT, &mesh("0.029", size)), "mesh.interface_spacing_mm");
    // Elements are a sixtieth of the crack by themselves.
    refused(&one(SHORT, &mesh("0.0049", "")), "mesh.interface_spacing_mm");
    for (spacing, rest) in [("0.031", size), ("0.0051", ""), ("5.0", size)] {
        assert!(read(&one(SHORT, &mesh(spacing, rest))).is_ok(), "{spacing}");
    }
    let other = format!("{size}[solver]\nengine = \"dislocation\"\n");
    assert!(read(&one(SHORT, &mesh("0.001", &other))).is_ok(), "without effect");
}

#[test]
fn cracks_closer_than_an_engine_resolves() {
    for engine in ["xfem", "dislocation"] {
        let solver = format!("[solver]\nengine = \"{engine}\"\n");
        let first = "[[0.0, 0.0], [6.0, -2.0]]";
        for second in ["[[5e-324, 0.0], [6.000000000000001, -2.0]]", "[[1e-9, 0.0], [6.000000001, -2.0]]"] {
            refused(&cracks(&[first, second], &solver), "crack[2]");
        }
        assert!(read(&cracks(&[first, "[[0.1, 0.0], [6.1, -2.0]]"], &solver)).is_ok());
        let row = "mouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\ncount = 3\nspacing_mm = 1e-12";
        refused(&one(row, &solver), "crack[1].spacing_mm");
    }
}

#[test]
fn what_no_engine_computes_is_out_of_range() {
    let contact = |half_width: &str| {
        one(SHORT, "").replace("half_width_mm = 6.75", &format!("half_width_mm = {half_width}"))
    };
    refused(&contact("5e-324"), "contact.half_width_mm");
    for angle in ["0.01", "1e-9", "179.9999999"] {
        let crack = format!("mouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = {angle}");
        refused(&one(&crack, ""), "crack[1].angle_deg");
    }
    refused(&one(SHORT, "[rail]\npoisson_ratio = 0.49999999999999994\n"), "rail.poisson_ratio");
    refused(&one(SHORT, "[growth]\nparis_c = 5e-324\narrest_rate_mm_per_cycle = 0.0\n"), "growth.paris_c");
    refused(&one(SHORT, "[growth]\nparis_c = 1.0\nparis_m = 20.0\n"), "growth.paris_c");
    refused(&one(SHORT, "[growth]\nincrement = 5e-324\n"), "growth.increment");
    for points in [
        "[[0.0, 0.0], [1.0, -1.0], [1.0, -1.000000000001], [2.0, -2.0]]",
        "[[0.0, 0.0], [6.0, -1e-9]]",
        "[[0.0, -1e-9], [6.0, -2.0]]",
    ] {
        refused(&cracks(&[points], ""), "crack[1].points_mm");
    }
}

#[test]
fn many_errors_are_counted_and_a_few_told() {
    let mut keys = one(SHORT, "[mesh]\n");
    for i in 0..20_000 {
        let _ = writeln!(keys, "key_{i} = 1");
    }
    let errors = read(&keys).unwrap_err();
    assert_eq!(errors.errors().len(), 50);
    assert!(errors.to_string().contains("and 19950 more errors"), "{errors}");
    let duplicates = one(SHORT, "[mesh]\n") + &"element_size_mm = 0.1\n".repeat(40_000);
    assert!(read(&duplicates).unwrap_err().errors().len() <= 50);
    assert_eq!(read("a = [[[[").unwrap_err().errors().len(), 1);
}

#[test]
fn a_file_without_end_is_read_no_further() {
    let started = Instant::now();
    if Path::new("/dev/zero").exists() {
        let errors = Input::read_with(Path::new("/dev/zero"), &Overrides::default()).unwrap_err();
        assert!(errors.to_string().contains("not a regular file"), "{errors}");
        let field = one(SHORT, "[plastic_stress]\nfield = \"/dev/zero\"\n");
        let errors = Case::parse(&field, "case.toml", Path::new("")).unwrap_err();
        assert!(errors.to_string().contains("not a regular file"), "{errors}");
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("too-long");
    std::fs::create_dir_all(&folder).unwrap();
    let long = folder.join("long.toml");
    std::fs::write(&long, vec![b'#'; (4 << 20) + 1]).unwrap();
    let errors = Input::read_with(&long, &Overrides::default()).unwrap_err();
    assert!(errors.to_string().contains("larger than 4 MB"), "{errors}");
    // Of a file that a case names, what would make it smaller.
    let profile = one(SHORT, "[residual_stress]\nprofile = \"long.toml\"\n");
    let errors = Case::parse(&profile, "case.toml", &folder).unwrap_err();
    let help = errors.errors()[0].help().unwrap_or_default();
    assert!(help.contains("leave out columns") && !help.contains("relative"), "{help}");
    assert!(started.elapsed() < BUDGET);
}

#[test]
fn control_characters_of_a_file_do_not_reach_the_terminal() {
    let text = one(SHORT, "[mesh]\n\"a\\u001b[31m\" = \"\\u202e\"\n# \u{1b}[2J\n");
    let errors = Case::parse(&text, "case\u{1b}.toml", Path::new("")).unwrap_err();
    let mut shown = errors.to_string();
    for error in errors.errors() {
        shown += &[error.text(), error.file(), error.message(), error.help().unwrap_or_default()].concat();
    }
    assert!(!shown.contains(['\u{1b}', '\u{202e}']), "{shown}");
}

#[test]
fn cells_upon_one_another_are_refused_in_time() {
    const CELLS: usize = 100_000;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("coincident-cells");
    std::fs::create_dir_all(&folder).unwrap();
    let offsets: String = (1..=CELLS).map(|cell| format!("{} ", 4 * cell)).collect();
    let array = |name: &str, kind: &str, components: usize, values: &str| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">\
             {values}</DataArray>"
        )
    };
    let file = format!(
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>\
         <Piece NumberOfPoints=\"4\" NumberOfCells=\"{CELLS}\"><Points>{}</Points><Cells>{}{}{}</Cells>\
         <PointData>{}</PointData></Piece></UnstructuredGrid></VTKFile>",
        array("points", "Float64", 3, "-9 -9 0  9 -9 0  9 0 0  -9 0 0"),
        array("connectivity", "Int64", 1, &"0 1 2 3 ".repeat(CELLS)),
        array("offsets", "Int64", 1, &offsets),
        array("types", "UInt8", 1, &"9 ".repeat(CELLS)),
        array("plastic_stress_mpa", "Float64", 6, &"9 0 0 0 0 0 ".repeat(4)),
    );
    std::fs::write(folder.join("field.vtu"), file).unwrap();
    let started = Instant::now();
    let case = one(SHORT, "[plastic_stress]\nfield = \"field.vtu\"\n");
    let errors = Case::parse(&case, "case.toml", &folder).unwrap_err();
    assert!(errors.to_string().contains("the 100000 cells lie on top of one another"), "{errors}");
    assert!(started.elapsed() < BUDGET, "{:?}", started.elapsed());
}
