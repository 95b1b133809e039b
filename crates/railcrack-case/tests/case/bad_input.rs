//! Every way of getting a case file wrong that we know, and what is said about it.

use railcrack_case::{Case, CaseErrors};
use std::path::Path;

/// A good case of eight lines; what is appended to it begins on line 9.
const GOOD: &str = "\
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.025
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.5
";

/// A good case in space of fifteen lines, spoilt: angle, lines after the crack, contact.
macro_rules! space {
    ($kind:literal, $half_length:literal, $angle:literal, $beside:literal) => {
        concat!(
            "[contact]\n",
            $kind,
            "peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nlateral_half_width_mm = 6.0\nfriction = 0.1\n[[crack]]\nmouth_mm = 0.0\n",
            $angle,
            "length_mm = 4.0\n",
            $half_length,
            "friction = 0.5\n",
            "[solver]\nengine = \"space\"\n",
            $beside
        )
    };
}
const SPACE_WITHOUT_LENGTH: &str = space!("", "", "angle_deg = 30.0\n", "");
const SPACE_AT_3: &str = space!("", "surface_half_length_mm = 6.0\n", "angle_deg = 3.0\n", "");
const SPACE_TWICE: &str = space!(
    "",
    "surface_half_length_mm = 6.0\n",
    "angle_deg = 30.0\n",
    "[[crack]]\nmouth_mm = 3.0\nlength_mm = 4.0\nangle_deg = 120.0\nfriction = 0.5\nsurface_half_length_mm = 6.0\n"
);
const SPACE_COPIES: &str =
    space!("", "surface_half_length_mm = 6.0\ncount = 3\nspacing_mm = 0.3\n", "angle_deg = 30.0\n", "");
const SPACE_LATIN: &str =
    space!("", "surface_half_length_mm = 6.0\n", "angle_deg = 30.0\n", "contact = \"latin\"\n");
const SPACE_TOO_WIDE: &str = space!("", "surface_half_length_mm = 400.0\n", "angle_deg = 30.0\n", "");
const SPACE_CARTER: &str =
    space!("kind = \"carter\"\ntraction = 0.5\n", "surface_half_length_mm = 6.0\n", "angle_deg = 30.0\n", "");
const SPACE_BOLD: &str =
    space!("", "surface_half_length_mm = 6.0\n", "angle_deg = 30.0\n", "[growth]\nlaw = \"bold\"\n");

/// How the good case is spoilt.
enum Change {
    /// Lines appended.
    Append(&'static str),
    /// A piece of the good case replaced.
    Replace(&'static str, &'static str),
    /// A piece of the good case replaced, and lines appended.
    Both(&'static str, &'static str, &'static str),
    /// Another text altogether.
    Whole(&'static str),
}
use Change::{Append, Both, Replace, Whole};

/// The first error that is expected.
struct Wrong {
    change: Change,
    line: usize,
    key: &'static str,
    /// A piece of the message.
    says: &'static str,
    /// A piece of the help.
    helps: &'static str,
}

const fn wrong(
    change: Change,
    line: usize,
    key: &'static str,
    says: &'static str,
    helps: &'static str,
) -> Wrong {
    Wrong { change, line, key, says, helps }
}

fn text(change: &Change) -> String {
    let replaced = |old: &str, new: &str| {
        assert!(GOOD.contains(old), "{old}");
        GOOD.replacen(old, new, 1)
    };
    match change {
        Append(lines) => format!("{GOOD}{lines}"),
        Replace(old, new) => replaced(old, new),
        Both(old, new, lines) => format!("{}{lines}", replaced(old, new)),
        Whole(text) => (*text).into(),
    }
}

fn errors(text: &str) -> CaseErrors {
    match Case::parse(text, "case.toml", Path::new("no-such-folder")) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(errors) => errors,
    }
}

fn check(cases: &[Wrong]) {
    for want in cases {
        let text = text(&want.change);
        let errors = errors(&text);
        let all = errors.to_string();
        let first = &errors.errors()[0];
        let line = first.position().map_or(0, |(line, _)| line);
        let help = first.help().unwrap_or_default();
        assert_eq!(errors.errors().len(), 1, "one thing is wrong, one error:\n{text}\n{all}");
        assert_eq!(first.file(), "case.toml");
        assert_eq!(line, want.line, "line of\n{text}\n{all}");
        assert_eq!(first.key().unwrap_or_default(), want.key, "key of\n{text}\n{all}");
        assert!(first.message().contains(want.says), "`{}` in the message of\n{text}\n{all}", want.says);
        assert!(help.contains(want.helps), "`{}` in the help of\n{text}\n{all}", want.helps);
    }
}

#[test]
fn numbers() {
    check(&[
        wrong(
            Append("[rail]\nyoung_modulus_mpa = nan"),
            11,
            "rail.young_modulus_mpa",
            "= nan`: must be a number in [1, 1e7] MPa",
            "",
        ),
        wrong(Append("[rail]\nyoung_modulus_mpa = inf"), 11, "rail.young_modulus_mpa", "= inf`: must be", ""),
        wrong(
            Append("[rail]\nyoung_modulus_mpa = -210e3"),
            11,
            "rail.young_modulus_mpa",
            "= -210e3`: must be",
            "",
        ),
        wrong(
            Append("[rail]\nyoung_modulus_mpa = 1e400"),
            11,
            "rail.young_modulus_mpa",
            "= 1e400`: must be",
            "",
        ),
        wrong(
            Append("[rail]\nyoung_modulus_mpa = 99999999999999999999"),
            11,
            "rail.young_modulus_mpa",
            "must be",
            "",
        ),
        wrong(
            Append("[rail]\npoisson_ratio = 0.5"),
            11,
            "rail.poisson_ratio",
            "must be a number in [0, 0.499]",
            "",
        ),
        wrong(Append("[rail]\npoisson_ratio = -0.1"), 11, "rail.poisson_ratio", "must be", ""),
        wrong(
            Append("[rail]\nwidth_mm = 0"),
            11,
            "rail.width_mm",
            "`rail.width_mm = 0`: must be a number in (0, 1e5] mm",
            "",
        ),
        wrong(Append("[rail]\ndepth_mm = -172.0"), 11, "rail.depth_mm", "must be", ""),
        wrong(Append("[rail]\ncentre_mm = nan"), 11, "rail.centre_mm", "must be", ""),
        wrong(
            Replace("845.0", "0.0"),
            2,
            "contact.peak_pressure_mpa",
            "must be a number in [0.001, 10000] MPa",
            "",
        ),
        wrong(Replace("845.0", "-845"), 2, "contact.peak_pressure_mpa", "= -845`", ""),
        wrong(Replace("6.75", "-inf"), 3, "contact.half_width_mm", "= -inf`", ""),
        wrong(Replace("0.025", "1.5"), 4, "contact.friction", "must be a number in [-1, 1]", ""),
        wrong(Replace("0.025", "-nan"), 4, "contact.friction", "must be a number in [-1, 1]", ""),
        wrong(
            Replace("length_mm = 6.0", "length_mm = 0"),
            7,
            "crack[1].length_mm",
            "must be a number in [0.001, 10000] mm",
            "",
        ),
        wrong(
            Replace("15.0", "0.0"),
            8,
            "crack[1].angle_deg",
            "must be a number in [0.5, 179.5] degrees",
            "",
        ),
        wrong(Replace("15.0", "180"), 8, "crack[1].angle_deg", "must be", ""),
        wrong(Replace("15.0", "-15"), 8, "crack[1].angle_deg", "must be", ""),
        wrong(
            Replace("friction = 0.5", "friction = -0.1"),
            9,
            "crack[1].friction",
            "must be a number in [0, 2]",
            "",
        ),
        wrong(Replace("friction = 0.5", "friction = 2.1"), 9, "crack[1].friction", "must be", ""),
        wrong(
            Append("[growth]\nincrement = 0.0"),
            11,
            "growth.increment",
            "must be a number in [1e-4, 0.5]",
            "",
        ),
        wrong(Append("[growth]\nincrement = 0.51"), 11, "growth.increment", "must be", ""),
        wrong(Append("[growth]\nparis_c = 0"), 11, "growth.paris_c", "must be", ""),
        wrong(
            Append("[growth]\nthreshold_mpa_sqrt_m = -1"),
            11,
            "growth.threshold_mpa_sqrt_m",
            "must be",
            "",
        ),
        wrong(
            Append(
                "[[wheel]]\nshare = 1.0\ncontact = { peak_pressure_mpa = 845, half_width_mm = 6, friction = 0 }",
            ),
            1,
            "contact",
            "same thing as `[[wheel]]`",
            "",
        ),
        wrong(
            Append("[inspection]\ndetectable_depth_mm = 2.0"),
            10,
            "inspection",
            "no axle load",
            "axle_load_t",
        ),
        wrong(Append("[scatter]\nsamples = 1000"), 10, "scatter", "no axle load", "axle_load_t"),
        wrong(
            Append(
                "[traffic]\naxle_load_t = 20\n[inspection]\ndetectable_depth_mm = 2.0\ncritical_depth_mm = 1.0",
            ),
            14,
            "inspection.critical_depth_mm",
            "must be more than",
            "",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[inspection]\nsafety_factor = 3.0"),
            12,
            "inspection",
            "needs `detectable_depth_mm`",
            "",
        ),
        wrong(
            Append("[maintenance]\nwear_mm_per_mgt = 0.1"),
            10,
            "maintenance",
            "no axle load",
            "axle_load_t",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[maintenance]\ngrinding_mm = 0.2"),
            13,
            "maintenance.grinding_mm",
            "needs grinding_interval_mgt",
            "the tonnes between",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[maintenance]\ngrinding_interval_mgt = 0.2"),
            13,
            "maintenance.grinding_interval_mgt",
            "needs grinding_mm",
            "a depth each time",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[maintenance]\nwear_mm_per_mgt = -1"),
            13,
            "maintenance.wear_mm_per_mgt",
            "must be a number in [0, 100] mm/MGT",
            "",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[maintenance]\nstress_moves_with = \"rail\""),
            13,
            "maintenance.stress_moves_with",
            "must be \"metal\"",
            "",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[scatter]\nwear_std = 0.1"),
            13,
            "scatter.wear_std",
            "no [maintenance] gives wear",
            "a [maintenance] section",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[scatter]\nshare_log_std = 0.1"),
            13,
            "scatter.share_log_std",
            "there is one wheel",
            "[[wheel]]",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[scatter]\ntoughness_std = 1.0"),
            13,
            "scatter.toughness_std",
            "no [fracture]",
            "",
        ),
        wrong(
            Append("[traffic]\naxle_load_t = 20\n[scatter]\nsamples = 5"),
            13,
            "scatter.samples",
            "must be",
            "",
        ),
        wrong(Append("[growth]\nlaw = \"parris\""), 11, "growth.law", "must be", "\"paris\""),
        wrong(Append("[growth]\nequivalent = \"bold\""), 11, "growth.equivalent", "must be", ""),
        wrong(
            Append("[growth]\nlaw = \"bold\"\nmode_2_weight = 0.772"),
            12,
            "growth.mode_2_weight",
            "equivalent range of its own",
            "leave `mode_2_weight` out",
        ),
        wrong(
            Append("[growth]\nlaw = \"bold\"\nequivalent = \"tanaka\""),
            12,
            "growth.equivalent",
            "needs law = \"paris\" or",
            "leave `equivalent` out",
        ),
        wrong(
            Append("[growth]\nlaw = \"walker\"\nparis_c = 1e-9"),
            12,
            "growth.paris_c",
            "needs law = \"paris\" or \"paris-threshold\"",
            "constants of its own",
        ),
        wrong(
            Append("[growth]\nwalker_gamma = 0.5"),
            11,
            "growth.walker_gamma",
            "needs law = \"walker\"",
            "",
        ),
        wrong(
            Append("[growth]\nlaw = \"walker\"\nwalker_gamma = 1.5"),
            12,
            "growth.walker_gamma",
            "must be",
            "",
        ),
        wrong(Append("[growth]\nlaw = \"forman\"\nforman_kc = 0"), 12, "growth.forman_kc", "must be", ""),
        wrong(
            Append("[growth]\nlaw = \"nasgro\"\nthreshold_mpa_sqrt_m = 4.0"),
            12,
            "growth.threshold_mpa_sqrt_m",
            "needs law",
            "threshold of its own",
        ),
        wrong(
            Append("[growth]\nequivalent = \"tanaka\"\nmode_2_weight = 0.5"),
            12,
            "growth.mode_2_weight",
            "needs equivalent = \"hourlier-pineau\"",
            "",
        ),
        wrong(Append("[growth]\nlaw = \"table\""), 10, "growth.table_profile", "is missing", ""),
        wrong(
            Append("[growth]\nlaw = \"table\"\ntable_profile = \"nowhere.csv\""),
            12,
            "growth.table_profile",
            "nowhere.csv",
            "relative to the folder",
        ),
        wrong(
            Append("[growth]\nsteel = \"R260\"\nparis_m = 3.0"),
            12,
            "growth.paris_m",
            "same thing as `steel`",
            "",
        ),
        wrong(Append("[growth]\nsteel = \"R220\""), 11, "growth.steel", "must be", "R260"),
        wrong(Append("[growth]\ncritical_length_mm = 0"), 11, "growth.critical_length_mm", "must be", ""),
        wrong(Append("[growth]\nstop_after_cycles = -5"), 11, "growth.stop_after_cycles", "must be", ""),
        wrong(Append("[passage]\nstep_tolerance = 0"), 11, "passage.step_tolerance", "must be", ""),
        wrong(Append("[passage]\npassage_tolerance = 1"), 11, "passage.passage_tolerance", "must be", ""),
        wrong(Append("[mesh]\nelement_size_mm = 0.0"), 11, "mesh.element_size_mm", "must be", ""),
        wrong(
            Append("[traffic]\naxle_load_t = 0"),
            11,
            "traffic.axle_load_t",
            "must be a number in (0, 100] t",
            "",
        ),
        wrong(Append("[shakedown]\nyield_stress_mpa = 0"), 11, "shakedown.yield_stress_mpa", "must be", ""),
        wrong(Append("[shakedown]\ndang_van_a = -1"), 11, "shakedown.dang_van_a", "must be", ""),
    ]);
}

#[test]
fn integers() {
    let plain = "without a decimal point";
    check(&[
        wrong(Append("[passage]\npositions = 241.5"), 11, "passage.positions", plain, ""),
        wrong(Append("[passage]\npositions = 241.0"), 11, "passage.positions", plain, ""),
        wrong(
            Append("[passage]\npositions = 1"),
            11,
            "passage.positions",
            "must be an integer from 2 to 100000",
            "",
        ),
        wrong(Append("[passage]\npositions = 100001"), 11, "passage.positions", "must be", ""),
        wrong(Append("[passage]\nmax_passages = 0"), 11, "passage.max_passages", "must be", ""),
        wrong(
            Append("[growth]\nsteps = -1"),
            11,
            "growth.steps",
            "= -1`: must be an integer from 0 to 10000",
            "",
        ),
        wrong(Append("[growth]\nsteps = 1e3"), 11, "growth.steps", plain, ""),
        wrong(Append("[growth]\nsteps = 99999999999999999999"), 11, "growth.steps", "must be", ""),
        wrong(Append("[growth]\nsteps = \"5\""), 11, "growth.steps", "not a string", "without quotes"),
        wrong(Append("[mesh]\ninterface_elements = 7"), 11, "mesh.interface_elements", "from 8 to 400", ""),
        wrong(Append("[mesh]\ninterface_elements = 401"), 11, "mesh.interface_elements", "from 8 to 400", ""),
    ]);
}

#[test]
fn types_and_words() {
    check(&[
        wrong(Append("[rail]\nwidth_mm = \"wide\""), 11, "rail.width_mm", "not a string", "without quotes"),
        wrong(Append("[rail]\nwidth_mm = true"), 11, "rail.width_mm", "not a boolean", ""),
        wrong(Append("[rail]\nwidth_mm = [300.0]"), 11, "rail.width_mm", "not a list", ""),
        wrong(Append("[rail.width_mm]\nx = 1"), 10, "rail.width_mm", "not a table", ""),
        wrong(Append("[rail]\nwidth_mm = 2020-01-01"), 11, "rail.width_mm", "not a date", ""),
        wrong(
            Append("[solver]\nengine = 5"),
            11,
            "solver.engine",
            "must be \"xfem\" or \"dislocation\" or \"space\", not a number",
            "quotes",
        ),
        wrong(
            Append("[solver]\nengine = \"dislocations\""),
            11,
            "solver.engine",
            "must be \"xfem\" or \"dislocation\" or \"space\"",
            "nearest: \"dislocation\"",
        ),
        wrong(
            Append("[solver]\ncontact = \"Newtons\""),
            11,
            "solver.contact",
            "\"newton\" or \"latin\"",
            "nearest: \"newton\"",
        ),
        wrong(
            Append("[growth]\ndirection = \"max-k2\""),
            11,
            "growth.direction",
            "must be \"max-rate\" or",
            "nearest: \"max-k1\"",
        ),
        wrong(
            Append("[residual_stress]\nprofile = \"\""),
            11,
            "residual_stress.profile",
            "must be the name of a file",
            "",
        ),
        wrong(
            Whole(
                "title = 5\n[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0\n[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0",
            ),
            1,
            "title",
            "one line of text",
            "",
        ),
    ]);
}

#[test]
fn what_this_version_has_not() {
    check(&[
        wrong(
            Append("[rail]\nboundary = \"block\"\n[solver]\nengine = \"dislocation\""),
            13,
            "solver.engine",
            "knows the half-plane only",
            "engine = \"xfem\" computes a block",
        ),
        wrong(
            Append("[rail]\nboundary = \"block\"\nwidth_mm = 100.0\n[passage]\nto_over_a = 5.0"),
            13,
            "passage.from_over_a",
            "puts the wheel at x = -40.5 mm",
            "a wider block",
        ),
        wrong(
            Append("[rail]\nbottom = \"clamped\""),
            11,
            "rail.bottom",
            "needs boundary = \"block\"",
            "leave `bottom` out",
        ),
        wrong(
            Append("[rail]\nboundary = \"half-plane\"\nsides = \"free\""),
            12,
            "rail.sides",
            "needs boundary",
            "a half-plane has no supports",
        ),
    ]);
}

/// Size of the good contact, to be replaced.
const SIZE: &str = "peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.025\n";

#[test]
fn loads() {
    check(&[
        wrong(Replace(SIZE, "kind = \"table\"\n"), 1, "contact", "needs `profile`", ""),
        wrong(
            Replace(SIZE, "kind = \"table\"\nprofile = \"none.csv\"\n"),
            3,
            "contact.profile",
            "there is no such file",
            "relative to the folder",
        ),
        wrong(
            Replace("friction = 0.025\n", "friction = 0.025\nscale = 2.0\n"),
            5,
            "contact.scale",
            "needs kind = \"table\"",
            "leave `scale` out",
        ),
        wrong(
            Replace(SIZE, "kind = \"table\"\nprofile = \"c.csv\"\nfriction = -0.1\n"),
            4,
            "contact.friction",
            "= -0.1`: must be a number in [0, 1]",
            "the most that |q|/p may be",
        ),
        wrong(
            Replace("[contact]", "[contact]\nkind = \"carter\""),
            1,
            "contact.traction",
            "is missing: it must be a number in [-1, 1]",
            "full sliding",
        ),
        wrong(
            Replace("friction = 0.025\n", "kind = \"carter\"\ntraction = 1.5\nfriction = 0.3\n"),
            5,
            "contact.traction",
            "= 1.5`: must be a number in [-1, 1]",
            "",
        ),
        wrong(
            Replace("friction = 0.025\n", "kind = \"carter\"\ntraction = 0.5\nfriction = -0.3\n"),
            6,
            "contact.friction",
            "= -0.3`: must be a number in [0, 1]",
            "traction",
        ),
        wrong(
            Replace("friction = 0.025\n", "friction = 0.025\ntraction = 0.5\n"),
            5,
            "contact.traction",
            "needs kind = \"carter\"",
            "",
        ),
        wrong(
            Replace("half_width_mm = 6.75", "wheel_load_kn = 100.0"),
            3,
            "contact.wheel_load_kn",
            "says the same thing as `peak_pressure_mpa`",
            "either `peak_pressure_mpa` and `half_width_mm` or `wheel_load_kn`, `wheel_radius_mm` and",
        ),
        wrong(
            Replace("half_width_mm = 6.75", "half_width_mm = 6.75\nwheel_radius_mm = 460"),
            4,
            "contact.wheel_radius_mm",
            "says the same thing as `peak_pressure_mpa`",
            "",
        ),
        wrong(
            Replace(SIZE, "wheel_load_kn = 100\nwheel_radius_mm = 460\nfriction = 0.1\n"),
            1,
            "contact.rail_head_radius_mm",
            "is missing",
            "Radius of the rail head",
        ),
        wrong(
            Replace(
                SIZE,
                "wheel_load_kn = 100\nwheel_radius_mm = 460\nrail_head_radius_mm = 300\nfriction = 0.1\nlateral_mm = 9.0\n",
            ),
            6,
            "contact.lateral_mm",
            "= 9`: is outside of the contact, which reaches",
            "within the ellipse",
        ),
        wrong(
            Replace(
                SIZE,
                "wheel_load_kn = 100\nwheel_radius_mm = 460\nrail_head_radius_mm = 300\nfriction = 0.1\n\
                 wheel_profile_radius_mm = -200.0\n",
            ),
            6,
            "contact.wheel_profile_radius_mm",
            "a concave profile must be flatter than the head",
            "",
        ),
        wrong(
            Append("[track]\nsection = \"60E1\""),
            10,
            "track",
            "wheel_load_kn is missing here and in",
            "kN",
        ),
        wrong(
            Append("[track]\nwheel_load_kn = 100"),
            10,
            "track",
            "needs `section`, or `second_moment_mm4` and `neutral_axis_depth_mm`",
            "",
        ),
        wrong(
            Append("[track]\nwheel_load_kn = 100\nsection = \"61E1\""),
            12,
            "track.section",
            "must be \"60E1\"",
            "60E1",
        ),
        wrong(
            Append("[track]\nwheel_load_kn = 100\nsection = \"60E1\"\nsecond_moment_mm4 = 3e7"),
            13,
            "track.second_moment_mm4",
            "says the same thing as `section`",
            "",
        ),
        wrong(
            Append("[track]\nwheel_load_kn = 100\nsection = \"60E1\"\nfoundation_mpa = 0"),
            13,
            "track.foundation_mpa",
            "must be a number in [0.01, 1e5] MPa",
            "",
        ),
        wrong(
            Append("[track]\nsection = \"60E1\"\naxles_mm = [0.0, -1800.0]\naxle_loads_kn = [100.0]"),
            13,
            "track.axle_loads_kn",
            "1 loads of 2 axles",
            "",
        ),
        wrong(
            Append("[track]\nwheel_load_kn = 100\nsection = \"60E1\"\naxles_mm = []"),
            13,
            "track.axles_mm",
            "at least one axle",
            "",
        ),
        wrong(
            Replace("friction = 0.025\n", "friction = 0.025\nstrip_mm = 1.0\n"),
            5,
            "contact.strip_mm",
            "needs kind = \"table\"",
            "lateral_mm is the strip of an ellipse",
        ),
        wrong(
            Replace("friction = 0.025\n", "friction = 0.025\nlateral_mm = 1.0\n"),
            5,
            "contact.lateral_mm",
            "whose semi-axis across the rail is missing",
            "lateral_half_width_mm",
        ),
        wrong(
            Whole(SPACE_WITHOUT_LENGTH),
            6,
            "crack[1].surface_half_length_mm",
            "needs the half axis of the crack along the surface",
            "",
        ),
        wrong(
            Replace(
                "friction = 0.5\n",
                "friction = 0.5\nsurface_half_length_mm = 6.0\n[solver]\nengine = \"space\"\n",
            ),
            1,
            "contact.lateral_half_width_mm",
            "needs the semi-axis of the contact ellipse across the rail",
            "radii of wheel and rail",
        ),
        wrong(Whole(SPACE_AT_3), 8, "crack[1].angle_deg", "must lie between 5° and 175°", ""),
        wrong(
            Replace("friction = 0.5\n", "friction = 0.5\nstrike_deg = 30.0\n"),
            10,
            "crack[1].strike_deg",
            "takes the engine space",
            "strike_deg = 0",
        ),
        wrong(Whole(SPACE_TWICE), 14, "crack[2]", "in space are 0.000e0 mm apart", "not modelled"),
        wrong(
            Whole(SPACE_COPIES),
            12,
            "crack[1].spacing_mm",
            "must be at least 2.000e-1 mm",
            "copies counted",
        ),
        wrong(Whole(SPACE_LATIN), 14, "solver.contact", "Newton's method", "newton"),
        wrong(Whole(SPACE_TOO_WIDE), 10, "crack[1].surface_half_length_mm", "ratio 100.000", "plane engine"),
        wrong(Whole(SPACE_CARTER), 2, "contact.kind", "full sliding", "hertz"),
        wrong(Whole(SPACE_BOLD), 15, "growth.law", "no mode III", "paris"),
        wrong(
            Append("[track]\nwheel_load_kn = 100\nsecond_moment_mm4 = 3e7"),
            10,
            "track.neutral_axis_depth_mm",
            "is missing",
            "neutral axis",
        ),
        wrong(
            Append("[temperature]\nrail_c = -5\nneutral_c = 25\nexpansion_per_k = 0"),
            13,
            "temperature.expansion_per_k",
            "must be a number in (0, 0.001] 1/K",
            "",
        ),
        wrong(
            Append("[fracture]\nprofile = \"none.csv\""),
            11,
            "fracture.profile",
            "there is no such file",
            "relative to the folder",
        ),
        wrong(
            Append("[temperature]\nrail_c = -5"),
            10,
            "temperature.neutral_c",
            "is missing",
            "without force",
        ),
        wrong(
            Append("[temperature]\nrail_c = -300\nneutral_c = 25"),
            11,
            "temperature.rail_c",
            "must be a number in [-200, 200] degrees C",
            "",
        ),
        wrong(
            Append("[fracture]\n"),
            10,
            "fracture",
            "needs `toughness_mpa_sqrt_m`, or `steel`, or `profile`",
            "",
        ),
        wrong(
            Append("[fracture]\ntoughness_mpa_sqrt_m = 0"),
            11,
            "fracture.toughness_mpa_sqrt_m",
            "must be a number in [0.1, 1000]",
            "",
        ),
        wrong(
            Append("[fracture]\nsteel = \"R269\""),
            11,
            "fracture.steel",
            "must be \"R260\" or \"R350HT\"",
            "R260",
        ),
        wrong(
            Append("[fracture]\nsteel = \"R260\"\ntoughness_mpa_sqrt_m = 30"),
            12,
            "fracture.toughness_mpa_sqrt_m",
            "says the same thing as `steel`",
            "",
        ),
        wrong(
            Append("[rail]\nboundary = \"block\"\n[track]\nwheel_load_kn = 100\nsection = \"60E1\""),
            12,
            "track.foundation_mpa",
            "a block of rail.width_mm bends on its own supports",
            "half-plane",
        ),
        wrong(
            Append("[rail]\nboundary = \"block\"\n[temperature]\nrail_c = -5\nneutral_c = 25"),
            13,
            "temperature.rail_c",
            "the sides of a block would move",
            "half-plane",
        ),
        wrong(
            Append("[plastic_stress]\n[temperature]\nrail_c = -5\nneutral_c = 25"),
            12,
            "temperature.rail_c",
            "is that of the contact alone",
            "without this section",
        ),
        wrong(
            Append("[plastic_stress]\n[track]\nwheel_load_kn = 100\nfoundation_mpa = 50\nsection = \"60E1\""),
            13,
            "track.foundation_mpa",
            "is that of the contact alone",
            "without this section",
        ),
    ]);
}

#[test]
fn unknown_names() {
    check(&[
        wrong(
            Append("[rail]\nyoungs_modulus = 210e3"),
            11,
            "rail.youngs_modulus",
            "`rail.youngs_modulus = 210e3`: unknown key",
            "nearest known key: `young_modulus_mpa`",
        ),
        wrong(
            Append("[passage]\npositons = 241"),
            11,
            "passage.positons",
            "unknown key",
            "nearest known key: `positions`",
        ),
        wrong(
            Append("[rail]\nfriction = 0.5"),
            11,
            "rail.friction",
            "unknown key",
            "key of [contact] and [[crack]]",
        ),
        wrong(
            Append("[growht]\nsteps = 5"),
            10,
            "growht",
            "unknown section `growht`",
            "nearest known section: `growth`",
        ),
        wrong(
            Append("[[cracks]]\nmouth_mm = 5"),
            10,
            "cracks",
            "unknown section",
            "nearest known section: `crack`",
        ),
        wrong(
            Replace("angle_deg = 15.0", "angle_deg = 15.0\nlength = 6.0"),
            9,
            "crack[1].length",
            "`crack[1].length = 6.0`: unknown key",
            "`length_mm`",
        ),
        wrong(
            Append("[[crack]]\nmouth_mm = 30\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\nfrictoin = 1"),
            15,
            "crack[2].frictoin",
            "unknown key",
            "`friction`",
        ),
    ]);
    let top = errors(&format!("steps = 5\n{GOOD}"));
    assert_eq!(top.errors()[0].help(), Some("`steps` is a key of [growth]"));
    let top = errors(&format!("tilte = \"x\"\n{GOOD}"));
    assert!(top.to_string().contains("nearest known key: `title`, of the top of the file"), "{top}");
}

#[test]
fn sections_written_as_something_else() {
    check(&[
        wrong(Replace("[[crack]]", "[crack]"), 5, "crack", "`[crack]` must be written `[[crack]]`", ""),
        wrong(Append("[[rail]]\nwidth_mm = 300"), 10, "rail", "`[[rail]]` must be written `[rail]`", ""),
        wrong(
            Whole(
                "rail = 5\n[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0\n[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0",
            ),
            1,
            "rail",
            "`rail` must be a section `[rail]`",
            "",
        ),
        wrong(
            Whole("crack = [5]\n[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0\n"),
            1,
            "crack",
            "must be",
            "",
        ),
    ]);
}

#[test]
fn toml_that_is_none() {
    check(&[
        wrong(Append("[growth]\nsteps = 5\nsteps = 6"), 12, "steps", "`steps` is given twice", "once"),
        wrong(Append("[contact]\n"), 10, "contact", "`contact` is given twice", "once"),
        wrong(Append("[growth]\nsteps = "), 11, "", "not TOML", "toml.io"),
        wrong(Append("[growth]\nsteps = five"), 11, "", "not TOML", ""),
        wrong(Append("[growth\nsteps = 5"), 10, "", "not TOML", ""),
    ]);
}

#[test]
fn missing_and_double() {
    check(&[
        wrong(
            Whole("[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0\n"),
            6,
            "contact",
            "`[contact]` is missing",
            "railcrack init",
        ),
        wrong(
            Whole("[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0\n"),
            5,
            "crack",
            "`[[crack]]` is missing",
            "railcrack init",
        ),
        wrong(
            Whole("crack = []\n[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0\n"),
            6,
            "crack",
            "`[[crack]]` is missing",
            "",
        ),
        wrong(
            Replace("peak_pressure_mpa = 845.0\n", ""),
            1,
            "contact.peak_pressure_mpa",
            "is missing: it must be a number in",
            "Peak pressure",
        ),
        wrong(Replace("friction = 0.025\n", ""), 1, "contact.friction", "is missing", "friction coefficient"),
        wrong(
            Replace("peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\n", ""),
            1,
            "contact",
            "needs `peak_pressure_mpa` and `half_width_mm`, or `line_load_n_per_mm` and `wheel_radius_mm`",
            "",
        ),
        wrong(
            Replace("half_width_mm = 6.75", "line_load_n_per_mm = 9000"),
            3,
            "contact.line_load_n_per_mm",
            "says the same thing as `peak_pressure_mpa`",
            "either `peak_pressure_mpa` and",
        ),
        wrong(
            Replace("half_width_mm = 6.75", "half_width_mm = 6.75\nrail_radius_mm = inf"),
            4,
            "contact.rail_radius_mm",
            "says the same thing",
            "",
        ),
        wrong(
            Replace("peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75", "line_load_n_per_mm = 9000"),
            1,
            "contact.wheel_radius_mm",
            "is missing",
            "",
        ),
        wrong(Replace("angle_deg = 15.0\n", ""), 5, "crack[1].angle_deg", "is missing", ""),
        wrong(
            Replace("mouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\n", ""),
            5,
            "crack[1]",
            "needs `mouth_mm`, `length_mm` and `angle_deg`, or `points_mm`",
            "",
        ),
        wrong(
            Replace("angle_deg = 15.0", "points_mm = [[0.0, 0.0], [6.0, -1.0]]"),
            8,
            "crack[1].points_mm",
            "says the same thing as `mouth_mm`",
            "",
        ),
        wrong(
            Append("count = 3"),
            10,
            "crack[1].spacing_mm",
            "`crack[1].count = 3` needs it",
            "both or neither",
        ),
        wrong(
            Append("spacing_mm = 3"),
            10,
            "crack[1].count",
            "`crack[1].spacing_mm = 3` needs it",
            "both or neither",
        ),
        wrong(Append("count = 0\nspacing_mm = 3"), 10, "crack[1].count", "from 1 to 256", ""),
        wrong(Append("count = 3\nspacing_mm = 0"), 11, "crack[1].spacing_mm", "must be", ""),
        wrong(Append("[residual_stress]"), 10, "residual_stress.profile", "is missing", ""),
        wrong(Append("[traffic]"), 10, "traffic.axle_load_t", "is missing", ""),
        wrong(
            Append("[passage]\nfrom_over_a = 6"),
            10,
            "passage.to_over_a",
            "must differ from from_over_a",
            "-x",
        ),
        wrong(
            Append("[passage]\nfrom_over_a = 2\nto_over_a = 2.0"),
            12,
            "passage.to_over_a",
            "must differ",
            "",
        ),
    ]);
    let empty = errors("");
    let keys: Vec<_> = empty.errors().iter().filter_map(|e| e.key()).collect();
    assert_eq!(keys, ["contact", "crack"]);
    assert_eq!(empty.errors()[0].position(), Some((1, 1)));
}

/// A crack by points in place of the straight one.
const STRAIGHT: &str = "mouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0";

#[test]
fn lists_of_numbers() {
    let key = "output.fields_over_a";
    let accepted = "must be a list of at most 100 numbers in [-1000, 1000] a";
    check(&[
        wrong(Append("[output]\nfields_over_a = 1.0"), 11, key, "not a number", "in brackets"),
        wrong(Append("[output]\nfields_over_a = \"all\""), 11, key, accepted, ""),
        wrong(
            Append("[output]\nfields_over_a = [0, 1, 2e3]"),
            11,
            key,
            "entry 3 must be a number in [-1000, 1000]",
            "",
        ),
        wrong(Append("[output]\nfields_over_a = [nan]"), 11, key, "entry 1 must be a number", ""),
        wrong(Append("[output]\nfields_over_a = [\n  0.0,\n  \"1\"]"), 13, key, "entry 2 must be", ""),
        wrong(
            Append("[output]\nfaces = \"some\""),
            11,
            "output.faces",
            "\"all\" or \"ends\" or \"none\" or true or false",
            "nearest",
        ),
        wrong(Append("[output]\nsif = 1"), 11, "output.sif", "must be \"all\"", "quotes"),
        wrong(
            Append("[output]\nplots = \"yes\""),
            11,
            "output.plots",
            "must be true or false, not a string",
            "without quotes",
        ),
        wrong(Append("[output]\nreport = 0"), 11, "output.report", "must be true or false, not a number", ""),
        wrong(
            Append("[output]\nfields = [true, false]"),
            11,
            "output.fields",
            "must be true or false, not a list",
            "",
        ),
        wrong(
            Append("[output]\nrun_folders = false"),
            11,
            "output.run_folders",
            "only a study",
            "railcrack sweep",
        ),
        wrong(Append("[output]\nfields_every = -1"), 11, "output.fields_every", "from 0 to 10000", ""),
    ]);
    let many = format!("{GOOD}[output]\nfields_over_a = [{}]", "0, ".repeat(101));
    assert!(errors(&many).to_string().contains("101 given"));
}

#[test]
fn impossible_cracks() {
    let points = |points: &'static str| Replace(STRAIGHT, points);
    let key = "crack[1].points_mm";
    check(&[
        wrong(points("points_mm = 5"), 6, key, "not a number", ""),
        wrong(points("points_mm = [[0, 0]]"), 6, key, "at least two points", ""),
        wrong(points("points_mm = [[0, 0],\n [1, -1, 3]]"), 7, key, "point 2 must be two numbers", ""),
        wrong(points("points_mm = [[0, 0],\n [1, nan]]"), 7, key, "point 2 must be two numbers", ""),
        wrong(points("points_mm = [[0, 0],\n [\"1\", -1]]"), 7, key, "point 2 must be two numbers", ""),
        wrong(points("points_mm = [[0, 0.1], [1, -1]]"), 6, key, "above the surface", "y points up"),
        wrong(points("points_mm = [[0, 0],\n[1, -1],\n[2, 0]]"), 8, key, "on the surface", "y points up"),
        wrong(points("points_mm = [[0, 0],\n[1, 1]]"), 7, key, "above the surface", "y points up"),
        wrong(points("points_mm = [[0, 0],\n[1, -1],\n[1, -1]]"), 8, key, "coincide", ""),
        wrong(
            points("points_mm = [[0, 0],\n[4, -4],\n[4, -2],\n[0, -3]]"),
            9,
            key,
            "must not cross itself",
            "",
        ),
        wrong(points("points_mm = [[0, 0],\n[4, -4],\n[2, -2]]"), 8, key, "must not cross itself", ""),
    ]);
}

#[test]
fn cracks_that_meet_or_leave_the_rail() {
    const CROSSING: &str = "[[crack]]\nmouth_mm = 2.0\nlength_mm = 6.0\nangle_deg = 165.0\nfriction = 0.5";
    const SAME: &str = "[[crack]]\nmouth_mm = 0.0\nlength_mm = 3.0\nangle_deg = 90.0\nfriction = 0.5";
    const TOUCHING: &str = "[[crack]]\npoints_mm = [[3.0, 0.0], [3.0, -2.0]]\nfriction = 0.5";
    check(&[
        wrong(
            Append(CROSSING),
            10,
            "crack[2]",
            "`crack[1]` and `crack[2]` cross, touch or overlap",
            "must not meet",
        ),
        wrong(Append(SAME), 10, "crack[2]", "cross, touch or overlap", ""),
        wrong(Append(TOUCHING), 10, "crack[2]", "cross, touch or overlap", ""),
        wrong(
            Both(
                STRAIGHT,
                "points_mm = [[0.0, 0.0], [4.0, -2.0], [4.0, -0.5]]",
                "count = 3\nspacing_mm = 1.0",
            ),
            9,
            "crack[1].spacing_mm",
            "its copies cross",
            "",
        ),
        wrong(
            Append(
                "count = 50\nspacing_mm = 1.0\n[[crack]]\nmouth_mm = -99.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\ncount = 207\nspacing_mm = 0.4",
            ),
            17,
            "crack[2]",
            "more than 256 cracks",
            "",
        ),
        wrong(
            Append("[rail]\nwidth_mm = 10.0"),
            6,
            "crack[1].mouth_mm",
            "leaves the rail at x = 5.79",
            "centre_mm",
        ),
        wrong(
            Append("[rail]\ncentre_mm = 1000"),
            6,
            "crack[1].mouth_mm",
            "the rail reaches from 850 to 1150 mm",
            "",
        ),
        wrong(
            Append("[rail]\ndepth_mm = 1.5"),
            7,
            "crack[1].length_mm",
            "leaves the rail at depth",
            "depth_mm",
        ),
        wrong(
            Append("[rail]\nwidth_mm = 5.0"),
            7,
            "crack[1].length_mm",
            "6 mm is longer than the rail, width_mm = 5",
            "",
        ),
        wrong(
            Append("[rail]\nwidth_mm = 1e-300"),
            7,
            "crack[1].length_mm",
            "longer than the rail, width_mm = 1e-300",
            "",
        ),
        wrong(
            Replace("length_mm = 6.0", "length_mm = 301"),
            7,
            "crack[1].length_mm",
            "longer than the rail",
            "",
        ),
        wrong(
            Replace(STRAIGHT, "points_mm = [[0, 0], [200, -10]]"),
            6,
            "crack[1].points_mm",
            "leaves the rail at x = 200",
            "",
        ),
        wrong(
            Both("mouth_mm = 0.0", "mouth_mm = 0", "count = 3\nspacing_mm = 5\n[rail]\nwidth_mm = 20"),
            6,
            "crack[1].mouth_mm",
            "leaves the rail at x = 15.79",
            "",
        ),
    ]);
}

#[test]
fn derived_contact_out_of_range() {
    check(&[wrong(
        Replace(
            "peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75",
            "line_load_n_per_mm = 1e7\nwheel_radius_mm = 460",
        ),
        2,
        "contact.line_load_n_per_mm",
        "gives peak_pressure_mpa",
        "together",
    )]);
}

#[test]
fn only_inf_is_infinity() {
    let text = |radius: &str| {
        let load = format!("line_load_n_per_mm = 9000\nwheel_radius_mm = 460\nrail_radius_mm = {radius}");
        GOOD.replace("peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75", &load)
    };
    assert!(Case::parse(&text("inf"), "case.toml", Path::new("")).is_ok());
    for radius in ["1e400", "nan", "-inf", "0", "-300"] {
        let errors = errors(&text(radius));
        assert_eq!(errors.errors()[0].key(), Some("contact.rail_radius_mm"), "{errors}");
        assert!(errors.to_string().contains("must be a number in (0, inf] mm"), "{errors}");
    }
}

#[test]
fn missing_profile() {
    check(&[
        wrong(
            Append("[residual_stress]\nprofile = \"none.csv\""),
            11,
            "residual_stress.profile",
            "there is no such file",
            "relative to the folder",
        ),
        wrong(
            Append("[plastic_stress]\nfield = \"none.vtu\""),
            11,
            "plastic_stress.field",
            "there is no such file",
            "relative to the folder of the case file",
        ),
        wrong(
            Append("[plastic_stress]\nprofile = \"none.csv\""),
            11,
            "plastic_stress.profile",
            "there is no such file",
            "relative to the folder of the case file",
        ),
        wrong(
            Append("[shakedown]\ninitial_residual = \"none.csv\""),
            11,
            "shakedown.initial_residual",
            "there is no such file",
            "",
        ),
    ]);
}

#[test]
fn all_errors_at_once() {
    let text = "[rail]\nwidth_mm = -1\nfoo = 1\n[contact]\npeak_pressure_mpa = nan\n[[crack]]\nlength_mm = 0\n\
                [growth]\nsteps = 1.0\n[solver]\nengine = \"fem\"\n";
    let keys: Vec<String> =
        errors(text).errors().iter().filter_map(|e| e.key().map(str::to_string)).collect();
    let want = [
        "rail.width_mm",
        "rail.foo",
        "contact.half_width_mm",
        "contact.friction",
        "contact.peak_pressure_mpa",
        "crack[1].mouth_mm",
        "crack[1].angle_deg",
        "crack[1].friction",
        "crack[1].length_mm",
        "growth.steps",
        "solver.engine",
    ];
    assert_eq!(keys, want);
}

#[test]
fn one_line_names_file_line_and_column() {
    let errors = errors(&format!("{GOOD}[growth]\nsteps = -1\n"));
    assert_eq!(errors.to_string(), "case.toml:11:9: `growth.steps = -1`: must be an integer from 0 to 10000");
}

#[test]
fn the_good_case_is_good() {
    let case = Case::parse(GOOD, "case.toml", Path::new("")).unwrap();
    assert_eq!(case.cracks.cracks().len(), 1);
}

/// A mix of wheels, of which one thing is wrong.
#[test]
fn wheels_that_make_no_mix() {
    let crack = "[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\n";
    let contact = "contact = { peak_pressure_mpa = 845, half_width_mm = 6.75, friction = 0.1 }";
    let mix = |second: &str| {
        format!("{crack}[[wheel]]\nshare = 0.5\naxle_load_t = 20\n{contact}\n[[wheel]]\n{second}\n")
    };
    for (second, key, says) in [
        (format!("share = 0.4\naxle_load_t = 20\n{contact}"), "wheel[2].share", "add up to 0.9"),
        (format!("share = 0.5\n{contact}"), "wheel[2].axle_load_t", "is missing"),
        ("share = 0.5\naxle_load_t = 20".to_owned(), "wheel[2].contact", "is missing"),
        (format!("axle_load_t = 20\n{contact}"), "wheel[2].share", "is missing"),
        (
            "share = 0.5\naxle_load_t = 20\n[wheel.contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6\nfriction = 2.0"
                .to_owned(),
            "wheel[2].contact.friction",
            "must be",
        ),
        (format!("share = 0.5\naxle_load_t = 20\nspeed = 3\n{contact}"), "wheel[2].speed", "unknown key"),
    ] {
        let errors = Case::parse(&mix(&second), "case.toml", Path::new("")).unwrap_err();
        let text = errors.to_string();
        assert!(text.contains(key) && text.contains(says), "{second}\n{text}");
    }
}

#[test]
fn fluid() {
    check(&[
        wrong(Append("[fluid]\nleak = true"), 10, "fluid.model", "`fluid.model` is missing", ""),
        wrong(Append("[fluid]\nmodel = \"wet\""), 11, "fluid.model", "\"trapped\"", ""),
        wrong(
            Append("[fluid]\nmodel = \"trapped\"\nbulk_modulus_mpa = -2200"),
            12,
            "fluid.bulk_modulus_mpa",
            "must be a number in (0, inf] MPa",
            "",
        ),
        wrong(
            Append("[fluid]\nmodel = \"mouth\"\npressure_cap_mpa = -1"),
            12,
            "fluid.pressure_cap_mpa",
            "must be a number in (0, inf] MPa",
            "",
        ),
        wrong(
            Append("[fluid]\nmodel = \"trapped\"\npressure_cap_mpa = 300"),
            12,
            "fluid.pressure_cap_mpa",
            "needs model = \"mouth\"",
            "limited by its volume",
        ),
        wrong(Append("[fluid]\nmodel = \"trapped\"\nleak = 1"), 12, "fluid.leak", "true or false", ""),
        wrong(
            Append("[fluid]\nmodel = \"mouth\"\nleak = false"),
            12,
            "fluid.leak",
            "needs model = \"trapped\"",
            "over the mouth",
        ),
        wrong(
            Append("[fluid]\nmodel = \"mouth\"\ncracks = [2]"),
            12,
            "fluid.cracks",
            "no crack 2; the case has 1",
            "",
        ),
        wrong(
            Append(
                "[[crack]]\npoints_mm = [[20.0, -3.0], [24.0, -4.0]]\nfriction = 0.5\n[fluid]\nmodel = \"mouth\"",
            ),
            14,
            "fluid.model",
            "crack 2 is buried and has no mouth",
            "names those with fluid",
        ),
    ]);
}
