//! Cases of rolling wheels and of tables of wheels, for the tests of several crates.

use railcrack::load::Contact;
use railcrack_case::{Case, ContactOrigin};
use std::path::{Path, PathBuf};

pub const CRACK: &str = "[[crack]]\nmouth_mm = 0\nlength_mm = 5\nangle_deg = 25\nfriction = 0.2\nlateral_mm = 6.0\n\
    [passage]\npositions = 41\n[growth]\nsteps = 0\n[solver]\nengine = \"dislocation\"\n";
pub const HEADER: &str = "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm";

/// The strip above the cracks loads them.
pub const STRIP: &str = "lateral = \"strip\"\n";

pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wheels").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The case of a table with `rows`, with `keys` beside it.
pub fn tabled(name: &str, header: &str, rows: &str, keys: &str) -> Case {
    let folder = folder(name);
    std::fs::write(folder.join("curve.csv"), format!("{header}\n{rows}")).unwrap();
    let text = format!("{CRACK}[[wheel]]\ntable = \"curve.csv\"\ncreepage_sign = \"contact\"\n{keys}");
    Case::parse(&text, "case.toml", &folder).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The case of a patch in rolling contact with the crack at its `lateral` (mm), the creepage
/// `across` and `spin` (1/mm), with `keys` beside them.
pub fn rolling([lateral, across, spin]: [f64; 3], keys: &str) -> Case {
    let text = format!(
        "{CRACK}[contact]\nkind = \"rolling\"\nnormal_kn = 85\nsemi_axes_mm = [6.0, 5.0]\nlateral_mm = {lateral}\n\
         creepage_x = 8e-4\ncreepage_y = {across}\nspin_per_mm = {spin}\ncreepage_sign = \"contact\"\nfriction = 0.3\n{keys}"
    );
    Case::parse(&text, "case.toml", Path::new(".")).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The contact of the first wheel.
pub fn contact(case: &Case) -> &Contact {
    case.first_wheel().wheel.contact().unwrap()
}

/// Its origin.
pub fn origin(case: &Case) -> &ContactOrigin {
    &case.first_wheel().wheel.given().unwrap().origin
}
