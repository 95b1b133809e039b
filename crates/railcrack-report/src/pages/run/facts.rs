//! The first screen of the report of a run: the result in a sentence, key figures, cycles to each
//! length.

use super::events;
use super::stored::RunFolder;
use crate::direction::Heading;
use crate::numbers::{fixed, grouped, significant, tonnage};
use crate::page::Fact;
use crate::svg::round_step;
use crate::table::{MISSING, Table};
use railcrack::growth::{RunStop, TipStop};
use railcrack::words::Choice;
use railcrack_run::csv::TipRow;
use railcrack_run::representative::{cycles_to, representative_tip as representative};
use std::collections::BTreeSet;

/// Rows of the table of lengths, about: of a single crack, and for each of several.
const LENGTHS: usize = 8;
const LENGTHS_OF_SEVERAL: usize = 5;
/// Cracks in the table of lengths.
const LENGTH_CRACKS: usize = 9;

/// The first and the last row of the representative tip.
fn representative_tip(run: &RunFolder) -> Option<(&TipRow, &TipRow)> {
    let rows = representative(&run.growth)?;
    Some((rows.first()?, rows.last()?))
}

/// How the crack of a tip is called.
fn crack_name(run: &RunFolder, crack: usize) -> String {
    if run.summary.cracks.len() == 1 { "the crack".to_owned() } else { format!("crack {crack}") }
}

/// The result in a sentence or two.
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
    let mut text = if last.length > first.length {
        let tonnes = run.case.axle_load.map_or_else(String::new, |load| {
            format!(" ({} million gross tonnes at {load} t per axle)", tonnage(last.load_cycles * load / 1e6))
        });
        format!(
            "{name} grows from {} to {} mm in {} load cycles{tonnes}, {}.",
            fixed(first.length, 2),
            fixed(last.length, 2),
            grouped(last.load_cycles),
            run.heading(last).map_or_else(|| "with no direction yet".to_owned(), |h| h.sentence())
        )
    } else if last.stop == Some(RunStop::NoTipGrows(TipStop::Arrest)) || last.rate == 0.0 {
        format!("{name} of {} mm does not grow.", fixed(first.length, 2))
    } else {
        format!(
            "{name} of {} mm is at ΔK_{{eq}} = {} MPa√m and grows by {} mm per load cycle at first; no increment was computed.",
            fixed(first.length, 2),
            significant(first.delta_keq),
            significant(first.rate)
        )
    };
    for sentence in events::sentences(run) {
        text.push(' ');
        text.push_str(&sentence);
    }
    text.push(' ');
    text.push_str(&stop_sentence(run));
    text
}

/// Why the run ended, in a sentence.
fn stop_sentence(run: &RunFolder) -> String {
    let steps = run.summary.steps;
    match run.summary.stop.map(RunStop::word) {
        None => format!("The run has not ended: step {steps} is the last finished one."),
        Some("steps-done") if steps == 0 => "The case asks for the initial geometry only.".to_owned(),
        Some("steps-done") => {
            format!("The run ended after the {steps} increments of the case; growth would continue.")
        }
        Some("cycles") => "The run ended at the load cycles of the case; growth would continue.".to_owned(),
        Some("critical-length") => {
            let length = run.case.growth.critical_length;
            format!(
                "The run ended at the critical length{}.",
                length.map_or_else(String::new, |l| format!(" of {l} mm"))
            )
        }
        Some("arrest") => "The run ended with the arrest of all tips.".to_owned(),
        Some("break-out") => {
            "The run ended with a break-out: the ligament to the running surface is lost, and a spall forms."
                .to_owned()
        }
        Some("fracture") => "The run ended with brittle fracture: the largest k_{1} of a passage reaches the toughness, and the \
             rail breaks."
            .to_owned(),
        Some("meets-crack") => "The run ended because the last growing tip reached another crack.".to_owned(),
        Some("leaves-rail") => "The run ended because the last growing tip would leave the rail.".to_owned(),
        Some(other) => format!("The run ended: {}.", other.replace('-', " ")),
    }
}

/// The key figures.
pub(super) fn facts(run: &RunFolder, warnings: usize) -> Vec<Fact> {
    let Some((first, last)) = representative_tip(run) else { return Vec::new() };
    let fact = |name: &str, value: String, note: String| Fact { name: name.to_owned(), value, note };
    let which = crack_name(run, last.crack);
    let mut facts = vec![fact(
        "Load cycles",
        grouped(last.load_cycles),
        format!("axles until {which} is {} mm long", fixed(last.length, 2)),
    )];
    facts.push(match run.case.axle_load {
        Some(load) => fact(
            "Million gross tonnes",
            tonnage(last.load_cycles * load / 1e6),
            format!("at {load} t per axle"),
        ),
        None => fact(
            "Million gross tonnes",
            "not given".to_owned(),
            "needs axle_load_t in [traffic] of the case".to_owned(),
        ),
    });
    facts.push(fact(
        "Crack length",
        format!("{} → {} mm", fixed(first.length, 2), fixed(last.length, 2)),
        format!("{which}; its tip is {} mm below the surface", fixed(-last.place[1], 2)),
    ));
    if let Some(heading) = run.heading(last) {
        facts.push(fact("Direction", heading.course().word().to_owned(), heading.note()));
    }
    facts.extend(events::fact(run));
    facts.extend(fracture(run));
    let stop = run.summary.stop.map_or("not ended", RunStop::word).replace('-', " ");
    facts.push(fact(
        "Ended by",
        stop,
        format!("after step {} of {}", run.summary.steps, run.case.growth.steps),
    ));
    facts.push(fact(
        "Warnings",
        if warnings == 0 { "none".to_owned() } else { warnings.to_string() },
        if warnings == 0 { String::new() } else { "below".to_owned() },
    ));
    facts
}

/// How far the passages are from breaking the rail, where its toughness is given.
fn fracture(run: &RunFolder) -> Option<Fact> {
    let fracture = run.summary.fracture?;
    let (toughness, share) = fracture.toughness_mpa_sqrt_m.zip(fracture.of_toughness)?;
    let at = match fracture.xc_mm {
        Some(xc) if xc.abs() >= 1e3 => format!(", wheel {} m away", fixed(1e-3 * xc.abs(), 2)),
        Some(xc) => format!(", wheel at x = {} mm", fixed(xc, 0)),
        None => String::new(),
    };
    Some(Fact {
        name: "Of the toughness".to_owned(),
        value: format!("{} %", fixed(100.0 * share, 0)),
        note: format!(
            "largest k_{{1}} = {} of {} MPa√m, in step {}{at}",
            fixed(fracture.largest_k1_mpa_sqrt_m, 1),
            fixed(toughness, 1),
            fracture.step
        ),
    })
}

/// Load cycles (and tonnage) until every crack has each of some round lengths; none without growth.
/// Between two steps cycles are taken as linear in the length.
pub(super) fn lengths(run: &RunFolder) -> Option<Table> {
    let tips: Vec<(usize, usize)> =
        run.tips().into_iter().filter(|&(_, tip)| tip == 1).take(LENGTH_CRACKS).collect();
    let histories: Vec<Vec<&TipRow>> =
        tips.iter().map(|&(crack, tip)| run.history(crack, tip).collect()).collect();
    let ends: Vec<[f64; 2]> =
        histories.iter().filter_map(|rows| Some([rows.first()?.length, rows.last()?.length])).collect();
    let milestones = milestones(&ends);
    if milestones.is_empty() {
        return None;
    }
    let load = run.case.axle_load;
    let mut headings = vec!["Length (mm)".to_owned()];
    for &(crack, _) in &tips {
        headings.push(if tips.len() == 1 {
            "Load cycles".to_owned()
        } else {
            let tonnes = if load.is_some() { "; million gross tonnes" } else { "" };
            format!("Crack {crack} (load cycles{tonnes})")
        });
    }
    if load.is_some() && tips.len() == 1 {
        headings.push("Million gross tonnes".to_owned());
    }
    let mut table = Table::new(headings);
    table.caption = match load {
        Some(load) if tips.len() > 1 => {
            format!("Load cycles to each length; one cycle is one axle of {load} t")
        }
        _ => "Load cycles to each length; one cycle is one axle".to_owned(),
    };
    for length in milestones {
        let cycles: Vec<Option<f64>> = histories.iter().map(|rows| cycles_to(rows, length)).collect();
        let mut cells = vec![fixed(length, 2)];
        let shown = |cycles: f64| match load {
            Some(load) if tips.len() > 1 => format!("{}; {}", grouped(cycles), tonnage(1e-6 * load * cycles)),
            _ => grouped(cycles),
        };
        cells.extend(cycles.iter().map(|cycles| cycles.map_or_else(|| MISSING.to_owned(), shown)));
        if let (Some(load), [cycles]) = (load, &cycles[..]) {
            cells.push(cycles.map_or_else(|| MISSING.to_owned(), |cycles| tonnage(cycles * load / 1e6)));
        }
        table.row(cells);
    }
    Some(table)
}

/// Round lengths through which cracks grow, given the first and the last length of each, and the
/// last length of the one that grows most.
fn milestones(ends: &[[f64; 2]]) -> Vec<f64> {
    let grown = |ends: &[f64; 2]| ends[1] - ends[0];
    let Some(most) = ends.iter().copied().reduce(|a, b| if grown(&b) > grown(&a) { b } else { a }) else {
        return Vec::new();
    };
    if grown(&most) <= 0.0 {
        return Vec::new();
    }
    let step = round_step(grown(&most), if ends.len() == 1 { LENGTHS } else { LENGTHS_OF_SEVERAL });
    // A crack of 3 mm up to round-off does not grow through 3 mm.
    let below = |length: &f64| (length / step + 1e-9).floor() as i64;
    let round = |[from, to]: &[f64; 2]| below(from) + 1..=below(to);
    let places: BTreeSet<i64> = ends.iter().flat_map(round).collect();
    let last = most[1];
    let mut lengths: Vec<f64> = places
        .into_iter()
        .map(|i| multiple(i, step))
        .filter(|length| (length - last).abs() > 0.2 * step)
        .collect();
    lengths.push(last);
    lengths.sort_by(f64::total_cmp);
    lengths
}

/// `i` times a round `step`, as people write it: steps below 1 are whole parts of 1, of which the
/// quotient is the nearest number.
fn multiple(i: i64, step: f64) -> f64 {
    if step < 1.0 { i as f64 / (1.0 / step).round() } else { i as f64 * step }
}

/// State of every tip in the last step; none for a single one.
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
            row.stop_word().replace('-', " "),
        ]);
    }
    Some(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milestones_are_round_and_end_at_the_last_length() {
        assert_eq!(milestones(&[[6.0, 15.995]]), [8.0, 10.0, 12.0, 14.0, 15.995]);
        // Each crack has its own, the end is that of the one that grew most.
        assert_eq!(milestones(&[[3.0, 6.54], [9.03, 12.5]]), [4.0, 5.0, 6.0, 6.54, 10.0, 11.0, 12.0]);
        assert_eq!(milestones(&[[3.0 - 1e-12, 3.25]])[0], 3.05);
        assert_eq!(milestones(&[[6.0, 6.0]]), [0.0; 0]);
        assert_eq!(milestones(&[]), [0.0; 0]);
    }
}
