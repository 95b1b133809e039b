//! `validation.html` and its plots.

use crate::chart::{
    Chart, ChartArea, ChartAxis, ChartSheet, Curve, CurveColour, CurveDots, CurveLook, CurveWidth,
};
use crate::figures::{ForestRatio, ForestRow, forest};
use crate::numbers::{given, rounded, significant};
use crate::page::{Block, Fact, Page, Section};
use crate::table::Table;
use railcrack_case::{Entry, Grade, Quantity};
use railcrack_run::validation::{GradeScore, Score, Scores, Validated, Validation};

/// The charts and tables of a validation.
pub struct ValidationPage<'a> {
    validated: &'a [Validated],
    scores: &'a Scores,
    /// Name of the file, heading, chart.
    charts: Vec<(String, String, Chart)>,
}

/// Depths (mm) between which the predicted rate is drawn.
const DEPTHS: [f64; 12] = [0.35, 0.5, 0.8, 1.3, 1.8, 2.3, 3.2, 5.0, 6.5, 8.0, 10.0, 14.0];
const GRADES: [(Grade, &str); 3] =
    [(Grade::Track, "Track"), (Grade::Rig, "Rigs"), (Grade::Law, "Growth laws")];

/// Units of the quantities, each with a chart of its own; none for ratios and exponents.
const UNITS: [&str; 3] = ["mm/MGT", "mm/cycle", ""];
/// The plot of the rate over depth.
const OVER_DEPTH: &str = "rate-over-depth.svg";

/// A score in two digits.
fn two_digits(score: f64) -> String {
    given(rounded(score, 2))
}

/// Name of the plot of the entries of `grade` whose quantity has the `unit`, without its ending.
fn id(grade: Grade, unit: &str) -> String {
    let what = if unit.is_empty() { "ratio" } else { unit };
    format!("{}-{}", grade.word(), what.replace('/', "-per-").to_lowercase())
}

/// Whether `name` is that of a plot of a validation.
#[must_use]
pub fn is_validation_plot(name: &str) -> bool {
    let mut all = GRADES.into_iter().flat_map(|(grade, _)| UNITS.map(|unit| id(grade, unit)));
    name == OVER_DEPTH || name.strip_suffix(".svg").is_some_and(|name| all.any(|id| id == name))
}

impl<'a> ValidationPage<'a> {
    /// Of the entries `validated` of `validation`.
    pub fn of(validation: &Validation, validated: &'a [Validated], scores: &'a Scores) -> Self {
        let mut charts = Vec::new();
        for (grade, name) in GRADES {
            for unit in UNITS {
                let of = |one: &&Validated| {
                    let comparison = one.entry.comparison.as_ref();
                    one.entry.grade == grade && comparison.is_some_and(|of| of.quantity.unit() == unit)
                };
                let own: Vec<&Validated> =
                    validated.iter().filter(of).filter(|one| one.score.is_some()).collect();
                if !own.is_empty() {
                    let id = id(grade, unit);
                    let heading =
                        format!("{name}: {}", if unit.is_empty() { "ratios and exponents" } else { "rates" });
                    charts.push((format!("{id}.svg"), heading, against(&id, unit, &own)));
                }
            }
        }
        for study in validation.studies_over_depth() {
            let chart = over_depth(validation, validated, study);
            charts.push((OVER_DEPTH.to_owned(), "Rate over depth".to_owned(), chart));
        }
        Self { validated, scores, charts }
    }

    /// Name and text of each plot.
    pub fn plots(&self) -> Vec<(String, String)> {
        let svg = |(name, heading, chart): &(String, String, Chart)| {
            (name.clone(), ChartSheet::of("Predicted and measured", heading, chart.clone()).svg())
        };
        self.charts.iter().map(svg).collect()
    }

    /// The page.
    pub fn page(&self) -> Page {
        let facts = self.scores.by_grade().map(|(name, of)| {
            let note = format!("predicted over measured {}", two_digits(of.factor));
            Fact::new(format!("{name}: within 95 %"), format!("{} of {}", of.inside, of.entries), note)
        });
        Page {
            title: "Measured numbers against the model".into(),
            kind: "Validation".into(),
            decision: None,
            verdict: self.verdict(),
            facts: facts.collect(),
            lead: self.forest().to_vec(),
            sections: self.sections(),
        }
    }

    /// How well rails in service are predicted.
    fn verdict(&self) -> String {
        let track = |of: &[GradeScore]| of.iter().find(|of| of.grade == Grade::Track).copied();
        let Some(plane) = track(&self.scores.plane) else {
            return "No entry of rails in service is scored.".to_owned();
        };
        let in_space = track(&self.scores.space).map_or_else(String::new, |space| {
            format!(
                " With an elliptical contact and a curved front it is {} of {}, {} within a factor of 5, and {} in the mean.",
                space.inside,
                space.entries,
                space.within_5,
                two_digits(space.factor)
            )
        });
        format!(
            "Of {} scored entries of rails in service, {} lie within the 95 % of the prediction in the plane, and {} medians within a factor of 5. Predicted over measured is {} in the mean.{in_space}",
            plane.entries,
            plane.inside,
            plane.within_5,
            two_digits(plane.factor)
        )
    }

    fn sections(&self) -> Vec<Section> {
        let meaning = Block::List(MEANING.map(str::to_owned).to_vec());
        let scores = vec![Block::Table(self.by_grade()), meaning];
        let mut sections = vec![Section::new("scores", "Scores by grade", scores)];
        if !self.scores.residuals.is_empty() {
            let prior = vec![Block::Table(self.prior()), Block::List(vec![PRIOR.to_owned()])];
            sections.push(Section::new("prior", "Prior of the coefficient", prior));
        }
        let over_depth = self.charts.iter().filter(|(name, ..)| name == OVER_DEPTH);
        sections.extend(over_depth.map(|(_, heading, chart)| {
            Section::new("over-depth", heading, vec![Block::charts([chart.clone()])])
        }));
        let charts = self.charts.iter().filter(|(name, ..)| name != OVER_DEPTH);
        let charts = Block::charts(charts.map(|(_, heading, chart)| {
            let caption = format!("{heading}. {}", chart.caption);
            Chart { caption, ..chart.clone() }
        }));
        sections.push(folded("charts", "Predicted against measured, by grade", charts));
        sections.push(folded("compared", "Compared entries", Block::Table(self.compared())));
        sections.push(folded("entries", "All entries and their sources", Block::Table(self.sources())));
        sections
    }

    /// Every compared entry by its name, grade by grade, and what its marks mean.
    fn forest(&self) -> [Block; 2] {
        let mut rows = Vec::new();
        for (grade, name) in GRADES {
            let of_grade = self.validated.iter().filter(|one| one.entry.grade == grade);
            let own: Vec<ForestRow> = of_grade.filter_map(forest_row).collect();
            if !own.is_empty() {
                rows.push(ForestRow { name: name.to_owned(), ratios: Vec::new() });
                rows.extend(own);
            }
        }
        let title = "Predicted over measured of every entry";
        [
            Block::Picture { svg: forest(title, &rows), caption: FOREST.to_owned() },
            Block::Text(FOREST_NOTE.to_owned()),
        ]
    }

    fn by_grade(&self) -> Table {
        let mut table = Table::new([
            "grade",
            "scored",
            "within 95 %",
            "factor 2",
            "factor 5",
            "predicted/measured",
            "CRPS of ln",
        ]);
        for (name, of) in self.scores.by_grade() {
            table.row([
                name,
                of.entries.to_string(),
                of.inside.to_string(),
                of.within_2.to_string(),
                of.within_5.to_string(),
                two_digits(of.factor),
                two_digits(of.crps),
            ]);
        }
        table
    }

    fn prior(&self) -> Table {
        let mut table = Table::new(["geometry", "entries", "prior_log_mean", "prior_log_std"]);
        for (name, of) in &self.scores.residuals {
            table.row([
                (*name).to_owned(),
                of.entries.to_string(),
                significant(of.mean),
                significant(of.log_std),
            ]);
        }
        table
    }

    fn compared(&self) -> Table {
        let mut table = Table::new([
            "entry",
            "quantity",
            "geometry",
            "unit",
            "measured",
            "predicted",
            "95 % of the samples",
            "factor",
            "PIT",
            "CRPS of ln",
            "scored",
        ]);
        for one in self.validated {
            let Some(comparison) = &one.entry.comparison else { continue };
            let plane = if comparison.quantity.needs_a_run() { "plane" } else { "" };
            for (geometry, score) in [(plane, &one.score), ("space", &one.in_space)] {
                let Some(score) = score else { continue };
                let [low, median, high] = score.predicted.map(significant);
                table.row([
                    one.entry.id.clone(),
                    one.entry.quantity.clone(),
                    geometry.to_owned(),
                    comparison.quantity.unit().to_owned(),
                    range(comparison.measured),
                    median,
                    format!("{low} to {high}"),
                    significant(score.factor),
                    significant(score.pit),
                    significant(score.crps),
                    if one.entry.is_scored() { "yes" } else { "no: from memory" }.to_owned(),
                ]);
            }
        }
        table
    }

    fn sources(&self) -> Table {
        let mut table = Table::new(["entry", "grade", "quantity", "numbers", "conditions", "read", "source"]);
        for Validated { entry, .. } in self.validated {
            table.row([
                entry.id.clone(),
                entry.grade.word().to_owned(),
                entry.quantity.clone(),
                numbers(entry),
                entry.conditions.clone(),
                entry.read.word().to_owned(),
                entry.source.clone(),
            ]);
        }
        table
    }
}

/// A section that opens on demand.
fn folded(id: &str, heading: &str, block: Block) -> Section {
    Section::new(id, heading, vec![Block::Folded { heading: heading.to_owned(), blocks: vec![block] }])
}

/// The row of an entry that is compared with a number of its own.
fn forest_row(one: &Validated) -> Option<ForestRow> {
    let measured = one.entry.comparison.as_ref()?.measured;
    let ratio = |score: Score, category: usize| ForestRatio {
        predicted: score.predicted.map(|predicted| predicted / score.measured),
        measured: [measured.0 / score.measured, measured.1 / score.measured],
        category: if one.entry.is_scored() { category } else { NOT_SCORED },
    };
    let ratios = one.score.map(|score| ratio(score, 0)).into_iter();
    let ratios: Vec<ForestRatio> = ratios.chain(one.in_space.map(|score| ratio(score, 2))).collect();
    let name = format!("{} {}", one.entry.id, one.entry.quantity);
    (!ratios.is_empty()).then_some(ForestRow { name, ratios })
}

/// The colour of entries that are not scored.
const NOT_SCORED: usize = 3;

const FOREST: &str = "Predicted over measured of every compared entry. Dot: median; line: 95 % of the samples; grey bar: the range \
     that was measured. A line that meets its bar agrees with the measurement; a dot between the lines of 1/2 and 2 is right \
     within a factor of 2.";
const FOREST_NOTE: &str = "Blue: in the plane. Green: with an elliptical contact and a curved front. Purple: from memory, not scored.";

const MEANING: [&str; 4] = [
    "PIT: the probability, by the samples and the error of measurement, of a value at or below the measured one; over many entries it is even between 0 and 1. An entry is within 95 % if it lies between 0.025 and 0.975.",
    "CRPS: the continuous ranked probability score of the logarithm. For a sure prediction it is the distance in ln; the smaller the better.",
    "Conditions are ranges of the literature. Nothing in them, and nothing in the defaults of the program, is fitted to these growth rates.",
    "What is known from memory alone is drawn hollow and never scored. Grades are never mixed.",
];

const PRIOR: &str = "By the residuals of growth in depth of rails in service: mean of ln(measured over predicted), and its standard deviation from entry to entry together with that of the rates from place to place. As [calibration] prior_log_mean and prior_log_std they are what is known of C on a line before it is measured, with the frictions in the middle of their ranges.";

fn numbers(entry: &Entry) -> String {
    let all: Vec<String> =
        entry.values.iter().map(|value| format!("{} = {}", value.name, value.value)).collect();
    all.join("; ")
}

fn range((low, high): (f64, f64)) -> String {
    format!("{} to {}", significant(low), significant(high))
}

/// Predicted against measured, with lines of equality and of factors 2 and 5.
fn against(id: &str, unit: &str, own: &[&Validated]) -> Chart {
    let plane = own.iter().filter_map(|one| Some((*one, one.score?, 0)));
    let space = own.iter().filter_map(|one| Some((*one, one.in_space?, 2)));
    let all: Vec<(&Validated, Score, usize)> = plane.chain(space).collect();
    let scores = || all.iter().copied();
    let ends = scores().flat_map(|(one, score, _)| {
        let measured = one.entry.comparison.as_ref().map_or((1.0, 1.0), |of| of.measured);
        [measured.0, measured.1, score.predicted[0], score.predicted[2]]
    });
    let (low, high) = ends.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let (low, high) = (0.7 * low, high / 0.7);
    let line = |name: &str, factor: f64, look: CurveLook| {
        Curve::line(name, vec![[low, factor * low], [high, factor * high]])
            .with_look(look)
            .with_colour(CurveColour::Quiet)
    };
    let mut curves = vec![
        line("equal", 1.0, CurveLook::Line),
        line("factor 2", 2.0, CurveLook::Dashed),
        line("", 0.5, CurveLook::Dashed),
        line("factor 5", 5.0, CurveLook::FineDashed),
        line("", 0.2, CurveLook::FineDashed),
    ];
    let mut named: Vec<&str> = Vec::new();
    for (one, score, category) in scores() {
        let measured = one.entry.comparison.as_ref().map_or((1.0, 1.0), |of| of.measured);
        let is_scored = one.entry.is_scored();
        let colour = CurveColour::Category(if is_scored { category } else { 1 });
        let [from, median, to] = score.predicted;
        let x = score.measured;
        for bar in [vec![[measured.0, median], [measured.1, median]], vec![[x, from], [x, to]]] {
            let bar = Curve::line("", bar).with_colour(colour);
            curves.push(Curve { note: one.entry.id.clone(), width: CurveWidth::Fine, ..bar });
        }
        let kind = match (is_scored, category) {
            (true, 0) => "scored",
            (true, _) => "scored, in space",
            (false, _) => "from memory, not scored",
        };
        let name = if named.contains(&kind) { "" } else { kind };
        named.push(kind);
        let mark = if is_scored {
            Curve::line(name, vec![[x, median]]).with_look(CurveLook::Dots).with_dots(CurveDots::All)
        } else {
            // A hollow mark: the outline of a lozenge, of the same size on both logarithmic axes.
            let by = (high / low).powf(0.012);
            let corners =
                [[x * by, median], [x, median * by], [x / by, median], [x, median / by], [x * by, median]];
            Curve::line(name, corners.to_vec())
        };
        curves.push(Curve { note: one.entry.id.clone(), ..mark.with_colour(colour) });
    }
    Chart {
        id: id.to_owned(),
        caption: "Predicted median with the 95 % of the samples against the measured value with its range."
            .into(),
        x: ChartAxis::logarithmic("Measured", unit),
        y: ChartAxis::logarithmic("Predicted", unit),
        curves,
        ..Chart::default()
    }
}

/// The predicted rate of growth over depth with the bands of the measured ones.
fn over_depth(validation: &Validation, validated: &[Validated], of: (&str, Option<&str>)) -> Chart {
    let curves = |study: &str, category: usize, median: &str, ends: &str| {
        let rates = validation.rate_over_depth(study, &DEPTHS);
        let curve = |name: &str, which: usize, look: CurveLook| {
            let points = rates.iter().map(|(depth, quantiles)| [*depth, quantiles[which]]).collect();
            Curve::line(name, points).with_look(look).with_colour(CurveColour::Category(category))
        };
        [
            curve(median, 1, CurveLook::Line),
            curve(ends, 0, CurveLook::Dashed),
            curve("", 2, CurveLook::Dashed),
        ]
    };
    let (study, in_space) = of;
    let mut all = curves(study, 0, "median", "95 % of the samples").to_vec();
    if let Some(space) = in_space {
        all.extend(curves(space, 2, "median in space", "95 % of the samples in space"));
    }
    let mut areas = Vec::new();
    for Validated { entry, .. } in validated.iter().filter(|one| one.entry.is_scored()) {
        let Some(comparison) = &entry.comparison else { continue };
        if let (Quantity::DepthRate { from, to }, (low, high)) = (comparison.quantity, comparison.measured) {
            let outline = vec![[from, low], [to, low], [to, high], [from, high]];
            areas.push(ChartArea { name: "measured".into(), outline });
        }
    }
    Chart {
        id: "rate-over-depth".into(),
        caption:
            "Growth in depth by depth: median and 95 % of the samples, and the ranges of the measured means."
                .into(),
        x: ChartAxis::logarithmic("Depth", "mm"),
        y: ChartAxis::logarithmic("Growth in depth", "mm/MGT"),
        areas,
        curves: all,
        ..Chart::default()
    }
}
