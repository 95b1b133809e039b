//! `[traffic]` and `[[wheel]]`: the load that passes.

use super::contact::{CONTACT, ContactExtent};
use super::fluid::{DRY, FLUID, MODEL};
use super::track::{TEMPERATURE, TRACK};
use crate::schema::{
    Off, Section, choice, closed, file, integer, number, read_by_word, section, text, within,
};
use railcrack::load::Travel;
use railcrack::rolling::{CreepageSign, RollingTheory};

section! {
    TRAFFIC "traffic", Optional,
        "Traffic, for results in million gross tonnes (MGT).";
    AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 17.0,
        "Axle load. Required, unless every [[wheel]] has its own.").optional();
    MGT_PER_YEAR: f64 = number("mgt_per_year", "MGT", closed(1e-6, 1e4), 20.0,
        "Traffic of a year; results are then also in months.").optional();
}

/// `[wheel.contact]`.
pub(crate) const WHEEL_CONTACT: Section =
    Section { name: "wheel.contact", instead: Some("table"), ..CONTACT };
/// `[wheel.track]`.
pub(crate) const WHEEL_TRACK: Section = Section { name: "wheel.track", ..TRACK };
/// `[wheel.temperature]`.
pub(crate) const WHEEL_TEMPERATURE: Section = Section { name: "wheel.temperature", ..TEMPERATURE };
/// `[wheel.fluid]`, or `fluid = false`.
pub(crate) const WHEEL_FLUID: Section =
    Section { name: "wheel.fluid", off: Some(Off { key: MODEL.key.name, choice: DRY }), ..FLUID };

read_by_word!(Travel);

section! {
    WHEEL "wheel", Several,
        "A wheel of a traffic mix, instead of [contact]; growth rates are summed by the shares of the axles.",
        forms [[SHARE],
            [TABLE, TABLE_SIGN, TABLE_THEORY, TABLE_EXTENT, REPRESENTATIVES, REPRESENTATIVES_ERROR, PLACE, PLACE_WINDOW]],
        parts [WHEEL_CONTACT, WHEEL_TRACK, WHEEL_TEMPERATURE, WHEEL_FLUID];
    WHEEL_NAME: String = text("name", "freight, loaded", "Name shown in reports.").optional();
    SHARE: f64 = number("share", "", closed(1e-9, 1.0), 0.7, "Fraction of all axles; the shares add up to 1.")
        .required();
    WHEEL_AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 22.5,
        "Axle load for the count of tonnes; by default that of [traffic].").optional();
    DIRECTION: Travel = choice("direction", "Direction of travel, by default that of [passage]; in the other one the passage is mirrored, but not the sign of friction.")
        .optional();
    TABLE: String = file("table", "inputs/wheels", "curve.csv",
        "CSV file with a row per wheel and patch: wheel, normal_kn, y_rail_mm (on the axis of lateral_mm of the cracks), creepage_x, creepage_y, spin_per_mm, mu, and a_mm, b_mm or rail_radius_mm, wheel_radius_mm; optionally place_m, patch, share, axle_load_t, angle_deg, x_mm, wheel_profile_radius_mm.")
        .required();
    TABLE_SIGN: CreepageSign = choice("creepage_sign", "Sign convention of creepages and spin.").required();
    TABLE_THEORY: RollingTheory = choice("theory", "Theory of the shear.");
    TABLE_EXTENT: ContactExtent = choice("lateral",
        "Part of the patches that loads cracks in the plane: by default the patch, in a block the strip.").optional();
    REPRESENTATIVES: usize = integer("representatives", (1, 30), 30,
        "Largest number of computed wheels; more are grouped, and one of each group is computed.");
    REPRESENTATIVES_ERROR: f64 = number("representatives_error", "", closed(1e-6, 1.0), 0.01,
        "Error of the mean growth rate by the representatives above which there is a warning.");
    PLACE: f64 = number("place_m", "m", within(1e7), 0.0,
        "Place along the track: only wheels at this place pass, with shares among them; by default all wheels.").optional();
    PLACE_WINDOW: f64 = number("place_window_m", "m", closed(1e-3, 1e7), 1.0, "Length of track around place_m that counts as this place.");
}
