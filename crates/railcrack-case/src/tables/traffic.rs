//! `[traffic]` and `[[wheel]]`: the load that passes.

use super::contact::CONTACT;
use super::fluid::{DRY, FLUID, MODEL};
use super::track::{TEMPERATURE, TRACK};
use crate::schema::{Off, Section, choice, closed, number, read_by_word, section, text};
use railcrack::load::Travel;

section! {
    TRAFFIC "traffic", Optional,
        "Traffic. With this section, cycles are also given in million gross tonnes, and growth.csv has the columns depth_mm and mgt.";
    AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 17.0, "Axle load; one passage is one axle.")
        .required();
    MGT_PER_YEAR: f64 = number("mgt_per_year", "MGT", closed(1e-6, 1e4), 20.0,
        "Traffic of a year, million gross tonnes: results are then also given in months.").optional();
}

/// `[wheel.contact]`.
pub(crate) const WHEEL_CONTACT: Section = Section { name: "wheel.contact", instead: None, ..CONTACT };
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
        parts [WHEEL_CONTACT, WHEEL_TRACK, WHEEL_TEMPERATURE, WHEEL_FLUID];
    WHEEL_NAME: String = text("name", "freight, loaded", "Name shown in reports.").optional();
    SHARE: f64 = number("share", "", closed(1e-9, 1.0), 0.7, "Fraction of all axles; the shares of all wheels must add up to 1.")
        .required();
    WHEEL_AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 22.5,
        "Load of one of its axles, used to count million gross tonnes; by default that of [traffic].").optional();
    DIRECTION: Travel = choice("direction", "Direction of travel, by default that of [passage]. A wheel that runs the other way starts as far before the mouth that it meets first, and ends as far behind the last one. The sign of its friction remains that of the shear on the rail along +x.")
        .optional();
}
