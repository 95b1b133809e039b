//! `[passage]`: the passage of the wheel over the cracks.

use crate::schema::{Report, SectionValues, choice, closed, integer, number, read_by_word, section, within};
use railcrack::contact::StepControl;
use railcrack::crack::CrackNetwork;
use railcrack::growth::PassageSettings;
use railcrack::load::{Passage, Travel};

section! {
    PASSAGE "passage", Defaulted,
        "Passage of the wheel, towards -x if from_over_a > to_over_a.";
    FROM: f64 = number("from_over_a", "a", within(1e3), -6.0,
        "First position of the contact centre, relative to the mouth met first.");
    TO: f64 = number("to_over_a", "a", within(1e3), 6.0,
        "Last position of the contact centre, relative to the mouth met last.");
    POSITIONS: usize = integer("positions", (2, 100_000), 241, "Number of evenly spaced output positions.");
    MAX_PASSAGES: usize = integer("max_passages", (1, 1000), 5,
        "Maximum number of passages over an unchanged crack until K repeats.");
    PASSAGE_TOLERANCE: f64 = number("passage_tolerance", "", closed(1e-9, 0.1), 1e-3,
        "Change of K between two passages, relative to its peak, below which it counts as repeating.");
    STEP_TOLERANCE: f64 = number("step_tolerance", "", closed(1e-6, 0.1), 2e-3,
        "Change of K, relative to its peak, to which load steps are refined.");
    NETWORK_TOLERANCE: f64 = number("network_tolerance", "", closed(1e-9, 0.1), 6e-4,
        "Estimated error of K, relative to its peak at the tip, at which sweeps with solver.network = \"groups\" end.");
    STEP_CONTROL: StepControl = choice("step_control", "Control of the load steps.");
}

read_by_word!(StepControl);

/// Direction of travel of the wheel.
pub(crate) fn read_travel(section: &SectionValues) -> Option<Travel> {
    Some(if section.get(TO)? < section.get(FROM)? { Travel::Backward } else { Travel::Forward })
}

/// Reports a passage in which the wheel does not move; whether it moves.
pub(crate) fn check_passage(section: &SectionValues, report: &mut Report) -> bool {
    let (Some(from), Some(to)) = (section.get(FROM), section.get(TO)) else { return false };
    if from == to {
        let help = "the wheel must move; from > to makes it run towards -x";
        let says = format!("must differ from {}", FROM.key.name);
        report.add(section.fault(TO, says).help(help));
    }
    from != to
}

/// The passages of a wheel with the half-width a = `half_width` (mm) that runs towards `travel`,
/// from the mouths of `cracks`; one that runs against the direction of the section has its passage
/// mirrored.
pub(crate) fn read_passages(
    section: &SectionValues,
    half_width: f64,
    travel: Travel,
    cracks: &CrackNetwork,
) -> Option<PassageSettings> {
    let (from, to) = (section.get(FROM)?, section.get(TO)?);
    let (from, to) = if Some(travel) == read_travel(section) { (from, to) } else { (-from, -to) };
    // The wheel meets the cracks one after the other: it starts before the first mouth that it
    // meets and ends behind the last one.
    let (first, last) = if from < to {
        (cracks.leftmost_mouth(), cracks.rightmost_mouth())
    } else {
        (cracks.rightmost_mouth(), cracks.leftmost_mouth())
    };
    let passage = Passage {
        from: first + from * half_width,
        to: last + to * half_width,
        positions: section.get(POSITIONS)?,
    };
    Some(PassageSettings {
        passage,
        max_passages: section.get(MAX_PASSAGES)?,
        passage_tolerance: section.get(PASSAGE_TOLERANCE)?,
        step_tolerance: section.get(STEP_TOLERANCE)?,
        step_control: section.get(STEP_CONTROL)?,
        network_tolerance: section.get(NETWORK_TOLERANCE)?,
    })
}
