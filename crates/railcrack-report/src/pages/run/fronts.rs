//! Cracks in space on the page of a run: fronts, tables, assumptions.

use super::assumptions::assumptions;
use super::facts::{at_rest, ending, stop_of, stop_sentence, tonnes_of};
use super::front_data::cracks;
use super::stored::RunFolder;
use super::{RunParts, decision, front_data, front_wheels, steps_section, warnings};
use crate::figures::{Plot, charts, space_view};
use crate::numbers::{fixed, given, grouped, significant, tonnage};
use crate::page::{Block, Fact, Section};
use crate::page_data::PageData;
use crate::table::Table;
use railcrack_case::SpaceCase;
use railcrack_run::csv::TipRow;

/// The parts of the page of `run` about cracks in space.
pub(super) fn parts(run: &RunFolder, space: &SpaceCase, page_data: &PageData, plots: &[Plot]) -> RunParts {
    let (mut growth, mut sections) = (Vec::new(), Vec::new());
    if run.summary.steps_recorded > 0 {
        growth.extend(decision::sensitivities(run).map(Block::Table));
        growth.push(charts(plots, &["length-cycles", "along-front"]));
        growth.push(front_table(run));
        growth.extend(front_wheels::wheels(run));
        growth.extend(front_wheels::drawn(run, plots));
        sections.push(front_data::explorer(run, space, page_data));
        sections.extend(whole_passage(run, plots));
        sections.push(Section::new(
            "fronts",
            "Fronts and K over the passage",
            vec![in_space(run), charts(plots, &["from-the-side", "ki", "kii", "kiii"])],
        ));
        sections.push(steps(run));
    }
    RunParts {
        kind: "Crack growth in space under rolling contact",
        verdict: verdict(run),
        facts: facts(run, warnings::count(run)),
        growth,
        tables: Vec::new(),
        assumptions: assumptions(run),
        sections,
    }
}

/// The cracks below the running surface, at an angle from above.
fn in_space(run: &RunFolder) -> Block {
    let (svg, grid) = space_view(&run.summary, &run.growth);
    let caption = format!(
        "The fronts of the growth steps below the running surface, to scale; black: the first; filled: the last. Lines on the \
         surface are {} mm apart.",
        given(grid)
    );
    Block::Picture { svg, caption }
}

/// The deepest point of a crack, counted from 1, in the first and in the last step.
fn deepest_of(run: &RunFolder, crack: usize) -> Option<(&TipRow, &TipRow)> {
    let distance = |row: &&TipRow| (row.phi_deg.unwrap_or(0.0) - 90.0).abs();
    let own = run.growth.iter().filter(|row| row.step == 0 && row.crack == crack);
    let first = own.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some((first, run.history(first.crack, first.tip).last()?))
}

/// The same for the crack with the largest growth down the dip, or with the largest load if none
/// grows.
fn deepest(run: &RunFolder) -> Option<(&TipRow, &TipRow)> {
    let all = (1..=cracks(run)).filter_map(|crack| deepest_of(run, crack));
    let rank = |(first, last): &(&TipRow, &TipRow)| (last.length - first.length, first.delta_keq);
    let is_ahead = |a: (f64, f64), b: (f64, f64)| a.0 > b.0 || (a.0 == b.0 && a.1 > b.1);
    all.reduce(|best, next| if is_ahead(rank(&next), rank(&best)) { next } else { best })
}

/// Whether the crack has a fold.
fn is_folded(run: &RunFolder) -> bool {
    run.case.space().is_some_and(|space| space.shapes.iter().any(|shape| shape.strip.is_some()))
}

fn verdict(run: &RunFolder) -> String {
    let Some((first, last)) = deepest(run) else { return "No step is finished yet.".to_owned() };
    let axes =
        |row: &TipRow| format!("{} by {} mm", fixed(row.length, 2), fixed(row.half_length.unwrap_or(0.0), 2));
    let sizes = if is_folded(run) { "a length and a half-length" } else { "semi-axes" };
    let grown = last.length > first.length || last.half_length > first.half_length;
    let (which, rank) = match cracks(run) {
        1 => ("The crack".to_owned(), String::new()),
        count => (format!("Crack {}", first.crack), format!(", the fastest of {count} cracks,")),
    };
    let text = if grown {
        let tonnes = tonnes_of(run, last.load_cycles);
        format!(
            "{which}{rank} grows from {sizes} of {} (down the dip, along the surface) to {} in {} load cycles{tonnes}.",
            axes(first),
            axes(last),
            grouped(last.load_cycles)
        )
    } else {
        at_rest(&format!("{which} with {sizes} of {}", axes(first)), first, last, " at its deepest point")
    };
    format!("{text} {}", stop_sentence(run))
}

fn facts(run: &RunFolder, warnings: usize) -> Vec<Fact> {
    let Some((first, last)) = deepest(run) else { return Vec::new() };
    let from_to = |a: f64, b: f64| format!("{} → {} mm", fixed(a, 2), fixed(b, 2));
    let sides = |row: &TipRow| row.half_length.unwrap_or(0.0);
    let mut facts = vec![Fact::new("Load cycles", grouped(last.load_cycles), "axles")];
    if let Some(load) = run.case.axle_load {
        let tonnes = tonnage(last.load_cycles * load / 1e6);
        facts.push(Fact::new("Million gross tonnes", tonnes, format!("at {} t per axle", given(load))));
    }
    let depth = from_to(-first.place[1], -last.place[1]);
    facts.push(Fact::new(
        "Depth",
        depth,
        format!(
            "{} {}",
            if is_folded(run) { "length down the dip, over the fold," } else { "semi-axis down the dip" },
            from_to(first.length, last.length)
        ),
    ));
    facts.push(Fact::new(
        "On the surface",
        from_to(2.0 * sides(first), 2.0 * sides(last)),
        "length of the mouth, or width of a buried crack",
    ));
    facts.push(Fact::new(
        "ΔK_{eq}",
        format!("{} MPa√m", significant(first.delta_keq)),
        match cracks(run) {
            1 => "at the deepest point of the initial crack".to_owned(),
            _ => format!("at the deepest point of the initial crack {}", first.crack),
        },
    ));
    if let Some((angle, ratio)) = first.wanted_kink_deg.zip(first.wanted_ratio) {
        facts.push(Fact::new(
            "Preferred kink",
            format!("{}°", fixed(angle, 0)),
            format!(
                "at the deepest point, where growth would be {} times as fast as straight ahead; the model grows the crack in its plane",
                fixed(ratio, 2)
            ),
        ));
    }
    facts.extend(ending(run, warnings));
    facts
}

/// The front in the last finished step.
fn front_table(run: &RunFolder) -> Block {
    let headings = [
        "Crack",
        "φ (°)",
        "z (mm)",
        "Depth (mm)",
        "ΔK_{I}",
        "ΔK_{II}",
        "ΔK_{III}",
        "ΔK_{eq} (MPa√m)",
        "Rate (mm/cycle)",
        "Preferred kink (°)",
    ];
    let mut table = Table::new(headings);
    let what = if cracks(run) == 1 { "The front" } else { "The fronts" };
    let sides = if is_folded(run) {
        "; φ below 0 and above 180° on the sides of the strip, ±90° beyond at the mouth"
    } else {
        ""
    };
    table.caption = format!("{what} in the last finished step, {}; K in MPa√m{sides}", run.summary.steps);
    for row in run.last() {
        table.row([
            row.crack.to_string(),
            fixed(row.phi_deg.unwrap_or(0.0), 1),
            fixed(row.lateral.unwrap_or(0.0), 3),
            fixed(-row.place[1], 3),
            fixed(row.delta_ki, 3),
            fixed(row.delta_kii, 3),
            fixed(row.delta_kiii.unwrap_or(0.0), 3),
            fixed(row.delta_keq, 3),
            significant(row.rate),
            row.wanted_kink_deg.map_or_else(String::new, |kink| fixed(kink, 0)),
        ]);
    }
    // The points of several fronts are pages of rows.
    if cracks(run) == 1 {
        return Block::Table(table);
    }
    let heading = format!("Points of the {} fronts in the last step, {} rows", cracks(run), table.rows.len());
    Block::Folded { heading, blocks: vec![Block::Table(table)] }
}

/// K over the whole passage; none for a rail without bending.
fn whole_passage(run: &RunFolder, plots: &[Plot]) -> Option<Section> {
    run.case.first_wheel().wheel.track.as_ref()?;
    let text = "The rail bends over several metres, and the passage covers this length. Bending is the same at all lateral positions.";
    Some(Section::new(
        "far",
        "The whole passage, in metres",
        vec![Block::Text(text.to_owned()), charts(plots, &["ki-far", "kii-far", "kiii-far"])],
    ))
}

fn steps(run: &RunFolder) -> Section {
    let mut table = Table::new([
        "Step",
        "Crack",
        "φ (°)",
        "Semi-axis down the dip (mm)",
        "Along the surface (mm)",
        "ΔK_{eq} (MPa√m)",
        "Rate (mm/cycle)",
        "Increment (mm)",
        "Relative to the local rate",
        "Load cycles",
        "Stop",
    ]);
    for row in run.growth.iter().take(super::TABLE_ROWS) {
        table.row([
            row.step.to_string(),
            row.crack.to_string(),
            fixed(row.phi_deg.unwrap_or(0.0), 1),
            fixed(row.length, 3),
            fixed(row.half_length.unwrap_or(0.0), 3),
            fixed(row.delta_keq, 3),
            significant(row.rate),
            fixed(row.increment, 4),
            row.followed.map_or_else(String::new, |share| fixed(share, 2)),
            grouped(row.load_cycles),
            stop_of(run, row),
        ]);
    }
    steps_section(run, table)
}
