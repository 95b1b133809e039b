//! The usual ranges of all quantities that a user types.

use super::usual::Usual;

const WHEELS: &str = "EN 13715: wheels of 330 to 1250 mm in diameter";
const LOADS: &str = "axle loads of 5 t (empty) to 45 t (ore lines), dynamic factor up to 1.3";
const HERTZ: &str = "Hertz contact of these loads and radii";
const RADII: &str = "rail heads of EN 13674-1 (13, 80, 300 mm) and worn or conformal ones";
const FRICTION: &str = "docs/parameters.md: 0.1 with a modifier to 0.6 dry";
const STEEL: &str = "steel at track temperatures";
const DEPTHS: &str = "from the smallest depth that is measured to the height of a rail";
const GROWTH_TESTS: &str = "da/dN tests of steels; docs/parameters.md";

/// A row of the table.
const fn usual(
    quantity: &'static str,
    (keys, columns): (&'static [&'static str], &'static [&'static str]),
    unit: &'static str,
    range: (f64, f64),
    source: &'static str,
) -> Usual {
    Usual { quantity, keys, columns, unit, range, source }
}

/// The usual ranges.
pub const USUAL: &[Usual] = &[
    usual("the peak pressure", (&["contact.peak_pressure_mpa"], &["p_mpa"]), "MPa", (50.0, 4000.0), HERTZ),
    usual(
        "the half-width of a contact",
        (
            &["contact.half_width_mm", "contact.lateral_half_width_mm", "contact.semi_axes_mm"],
            &["a_mm", "b_mm", "u_mm"],
        ),
        "mm",
        (0.3, 30.0),
        HERTZ,
    ),
    usual("the load per width", (&["contact.line_load_n_per_mm"], &[]), "N/mm", (100.0, 1e5), HERTZ),
    usual(
        "the radius of a wheel",
        (&["contact.wheel_radius_mm"], &["wheel_radius_mm"]),
        "mm",
        (150.0, 700.0),
        WHEELS,
    ),
    usual(
        "the radius of a profile",
        (
            &["contact.rail_radius_mm", "contact.rail_head_radius_mm", "contact.wheel_profile_radius_mm"],
            &["rail_radius_mm", "wheel_profile_radius_mm"],
        ),
        "mm",
        (5.0, 1e6),
        RADII,
    ),
    usual(
        "the load of a wheel",
        (
            &["contact.wheel_load_kn", "contact.normal_kn", "track.wheel_load_kn", "track.axle_loads_kn"],
            &["normal_kn"],
        ),
        "kN",
        (1.0, 300.0),
        LOADS,
    ),
    usual(
        "friction under a wheel",
        (&["contact.friction", "contact.lateral_friction"], &["mu"]),
        "",
        (1e-3, 0.8),
        FRICTION,
    ),
    usual(
        "creepage",
        (&["contact.creepage_x", "contact.creepage_y"], &["creepage_x", "creepage_y"]),
        "",
        (0.0, 0.05),
        "creepage is a fraction of the speed; sharp curves reach 0.02",
    ),
    usual(
        "spin",
        (&["contact.spin_per_mm"], &["spin_per_mm"]),
        "1/mm",
        (0.0, 1.0 / 150.0),
        "at most 1 over the radius of the wheel, which is compared too",
    ),
    usual(
        "the angle of attack",
        (&["contact.yaw_deg"], &[]),
        "degrees",
        (0.0, 5.0),
        "curves of 100 m and more",
    ),
    usual(
        "the roll of a wheel",
        (&["contact.roll_deg"], &[]),
        "degrees",
        (0.0, 5.0),
        "a wheelset 40 mm to the side",
    ),
    usual(
        "the foundation modulus",
        (&["track.foundation_mpa"], &[]),
        "MPa",
        (2.0, 500.0),
        "soft ballast to slab track, per rail",
    ),
    usual(
        "the second moment of a rail",
        (&["track.second_moment_mm4"], &[]),
        "mm^4",
        (2e6, 6e7),
        "EN 13674-1: 46E1 1.6e7, 60E1 3.04e7; light rails",
    ),
    usual(
        "the depth of the neutral axis",
        (&["track.neutral_axis_depth_mm"], &[]),
        "mm",
        (40.0, 130.0),
        "EN 13674-1: 46E1 to 60E2",
    ),
    usual(
        "the distance of two axles",
        (&["track.axles_mm"], &[]),
        "mm",
        (500.0, 1e6),
        "bogies of 1.5 to 3 m; a train of 1 km",
    ),
    usual(
        "the temperature of a rail",
        (&["temperature.rail_c", "temperature.seasons_c"], &[]),
        "degrees C",
        (0.0, 75.0),
        STEEL,
    ),
    usual(
        "the neutral temperature",
        (&["temperature.neutral_c"], &[]),
        "degrees C",
        (0.0, 50.0),
        "laid at 15 to 45 degrees C",
    ),
    usual("thermal expansion", (&["temperature.expansion_per_k"], &[]), "1/K", (1e-5, 1.4e-5), STEEL),
    usual("Young's modulus", (&["rail.young_modulus_mpa"], &[]), "MPa", (1.8e5, 2.3e5), STEEL),
    usual("Poisson's ratio", (&["rail.poisson_ratio"], &[]), "", (0.25, 0.33), STEEL),
    usual(
        "the depth of a rail",
        (&["rail.depth_mm"], &[]),
        "mm",
        (20.0, 250.0),
        "EN 13674-1: 145 to 172 mm; test blocks",
    ),
    usual("the width of a block", (&["rail.width_mm"], &[]), "mm", (20.0, 1e5), "test rigs"),
    usual(
        "the length of a crack",
        (&["crack.length_mm", "crack.depth_mm", "crack.surface_half_length_mm"], &["length_mm"]),
        "mm",
        (0.05, 200.0),
        "grains of rail steel to the height of a rail",
    ),
    usual(
        "the angle of a crack",
        (&["crack.angle_deg"], &[]),
        "degrees",
        (2.0, 178.0),
        "head checks 15 to 35 degrees, transverse cracks 90",
    ),
    usual(
        "the distance of cracks",
        (&["crack.spacing_mm"], &[]),
        "mm",
        (0.2, 1000.0),
        "docs/parameters.md, T17: 0.5 to 7 mm; squats",
    ),
    usual(
        "friction between crack faces",
        (&["crack.friction", "growth.kink_friction"], &[]),
        "",
        (1e-3, 1.0),
        "0.1 to 0.5; docs/parameters.md",
    ),
    usual(
        "a pressure of fluid",
        (&["fluid.pressure_cap_mpa"], &[]),
        "MPa",
        (1.0, 4000.0),
        "at most that of the contact",
    ),
    usual(
        "the bulk modulus of a fluid",
        (&["fluid.bulk_modulus_mpa"], &[]),
        "MPa",
        (100.0, 5000.0),
        "water 2200, grease 1500, with air less",
    ),
    usual(
        "the yield stress",
        (&["shakedown.yield_stress_mpa", "shakedown.dang_van_b_mpa"], &[]),
        "MPa",
        (100.0, 1500.0),
        "rail steels of 350 to 1000 MPa",
    ),
    usual(
        "the hardening modulus",
        (&["shakedown.hardening_modulus_mpa"], &[]),
        "MPa",
        (500.0, 2e5),
        "below Young's modulus",
    ),
    usual(
        "a threshold of the range of K",
        (&["growth.threshold_mpa_sqrt_m", "growth.threshold_2_mpa_sqrt_m", "growth.nasgro_threshold"], &[]),
        "MPa sqrt(m)",
        (0.5, 20.0),
        GROWTH_TESTS,
    ),
    usual(
        "the exponent of a growth law",
        (&["growth.paris_m", "growth.walker_m", "growth.forman_m", "growth.nasgro_n"], &[]),
        "",
        (1.5, 7.0),
        GROWTH_TESTS,
    ),
    usual(
        "a toughness",
        (
            &["fracture.toughness_mpa_sqrt_m", "growth.forman_kc", "growth.nasgro_kc"],
            &["toughness_mpa_sqrt_m"],
        ),
        "MPa sqrt(m)",
        (10.0, 200.0),
        "EN 13674-1: 26 to 40 MPa sqrt(m); steels",
    ),
    usual(
        "the weight of a mode",
        (&["growth.mode_2_weight", "growth.mode_3_weight"], &[]),
        "",
        (0.1, 10.0),
        GROWTH_TESTS,
    ),
    usual(
        "the depth to which a path is straight",
        (&["growth.straight_to_mm"], &[]),
        "mm",
        (0.05, 50.0),
        "measured paths of head checks: 2 to 3 mm",
    ),
    usual(
        "the length over which a path turns",
        (&["growth.turning_length_mm"], &[]),
        "mm",
        (0.01, 50.0),
        "docs/parameters.md",
    ),
    usual(
        "a critical size",
        (
            &["growth.critical_length_mm", "inspection.critical_depth_mm", "inspection.ultrasonic_depth_mm"],
            &[],
        ),
        "mm",
        (0.2, 250.0),
        DEPTHS,
    ),
    usual(
        "a size that inspections find",
        (
            &[
                "inspection.detectable_depth_mm",
                "inspection.detectable_length_mm",
                "inspection.pod_median_mm",
            ],
            &["depth_mm"],
        ),
        "mm",
        (0.05, 150.0),
        DEPTHS,
    ),
    usual("a safety factor", (&["inspection.safety_factor"], &[]), "", (1.0, 20.0), "2 to 5"),
    usual(
        "the load of an axle",
        (&["traffic.axle_load_t", "wheel.axle_load_t"], &["axle_load_t"]),
        "t",
        (3.0, 45.0),
        LOADS,
    ),
    usual(
        "traffic of a year",
        (&["traffic.mgt_per_year"], &[]),
        "MGT",
        (0.01, 400.0),
        "branch lines to ore lines",
    ),
    usual(
        "wear",
        (&["maintenance.wear_mm_per_mgt"], &[]),
        "mm/MGT",
        (1e-5, 0.3),
        "0.001 on straight track to 0.1 at the gauge face of sharp curves",
    ),
    usual(
        "the depth of a grinding",
        (&["maintenance.grinding_mm"], &[]),
        "mm",
        (0.01, 5.0),
        "0.1 to 0.5 mm by grinding, 1 to 5 mm by milling",
    ),
    usual(
        "traffic between grindings",
        (&["maintenance.grinding_interval_mgt", "maintenance.first_grinding_mgt"], &[]),
        "MGT",
        (1e-3, 500.0),
        "5 to 60 MGT",
    ),
    usual(
        "the thickness of a spall",
        (&["maintenance.least_spall_mm"], &[]),
        "mm",
        (0.01, 20.0),
        "flakes of 0.1 mm to shells of 10 mm",
    ),
    usual(
        "the limit of wear",
        (&["maintenance.wear_limit_mm"], &[]),
        "mm",
        (0.5, 40.0),
        "8 to 20 mm by class of line",
    ),
    usual("a pop-in", (&["fracture.pop_in_mm"], &[]), "mm", (0.05, 20.0), "docs/theory.md"),
    usual(
        "a residual stress",
        (&[], &["sxx_mpa", "szz_mpa"]),
        "MPa",
        (1.0, 1500.0),
        "up to the yield stress of worked layers",
    ),
    usual("the depth of a stress profile", (&[], &["depth_mm of stresses"]), "mm", (0.2, 250.0), DEPTHS),
];

/// Keys whose numbers have no usual range: places, shares, numbers of the model, tolerances and
/// standard deviations.
pub const ANY: &[&str] = &[
    "contact.lateral_mm",
    "contact.scale",
    "contact.strip_mm",
    "contact.traction",
    "contact.profile_smoothing_mm",
    "contact.shift_mm",
    "contact.coupled_within_over_a",
    "crack.mouth_mm",
    "crack.points_mm",
    "crack.lateral_mm",
    "crack.strike_deg",
    "crack.length_sd_mm",
    "crack.angle_sd_deg",
    "crack.spacing_sd_mm",
    "fluid.cracks",
    "growth.increment",
    "growth.tolerance",
    "growth.kink_angle_deg",
    "growth.arrest_rate_mm_per_cycle",
    "growth.stop_after_cycles",
    // Compared with the rates of rail steel.
    "growth.paris_c",
    "growth.bold_c",
    "growth.walker_c",
    "growth.forman_c",
    "growth.nasgro_c",
    "growth.walker_gamma",
    "growth.nasgro_p",
    "growth.nasgro_q",
    "growth.nasgro_alpha",
    "growth.nasgro_s",
    "inspection.target_risk",
    "inspection.pod_log_std",
    "scatter.paris_c_log_std",
    "scatter.paris_m_std",
    "scatter.toughness_std",
    "scatter.detectable_depth_std",
    "scatter.wear_std",
    "scatter.share_log_std",
    "mesh.element_size_mm",
    "mesh.tip_enrichment_radius_mm",
    "mesh.interface_spacing_mm",
    "output.fields_over_a",
    "passage.from_over_a",
    "passage.to_over_a",
    "passage.passage_tolerance",
    "passage.step_tolerance",
    "passage.network_tolerance",
    "rail.centre_mm",
    "shakedown.dang_van_a",
    "temperature.season_shares",
    "wheel.share",
    "wheel.representatives_error",
    "wheel.place_m",
    "wheel.place_window_m",
];

/// The range of a key, `section.key`.
pub(super) fn of_key(key: &str) -> Option<&'static Usual> {
    USUAL.iter().find(|usual| usual.keys.contains(&key))
}

/// The range of a column.
pub(super) fn of_column(column: &str) -> Option<&'static Usual> {
    USUAL.iter().find(|usual| usual.columns.contains(&column))
}
