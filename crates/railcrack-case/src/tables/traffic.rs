//! `[traffic]` and `[[wheel]]`: the load that passes.

use super::contact::CONTACT;
use super::track::{TEMPERATURE, TRACK};
use crate::schema::{Section, closed, number, section, text};

section! {
    TRAFFIC "traffic", Optional,
        "Traffic. With this section, cycles are also given in million gross tonnes, and growth.csv has the columns depth_mm and mgt.";
    AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 17.0, "Axle load; one passage is one axle.")
        .required();
}

/// `[wheel.contact]`.
pub(crate) const WHEEL_CONTACT: Section = Section { name: "wheel.contact", instead: None, ..CONTACT };
/// `[wheel.track]`.
pub(crate) const WHEEL_TRACK: Section = Section { name: "wheel.track", ..TRACK };
/// `[wheel.temperature]`.
pub(crate) const WHEEL_TEMPERATURE: Section = Section { name: "wheel.temperature", ..TEMPERATURE };

section! {
    WHEEL "wheel", Several,
        "A wheel of a traffic mix, replacing [contact]; growth rates are summed in proportion to the shares of the axles.",
        parts [WHEEL_CONTACT, WHEEL_TRACK, WHEEL_TEMPERATURE];
    WHEEL_NAME: String = text("name", "freight, loaded", "Name shown in reports.").optional();
    SHARE: f64 = number("share", "", closed(1e-9, 1.0), 0.7, "Fraction of all axles; the shares of all wheels must add up to 1.")
        .required();
    WHEEL_AXLE_LOAD: f64 = number("axle_load_t", "t", closed(1e-3, 100.0), 22.5,
        "Load of one of its axles, used to count million gross tonnes; by default that of [traffic].").optional();
}
