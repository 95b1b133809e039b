//! `[fluid]`: water in the cracks.

use crate::schema::{
    Choice, Preset, Report, SectionValues, Word, choice, closed, number, numbers, read_by_word, section,
    switch,
};
use railcrack::contact::{CrackFluid, FluidModel, PressureProfile};
use railcrack::crack::CrackNetwork;

const MOUTH: &str = "mouth";
const TRAPPED: &str = "trapped";
/// The model of dry cracks.
pub(super) const DRY: &str = "none";

section! {
    FLUID "fluid", Optional, "Pressure of water or grease in the cracks.";
    MODEL: FluidKind = choice("model", "Model of the fluid pressure.").required();
    PRESSURE_PROFILE: PressureProfile = choice("profile", "Pressure at the distance s from the mouth; l is the crack length.")
        .only_with(MODEL, MOUTH, "a trapped fluid has one pressure");
    PRESSURE_CAP: f64 = number("pressure_cap_mpa", "MPa", closed(1e-3, f64::INFINITY), f64::INFINITY,
        "Upper limit of the pressure; inf lets it lift the flap above a shallow crack off the rail. Not under a coupled wheel.")
        .only_with(MODEL, MOUTH, "a trapped fluid is limited by its volume");
    BULK_MODULUS: f64 = number("bulk_modulus_mpa", "MPa", closed(10.0, f64::INFINITY), f64::INFINITY,
        "Bulk modulus B of the fluid, V = V0 exp(-p/B): 2200 for water, inf if incompressible.")
        .only_with(MODEL, TRAPPED, "the pressure equals that over the mouth");
    LEAK: bool = switch("leak", Preset::Switch(true),
        "Whether fluid above the pressure over the mouth leaks out once no closed faces block its path.")
        .only_with(MODEL, TRAPPED, "the pressure equals that over the mouth");
    WET_CRACKS: Vec<f64> = numbers("cracks", "", closed(1.0, 1e4), &[1.0],
        "Numbers of the cracks with fluid, from 1 and including copies; by default all. Joined cracks share it.")
        .optional();
}

read_by_word!(FluidKind, PressureProfile);

/// Models of the fluid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FluidKind {
    None,
    Mouth,
    Trapped,
}

impl Choice for FluidKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::None, Word::now(DRY, "dry cracks, for studies")),
        (Self::Mouth, Word::now(MOUTH, "the contact pressure over the mouth acts inside the crack")),
        (
            Self::Trapped,
            Word::now(TRAPPED, "the fluid in the crack is enclosed while the contact covers its mouth"),
        ),
    ];
}

/// The fluid in the cracks of `network`, if any; `None` if there is an error, which is added to
/// `report`.
#[expect(clippy::option_option, reason = "dry cracks, and a section with errors")]
pub(crate) fn read_fluid(
    section: &SectionValues,
    network: &CrackNetwork,
    report: &mut Report,
) -> Option<Option<CrackFluid>> {
    let count = network.cracks().len();
    let cracks = section.get(WET_CRACKS);
    let wrong = cracks.iter().flatten().find(|number| number.fract() != 0.0 || **number > count as f64);
    if let Some(number) = wrong {
        let says = format!("no crack {number}; the case has {count}, numbered from 1 with copies counted");
        return report.refuse(section.fault(WET_CRACKS, says));
    }
    let cracks: Option<Vec<usize>> =
        cracks.map(|numbers| numbers.into_iter().map(|number| number as usize - 1).collect());
    let wet = |crack: &usize| cracks.as_ref().is_none_or(|wet| wet.contains(crack));
    let model = match section.get(MODEL)? {
        FluidKind::None => return Some(None),
        FluidKind::Mouth => {
            let buried = |crack: &usize| !network.cracks()[*crack].is_surface_breaking();
            if let Some(crack) = (0..count).filter(wet).find(buried) {
                let says = format!(
                    "\"mouth\": crack {} is buried and has no mouth through which pressure could enter",
                    crack + 1
                );
                let help = "cracks = [\u{2026}] lists the cracks that contain fluid";
                return report.refuse(section.fault(MODEL, says).help(help));
            }
            FluidModel::Mouth { cap: section.get(PRESSURE_CAP)? }
        }
        FluidKind::Trapped => {
            FluidModel::Trapped { bulk_modulus: section.get(BULK_MODULUS)?, leak: section.get(LEAK)? }
        }
    };
    let profile = section.get(PRESSURE_PROFILE).unwrap_or_default();
    Some(Some(CrackFluid { model, profile, cracks }))
}
