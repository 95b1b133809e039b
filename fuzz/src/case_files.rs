//! A case for every key that names a file, with such a file: for the fuzz target of these files,
//! and for tests that no kind of file is forgotten by a run folder or a study.

use std::fmt::Write;

/// The name of the file, relative to the folder of the case.
pub const GIVEN: &str = "input";

/// The crack, and what makes the case a quick one.
pub const COMMON: &str = "\
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
[solver]
engine = \"dislocation\"
[passage]
positions = 21
[mesh]
interface_elements = 10
";

/// The contact of cases whose file is not that of the contact.
const CONTACT: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n";

const PROFILES: &str = "[contact]\nkind = \"rolling\"\nnormal_kn = 80\nwheel_radius_mm = 460\nlateral_mm = 0.0\n\
creepage_x = 1e-3\ncreepage_sign = \"contact\"\nfriction = 0.3\n";

/// A case that names one file.
pub struct CaseWithFile {
    /// Name of the copy beside a stored case.
    pub kept_as: &'static str,
    /// The case without [`COMMON`]; it names [`GIVEN`].
    pub case: String,
    /// A content of the file that is accepted.
    pub content: String,
    /// Another file that the case needs: its name and content.
    pub other: Option<(&'static str, String)>,
}

/// One case for each kind of file.
pub fn cases() -> Vec<CaseWithFile> {
    let of = |kept_as, text: &str, content: &str| CaseWithFile {
        kept_as,
        case: format!("{CONTACT}{text}"),
        content: content.to_owned(),
        other: None,
    };
    let stress = "depth_mm,sxx_mpa\n0,25\n0.8,-110\n5,20\n40,0\n";
    vec![
        of("inputs/residual-stress.csv", "[residual_stress]\nprofile = \"input\"\n", stress),
        of("inputs/initial-residual.csv", "[shakedown]\ninitial_residual = \"input\"\n", stress),
        of("inputs/plastic-stress.csv", "[plastic_stress]\nprofile = \"input\"\n", stress),
        of("inputs/plastic-stress.vtu", "[plastic_stress]\nfield = \"input\"\n", &plastic_field()),
        of(
            "inputs/toughness.csv",
            "[temperature]\nrail_c = -5.0\nneutral_c = 25.0\n[fracture]\nprofile = \"input\"\n",
            "temperature_c,toughness_mpa_sqrt_m\n-40,26\n20,38\n",
        ),
        of(
            "inputs/rates.csv",
            "[growth]\nlaw = \"table\"\ntable_profile = \"input\"\n",
            "delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n50,1e-3\n",
        ),
        of(
            "inputs/pod.csv",
            "[traffic]\naxle_load_t = 20.0\n[inspection]\ndetectable_depth_mm = 2.0\npod = \"input\"\n",
            "depth_mm,probability\n0.5,0\n2,0.5\n5,0.9\n",
        ),
        with_contact(
            "inputs/contact-table",
            "[contact]\nkind = \"table\"\nprofile = \"input\"\nfriction = 0.3\n",
            "u_mm,p_mpa,q_mpa\n-6,0,0\n-3,600,-60\n0,900,-90\n3,600,-60\n6,0,0\n",
        ),
        with_contact(
            "inputs/wheels",
            "[[wheel]]\ntable = \"input\"\ncreepage_sign = \"contact\"\nplace_m = 20.0\n",
            "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm,place_m\n\
             7,85,1,0.001,0.0005,0.0002,0.3,6,4,10.5\n8,60,0,0.002,0,0,0.3,6,5,20\n",
        ),
        of(
            "inputs/cracks",
            "[[crack]]\ntable = \"input\"\nangle_deg = 25.0\nfriction = 0.3\n",
            "mouth_mm,depth_mm\n20,0.5-1.0\n32,1.5\n",
        ),
        of_profile(RAIL),
        of_profile(WHEEL),
    ]
}

const RAIL: (&str, &str) = ("rail", "inputs/rail-profile");
const WHEEL: (&str, &str) = ("wheel", "inputs/wheel-profile");

fn with_contact(kept_as: &'static str, case: &str, content: &str) -> CaseWithFile {
    CaseWithFile { kept_as, case: case.to_owned(), content: content.to_owned(), other: None }
}

/// The case of two profiles of which the one of `body` is the file.
fn of_profile((body, kept_as): (&'static str, &'static str)) -> CaseWithFile {
    let other = if body == "rail" { "wheel" } else { "rail" };
    CaseWithFile {
        kept_as,
        case: format!("{PROFILES}{body}_profile = \"input\"\n{other}_profile = \"other\"\n"),
        content: profile(body),
        other: Some(("other", profile(other))),
    }
}

/// A head of radius 80 mm, and a wheel that follows it but for a curvature of 1/250 mm.
fn profile(body: &str) -> String {
    let mut text = String::from("y_mm,z_mm\n");
    let (end, away) = if body == "rail" { (35.0, 0.0) } else { (25.0, 2e-3) };
    let mut y: f64 = -end;
    while y <= end {
        let z = 80.0 - (6400.0 - y * y).sqrt() - away * y * y;
        writeln!(text, "{y},{z:.6}").expect("a string");
        y += 0.5;
    }
    text
}

/// Constant plastic stress on one cell of 40 mm × 20 mm.
fn plastic_field() -> String {
    let array = |kind: &str, name: &str, components: usize, values: &str| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">\
             {values}</DataArray>"
        )
    };
    format!(
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>\
         <Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>{}</Points><Cells>{}{}{}</Cells>\
         <PointData>{}</PointData></Piece></UnstructuredGrid></VTKFile>",
        array("Float64", "points", 3, "-20 -20 0  20 -20 0  20 0 0  -20 0 0"),
        array("Int64", "connectivity", 1, "0 1 2 3"),
        array("Int64", "offsets", 1, "4"),
        array("UInt8", "types", 1, "9"),
        array("Float64", "plastic_stress_mpa", 6, &"9 0 0 0 0 0 ".repeat(4)),
    )
}
