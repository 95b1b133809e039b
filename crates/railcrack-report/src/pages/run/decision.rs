//! The decision block of a run: depth over traffic, wheels, interval, scatter.

use super::stored::RunFolder;
use crate::numbers::{fixed, given, rounded, significant, tonnage};
use crate::page::{Banner, Block};
use crate::pages::phrases::{calibration, detectable_to_critical, sentence};
use crate::table::{MISSING, Table};
use railcrack_run::decision::{
    Decision, FailureMode, FrictionLife, InspectionSummary, MaintenanceSummary, PathLives, Reason,
    RiskSummary, RowPartSummary, ScatterSummary, StageSummary, StagesSummary, TonnageWords, TornadoBar,
    VerdictLevel, WheelSummary, interval_in_words,
};

/// Approximate number of rows in the table of depths; `summary.json` has all.
const ROWS: usize = 9;

/// The sentences of the decision; none without axle loads.
pub(super) fn decision(run: &RunFolder) -> Vec<Block> {
    let Some(decision) = &run.summary.decision else { return Vec::new() };
    let words = TonnageWords { mgt_per_year: decision.mgt_per_year };
    let to_act_on = interval_in_words(decision.inspection.as_ref(), &decision.risk, words);
    let mut sentences: Vec<String> = to_act_on.map(|text| sentence(&text)).into_iter().collect();
    sentences.extend(decision.verdict.reasons.iter().skip(1).map(reason));
    sentences.extend(second(decision));
    sentences.extend(decision.paths.as_ref().map(paths));
    sentences.extend(decision.stages.as_ref().into_iter().flat_map(stages));
    sentences.extend(frictions(&decision.frictions));
    sentences.extend(decision.part_of_row.as_ref().map(part_of_row));
    sentences.extend(decision.inspection.as_ref().map(window));
    sentences.extend(decision.maintenance.as_ref().map(maintenance));
    sentences.extend(decision.scatter.as_ref().and_then(scatter));
    sentences.extend(calibration(&decision.calibration));
    if sentences.is_empty() {
        return Vec::new();
    }
    vec![Block::Heading("Decision".to_owned()), Block::List(sentences)]
}

/// The quantities that decide the answer; none where nothing was varied.
pub(super) fn sensitivities(run: &RunFolder) -> Option<Table> {
    let bars = &run.summary.decision.as_ref()?.tornado;
    (!bars.is_empty()).then(|| tornado(bars))
}

/// The tables behind it.
pub(super) fn tables(run: &RunFolder) -> Vec<Block> {
    let Some(decision) = &run.summary.decision else { return Vec::new() };
    let mut blocks = Vec::new();
    if decision.rows.len() > 1 {
        blocks.push(Block::Table(depths(decision)));
    }
    if !decision.risk.risk.is_empty() {
        blocks.push(Block::Table(risks(&decision.risk)));
    }
    if !decision.wheels.is_empty() {
        blocks.push(Block::Table(wheels(&decision.wheels)));
    }
    blocks
}

/// The verdict with its first reason; without axle loads only where the model does not describe
/// the run.
pub(super) fn banner(run: &RunFolder) -> Option<Banner> {
    let verdict = run.summary.verdict.as_ref()?;
    let (level, word) = match verdict.level {
        VerdictLevel::Ok => ("ok", "OK"),
        VerdictLevel::Act => ("act", "Act"),
        VerdictLevel::Unknown => ("unknown", "Not known"),
        VerdictLevel::Stop => ("stop", "Stop"),
        VerdictLevel::Outside => ("outside", "Outside of what the model describes"),
    };
    Some(Banner { level, word, text: verdict.reasons.first().map_or_else(String::new, reason) })
}

/// A reason as a sentence.
fn reason(reason: &Reason) -> String {
    let place = reason
        .crack
        .zip(reason.step)
        .map_or_else(String::new, |(crack, step)| format!(" (crack {crack}, step {step})"));
    format!("{}{place}.", reason.text)
}

/// The failure that follows.
fn second(decision: &Decision) -> Option<String> {
    let (mode, mgt) = (decision.second.mode?, decision.second.mgt?);
    let crack = decision.second.crack.map_or_else(String::new, |crack| format!(" of crack {crack}"));
    Some(format!("Next: {}{crack} after {} MGT.", mode.words(), tonnage(mgt)))
}

/// The lives along three paths.
fn paths(paths: &PathLives) -> String {
    let life = |mgt: Option<f64>| {
        mgt.map_or_else(|| "no failure within the run".to_owned(), |mgt| format!("{} MGT", tonnage(mgt)))
    };
    format!(
        "Life by path: straight ahead {}, as computed {}, limit path {}. The spread is an uncertainty of the model: verdict and interval are those of the shortest.",
        life(paths.straight),
        life(paths.nominal),
        life(paths.limit)
    )
}

/// The two stages, with the inspection of each.
fn stages(stages: &StagesSummary) -> [String; 2] {
    let found = |stage: &StageSummary, by: &str| {
        let Some(depth) = stage.detectable_depth_mm else { return String::new() };
        let Some(mgt) = stage.mgt_to_detectable else {
            return format!(
                " {by}, which finds it from {} mm on, does not find it before its end.",
                fixed(depth, 2)
            );
        };
        let left = stage.mgt_detectable_to_end;
        let left = left.map_or_else(String::new, |left| format!(", {} MGT before its end", tonnage(left)));
        format!(" {by} finds it from {} mm on, after {} MGT{left}.", fixed(depth, 2), tonnage(mgt))
    };
    let length = stages.transverse.mgt.map_or_else(
        || "the run ends before it fails".to_owned(),
        |mgt| format!("{} MGT to failure", tonnage(mgt)),
    );
    let [depth, long] = [stages.turn_depth_mm, stages.turn_length_mm].map(|value| fixed(value, 2));
    let first = match &stages.head_check {
        Some(head_check) => format!(
            "Stage 1, head check: {} MGT until it turns down, {depth} mm deep and {long} mm long.{}",
            tonnage(stages.mgt_to_turn),
            found(head_check, "Eddy current")
        ),
        None => format!(
            "Stage 1, head check: it has turned down before the run, which begins {depth} mm deep and {long} mm long."
        ),
    };
    [
        first,
        format!("Stage 2, transverse crack: {length}.{}", found(&stages.transverse, "Ultrasonic testing")),
    ]
}

/// The lives with other frictions.
fn frictions(lives: &[FrictionLife]) -> Option<String> {
    let life = |of: &FrictionLife| {
        let mgt = of
            .mgt
            .map_or_else(|| "no failure within the run".to_owned(), |mgt| format!("{} MGT", tonnage(mgt)));
        format!("{mgt} with {}", given(of.friction))
    };
    let all: Vec<String> = lives.iter().map(life).collect();
    (!all.is_empty()).then(|| {
        format!(
            "The friction between the faces is one value in the samples, and seldom known. Life with others: {}.",
            all.join(", ")
        )
    })
}

/// The cracks of a long row that were followed beside the run.
fn part_of_row(part: &RowPartSummary) -> String {
    format!(
        "Other paths and speeds were followed with cracks {} of the {} alone. This changes the {} by {} %{}.",
        part.numbers(),
        part.of,
        if part.mgt.is_some() { "life of the run" } else { "growth in the run" },
        fixed(part.difference_percent, 2),
        part.mgt.map_or_else(String::new, |mgt| format!(", to {} MGT", tonnage(mgt))),
    )
}

/// When the crack is detectable, and when critical.
fn window(inspection: &InspectionSummary) -> String {
    let found = match (inspection.detectable_depth_mm, inspection.mgt_to_detectable) {
        (Some(depth), Some(mgt)) => {
            format!(
                "The crack reaches the detectable depth of {} mm after {} MGT",
                fixed(depth, 2),
                tonnage(mgt)
            )
        }
        (Some(depth), None) => {
            format!("The crack does not reach the detectable depth of {} mm", fixed(depth, 2))
        }
        (None, _) => "The crack does not become detectable within the run".to_owned(),
    };
    let by = |by: FailureMode| match by {
        FailureMode::Depth => "the critical depth",
        FailureMode::Length => "the critical length",
        FailureMode::Fracture => "fracture",
        FailureMode::Spall => "a spall",
        FailureMode::Detached => "the loss of a piece",
    };
    let critical = match (inspection.critical_by, inspection.mgt_to_critical) {
        (Some(what), Some(mgt)) => format!("{} is reached after {} MGT", by(what), tonnage(mgt)),
        _ => "no critical state is reached within the run".to_owned(),
    };
    format!("{found}; {critical}.")
}

/// The inputs on which the answer depends, a row each.
fn tornado(bars: &[TornadoBar]) -> Table {
    let mut table = Table::new(["Quantity", "Value: life, verdict"]);
    table.caption =
        "What the answer hangs on, the widest first: lives (MGT) and verdicts with other values of what is seldom known"
            .to_owned();
    for bars in bars.chunk_by(|one, next| one.quantity == next.quantity) {
        let words: Vec<String> = bars.iter().map(bar).collect();
        table.row(bars.first().map(|bar| bar.quantity.clone()).into_iter().chain([words.join("; ")]));
    }
    table
}

/// Value, life and verdict of a bar.
fn bar(bar: &TornadoBar) -> String {
    let life = bar.mgt.map_or_else(|| "no failure".to_owned(), |mgt| given(rounded(mgt, 2)));
    format!("{}: {life}, {}", bar.setting.replace('-', "\u{2212}"), bar.level.word())
}

fn risks(risk: &RiskSummary) -> Table {
    let mut table = Table::new(["Inspections every (MGT)", "Probability of failure before detection"]);
    table.caption = "Risk between inspections whose first moment is unknown".to_owned();
    for at in &risk.risk {
        table.row([tonnage(at.interval_mgt), significant(at.probability)]);
    }
    table
}

/// Growth compared with wear and grinding.
fn maintenance(maintenance: &MaintenanceSummary) -> String {
    let mut text = format!(
        "Wear and grinding remove on average {} mm of the surface per MGT, {} mm in total so far.",
        given(maintenance.removal_mm_per_mgt),
        fixed(maintenance.removed_mm, 2)
    );
    if let Some([first, last]) = maintenance.growth_over_removal {
        text.push_str(&format!(
            " Growth deepens the crack at {} times this rate in the first step and {} times in the last.",
            given(first),
            given(last)
        ));
    }
    if let Some(depth) = maintenance.balance_depth_mm {
        text.push_str(&format!(" Growth and removal balance at a depth of {} mm.", fixed(depth, 2)));
    }
    if let Some(mgt) = maintenance.mgt_to_worn_away {
        text.push_str(&format!(" The crack is worn away completely after {} MGT.", tonnage(mgt)));
    }
    if let (Some(limit), Some(mgt)) = (maintenance.wear_limit_mm, maintenance.mgt_to_wear_limit) {
        text.push_str(&format!(
            " The rail is worn to its limit of {} mm after {} MGT.",
            fixed(limit, 2),
            tonnage(mgt)
        ));
    }
    text
}

/// Results of the scatter; none if no sample reaches a critical state.
fn scatter(scatter: &ScatterSummary) -> Option<String> {
    let growing = scatter.probability_growing.map(|probability| {
        format!("Probability that growth initially outpaces wear and grinding: {}.", given(probability))
    });
    let traffic = detectable_to_critical(scatter);
    let sentences: Vec<String> = traffic.into_iter().chain(growing).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

fn depths(decision: &Decision) -> Table {
    let headings = [
        "Depth (mm)",
        "Length (mm)",
        "Million gross tonnes",
        "Growth in depth (mm/MGT)",
        "Balancing removal (mm/MGT)",
    ];
    let mut table = Table::new(headings);
    table.caption = "Growth, and the rate of removal by wear and grinding that would balance it".to_owned();
    let last = decision.rows.len() - 1;
    let mut places: Vec<usize> = (0..ROWS).map(|i| (i * last + (ROWS - 1) / 2) / (ROWS - 1)).collect();
    places.dedup();
    let shown = |value: Option<f64>| value.map_or_else(|| MISSING.to_owned(), significant);
    for row in places.into_iter().filter_map(|place| decision.rows.get(place)) {
        table.row([
            fixed(row.depth_mm, 2),
            fixed(row.length_mm, 2),
            tonnage(row.mgt),
            shown(row.depth_mm_per_mgt),
            shown(row.balance_mm_per_mgt),
        ]);
    }
    table
}

fn wheels(wheels: &[WheelSummary]) -> Table {
    let mut table = Table::new([
        "Wheel",
        "Share of the axles (%)",
        "Share of the growth (%)",
        "Determines the direction",
    ]);
    table.caption =
        "Shares of the growth of the deepest tip, and the number of steps in which omitting this wheel \
                     would change the crack direction most"
            .to_owned();
    for wheel in wheels {
        let turns = match wheel.turns_in_steps {
            0 => "no".to_owned(),
            1 => "in 1 step".to_owned(),
            steps => format!("in {steps} steps"),
        };
        table.row([
            wheel.name.clone(),
            fixed(100.0 * wheel.share_of_axles, 1),
            fixed(100.0 * wheel.share_of_growth, 1),
            turns,
        ]);
    }
    table
}
