//! The page of two runs set against each other.

use crate::numbers::{fixed, grouped, significant};
use crate::{
    Block, ChartAspect, ChartAxis, ChartScale, Curve, CurveLook, Fact, LineChart, Page, Section, Table,
};
use railcrack::growth::RunStop;
use railcrack_run::Word;
use railcrack_run::compare::Aligned;
use railcrack_run::compare::TipComparison;
use railcrack_run::{Comparison, CrackSummary};

/// Rows of the table of tips; `compare.csv` has all.
const TABLE_ROWS: usize = 500;
/// Tips on a chart of K.
const CHART_TIPS: usize = 12;

/// The page of `comparison`, judged by `tolerance` (per cent of the largest |K|) where there is one; `pictures` (file name and
/// SVG) are its plots, for readers without scripts.
pub(crate) fn comparison_page(
    comparison: &Comparison,
    tolerance: Option<f64>,
    pictures: &[(&'static str, String)],
) -> Page {
    let names = comparison.names();
    let mut lead = Vec::new();
    if !comparison.notes.is_empty() {
        lead.push(Block::Warnings(comparison.notes.clone()));
    }
    lead.push(Block::Table(runs(comparison)));
    lead.push(if comparison.case_differences.is_empty() {
        Block::Text("Both cases are equal.".to_owned())
    } else {
        Block::Table(differences(comparison))
    });
    let still = |(file, svg): &(&str, String)| Block::Still { svg: svg.clone(), caption: (*file).to_owned() };
    let mut sections = Vec::new();
    if comparison.common_steps > 0 {
        sections.push(Section {
            id: "k".to_owned(),
            heading: "K of both over the passage".to_owned(),
            blocks: k_blocks(comparison, &names).into_iter().chain(pictures.iter().map(still)).collect(),
        });
        sections.push(Section {
            id: "paths".to_owned(),
            heading: "Paths and growth".to_owned(),
            blocks: vec![Block::charts(vec![paths(comparison, &names), lengths(comparison, &names)])],
        });
        let rows = comparison.tips.len().min(TABLE_ROWS);
        sections.push(Section {
            id: "steps".to_owned(),
            heading: "Every step and tip".to_owned(),
            blocks: vec![Block::Folded {
                heading: format!("{rows} rows"),
                blocks: vec![Block::Table(tips(comparison))],
            }],
        });
    }
    Page {
        title: format!("{} against {}", names[0], names[1]),
        kind: "Two runs compared".to_owned(),
        verdict: verdict(comparison, tolerance),
        facts: facts(comparison, tolerance),
        lead,
        sections,
    }
}

fn verdict(comparison: &Comparison, tolerance: Option<f64>) -> String {
    let (Some(largest), Some(farthest)) = (comparison.largest_percent(), comparison.farthest()) else {
        return "The runs have no step, tip or wheel position in common: K is not compared.".to_owned();
    };
    let judged = match tolerance {
        Some(tolerance) if largest <= tolerance => format!(", within the tolerance of {tolerance} %"),
        Some(tolerance) => format!(", NOT within the tolerance of {tolerance} %"),
        None => String::new(),
    };
    let parting = match &comparison.parting {
        None => "the paths do not part".to_owned(),
        Some(parting) => format!(
            "the paths part in step {} at crack {}{}",
            parting.step,
            parting.crack,
            if parting.near_tie { ", a near tie of directions" } else { "" }
        ),
    };
    format!(
        "K differs by at most {} % of the largest |K| in the {} common steps{judged}; the tips are at most {} mm apart, and {parting}.",
        significant(largest),
        comparison.common_steps,
        significant(farthest.distance)
    )
}

fn facts(comparison: &Comparison, tolerance: Option<f64>) -> Vec<Fact> {
    let fact = |name: &str, value: String, note: String| Fact { name: name.to_owned(), value, note };
    let mut facts = Vec::new();
    for (name, largest) in [
        ("K_{I} differs by", comparison.largest(|sifs| sifs.ki)),
        ("K_{II} differs by", comparison.largest(|sifs| sifs.kii)),
    ] {
        let Some((tip, difference)) = largest else { continue };
        facts.push(fact(
            name,
            format!("{} %", significant(comparison.percent(difference.largest))),
            format!(
                "{} MPa√m in step {}, crack {}, at x_{{c}}/a = {}",
                significant(difference.largest),
                tip.step,
                tip.crack,
                fixed(difference.xc_over_a, 2)
            ),
        ));
    }
    if let Some(tip) = comparison.farthest() {
        facts.push(fact(
            "Tips apart",
            format!("{} mm", significant(tip.distance)),
            format!("step {}, crack {}", tip.step, tip.crack),
        ));
    }
    if let Some(tip) = comparison.tips.last() {
        let [first, second] = tip.load_cycles;
        facts.push(fact(
            "Load cycles",
            format!("{} and {}", grouped(first), grouped(second)),
            format!("to step {}", tip.step),
        ));
    }
    if let Some(parting) = &comparison.parting {
        let how = format!("kinks {}° apart", fixed(parting.apart_deg, 1));
        facts.push(fact("Paths part", format!("step {}", parting.step), how));
    }
    if let Some(tolerance) = tolerance {
        let within = comparison.largest_percent().is_some_and(|largest| largest <= tolerance);
        facts.push(fact(
            "Tolerance",
            format!("{tolerance} %"),
            if within { "met".to_owned() } else { "not met".to_owned() },
        ));
    }
    facts
}

fn runs(comparison: &Comparison) -> Table {
    let mut table = Table::new(["Run", "Engine", "Contact", "Boundary", "Steps", "Ended by", "Load cycles"]);
    for run in &comparison.runs {
        table.row([
            run.folder.display().to_string(),
            run.engine.name().to_owned(),
            run.contact.name().to_owned(),
            run.boundary.word().to_owned(),
            run.steps_recorded.to_string(),
            run.stop.map_or("not ended", RunStop::name).replace('-', " "),
            grouped(run.load_cycles),
        ]);
    }
    table
}

fn differences(comparison: &Comparison) -> Table {
    let mut table = Table::new(["Key of the case", "First", "Second"]);
    for difference in &comparison.case_differences {
        let [first, second] =
            difference.values.each_ref().map(|value| value.clone().unwrap_or_else(|| "–".to_owned()));
        table.row([difference.key.clone(), first, second]);
    }
    table
}

fn k_blocks(comparison: &Comparison, names: &[String; 2]) -> Vec<Block> {
    let last = comparison.common_steps - 1;
    let mut steps = vec![0, last];
    steps.dedup();
    let mut blocks = Vec::new();
    for step in steps {
        let heading = if step == 0 {
            "Step 0, the initial cracks".to_owned()
        } else {
            format!("Step {step}, the last common one")
        };
        blocks.push(Block::Heading(heading));
        let mut charts = Vec::new();
        for (id, symbol, k) in [
            ("ki", "K_{I}", (|aligned| &aligned.ki) as fn(&Aligned) -> &[Vec<f64>; 2]),
            ("kii", "K_{II}", |aligned| &aligned.kii),
        ] {
            let chart = |id: String, title: String, caption: String, curves| LineChart {
                id,
                caption,
                x: ChartAxis::linear("Wheel position x_{c}/a"),
                y: ChartAxis::linear(&title),
                curves,
                ..LineChart::default()
            };
            charts.push(chart(
                format!("{id}-{step}"),
                format!("{symbol} (MPa√m)"),
                format!("{symbol} of both runs; the second one dashed."),
                both(comparison, names, step, k),
            ));
            charts.push(chart(
                format!("{id}-difference-{step}"),
                format!("{symbol}, second − first (MPa√m)"),
                format!("Difference of {symbol}, second minus first."),
                difference(comparison, step, k),
            ));
        }
        blocks.push(Block::charts(charts));
    }
    blocks
}

/// Tips of a step with their histories.
fn at_step(
    comparison: &Comparison,
    step: usize,
) -> impl Iterator<Item = (usize, (&TipComparison, &Aligned))> {
    let tips = comparison.tips.iter().zip(&comparison.aligned);
    tips.filter(move |(tip, _)| tip.step == step).take(CHART_TIPS).enumerate()
}

fn tip_name(tip: &TipComparison) -> String {
    if tip.tip > 1 { format!("crack {}, tip {}", tip.crack, tip.tip) } else { format!("crack {}", tip.crack) }
}

fn points(x: &[f64], y: impl IntoIterator<Item = f64>) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(&x, y)| [x, y]).collect()
}

fn both(
    comparison: &Comparison,
    names: &[String; 2],
    step: usize,
    k: fn(&Aligned) -> &[Vec<f64>; 2],
) -> Vec<Curve> {
    let single = at_step(comparison, step).count() == 1;
    let of_tip = |(place, (tip, aligned)): (usize, (&TipComparison, &Aligned))| {
        let curve = |run: usize| {
            let name = if single { names[run].clone() } else { format!("{}, {}", tip_name(tip), names[run]) };
            let points = points(&aligned.xc_over_a, k(aligned)[run].iter().copied());
            let look = if run == 0 { CurveLook::Line } else { CurveLook::Dashed };
            Curve::line(&name, points).with_look(look).with_colour(if single { run } else { place })
        };
        [curve(0), curve(1)]
    };
    at_step(comparison, step).flat_map(of_tip).collect()
}

fn difference(comparison: &Comparison, step: usize, k: fn(&Aligned) -> &[Vec<f64>; 2]) -> Vec<Curve> {
    let single = at_step(comparison, step).count() == 1;
    let of_tip = |(place, (tip, aligned)): (usize, (&TipComparison, &Aligned))| {
        let [first, second] = k(aligned);
        let name = if single { String::new() } else { tip_name(tip) };
        let points =
            points(&aligned.xc_over_a, first.iter().zip(second).map(|(first, second)| second - first));
        Curve::line(&name, points).with_colour(if single { 2 } else { place })
    };
    at_step(comparison, step).map(of_tip).collect()
}

fn paths(comparison: &Comparison, names: &[String; 2]) -> LineChart {
    let curve = |run: usize, crack: &CrackSummary| {
        let points = crack.points_mm.iter().map(|&[x, y]| [x, -y]).collect();
        let look = if run == 0 { CurveLook::Dotted } else { CurveLook::Dashed };
        Curve::line(&names[run], points).with_look(look).with_colour(run)
    };
    let of_run = |run: usize| comparison.cracks[run].iter().map(move |crack| (run, crack));
    LineChart {
        id: "path".to_owned(),
        caption: "Crack paths to scale; the second run dashed.".to_owned(),
        x: ChartAxis::linear("x (mm)"),
        y: ChartAxis { scale: ChartScale::Depth, ..ChartAxis::linear("Depth (mm)") },
        curves: (0..2).flat_map(of_run).map(|(run, crack)| curve(run, crack)).collect(),
        aspect: ChartAspect::Equal,
        ..LineChart::default()
    }
}

fn lengths(comparison: &Comparison, names: &[String; 2]) -> LineChart {
    let mut cracks: Vec<usize> = comparison.tips.iter().map(|tip| tip.crack).collect();
    cracks.sort_unstable();
    cracks.dedup();
    let curve = |run: usize, crack: usize| {
        let rows = comparison.tips.iter().filter(|tip| (tip.crack, tip.tip) == (crack, 1));
        let points = rows.map(|tip| [tip.load_cycles[run], tip.lengths[run]]).collect();
        let look = if run == 0 { CurveLook::Dotted } else { CurveLook::Dashed };
        Curve::line(&names[run], points).with_look(look).with_colour(run)
    };
    LineChart {
        id: "length-cycles".to_owned(),
        caption: "Crack length against load cycles in the common steps; the second run dashed.".to_owned(),
        x: ChartAxis::linear("Load cycles (axles)"),
        y: ChartAxis::linear("Crack length (mm)"),
        curves: (0..2)
            .flat_map(|run| cracks.iter().map(move |&crack| (run, crack)))
            .map(|(run, crack)| curve(run, crack))
            .collect(),
        ..LineChart::default()
    }
}

fn tips(comparison: &Comparison) -> Table {
    let headings = [
        "Step",
        "Crack",
        "Tip",
        "K_{I} differs (MPa√m)",
        "%",
        "K_{II} differs (MPa√m)",
        "%",
        "Tips apart (mm)",
        "Length, first (mm)",
        "Length, second (mm)",
        "Kink, first (°)",
        "Kink, second (°)",
        "Load cycles, first",
        "Load cycles, second",
    ];
    let mut table = Table::new(headings);
    table.caption =
        "Largest differences over the passage, in per cent of the largest |K| of the step".to_owned();
    if comparison.tips.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of compare.csv"));
    }
    let angle = |angle: Option<f64>| angle.map_or_else(String::new, |angle| fixed(angle, 1));
    for tip in comparison.tips.iter().take(TABLE_ROWS) {
        let mode = |largest: Option<f64>| {
            largest.map_or([String::new(), String::new()], |k| [significant(k), fixed(tip.percent(k), 3)])
        };
        let [ki, ki_percent] = mode(tip.sifs.map(|sifs| sifs.ki.largest));
        let [kii, kii_percent] = mode(tip.sifs.map(|sifs| sifs.kii.largest));
        table.row([
            tip.step.to_string(),
            tip.crack.to_string(),
            tip.tip.to_string(),
            ki,
            ki_percent,
            kii,
            kii_percent,
            significant(tip.distance),
            fixed(tip.lengths[0], 3),
            fixed(tip.lengths[1], 3),
            angle(tip.kink_deg[0]),
            angle(tip.kink_deg[1]),
            grouped(tip.load_cycles[0]),
            grouped(tip.load_cycles[1]),
        ]);
    }
    table
}
