//! Rolling contact and tables of wheels.

use super::cases::{CRACK, HEADER, STRIP, contact, folder, origin, rolling, tabled};
use railcrack::load::Contact;
use railcrack_case::{Case, ContactExtent, ContactOrigin};
use std::path::{Path, PathBuf};

#[test]
fn the_mirrored_rail_has_the_same_history() {
    let strip = |numbers| contact(&rolling(numbers, STRIP)).clone();
    let (left, right) = (strip([1.5, -4e-4, 2e-4]), strip([-1.5, 4e-4, -2e-4]));
    assert_eq!(left, right);
    assert_ne!(left, strip([-1.5, -4e-4, 2e-4]));
}

/// The contact of a wheel that loads cracks by its patches is the middle strip of the heaviest one,
/// wherever the cracks lie.
#[test]
fn a_patch_is_named_by_its_middle_strip() {
    let middle = rolling([0.0, -4e-4, 2e-4], STRIP);
    for lateral in [0.0, 1.5, 8.0] {
        let case = rolling([lateral, -4e-4, 2e-4], "");
        assert_eq!(contact(&case), contact(&middle), "{lateral}");
        assert_eq!(case.first_wheel().wheel.given().unwrap().extent, ContactExtent::Patch);
        let y = 6.0 - lateral;
        let beside = y + 10.0;
        let rows = format!("1,85,{y},8e-4,-4e-4,2e-4,0.3,6,5\n1,20,{beside},8e-4,0,0,0.3,4,3\n");
        let table = tabled("middle", HEADER, &rows, "");
        assert_eq!((contact(&table), origin(&table)), (contact(&middle), origin(&case)), "{lateral}");
    }
}

/// A strip is for cracks in the plane of a half-plane, and a patch for all but blocks.
#[test]
fn an_extent_that_the_case_cannot_take_is_refused() {
    let folder = folder("extents");
    std::fs::write(folder.join("curve.csv"), format!("{HEADER}\n1,85,4.5,8e-4,0,0,0.3,6,5\n")).unwrap();
    let table = "[[wheel]]\ntable = \"curve.csv\"\ncreepage_sign = \"contact\"\n";
    let own = "[contact]\nkind = \"rolling\"\nnormal_kn = 85\nsemi_axes_mm = [6.0, 5.0]\n\
        creepage_sign = \"contact\"\nfriction = 0.3\n";
    let space =
        CRACK.replace("dislocation", "space").replace("[passage]", "surface_half_length_mm = 5\n[passage]");
    let block = CRACK.replace("dislocation", "xfem") + "[rail]\nboundary = \"block\"\n";
    for (wheel, key) in [(table, "wheel[1].lateral"), (own, "contact.lateral")] {
        for (rest, extent) in [(&space, "strip"), (&block, "patch")] {
            let parse = |extent: &str| {
                let text = format!("{rest}{wheel}lateral = \"{extent}\"\n");
                Case::parse(&text, "case.toml", &folder).map_err(|errors| errors.to_string())
            };
            let refused = parse(extent).unwrap_err();
            assert!(refused.contains(&format!("`{key} = \"{extent}\"`: ")), "{refused}");
            let other = if extent == "strip" { "patch" } else { "strip" };
            assert!(parse(other).is_ok(), "{:?}", parse(other).err());
        }
    }
    let coupled = format!("{CRACK}{own}coupled = true\nlateral = \"patch\"\n");
    let refused = Case::parse(&coupled, "case.toml", &folder).unwrap_err().to_string();
    assert!(refused.contains("`contact.coupled = true`: is true, and a wheel that feels"), "{refused}");
}

#[test]
fn driving_and_braking_wheels_shear_the_rail_in_opposite_directions() {
    let shear = |sign: &str, travel: &str| {
        let text = format!(
            "{CRACK}[contact]\nkind = \"rolling\"\nnormal_kn = 85\nwheel_radius_mm = 460\nrail_head_radius_mm = 300\n\
             creepage_x = 8e-4\ncreepage_sign = \"{sign}\"\nfriction = 0.3\n"
        );
        let text = text.replace("[passage]\n", &format!("[passage]\n{travel}"));
        Case::parse(&text, "case.toml", Path::new("."))
            .unwrap()
            .first_wheel()
            .wheel
            .contact()
            .unwrap()
            .adhesion()
    };
    let driving = shear("contact", "");
    assert!(driving < 0.0, "{driving}");
    assert_eq!(shear("vehicle", ""), -driving);
    assert_eq!(shear("contact", "from_over_a = 6\nto_over_a = -6\n"), -driving);
}

#[test]
fn two_patches_over_one_crack_are_one_history() {
    let header = format!("{HEADER},x_mm");
    let rows = "1,60,4.5,8e-4,0,0,0.3,6,5,0\n1,40,7.0,8e-4,0,1e-4,0.3,4,3,-9\n";
    let both = tabled("both", &header, rows, STRIP);
    let first = tabled("first", &header, "1,60,4.5,8e-4,0,0,0.3,6,5,0\n", STRIP);
    let second = tabled("second", &header, "1,40,7.0,8e-4,0,1e-4,0.3,4,3,-9\n", STRIP);
    assert_eq!(both.wheels.len(), 1);
    let (sum, a, b) = (contact(&both), contact(&first), contact(&second));
    let load = a.line_load() + b.line_load();
    assert!((sum.line_load() / load - 1.0).abs() < 5e-4, "{} {load}", sum.line_load());
    let shear = a.line_load() * a.adhesion() + b.line_load() * b.adhesion();
    assert!((sum.line_load() * sum.adhesion() / shear - 1.0).abs() < 5e-3);
    // The second patch follows the first one at 9 mm: it ends at −9 − a_y, the first one begins at
    // a_y.
    let Contact::Table(table) = sum else { panic!("{sum:?}") };
    let rows = table.rows();
    let ends = (rows[0].u, rows[rows.len() - 1].u);
    assert!(
        (ends.0 + 9.0 + b.half_width()).abs() < 1e-9 && (ends.1 - a.half_width()).abs() < 1e-9,
        "{ends:?}"
    );
}

/// A folder with the files of a stored case.
fn kept(case: &Case, name: &str) -> PathBuf {
    let folder = folder(name);
    for companion in case.companions() {
        let path = folder.join(companion.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, companion.text).unwrap();
    }
    folder
}

#[test]
fn a_place_along_the_curve_selects_its_wheels() {
    let header = format!("{HEADER},place_m,share");
    let rows = "1,85,4.5,8e-4,0,0,0.3,6,5,100,0.5\n1,60,4.5,8e-4,0,0,0.3,6,5,200,0.5\n2,70,5,0,0,0,0.3,6,5,200,0.25\n";
    let here = tabled("place", &header, rows, "place_m = 200.2\n");
    assert_eq!(here.wheels.iter().map(|wheel| wheel.share).collect::<Vec<_>>(), [0.5 / 0.75, 0.25 / 0.75]);
    let all = tabled("all-places", &header, rows, "");
    assert_eq!(all.wheels.len(), 3);
}

#[test]
fn tables_that_are_wrong_are_refused_with_row_and_column() {
    let folder = folder("wrong");
    let refused = |rows: &str, keys: &str| {
        std::fs::write(folder.join("curve.csv"), rows).unwrap();
        let text = format!("{CRACK}[[wheel]]\n{keys}");
        Case::parse(&text, "case.toml", &folder).unwrap_err().to_string()
    };
    let table = "table = \"curve.csv\"\ncreepage_sign = \"contact\"\n";
    let row = "1,85,4.5,8e-4,0,0,0.3,6,5\n";
    let good = format!("{HEADER}\n{row}");
    let wrong = |bad: &str| refused(&format!("{HEADER}\n{row}{bad}\n"), table);
    assert!(wrong("2,-5,4.5,0,0,0,0.3,6,5").contains("row 2: `normal_kn = -5`: must be"));
    assert!(wrong("2,85,80,0,0,0,0.3,6,5").contains("row 2: `y_rail_mm = 80`"));
    assert!(
        wrong("2,85,4.5,1e-3,0,0,0,6,5")
            .contains("row 2: `mu = 0`: must be positive where there is creepage")
    );
    assert!(wrong("2,85,4.5,0,0,0,0.3,6,").contains("row 2: `b_mm` is missing: it belongs to `a_mm`"));
    assert!(wrong("2,85,4.5,0,0,0,0.3,0.1,0.1").contains("row 2: `normal_kn = 85`: gives a patch with a = "));
    assert!(wrong("2,,4.5,0,0,0,0.3,6,5").contains("row 2: `normal_kn` is blank: must be a number"));
    assert!(wrong("2,85,4.5,0,0,0").contains("row 2: 6 values in a row of 9 columns"));
    let places =
        "1,85,4.5,0,0,0,0.3,6,5,10,0.6\n2,85,4.5,0,0,0,0.3,6,5,20,0.5\n3,85,4.5,0,0,0,0.3,6,5,20,0.75\n";
    let says = refused(&format!("{HEADER},place_m,share\n{places}"), table);
    assert!(says.contains("row 3: `share`: the shares of the wheels at place_m = 20 add up to 1.25; at one"));
    assert!(refused(&good.replace("mu", "friction"), table).contains("unknown column `friction`"));
    assert!(refused(&good, "table = \"curve.csv\"\n").contains("`wheel[1].creepage_sign` is missing"));
    let both =
        format!("{table}contact = {{ peak_pressure_mpa = 845.0, half_width_mm = 6.75, friction = 0.1 }}\n");
    assert!(refused(&good, &both).contains("says the same thing as `table`"));
    assert!(refused(&good, &format!("{table}share = 1.0\n")).contains("says the same thing"));
    let beside = refused(&good.replace("4.5", "-40"), &format!("{table}{STRIP}"));
    assert!(beside.contains("no patch of its 1 wheels meets the crack"), "{beside}");
    assert!(refused(&good, &format!("{table}place_m = 5\n")).contains("no wheel of the table has a place_m"));
}

/// `keys` of a contact of the shipped profiles.
fn profiled(keys: &str) -> Result<Case, String> {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let crack = CRACK.replace("lateral_mm = 6.0\n", "");
    let text = format!(
        "{crack}[contact]\nkind = \"rolling\"\nrail_profile = \"profiles/uic60.csv\"\nwheel_profile = \"profiles/s1002.csv\"\n\
         normal_kn = 80\nwheel_radius_mm = 460\ncreepage_x = 1e-3\ncreepage_sign = \"contact\"\nfriction = 0.3\n{keys}"
    );
    Case::parse(&text, "case.toml", &cases).map_err(|errors| errors.to_string())
}

#[test]
fn profiles_load_the_crack_where_they_touch() {
    let case = profiled("shift_mm = -8.5\n").unwrap();
    let ContactOrigin::Profiles(own) = origin(&case) else { panic!("{:?}", case.wheels) };
    let [one] = own.contacts[..] else { panic!("{} patches", own.contacts.len()) };
    assert!((one.normal_force / 80e3 - 1.0).abs() < 1e-9 && own.lateral == one.y);
    // The middle strip has the pressure of the patch, and the wheel drives.
    let contact = contact(&case);
    assert!((contact.peak_pressure() / one.ellipse.peak_pressure - 1.0).abs() < 0.02);
    assert!(contact.adhesion() < 0.0);
    let again = Case::parse(&case.to_toml(), "case.toml", &kept(&case, "profiles-kept")).unwrap();
    assert_eq!(again, case);
    let says = |keys: &str| profiled(keys).unwrap_err();
    assert!(says("shift_mm = 150\n").contains("the wheel is not above the rail head"));
    let outside = "shift_mm = -8.5\nlateral_mm = 12\n";
    assert!(says(&format!("{outside}{STRIP}")).contains("is outside the patches, which reach from"));
    assert_eq!(super::cases::contact(&profiled(outside).unwrap()), contact);
    assert!(says("semi_axes_mm = [6.0, 5.0]\n").contains("semi_axes_mm"));
}

/// Between tread and flange root a patch spreads over a pass, and the force of the theory jumps.
#[test]
fn spreading_patches_of_profiles_carry_the_normal_force() {
    for shift in [-6.0, -5.8, -5.6, -5.55, -5.5, -5.4, -5.3, -5.2, -5.0] {
        let case = profiled(&format!("shift_mm = {shift}\nyaw_deg = 0.34\n")).unwrap();
        let ContactOrigin::Profiles(own) = origin(&case) else { panic!("{:?}", case.wheels) };
        let told: f64 = own.contacts.iter().map(|own| own.normal_force).sum();
        let carried: f64 = own.placed.iter().map(|own| own.patch.normal_force()).sum();
        assert!((told / 80e3 - 1.0).abs() < 1e-6 && (carried / told - 1.0).abs() < 1e-6, "{shift}: {told}");
    }
}
