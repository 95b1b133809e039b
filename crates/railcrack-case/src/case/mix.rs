//! A mix of wheels: shares of the axles, and the load of each.

use super::read_wheel::ReadWheel;
use super::wheel_table::WheelTable;
use super::wheels_of_table::{TableContext, read_wheels_of_table};
use crate::files::Companion;
use crate::schema::{Fault, Report, SectionValues, Sections};
use crate::tables::{
    AXLE_LOAD, CONTACT, ContactExtent, DIRECTION, GivenWheel, PASSAGE, SHARE, TABLE, TEMPERATURE, TRACK,
    TRAFFIC, WHEEL, WHEEL_AXLE_LOAD, WHEEL_CONTACT, WHEEL_FLUID, WHEEL_NAME, WHEEL_TEMPERATURE, WHEEL_TRACK,
    WheelSections, read_travel,
};
use railcrack::contact::CrackFluid;
use railcrack::crack::CrackNetwork;
use railcrack::fatigue::GrowthLaw;
use railcrack::growth::{MOST_WHEELS, PassageSettings};
use railcrack::material::IsotropicElastic;
use std::path::Path;

/// A wheel of a mix.
#[derive(Debug, Clone, PartialEq)]
pub struct MixedWheel {
    /// Its name in reports.
    pub name: String,
    /// Share of the axles.
    pub share: f64,
    /// Load of one of its axles, t.
    pub axle_load: Option<f64>,
    /// Contact, track, temperature.
    pub wheel: GivenWheel,
    /// Fluid in the cracks while it passes, if any.
    pub fluid: Option<CrackFluid>,
    /// Its passages, in its direction of travel: positions are measured in its own half-width.
    pub passages: PassageSettings,
}

/// Shares whose sum differs from 1 by less add up to 1: they were rounded to six digits.
const SUM: f64 = 1e-6;

/// The wheels of `[[wheel]]`, shares adding up to 1; none if there are none or there is an error,
/// which is added to `report`. Track, temperature, fluid and direction of the case apply to every
/// wheel that does not define its own. `extent` selects the part of the contacts that is read.
pub(super) fn read_mix(
    sections: &Sections,
    steel: Option<&IsotropicElastic>,
    extent: ContactExtent,
    cracks: (Option<&CrackNetwork>, Option<&GrowthLaw>),
    folder: &Path,
    report: &mut Report,
) -> Option<(Vec<ReadWheel>, Option<WheelTable>)> {
    let given: Vec<&SectionValues> = sections.all(&WHEEL).collect();
    let last = given.last()?;
    if let Some(contact) = sections.one(&CONTACT) {
        let says = "says the same thing as `[[wheel]]`, whose wheels define their own contacts: give one or the other";
        report.add(contact.fault_of_all(says));
    }
    if given.len() > MOST_WHEELS {
        let says = format!("is wheel {} of a mix; the limit is {MOST_WHEELS}", given.len());
        report.add(last.fault(SHARE, says));
        return None;
    }
    let travel = sections.one(&PASSAGE).and_then(read_travel)?;
    let traffic = sections.one(&TRAFFIC).and_then(|traffic| traffic.get(AXLE_LOAD));
    let (tables, single): (Vec<_>, Vec<_>) =
        given.iter().copied().enumerate().partition(|(_, wheel)| wheel.get(TABLE).is_some());
    if let Some((_, second)) = tables.get(1) {
        let says = "is the second table of a mix, which takes one";
        report.add(second.fault(TABLE, says).help("one table holds all wheels"));
        return None;
    }
    let read = |(i, given): &(usize, &SectionValues)| {
        let travel = given.get(DIRECTION).unwrap_or(travel);
        let of_wheel = WheelSections {
            contact: sections.part(given, &WHEEL_CONTACT)?,
            track: sections.part(given, &WHEEL_TRACK).or_else(|| sections.one(&TRACK)),
            temperature: sections.part(given, &WHEEL_TEMPERATURE).or_else(|| sections.one(&TEMPERATURE)),
            extent,
        };
        let wheel = GivenWheel::read(of_wheel, steel?, travel, folder, report)?;
        let given = *given;
        Some(ReadWheel {
            name: given.get(WHEEL_NAME).unwrap_or_else(|| format!("wheel {}", i + 1)),
            share: given.get(SHARE)?,
            axle_load: given.get(WHEEL_AXLE_LOAD).or(traffic),
            wheel,
            travel,
            fluid: sections.part(given, &WHEEL_FLUID).cloned(),
        })
    };
    // All of them, so that all errors are found at once.
    let wheels: Vec<Option<ReadWheel>> = single.iter().map(read).collect();
    let mut wheels: Vec<ReadWheel> = wheels.into_iter().collect::<Option<_>>()?;
    let mut table = None;
    if let Some((_, given)) = tables.first() {
        let others: f64 = wheels.iter().map(|wheel| wheel.share).sum();
        if others >= 1.0 {
            let says = format!("the other wheels have {others} of all axles and leave none for the table");
            report.add(given.fault(TABLE, says));
            return None;
        }
        let context = TableContext {
            sections,
            steel: steel?,
            travel: given.get(DIRECTION).unwrap_or(travel),
            network: cracks.0?,
            law: cracks.1?,
            share: 1.0 - others,
            axle_load: given.get(WHEEL_AXLE_LOAD).or(traffic),
            first: wheels.len(),
            folder,
            extent,
        };
        let (read, used) = read_wheels_of_table(given, &context, report)?;
        wheels.extend(read);
        table = Some(used);
        if wheels.len() > MOST_WHEELS {
            let says =
                format!("has {} wheels with the others of the mix; the limit is {MOST_WHEELS}", wheels.len());
            report.add(given.fault(TABLE, says).help("use fewer representatives"));
            return None;
        }
    }
    let sum: f64 = wheels.iter().map(|wheel| wheel.share).sum();
    if table.is_none() && (sum - 1.0).abs() > SUM {
        let says = format!("the shares of all wheels add up to {sum}; they must add up to 1");
        report.add(
            last.fault(SHARE, says).help("shares are fractions of the number of axles, not of the tonnes"),
        );
        return None;
    }
    check_axle_loads(&given, &wheels, report)?;
    check_files(&given, &wheels, report)?;
    Some((wheels, table))
}

/// Million gross tonnes need the load of every axle.
fn check_axle_loads(given: &[&SectionValues], wheels: &[ReadWheel], report: &mut Report) -> Option<()> {
    let without = wheels.iter().position(|wheel| wheel.axle_load.is_none());
    let (Some(without), true) = (without, wheels.iter().any(|wheel| wheel.axle_load.is_some())) else {
        return Some(());
    };
    let section = given[without.min(given.len() - 1)];
    let dotted = section.dotted(WHEEL_AXLE_LOAD.key.name);
    let message = format!(
        "`{dotted}` is missing: other wheels have it, and counting tonnes requires the load of every axle"
    );
    let help =
        "give axle_load_t to every wheel or to none; [traffic] axle_load_t applies to wheels without one";
    report.add(Fault::of(dotted, section.span.clone(), message).help(help));
    None
}

/// Traffic is counted in tonnes: `[traffic]` needs the axle load that no wheel gives.
pub(super) fn require_axle_load(traffic: &SectionValues, report: &mut Report) {
    if traffic.is_refused(AXLE_LOAD) {
        return;
    }
    let dotted = traffic.dotted(AXLE_LOAD.key.name);
    let message = format!("`{dotted}` is missing: it must be {}", AXLE_LOAD.key.kind.accepted());
    let help = "add axle_load_t to [traffic], or to every [[wheel]]";
    report.add(Fault::of(dotted, traffic.span.clone(), message).help(help));
}

/// A stored case keeps one file of a contact.
fn check_files(given: &[&SectionValues], wheels: &[ReadWheel], report: &mut Report) -> Option<()> {
    let all = wheels.iter().map(|wheel| wheel.wheel.companions()).enumerate();
    let named: Vec<(usize, Vec<Companion<'_>>)> = all.filter(|(_, files)| !files.is_empty()).collect();
    let Some(&(other, _)) = named.iter().find(|(_, files)| *files != named[0].1) else { return Some(()) };
    let says = "all contact tables of a mix must be the same file, with different scales where wheels differ, and so must its profiles";
    report.add(given[other].fault_of_all(says).help("use kind = \"hertz\" or \"carter\" for the others"));
    None
}
