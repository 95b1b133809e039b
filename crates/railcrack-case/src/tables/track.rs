//! `[track]` and `[temperature]`: the rail as a beam, and as a rod that cannot lengthen.

use super::contact::WHEEL_LOAD;
use crate::schema::{
    Choice, Report, SectionValues, Word, choice, closed, number, numbers, read_by_word, section, within,
};
use railcrack::load::{Axle, NamedSection, RailSection, Temperature, Track};

section! {
    TRACK "track", Optional,
        "Bending of the rail on its foundation under the passing axles.",
        forms [[RAIL_SECTION], [SECOND_MOMENT, NEUTRAL_AXIS_DEPTH]];
    TRACK_LOAD: f64 = number("wheel_load_kn", "kN", closed(1e-3, 1e4), 100.0,
        "Wheel load on this rail; by default that of [contact].").optional();
    FOUNDATION: f64 = number("foundation_mpa", "MPa", closed(1e-2, 1e5), 50.0,
        "Foundation modulus k, N/mm per mm of deflection of one rail.");
    RAIL_SECTION: SectionName = choice("section", "Rail section.").required();
    SECOND_MOMENT: f64 = number("second_moment_mm4", "mm^4", closed(1e3, 1e10), 3.0383e7,
        "Second moment of area about the horizontal axis.").required();
    NEUTRAL_AXIS_DEPTH: f64 = number("neutral_axis_depth_mm", "mm", closed(1.0, 1e4), 91.05,
        "Depth of the neutral axis below the running surface.").required();
    AXLES: Vec<f64> = numbers("axles_mm", "mm", within(1e6), &[0.0],
        "Positions of its own and other axles along +x, relative to this wheel.");
    AXLE_LOADS: Vec<f64> = numbers("axle_loads_kn", "kN", closed(1e-3, 1e4), &[100.0],
        "Wheel load of each axle; by default wheel_load_kn.").optional();
}

section! {
    TEMPERATURE "temperature", Optional, "Temperature of a rail that is restrained lengthwise, in tension below neutral_c.",
        forms [[RAIL_TEMPERATURE], [SEASONS, SEASON_SHARES]];
    RAIL_TEMPERATURE: f64 = number("rail_c", "degrees C", within(200.0), -5.0, "Temperature of the rail.").required();
    SEASONS: Vec<f64> = numbers("seasons_c", "degrees C", within(200.0), &[35.0, 15.0, -5.0],
        "Temperatures of the rail over the year; each wheel passes at each of them, as a mix, with the toughness at that temperature.")
        .required();
    SEASON_SHARES: Vec<f64> = numbers("season_shares", "", closed(1e-9, 1.0), &[0.3, 0.6, 0.1],
        "Shares of the axles at seasons_c; their sum is 1.").required();
    NEUTRAL_TEMPERATURE: f64 = number("neutral_c", "degrees C", within(200.0), 25.0,
        "Neutral temperature, at which there is no longitudinal force.").required();
    EXPANSION: f64 = number("expansion_per_k", "1/K", closed(1e-9, 1e-3), Temperature::RAIL_STEEL_EXPANSION,
        "Coefficient of thermal expansion.");
}

read_by_word!(SectionName);

/// The rail sections that are known by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SectionName {
    E60,
    E54,
    E49,
}

const OLD_NAME: &str = "older name";

impl Choice for SectionName {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::E60, Word::now("60E1", "60 kg/m")),
        (Self::E54, Word::now("54E1", "54 kg/m")),
        (Self::E49, Word::now("49E1", "49 kg/m")),
        (Self::E60, Word::now("UIC60", OLD_NAME)),
        (Self::E54, Word::now("UIC54", OLD_NAME)),
        (Self::E49, Word::now("S49", OLD_NAME)),
    ];
}

/// The track; `contact` gives the load of the wheel where the track does not.
pub(crate) fn read_track(
    section: &SectionValues,
    contact: Option<&SectionValues>,
    report: &mut Report,
) -> Option<Track> {
    let load = section.get(TRACK_LOAD).or_else(|| contact?.get(WHEEL_LOAD));
    let axles = section.get(AXLES)?;
    let loads = section.get(AXLE_LOADS);
    if axles.is_empty() {
        return report.refuse(section.fault(AXLES, "at least one axle, that of this wheel: [0.0]"));
    }
    if let Some(loads) = &loads
        && loads.len() != axles.len()
    {
        let says = format!("{} loads of {} axles; one of each", loads.len(), axles.len());
        return report.refuse(section.fault(AXLE_LOADS, says));
    }
    if load.is_none() && loads.is_none() {
        if !section.is_refused(TRACK_LOAD) && !section.is_refused(AXLE_LOADS) {
            let says = "wheel_load_kn is missing here and in `[contact]`";
            report.add(section.fault_of_all(says).help("the load of a wheel on this rail, in kN"));
        }
        return None;
    }
    let of = |i: usize| loads.as_ref().map_or(load, |loads| loads.get(i).copied()).unwrap_or(0.0);
    let axles: Vec<Axle> =
        axles.iter().enumerate().map(|(i, &at)| Axle { at, wheel_load: 1e3 * of(i) }).collect();
    let track = Track { section: read_section(section)?, foundation: section.get(FOUNDATION)?, axles };
    track.check().map_err(|error| report.add(section.fault_of_all(error))).ok()?;
    Some(track)
}

fn read_section(section: &SectionValues) -> Option<RailSection> {
    if let (Some(second_moment), Some(neutral_axis_depth)) =
        (section.get(SECOND_MOMENT), section.get(NEUTRAL_AXIS_DEPTH))
    {
        return Some(RailSection { second_moment, neutral_axis_depth, height: None });
    }
    Some(NamedSection::of(section.get(RAIL_SECTION)?.word())?.section())
}

/// The temperature; of seasons that of the first one.
pub(crate) fn read_temperature(section: &SectionValues, report: &mut Report) -> Option<Temperature> {
    let rail = section.get(RAIL_TEMPERATURE).or_else(|| section.get(SEASONS)?.first().copied());
    let temperature = Temperature {
        rail: rail?,
        neutral: section.get(NEUTRAL_TEMPERATURE)?,
        expansion: section.get(EXPANSION)?,
    };
    temperature.check().map_err(|error| report.add(section.fault_of_all(error))).ok()?;
    Some(temperature)
}

/// Shares whose sum differs from 1 by less add up to 1: they were rounded to six digits.
const SUM: f64 = 1e-6;

/// The temperatures (degrees C) of the seasons of `section` with their shares of the axles, each
/// once; empty where it has one temperature. None after a fault in `report`.
pub(crate) fn read_seasons(section: &SectionValues, report: &mut Report) -> Option<Vec<(f64, f64)>> {
    let (Some(given), Some(shares)) = (section.get(SEASONS), section.get(SEASON_SHARES)) else {
        return Some(Vec::new());
    };
    let sum: f64 = shares.iter().sum();
    let says = match given.len() == shares.len() {
        false => format!("{} shares of {} temperatures; one of each", shares.len(), given.len()),
        true if (sum - 1.0).abs() > SUM => format!("the shares add up to {sum}; they must add up to 1"),
        true => {
            let mut seasons: Vec<(f64, f64)> = Vec::new();
            for (rail, share) in given.into_iter().zip(shares) {
                match seasons.iter_mut().find(|(other, _)| *other == rail) {
                    Some((_, known)) => *known += share,
                    None => seasons.push((rail, share)),
                }
            }
            return Some(seasons);
        }
    };
    report.refuse(section.fault(SEASON_SHARES, says))
}
