//! `[temperature] seasons_c`: every wheel at each temperature of the rail.

use super::traffic_wheel::TrafficWheel;
use crate::schema::{Report, SectionValues, Sections, short};
use crate::tables::{SEASONS, TABLE, TEMPERATURE, WHEEL, WHEEL_TEMPERATURE, read_seasons};
use railcrack::growth::MOST_WHEELS;
use railcrack::load::Temperature;

/// A wheel for each of `passing` and each season, whose share is the product of theirs: the
/// wheels in their first seasons, then the others. None after a fault in `report`.
pub(super) fn over_seasons(
    passing: Vec<TrafficWheel>,
    sections: &Sections,
    report: &mut Report,
) -> Option<Vec<TrafficWheel>> {
    let (tables, wheels): (Vec<_>, Vec<_>) =
        sections.all(&WHEEL).partition(|wheel| wheel.get(TABLE).is_some());
    let of_case = sections.one(&TEMPERATURE);
    let own = |wheel: &SectionValues| sections.part(wheel, &WHEEL_TEMPERATURE).or(of_case);
    let at_seasons = |section: &&SectionValues| section.get(SEASONS).is_some();
    if let Some(section) = tables.into_iter().filter_map(own).find(at_seasons) {
        let says = "are several temperatures, and the wheels of a table pass at one";
        return report
            .refuse(section.fault(SEASONS, says).help("use rail_c, or wheels with sections of their own"));
    }
    let given = if wheels.is_empty() { vec![of_case] } else { wheels.into_iter().map(own).collect() };
    if !given.iter().flatten().any(at_seasons) {
        return Some(passing);
    }
    let (mut first, mut others) = (Vec::new(), Vec::new());
    let mut places = given.iter().copied();
    for wheel in passing {
        let seasons = match places.next().flatten() {
            Some(section) => read_seasons(section, report)?,
            None => Vec::new(),
        };
        let mut all = seasons.iter().map(|season| in_season(&wheel, *season, seasons.len()));
        first.push(all.next().unwrap_or_else(|| wheel.clone()));
        others.extend(all);
    }
    first.extend(others);
    if first.len() > MOST_WHEELS {
        let section = given.into_iter().flatten().find(at_seasons)?;
        let says = format!("make a mix of {} wheels; the limit is {MOST_WHEELS}", first.len());
        return report.refuse(section.fault(SEASONS, says));
    }
    Some(first)
}

/// The `wheel` in one of `count` seasons, with its temperature (degrees C) and share.
fn in_season(wheel: &TrafficWheel, (rail, share): (f64, f64), count: usize) -> TrafficWheel {
    let mut own = wheel.clone();
    own.wheel.temperature = wheel.wheel.temperature.map(|other| Temperature { rail, ..other });
    if count > 1 {
        own.share *= share;
        own.name = format!("{}, {} \u{b0}C", wheel.name, short(rail));
    }
    own
}
