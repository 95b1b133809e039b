//! The first screen of the report of a run: the result in a sentence, key figures, the state of the
//! tips.

use super::events;
use super::stored::RunFolder;
use crate::direction::Heading;
use crate::numbers::{fixed, given, grouped, significant, tonnage};
use crate::page::Fact;
use crate::table::Table;
use railcrack::growth::{RunStop, TipStop};
use railcrack::words::Choice;
use railcrack_run::csv::TipRow;
use railcrack_run::decision::{Verdict, VerdictLevel};
use railcrack_run::run_folder::representative_tip as representative;

/// The first row of the representative tip, and that in which it has failed, or its last.
fn representative_tip(run: &RunFolder) -> Option<(&TipRow, &TipRow)> {
    let rows = representative(&run.growth)?;
    let last = rows.iter().rfind(|row| run.is_before_failure(row.step))?;
    Some((rows.first()?, last))
}

/// How the crack of a tip is called.
fn crack_name(run: &RunFolder, crack: usize) -> String {
    if run.summary.cracks.len() == 1 { "the crack".to_owned() } else { format!("crack {crack}") }
}

/// The tonnage of so many load cycles, in brackets; empty without an axle load.
pub(super) fn tonnes_of(run: &RunFolder, load_cycles: f64) -> String {
    run.case.axle_load.map_or_else(String::new, |load| {
        format!(" ({} million gross tonnes at {} t per axle)", tonnage(load_cycles * load / 1e6), given(load))
    })
}

/// The main result.
pub(super) fn verdict(run: &RunFolder) -> String {
    let Some((first, last)) = representative_tip(run) else {
        return "No step is finished yet.".to_owned();
    };
    let count = run.summary.cracks.len();
    let name = match count {
        1 => "The crack".to_owned(),
        2 => format!("The faster of 2 cracks, crack {},", first.crack),
        _ => format!("The fastest of {count} cracks, crack {},", first.crack),
    };
    let text = if last.length > first.length {
        let tonnes = tonnes_of(run, last.load_cycles);
        format!(
            "{name} grows from {} to {} mm in {} load cycles{}{tonnes}, {}.",
            fixed(first.length, 2),
            fixed(last.length, 2),
            grouped(last.load_cycles),
            error_of(last).map_or_else(String::new, |error| format!(" ({error})")),
            run.heading(last).map_or_else(|| "direction not yet determined".to_owned(), |h| h.sentence())
        )
    } else if last.removed.is_some_and(|removed| removed > 0.0) {
        format!(
            "{name} is worn from {} to {} mm in {} load cycles: wear and grinding exceed growth.",
            fixed(first.length, 2),
            fixed(last.length, 2),
            grouped(last.load_cycles),
        )
    } else {
        at_rest(&format!("{name} of {} mm", fixed(first.length, 2)), first, last, "")
    };
    // What has come loose counts more than what grows.
    let mut sentences = events::sentences(run);
    sentences.push(text);
    sentences.extend(deepest_beside(run, last));
    sentences.push(stop_sentence(run));
    sentences.join(" ")
}

/// The sentence on a `crack` that has not grown, by its tip in the `first` and in the `last` step,
/// which lies at `place`.
pub(super) fn at_rest(crack: &str, first: &TipRow, last: &TipRow, place: &str) -> String {
    if last.stop == Some(RunStop::NoTipGrows(TipStop::Arrest)) || last.rate == 0.0 {
        return format!("{crack} does not grow.");
    }
    format!(
        "{crack} has ΔK_{{eq}} = {} MPa√m and an initial growth rate of {} mm per load cycle{place}; no increment was computed.",
        significant(first.delta_keq),
        significant(first.rate)
    )
}

/// The deepest tip, where it is not that of the representative crack.
fn deepest_beside(run: &RunFolder, representative: &TipRow) -> Option<String> {
    let deepest = run.last().reduce(|one, other| if other.place[1] < one.place[1] { other } else { one })?;
    (deepest.crack != representative.crack && deepest.place[1] < representative.place[1]).then(|| {
        format!(
            "The deepest is crack {}, {} mm below the surface, which grows by {} mm per load cycle.",
            deepest.crack,
            fixed(-deepest.place[1], 2),
            significant(deepest.rate)
        )
    })
}

/// Reason for the end of the run.
pub(super) fn stop_sentence(run: &RunFolder) -> String {
    let steps = run.summary.steps;
    match run.summary.stop.map(RunStop::word) {
        None => format!("The run has not ended: step {steps} is the last finished one."),
        Some("steps-done") if steps == 0 => "The case requests the initial geometry only.".to_owned(),
        Some("steps-done") => {
            let increments = if steps == 1 { "increment".to_owned() } else { format!("{steps} increments") };
            format!("The run ended after the {increments} requested{}.", what_follows(run))
        }
        Some("cycles") => {
            format!("The run ended at the load cycles given in the case{}.", what_follows(run))
        }
        Some("critical-length") => {
            let length = run.case.growth.critical_length;
            format!(
                "The run ended at the critical length{}.",
                length.map_or_else(String::new, |l| format!(" of {} mm", given(l)))
            )
        }
        Some("arrest") => "The run ended with the arrest of all tips.".to_owned(),
        Some("break-out") => {
            "The run ended with a break-out: the crack reached the running surface, and a spall forms."
                .to_owned()
        }
        Some("fracture") => {
            "The run ended with brittle fracture: the largest k_{1} of a passage reached the toughness."
                .to_owned()
        }
        Some("worn-away") => "The run ended because the crack was worn away completely.".to_owned(),
        Some("wear-limit") => {
            "The run ended because the rail is worn to the limit at which it is replaced.".to_owned()
        }
        Some("meets-crack") => "The run ended because the last growing tip reached another crack.".to_owned(),
        Some("leaves-rail") => "The run ended because the last growing tip would leave the rail.".to_owned(),
        Some(other) => format!("The run ended: {}.", other.replace('-', " ")),
    }
}

/// The continuation of a run that ended before its cracks: nothing is known where the rail
/// fails, or where the model does not describe it.
fn what_follows(run: &RunFolder) -> &'static str {
    let is_grave = |verdict: &Verdict| verdict.level >= VerdictLevel::Stop;
    if run.summary.verdict.as_ref().is_some_and(is_grave) { "" } else { "; growth would continue" }
}

/// The estimated error of the load cycles of `row`, as a text; `None` where it is not known.
fn error_of(row: &TipRow) -> Option<String> {
    let share = row.cycles_error / row.load_cycles;
    (share > 0.0).then(|| format!("± {} % by the increments", fixed((100.0 * share).max(0.01), 2)))
}

/// The key figures.
pub(super) fn facts(run: &RunFolder, warnings: usize) -> Vec<Fact> {
    let Some((first, last)) = representative_tip(run) else { return Vec::new() };
    let which = crack_name(run, last.crack);
    let mut facts = vec![Fact::new(
        "Load cycles",
        grouped(last.load_cycles),
        match error_of(last) {
            Some(error) => {
                format!("axles until {which} is {} mm long; {error}", fixed(last.length, 2))
            }
            None => format!("axles until {which} is {} mm long", fixed(last.length, 2)),
        },
    )];
    facts.push(match run.case.axle_load {
        Some(load) => Fact::new(
            "Million gross tonnes",
            tonnage(last.load_cycles * load / 1e6),
            format!("at {} t per axle", given(load)),
        ),
        None => Fact::new("Million gross tonnes", "not given", "requires axle_load_t in [traffic]"),
    });
    facts.push(Fact::new(
        "Crack length",
        format!("{} → {} mm", fixed(first.length, 2), fixed(last.length, 2)),
        format!("{which}; its tip is {} mm below the surface", fixed(-last.place[1], 2)),
    ));
    if let Some(heading) = run.heading(last) {
        facts.push(Fact::new("Direction", heading.course().word().to_owned(), heading.note()));
    }
    facts.extend(events::fact(run));
    facts.extend(fracture(run));
    facts.extend(ending(run, warnings));
    facts
}

/// End of the run, and number of `warnings`.
pub(super) fn ending(run: &RunFolder, warnings: usize) -> [Fact; 2] {
    let stop = run.summary.stop.map_or("not ended", RunStop::word).replace('-', " ");
    [
        Fact::new("Ended by", stop, format!("after step {} of {}", run.summary.steps, run.case.growth.steps)),
        Fact::new(
            "Warnings",
            if warnings == 0 { "none".to_owned() } else { warnings.to_string() },
            if warnings == 0 { String::new() } else { "below, by kind".to_owned() },
        ),
    ]
}

/// Largest k1 in relation to the toughness, if that is given.
fn fracture(run: &RunFolder) -> Option<Fact> {
    let fracture = run.summary.fracture?;
    let (toughness, share) = fracture.toughness_mpa_sqrt_m.zip(fracture.of_toughness)?;
    let at = match fracture.xc_mm {
        Some(xc) if xc.abs() >= 1e3 => format!(", wheel {} m away", fixed(1e-3 * xc.abs(), 2)),
        Some(xc) => format!(", wheel at x = {} mm", fixed(xc, 0)),
        None => String::new(),
    };
    Some(Fact::new(
        "Fraction of the toughness",
        format!("{} %", fixed(100.0 * share, 0)),
        format!(
            "largest k_{{1}} = {} MPa√m, toughness {} MPa√m, in step {}{at}",
            fixed(fracture.largest_k1_mpa_sqrt_m, 1),
            fixed(toughness, 1),
            fracture.step
        ),
    ))
}

/// State of every tip in the last step; none for a single tip.
pub(super) fn cracks(run: &RunFolder) -> Option<Table> {
    if run.tips().len() < 2 {
        return None;
    }
    let headings = [
        "Crack",
        "Length (mm)",
        "Growth (mm)",
        "Tip depth (mm)",
        "ΔK_{eq} (MPa√m)",
        "Rate (mm/cycle)",
        "Direction",
        "Stop",
    ];
    let mut table = Table::new(headings);
    table.caption = format!("Every tip in the last finished step, {}", run.summary.steps);
    let has_two = run.tips().iter().any(|&(_, tip)| tip > 1);
    for row in run.last() {
        let first = run.history(row.crack, row.tip).next().map_or(row.length, |first| first.length);
        table.row([
            if has_two { format!("{}, tip {}", row.crack, row.tip) } else { row.crack.to_string() },
            fixed(row.length, 3),
            fixed(row.length - first, 3),
            fixed(-row.place[1], 3),
            significant(row.delta_keq),
            significant(row.rate),
            run.heading(row).as_ref().map_or_else(String::new, Heading::note),
            stop_of(run, row),
        ]);
    }
    Some(table)
}

/// Why a tip stopped. The run ends with the fracture at one tip; the others end with it.
pub(super) fn stop_of(run: &RunFolder, row: &TipRow) -> String {
    let broken = run.summary.fracture.filter(|_| row.stop == Some(RunStop::Fracture));
    match broken {
        Some(at) if (at.crack, at.tip) != (row.crack, row.tip) => format!("ends with crack {}", at.crack),
        _ => row.stop_word().replace('-', " "),
    }
}
