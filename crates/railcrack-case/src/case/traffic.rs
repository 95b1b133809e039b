//! The wheels that pass: the one of `[contact]`, or those of `[[wheel]]` with their shares of the
//! axles.

use super::seasons::over_seasons;
use super::traffic_wheel::{TrafficContext, TrafficWheel};
use super::wheel_table::WheelTable;
use super::wheels_of_table::{TableContext, read_wheels_of_table};
use crate::files::Companion;
use crate::schema::{Fault, Report, SectionValues, Sections};
use crate::tables::{
    AXLE_LOAD, CONTACT, DIRECTION, FLUID, GivenWheel, PASSAGE, SHARE, TABLE, TEMPERATURE, TRACK, TRAFFIC,
    WHEEL, WHEEL_AXLE_LOAD, WHEEL_CONTACT, WHEEL_FLUID, WHEEL_NAME, WHEEL_TEMPERATURE, WHEEL_TRACK,
    WheelSections, check_passage, read_passages, read_travel,
};
use railcrack::contact::CrackFluid;
use railcrack::growth::MOST_WHEELS;
use railcrack::load::Travel;

/// The wheels of a case, at least one.
pub(super) struct Traffic {
    /// All of them, those of a table last.
    pub wheels: Vec<TrafficWheel>,
    /// The table, where there is one.
    pub table: Option<WheelTable>,
}

/// The wheels; none if there is an error, which is added to `report`. Track, temperature, fluid and
/// direction of the case apply to every wheel that does not define its own.
pub(super) fn read_traffic(context: TrafficContext<'_>, report: &mut Report) -> Option<Traffic> {
    let sections = context.sections;
    let fluid = context.fluid(sections.one(&FLUID), report);
    let traffic = match sections.all(&WHEEL).next() {
        Some(_) => read_mix(context, fluid.as_ref(), report),
        None => read_single(context, fluid, report),
    };
    let moves = sections.one(&PASSAGE).is_some_and(|passage| check_passage(passage, report));
    let traffic = traffic.filter(|_| moves)?;
    let wheels = over_seasons(traffic.wheels, sections, report)?;
    Some(Traffic { wheels, ..traffic })
}

/// The wheel of `[contact]`.
#[expect(clippy::option_option, reason = "dry cracks, and a section with errors")]
fn read_single(
    context: TrafficContext<'_>,
    fluid: Option<Option<CrackFluid>>,
    report: &mut Report,
) -> Option<Traffic> {
    let TrafficContext { sections, steel, network, extent, folder } = context;
    let passage = sections.one(&PASSAGE)?;
    let travel = read_travel(passage)?;
    let of_wheel = WheelSections {
        contact: sections.one(&CONTACT)?,
        track: sections.one(&TRACK),
        temperature: sections.one(&TEMPERATURE),
        extent,
    };
    let wheel = GivenWheel::read(of_wheel, steel?, travel, folder, report)?;
    let passages = read_passages(passage, wheel.half_width(), travel, network?)?;
    let axle_load = sections.one(&TRAFFIC).and_then(|traffic| traffic.get(AXLE_LOAD));
    let wheel =
        TrafficWheel { name: "wheel 1".to_owned(), share: 1.0, axle_load, wheel, fluid: fluid?, passages };
    Some(Traffic { wheels: vec![wheel], table: None })
}

/// Shares whose sum differs from 1 by less add up to 1: they were rounded to six digits.
const SUM: f64 = 1e-6;

/// The wheels of `[[wheel]]`, shares adding up to 1.
fn read_mix(
    context: TrafficContext<'_>,
    fluid: Option<&Option<CrackFluid>>,
    report: &mut Report,
) -> Option<Traffic> {
    let sections = context.sections;
    let given: Vec<&SectionValues> = sections.all(&WHEEL).collect();
    let last = given.last()?;
    if let Some(contact) = sections.one(&CONTACT) {
        let says = "says the same thing as `[[wheel]]`, whose wheels define their own contacts: give one or the other";
        report.add(contact.fault_of_all(says));
    }
    if given.len() > MOST_WHEELS {
        let says = format!("is wheel {} of a mix; the limit is {MOST_WHEELS}", given.len());
        return report.refuse(last.fault(SHARE, says));
    }
    let travel = sections.one(&PASSAGE).and_then(read_travel)?;
    let (tables, single): (Vec<_>, Vec<_>) =
        given.iter().copied().enumerate().partition(|(_, wheel)| wheel.get(TABLE).is_some());
    if let Some((_, second)) = tables.get(1) {
        let says = "is the second table of a mix, which takes one";
        return report.refuse(second.fault(TABLE, says).help("one table holds all wheels"));
    }
    // All of them, so that all errors are found at once.
    let wheels: Vec<Option<TrafficWheel>> =
        single.iter().map(|(i, given)| read_wheel(context, (*i, given), travel, fluid, report)).collect();
    let mut wheels: Vec<TrafficWheel> = wheels.into_iter().collect::<Option<_>>()?;
    let mut table = None;
    if let Some((_, given)) = tables.first() {
        let others: f64 = wheels.iter().map(|wheel| wheel.share).sum();
        if others >= 1.0 {
            let says = format!("the other wheels have {others} of all axles and leave none for the table");
            return report.refuse(given.fault(TABLE, says));
        }
        let table_context = TableContext {
            of_traffic: context,
            travel: given.get(DIRECTION).unwrap_or(travel),
            share: 1.0 - others,
            axle_load: axle_load(sections, given),
            first: wheels.len(),
            fluid: own_fluid(context, given, fluid, report)?,
        };
        let (read, used) = read_wheels_of_table(given, table_context, report)?;
        wheels.extend(read);
        let computed = used.computed_wheels(&wheels);
        table = Some(used);
        if computed > MOST_WHEELS {
            let says =
                format!("has {computed} wheels with the others of the mix; the limit is {MOST_WHEELS}");
            return report.refuse(given.fault(TABLE, says).help("use fewer representatives"));
        }
    }
    if table.is_none() {
        check_shares(last, &wheels, report)?;
    }
    check_axle_loads(&given, &wheels, report)?;
    check_files(&given, &wheels, report)?;
    Some(Traffic { wheels, table })
}

/// The shares of `wheels`, of which `last` is the last section, must add up to 1.
fn check_shares(last: &SectionValues, wheels: &[TrafficWheel], report: &mut Report) -> Option<()> {
    let sum: f64 = wheels.iter().map(|wheel| wheel.share).sum();
    if (sum - 1.0).abs() <= SUM {
        return Some(());
    }
    let says = format!("the shares of all wheels add up to {sum}; they must add up to 1");
    report.refuse(
        last.fault(SHARE, says).help("shares are fractions of the number of axles, not of the tonnes"),
    )
}

/// The wheel of the `given` section, from 0, that is no table.
fn read_wheel(
    context: TrafficContext<'_>,
    (number, given): (usize, &SectionValues),
    travel: Travel,
    fluid: Option<&Option<CrackFluid>>,
    report: &mut Report,
) -> Option<TrafficWheel> {
    let TrafficContext { sections, steel, network, extent, folder } = context;
    let travel = given.get(DIRECTION).unwrap_or(travel);
    let of_wheel = WheelSections {
        contact: sections.part(given, &WHEEL_CONTACT)?,
        track: sections.part(given, &WHEEL_TRACK).or_else(|| sections.one(&TRACK)),
        temperature: sections.part(given, &WHEEL_TEMPERATURE).or_else(|| sections.one(&TEMPERATURE)),
        extent,
    };
    let wheel = GivenWheel::read(of_wheel, steel?, travel, folder, report);
    let fluid = own_fluid(context, given, fluid, report);
    let wheel = wheel?;
    Some(TrafficWheel {
        name: given.get(WHEEL_NAME).unwrap_or_else(|| format!("wheel {}", number + 1)),
        share: given.get(SHARE)?,
        axle_load: axle_load(sections, given),
        passages: read_passages(sections.one(&PASSAGE)?, wheel.half_width(), travel, network?)?,
        wheel,
        fluid: fluid?,
    })
}

/// The fluid of the `given` wheel, by default that of the case.
#[expect(clippy::option_option, reason = "dry cracks, and a section with errors")]
fn own_fluid(
    context: TrafficContext<'_>,
    given: &SectionValues,
    of_case: Option<&Option<CrackFluid>>,
    report: &mut Report,
) -> Option<Option<CrackFluid>> {
    match context.sections.part(given, &WHEEL_FLUID) {
        Some(own) => context.fluid(Some(own), report),
        None => of_case.cloned(),
    }
}

/// Load (t) of an axle of the `given` wheel, by default that of the case.
fn axle_load(sections: &Sections, given: &SectionValues) -> Option<f64> {
    given.get(WHEEL_AXLE_LOAD).or_else(|| sections.one(&TRAFFIC)?.get(AXLE_LOAD))
}

/// Million gross tonnes need the load of every axle.
fn check_axle_loads(given: &[&SectionValues], wheels: &[TrafficWheel], report: &mut Report) -> Option<()> {
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
    report.refuse(Fault::of(dotted, section.span.clone(), message).help(help))
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
fn check_files(given: &[&SectionValues], wheels: &[TrafficWheel], report: &mut Report) -> Option<()> {
    let all = wheels.iter().map(|wheel| wheel.wheel.companions()).enumerate();
    let named: Vec<(usize, Vec<Companion<'_>>)> = all.filter(|(_, files)| !files.is_empty()).collect();
    let Some(&(other, _)) = named.iter().find(|(_, files)| *files != named[0].1) else { return Some(()) };
    let says = "all contact tables of a mix must be the same file, with different scales where wheels differ, and so must its profiles";
    report.refuse(given[other].fault_of_all(says).help("use kind = \"hertz\" or \"carter\" for the others"))
}
