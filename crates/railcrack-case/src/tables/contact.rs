//! `[contact]`: wheel on rail.

use crate::schema::{
    Availability, Choice, Kind, Report, Row, SectionValues, Word, choice, closed, number, positive,
    read_by_word, section,
};
use railcrack::load::HertzianContact;
use railcrack::material::IsotropicElastic;

section! {
    CONTACT "contact", Required, "Wheel on rail: fully sliding line contact; one passage is one axle.",
        forms [[PEAK_PRESSURE, HALF_WIDTH], [LINE_LOAD, WHEEL_RADIUS, RAIL_RADIUS]];
    KIND: ContactKind = choice("kind", "Description of the contact.");
    PEAK_PRESSURE: f64 = number("peak_pressure_mpa", "MPa", closed(1e-3, 1e4), 845.0, "Peak pressure p0.").required();
    HALF_WIDTH: f64 =
        number("half_width_mm", "mm", closed(0.01, 100.0), 6.75,
            "Half-width a of the contact; below 0.01 mm it is smaller than the roughness of a rail.").required();
    LINE_LOAD: f64 =
        number("line_load_n_per_mm", "N/mm", closed(1e-5, 1e7), 8959.4, "Wheel load per width.").required();
    WHEEL_RADIUS: f64 = number("wheel_radius_mm", "mm", closed(1e-2, 1e5), 460.9, "Radius of the wheel.").required();
    RAIL_RADIUS: f64 = number("rail_radius_mm", "mm", positive(f64::INFINITY), f64::INFINITY,
        "Radius of the rail in the plane of the model; inf is flat.");
    FRICTION: f64 = number("friction", "", closed(-1.0, 1.0), 0.025,
        "Wheel-rail friction coefficient; > 0 drags the rail along +x (a braking wheel running towards +x).")
        .required();
}

read_by_word!(ContactKind);

/// Descriptions of the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ContactKind {
    Hertz,
}

impl Choice for ContactKind {
    const WORDS: &'static [(Self, Word)] = &[(
        Self::Hertz,
        Word::now("hertz", "pressure p0 sqrt(1 - (x - xc)^2 / a^2) and a shear proportional to it"),
    )];

    const LATER: &'static [Word] = &[Word {
        name: "table",
        doc: "measured pressure and shear",
        availability: Availability::Later {
            reason: "measured contact tables are not part of this version",
            instead: "describe the contact with kind = \"hertz\"",
        },
    }];
}

/// The contact, of peak pressure and half-width, or of a line load and radii on a rail of `steel`.
pub(crate) fn read_contact(
    section: &SectionValues,
    steel: &IsotropicElastic,
    report: &mut Report,
) -> Option<HertzianContact> {
    let ContactKind::Hertz = section.get(KIND)?;
    let friction = section.get(FRICTION)?;
    if let (Some(peak_pressure), Some(half_width)) = (section.get(PEAK_PRESSURE), section.get(HALF_WIDTH)) {
        return Some(HertzianContact { peak_pressure, half_width, friction });
    }
    let line_load = section.get(LINE_LOAD)?;
    let (wheel, rail) = (section.get(WHEEL_RADIUS)?, section.get(RAIL_RADIUS)?);
    let contact = HertzianContact::from_line_load(line_load, wheel, rail, steel, friction);
    let refusal = match &contact {
        Ok(contact) => out_of_range(PEAK_PRESSURE, contact.peak_pressure)
            .or_else(|| out_of_range(HALF_WIDTH, contact.half_width)),
        Err(error) => Some(error.to_string()),
    };
    if let Some(says) = refusal {
        let help = "line load and radii together give the peak pressure and the half-width";
        report.add(section.fault(LINE_LOAD, says).help(help));
        return None;
    }
    contact.ok()
}

/// Why a value that follows from others is not one that could have been given.
fn out_of_range(row: Row<f64>, value: f64) -> Option<String> {
    match row.key.kind {
        Kind::Number { range, .. } if !range.contains(value) => {
            Some(format!("gives {} = {value:.4}, which must be in {range}", row.key.name))
        }
        _ => None,
    }
}
