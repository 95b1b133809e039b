//! `[traffic]` and `[[wheel]]`: the load that passes.

use super::contact::CONTACT;
use super::track::{TEMPERATURE, TRACK};
use crate::schema::{Section, number, positive, section, text};

section! {
    TRAFFIC "traffic", Optional,
        "Traffic: with it, cycles are also given in million gross tonnes, and growth.csv has depth_mm and mgt.";
    AXLE_LOAD: f64 = number("axle_load_t", "t", positive(100.0), 17.0, "Load of one axle; one passage is one axle.")
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
        "A wheel of a mix of traffic, instead of [contact]: rates of growth add by the shares of the axles.",
        parts [WHEEL_CONTACT, WHEEL_TRACK, WHEEL_TEMPERATURE];
    WHEEL_NAME: String = text("name", "freight, loaded", "Name in reports.").optional();
    SHARE: f64 = number("share", "", positive(1.0), 0.7, "Share of the axles; the shares of all wheels add up to 1.")
        .required();
    WHEEL_AXLE_LOAD: f64 = number("axle_load_t", "t", positive(100.0), 22.5,
        "Load of one of its axles, for million gross tonnes; without it, that of [traffic].").optional();
}
