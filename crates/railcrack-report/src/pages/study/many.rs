//! The page of a study with too many runs for individual curves: quantile bands, scatter plots,
//! sensitivities, a sortable table.

use super::runs::verdict;
use crate::figures::{StudyRun, band_charts};
use crate::numbers::{fixed, given};
use crate::page::Block;
use crate::page_data::Deflated;
use crate::sensitivity::{Estimate, first_order, rank_correlation};
use crate::svg::{Axis, around};
use crate::table::{MISSING, Table};
use railcrack::words::Choice;
use railcrack_run::Summary;
use railcrack_run::decision::Verdict;
use railcrack_run::run_folder::{RepresentativeTip, cycles_to};
use railcrack_run::study::StudyPlan;
use serde_json::{Value, json};

/// A column of the table, also available as an axis of the charts.
struct Column {
    /// Its name: a key, or a column of `summary.csv`.
    name: String,
    /// Its name with unit.
    title: String,
    /// Whether it is a key of the study.
    is_key: bool,
    /// Whether it is laid out by its logarithm.
    is_logarithmic: bool,
    /// Values by run, NaN where missing; for words, their indices.
    values: Vec<f64>,
    words: Vec<String>,
}

/// Bands, and the viewer.
pub(super) fn blocks(plan: &StudyPlan, runs: &[StudyRun]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut charts = band_charts(runs).into_iter();
    let passages: Vec<_> = charts.by_ref().take(2).collect();
    blocks.push(Block::charts(passages));
    blocks.push(Block::charts(charts));
    blocks.push(Block::Heading("Keys and results".to_owned()));
    let columns = columns(plan, runs);
    blocks.push(Block::Viewer {
        id: "keys-and-results",
        html: include_str!("../../assets/study.html"),
        blocks: Vec::new(),
        data_id: "study-data",
        data: data(&columns, runs),
        script: concat!(
            include_str!("../../assets/study-conditions.js"),
            include_str!("../../assets/study.js")
        ),
    });
    blocks.push(Block::Table(dependence(&columns)));
    blocks
}

fn data(columns: &[Column], runs: &[StudyRun]) -> Value {
    let (mut first, mut cycles, mut lengths) = (vec![0.0], Vec::new(), Vec::new());
    for run in runs {
        for row in run.tip().map_or(&[][..], |tip| &tip.rows) {
            cycles.push(row.load_cycles);
            lengths.push(row.length);
        }
        first.push(cycles.len() as f64);
    }
    json!({
        "columns": columns.iter().map(column_data).collect::<Vec<_>>(),
        "first": Deflated::singles(&first),
        "cycles": Deflated::singles(&cycles),
        "lengths": Deflated::singles(&lengths),
    })
}

/// Most values of a key that an axis shows one by one.
const LEVELS: usize = 24;
/// Most ticks of an axis.
const TICKS: usize = 6;

/// A column with the axis on which charts have it: a key of few values, each in many runs, as a
/// list.
fn column_data(column: &Column) -> Value {
    let mut levels: Vec<f64> = column.values.iter().copied().filter(|value| !value.is_nan()).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let is_few = column.is_key && levels.len() <= LEVELS && 2 * levels.len() < column.values.len();
    let is_list = !column.words.is_empty() || is_few;
    let axis = if is_list {
        let name = |value: f64| column.words.get(value as usize).cloned().unwrap_or_else(|| given(value));
        let every = levels.len().div_ceil(TICKS).max(1);
        let ticks: Vec<_> =
            levels.iter().enumerate().step_by(every).map(|(k, value)| json!([k, name(*value)])).collect();
        json!({ "from": -0.5, "to": levels.len() as f64 - 0.5, "log": false, "ticks": ticks })
    } else {
        let values = column.values.iter().copied().filter(|value| !column.is_logarithmic || *value > 0.0);
        let axis = if column.is_logarithmic {
            let [low, high] = around(values.map(f64::ln)).map(f64::exp);
            Axis::logarithmic(low, high)
        } else {
            let [low, high] = around(values);
            Axis::exact(low, high, TICKS)
        };
        axis.data(TICKS)
    };
    json!({
        "name": column.name,
        "title": column.title,
        "key": column.is_key,
        "axis": axis,
        "levels": is_list.then_some(levels),
        "words": if column.words.is_empty() { None } else { Some(&column.words) },
        "data": Deflated::singles(&column.values),
    })
}

fn is_result(column: &Column) -> bool {
    !column.is_key && column.words.is_empty() && column.name != "run"
}

/// Dependence of each result on the keys: estimates for each key, with their intervals.
fn dependence(columns: &[Column]) -> Table {
    let mut table =
        Table::new(["Result", "Key", "Rank correlation", "95 %", "First-order Sobol index", "95 %"])
            .sortable();
    table.caption = "What results depend on, of all runs: Spearman's rank correlation, and the share of the variance explained \
                     by the key alone, of a life or a rate that of its logarithm; with intervals of 95 %"
        .to_owned();
    for result in columns.iter().filter(|column| is_result(column)) {
        // In the precision of the page: lengths that differ in their last digits have one rank.
        let single = |value: f64| f64::from(value as f32);
        let level = |value: f64| if result.is_logarithmic { single(value).ln() } else { single(value) };
        for key in columns.iter().filter(|column| column.is_key) {
            let pairs = key.values.iter().zip(&result.values).map(|(x, y)| (single(*x), level(*y)));
            let (x, y): (Vec<f64>, Vec<f64>) = pairs.filter(|(x, y)| x.is_finite() && y.is_finite()).unzip();
            let rank = rank_correlation(&x, &y).filter(|_| key.words.is_empty());
            let cells = [rank, first_order(&x, &y)].into_iter().flat_map(estimate);
            table.row([result.title.clone(), key.name.clone()].into_iter().chain(cells));
        }
    }
    table
}

/// An estimate and its interval.
fn estimate(estimate: Option<Estimate>) -> [String; 2] {
    estimate.map_or([MISSING, ""].map(str::to_owned), |Estimate { value, low, high }| {
        [fixed(value, 3), format!("{} to {}", fixed(low, 2), fixed(high, 2))]
    })
}

fn columns(plan: &StudyPlan, runs: &[StudyRun]) -> Vec<Column> {
    let mut columns = vec![numbers("run", "Run", runs.iter().map(|run| run.number() as f64).collect())];
    columns.extend(keys(plan, runs));
    columns.extend(growth(runs));
    columns.extend(traffic(runs));
    columns.extend(ends(runs));
    columns
}

/// The keys of the study.
fn keys(plan: &StudyPlan, runs: &[StudyRun]) -> Vec<Column> {
    let keys = plan.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.key.as_str());
    let column = |(place, key): (usize, &str)| {
        let values = runs.iter().map(|run| plan.values_of(run.planned).nth(place));
        let texts: Vec<&str> = values.map(|value| value.map_or("", |(_, value)| value)).collect();
        let parsed: Option<Vec<f64>> = texts.iter().map(|text| text.parse().ok()).collect();
        match parsed {
            Some(values) => Column { is_key: true, ..numbers(key, key, values) },
            None => Column { is_key: true, ..words(key, key, &texts) },
        }
    };
    keys.enumerate().map(column).collect()
}

/// Growth at the representative tips.
fn growth(runs: &[StudyRun]) -> Vec<Column> {
    let of_tip = |value: &dyn Fn(&RepresentativeTip) -> f64| -> Vec<f64> {
        runs.iter().map(|run| run.tip().map_or(f64::NAN, value)).collect()
    };
    let life = common_length(runs).map(|length| {
        let lives = of_tip(&|tip| cycles_to(&tip.rows, length).unwrap_or(f64::NAN));
        logarithmic("life", &format!("Load cycles to {length:.2} mm"), lives)
    });
    let mut columns: Vec<Column> = life.into_iter().collect();
    columns.extend([
        logarithmic("rate_mm_per_cycle", "Initial rate (mm/cycle)", of_tip(&|tip| tip.first.rate)),
        numbers("delta_keq_mpa_sqrt_m", "Initial ΔK_{eq} (MPa√m)", of_tip(&|tip| tip.first.delta_keq)),
        numbers("length_mm", "Length (mm)", of_tip(&|tip| tip.last().length)),
        numbers("depth_mm", "Depth of the tip (mm)", of_tip(&|tip| -tip.last().place[1])),
        logarithmic("load_cycles", "Load cycles", of_tip(&|tip| tip.last().load_cycles)),
    ]);
    columns
}

/// Million gross tonnes, as far as a run has them.
fn traffic(runs: &[StudyRun]) -> impl Iterator<Item = Column> {
    let of = |name: &str, title: &str, value: fn(&Summary) -> Option<f64>| {
        let value = |run: &StudyRun| run.row.summary.as_ref().and_then(value).unwrap_or(f64::NAN);
        logarithmic(name, title, runs.iter().map(value).collect())
    };
    let columns = [
        of("mgt", "Million gross tonnes", |summary| summary.million_gross_tonnes),
        of("failure_mgt", "MGT to failure", |summary| summary.decision.as_ref()?.failure.mgt),
        of("interval_mgt", "Inspection interval (MGT)", |summary| {
            summary.decision.as_ref()?.inspection.as_ref()?.interval_mgt
        }),
    ];
    columns.into_iter().filter(|column| column.values.iter().any(|value| value.is_finite()))
}

/// The verdicts, where there are any, and how the runs ended.
fn ends(runs: &[StudyRun]) -> Vec<Column> {
    let of = |name, title, text: &dyn Fn(&StudyRun) -> String| {
        let texts: Vec<String> = runs.iter().map(text).collect();
        words(name, title, &texts.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let of_verdict = |text: fn(&Verdict) -> String| {
        move |run: &StudyRun| verdict(run).map_or_else(|| "none".to_owned(), text)
    };
    let mut columns = Vec::new();
    if runs.iter().any(|run| verdict(run).is_some()) {
        columns.push(of("verdict", "Verdict", &of_verdict(|verdict| verdict.level.word().to_owned())));
        columns.push(of("reasons", "Reasons", &of_verdict(Verdict::kinds)));
    }
    columns.push(of("stop", "Ended by", &|run| {
        let stop = run.row.summary.as_ref().and_then(|summary| summary.stop);
        stop.map_or_else(|| run.row.state.name().to_owned(), |stop| stop.word().to_owned())
    }));
    columns
}

/// The length that nine tenths of the runs reach.
fn common_length(runs: &[StudyRun]) -> Option<f64> {
    let tips: Vec<&RepresentativeTip> = runs.iter().filter_map(StudyRun::tip).collect();
    let begun = tips.iter().map(|tip| tip.first.length).reduce(f64::max)?;
    let mut ends: Vec<f64> = tips.iter().map(|tip| tip.last().length).collect();
    ends.sort_by(f64::total_cmp);
    let length = ends[ends.len() / 10];
    (length > begun).then_some(length)
}

fn numbers(name: &str, title: &str, values: Vec<f64>) -> Column {
    let (name, title) = (name.to_owned(), title.to_owned());
    Column { name, title, is_key: false, is_logarithmic: false, values, words: Vec::new() }
}

fn logarithmic(name: &str, title: &str, values: Vec<f64>) -> Column {
    Column { is_logarithmic: true, ..numbers(name, title, values) }
}

fn words(name: &str, title: &str, texts: &[&str]) -> Column {
    let mut known: Vec<String> = texts.iter().map(|text| (*text).to_owned()).collect();
    known.sort();
    known.dedup();
    let place = |text: &&str| known.binary_search_by(|word| word.as_str().cmp(text)).unwrap_or(0) as f64;
    let values = texts.iter().map(place).collect();
    Column { words: known, ..numbers(name, title, values) }
}
