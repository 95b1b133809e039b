//! `[traffic]` and `[[wheel]]`: the load that passes.

use super::contact::CONTACT;
use super::fluid::{DRY, FLUID, MODEL};
use super::track::{TEMPERATURE, TRACK};
use crate::schema::{
    Off, Section, choice, closed, file, integer, number, read_by_word, section, text, within,
};
use railcrack::load::Travel;
use railcrack::rolling::{CreepageSign, RollingTheory};

section! {
    TRAFFIC "traffic", Optional,
        "Traffic. With this section, cycles are also given in million gross tonnes, and growth.csv has the columns depth_mm and mgt.";
    AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 17.0,
        "Axle load; one passage is one axle. Required, unless every [[wheel]] has its own.").optional();
    MGT_PER_YEAR: f64 = number("mgt_per_year", "MGT", closed(1e-6, 1e4), 20.0,
        "Traffic of a year, million gross tonnes: results are then also given in months.").optional();
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
        "A wheel of a traffic mix, replacing [contact]; growth rates are summed in proportion to the shares of the axles.",
        forms [[SHARE],
            [TABLE, TABLE_SIGN, TABLE_THEORY, REPRESENTATIVES, REPRESENTATIVES_ERROR, PLACE, PLACE_WINDOW]],
        parts [WHEEL_CONTACT, WHEEL_TRACK, WHEEL_TEMPERATURE, WHEEL_FLUID];
    WHEEL_NAME: String = text("name", "freight, loaded", "Name shown in reports.").optional();
    SHARE: f64 = number("share", "", closed(1e-9, 1.0), 0.7, "Fraction of all axles; the shares of all wheels must add up to 1.")
        .required();
    WHEEL_AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 22.5,
        "Load of one of its axles, used to count million gross tonnes; by default that of [traffic].").optional();
    DIRECTION: Travel = choice("direction", "Direction of travel, by default that of [passage]. A wheel that runs the other way starts as far before the mouth that it meets first, and ends as far behind the last one. The sign of its friction remains that of the shear on the rail along +x.")
        .optional();
    TABLE: String = file("table", "inputs/wheels", "curve.csv",
        "CSV file with a row per wheel and patch, instead of share and contact: wheel, normal_kn, y_rail_mm, creepage_x, creepage_y, spin_per_mm, mu, and a_mm, b_mm or rail_radius_mm, wheel_radius_mm; optional are place_m, patch, share, axle_load_t, angle_deg, x_mm, wheel_profile_radius_mm. Each wheel loads the cracks by its patches, at their places beside lateral_mm of the cracks.")
        .required();
    TABLE_SIGN: CreepageSign = choice("creepage_sign", "Convention for the signs of creepages and spin of the table.").required();
    TABLE_THEORY: RollingTheory = choice("theory", "Theory of the shear of its patches.");
    REPRESENTATIVES: usize = integer("representatives", (1, 30), 30,
        "Largest number of wheels that are computed; more wheels are grouped, and each group is represented by one of its wheels.");
    REPRESENTATIVES_ERROR: f64 = number("representatives_error", "", closed(1e-6, 1.0), 0.01,
        "Accepted error of the mean growth rate by the representatives; a larger one is a warning.");
    PLACE: f64 = number("place_m", "m", within(1e7), 0.0,
        "Place along the track: only wheels of the table at this place pass, and their shares are those among them. All wheels if not given.").optional();
    PLACE_WINDOW: f64 = number("place_window_m", "m", closed(1e-3, 1e7), 1.0, "Length of track around place_m from which wheels are taken.");
}
