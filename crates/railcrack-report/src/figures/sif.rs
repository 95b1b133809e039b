//! K_I and K_II against the wheel position, under every wheel of a mix, and the fluid in the
//! cracks.

use super::plot::Plot;
use super::row::bundle;
use super::wheel_passage::{WheelPassage, mouth, mouth_over_a, near, origin};
use crate::chart::{Chart, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveLook, SheetLegend};
use crate::page_data::PageData;
use crate::row::NamedCrack;
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;
use railcrack_run::run_folder::History;

/// A mode of fracture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// Opening.
    I,
    /// In-plane shear.
    II,
}

impl Mode {
    pub(super) const BOTH: [Self; 2] = [Self::I, Self::II];

    /// K of this mode, for titles.
    pub(super) fn symbol(self) -> &'static str {
        match self {
            Self::I => "K_{I}",
            Self::II => "K_{II}",
        }
    }

    /// Name of its charts.
    pub(super) fn id(self) -> &'static str {
        match self {
            Self::I => "ki",
            Self::II => "kii",
        }
    }

    /// Name of its file.
    pub(super) fn file(self) -> &'static str {
        match self {
            Self::I => "ki.svg",
            Self::II => "kii.svg",
        }
    }

    fn of(self, history: &History) -> &[f64] {
        match self {
            Self::I => &history.ki,
            Self::II => &history.kii,
        }
    }

    /// K over the wheel positions of `history`.
    pub(super) fn points(self, history: &History) -> Vec<[f64; 2]> {
        history.xc_over_a.iter().zip(self.of(history)).map(|(&x, &k)| [x, k]).collect()
    }

    /// K over the wheel position in metres.
    pub(super) fn points_in_metres(self, history: &History, summary: &Summary) -> Vec<[f64; 2]> {
        let metres = |over_a: f64| 1e-3 * (origin(summary) + over_a * summary.half_width_mm);
        self.points(history).into_iter().map(|[x, k]| [metres(x), k]).collect()
    }
}

/// `curves` of a quantity in MPa√m over the wheel positions.
pub(super) fn chart(id: &str, quantity: &str, caption: String, curves: Vec<Curve>) -> Chart {
    Chart {
        id: id.to_owned(),
        caption,
        x: ChartAxis::linear("Wheel position x_{c}/a", "").over(ChartRange::Tight),
        y: ChartAxis::linear(quantity, "MPa√m").over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    }
}

/// [`chart`] over the wheel position in metres, for a rail that bends.
pub(crate) fn far_chart(id: &str, quantity: &str, caption: String, curves: Vec<Curve>) -> Chart {
    Chart {
        x: ChartAxis::linear("Wheel position x_{c}", "metres").over(ChartRange::Tight),
        ..chart(id, quantity, caption, curves)
    }
}

/// The plot of one mode for the run with this `summary` on the model `model`: for a single tip one
/// colour per step, for several tips one colour per tip with the last step dashed. With bending of
/// the rail a second chart shows the whole passage in metres. For many cracks the `named` ones are
/// highlighted, and the wheel position is relative to each crack.
pub(super) fn plot(
    summary: &Summary,
    model: &str,
    histories: &[&History],
    named: Option<&[NamedCrack]>,
    mode: Mode,
) -> Plot {
    if let Some(named) = named {
        return many(summary, model, histories, named, mode);
    }

    let title = &summary.title;
    let initial: Vec<(usize, usize)> =
        histories.iter().filter(|h| h.step == 0).map(|h| (h.crack, h.tip)).collect();
    let has_two_tips = histories.iter().any(|h| h.tip > 1);
    let mut steps: Vec<usize> = histories.iter().map(|h| h.step).collect();
    steps.dedup();
    let name = |crack: usize, tip: usize| {
        if has_two_tips { format!("crack {crack}, tip {tip}") } else { format!("crack {crack}") }
    };
    let curve = |history: &&History, points: Vec<[f64; 2]>| {
        let History { step, crack, tip, .. } = **history;
        if initial.len() <= 1 {
            let place = steps.iter().position(|&s| s == step).unwrap_or(0) as f64;
            let words = if step == 0 { "initial crack".to_owned() } else { format!("step {step}") };
            let along = CurveColour::Along(1.1 * place / steps.len().max(2) as f64);
            return Curve::line(&words, points).with_colour(along);
        }
        let place = initial.iter().position(|&tip| tip == (history.crack, history.tip)).unwrap_or(0);
        let name = name(crack, tip);
        let curve = if step == 0 {
            Curve::line(&name, points)
        } else {
            Curve::line(&format!("{name}, step {step}"), points).with_look(CurveLook::Dashed)
        };
        curve.with_colour(CurveColour::of(place, initial.len()))
    };
    let close = |history: &&History| mode.points(history)[near(summary, &history.xc_over_a)].to_vec();
    let curves: Vec<Curve> = histories.iter().map(|history| curve(history, close(history))).collect();
    let is_far = histories.iter().any(|h| near(summary, &h.xc_over_a).len() < h.xc_over_a.len());
    let words = format!("{} over the stabilised passage", mode.symbol());
    let chart = chart(mode.id(), mode.symbol(), format!("{words}."), curves);
    let mut sheet = ChartSheet::of(title, &format!("{words} · {model}"), chart);
    if is_far {
        let whole = |history: &&History| curve(history, mode.points_in_metres(history, summary));
        let curves = histories.iter().map(whole).collect();
        let id = format!("{}-far", mode.id());
        let caption = format!("{words}, the whole passage.");
        sheet.rows.push(vec![far_chart(&id, mode.symbol(), caption, curves)]);
    }
    Plot::sheet(mode.file(), sheet)
}

/// The plot of one mode for many cracks: initial cracks and, in a chart below, the last step, with
/// the wheel position relative to the mouth of each crack.
fn many(summary: &Summary, model: &str, histories: &[&History], named: &[NamedCrack], mode: Mode) -> Plot {
    let words = format!("{} over the stabilised passage", mode.symbol());
    let mut rows = Vec::new();
    for histories in histories.chunk_by(|one, next| one.step == next.step) {
        let step = histories.first().map_or(0, |history| history.step);
        let curve = |history: &&History| {
            let window = WheelPassage::first(summary).window(history.crack, &history.xc_over_a);
            let mouth = mouth_over_a(summary, history.crack);
            let points = mode.points(history)[window].iter().map(|&[x, k]| [x - mouth, k]).collect();
            (history.crack, Curve::line(&format!("crack {}", history.crack), points))
        };
        let curves = bundle(named, histories.iter().map(curve).collect());
        let id = if rows.is_empty() { mode.id().to_owned() } else { format!("{}-last", mode.id()) };
        let chart = chart(&id, mode.symbol(), format!("{words}, step {step}."), curves);
        let x = ChartAxis::linear("Wheel position relative to the mouth of each crack, over a", "");
        rows.push(vec![Chart { heading: format!("Step {step}"), x: x.over(ChartRange::Tight), ..chart }]);
    }
    let title = summary.title.clone();
    let subtitle = format!("{words} of {} cracks · {model}", summary.cracks.len());
    Plot::sheet(mode.file(), ChartSheet { title, subtitle, rows, legend: SheetLegend::default() })
}

/// How far from the mouth of the crack wheels are drawn, over the half-width of the first contact.
const REACH: f64 = 8.0;

/// The plot of the fastest tip in the last step under every wheel of a mix, whose contacts have
/// these `half_widths` (mm); none for one wheel.
pub(super) fn under_wheels(
    summary: &Summary,
    model: &str,
    growth: &[TipRow],
    page_data: &PageData,
    half_widths: &[f64],
) -> Option<Plot> {
    let last = growth.last()?.step;
    let of_step = growth.iter().filter(|row| row.step == last);
    let fastest = of_step.max_by(|a, b| a.rate.total_cmp(&b.rate))?;
    let is_own = |history: &&History| (history.crack, history.tip) == (fastest.crack, fastest.tip);
    let under = page_data.by_wheel(last).iter().map(|wheel| wheel.iter().find(is_own));
    let own: Vec<(&History, f64)> =
        under.zip(half_widths).filter_map(|(history, a)| Some((history?, *a))).collect();
    if own.len() < 2 {
        return None;
    }
    let wheels = summary.decision.as_ref().map_or(&[][..], |decision| &decision.wheels);
    let name =
        |place: usize| wheels.get(place).map_or_else(|| format!("wheel {}", place + 1), |of| of.name.clone());
    // x_c/a is counted from the first mouth.
    let aside = origin(summary) - mouth(summary, fastest.crack).unwrap_or(0.0);
    let reach = REACH * summary.half_width_mm;
    let chart = |id: &str, mode: Mode| {
        let curve = |(place, (history, a)): (usize, &(&History, f64))| {
            let points = mode.points(history).into_iter().map(|[x, k]| [a * x + aside, k]);
            Curve::line(&name(place), points.filter(|point| point[0].abs() <= reach).collect())
                .with_colour(CurveColour::of(place, own.len()))
        };
        let symbol = mode.symbol();
        Chart {
            x: ChartAxis::linear("Wheel position from the mouth", "mm").over(ChartRange::Tight),
            ..chart(
                id,
                symbol,
                format!("{symbol} of crack {} under each wheel, step {last}.", fastest.crack),
                own.iter().enumerate().map(curve).collect(),
            )
        }
    };
    let words = format!("K of crack {} under each wheel · {model}", fastest.crack);
    let mut sheet = ChartSheet::of(&summary.title, &words, chart("wheels-ki", Mode::I));
    sheet.rows.push(vec![chart("wheels-kii", Mode::II)]);
    Some(Plot::sheet("wheels.svg", sheet))
}

/// The plot for the run with this `summary` on the model `model`; none for dry cracks. For many
/// cracks only the last step is shown, with the `named` cracks highlighted.
pub(super) fn fluid(
    summary: &Summary,
    model: &str,
    histories: &[&History],
    named: Option<&[NamedCrack]>,
) -> Option<Plot> {
    let last = histories.last().filter(|_| named.is_some()).map(|history| history.step);
    let is_drawn = |history: &&&History| last.is_none_or(|last| history.step == last);
    let wet: Vec<&&History> =
        histories.iter().filter(is_drawn).filter(|history| !history.pressure.is_empty()).collect();
    if wet.is_empty() {
        return None;
    }
    let tips: Vec<(usize, usize)> = wet.iter().map(|history| (history.crack, history.tip)).collect();
    let is_single = tips.iter().all(|tip| *tip == tips[0]);
    let curves = |of: fn(&History) -> &[f64]| -> Vec<Curve> {
        let curve = |(place, history): (usize, &&&History)| {
            let words = match (is_single, history.step) {
                (true, 0) => "initial crack".to_owned(),
                (true, step) => format!("step {step}"),
                (false, _) if named.is_some() => format!("crack {}", history.crack),
                (false, step) => format!("crack {}, step {step}", history.crack),
            };
            let all = history.xc_over_a.iter().zip(of(history)).map(|(&x, &value)| [x, value]);
            let points = all.collect::<Vec<_>>()[near(summary, &history.xc_over_a)].to_vec();
            let along = CurveColour::Along(1.1 * place as f64 / wet.len().max(2) as f64);
            Curve::line(&words, points).with_colour(along)
        };
        let curves: Vec<Curve> = wet.iter().enumerate().map(curve).collect();
        match named {
            Some(named) => bundle(named, wet.iter().map(|history| history.crack).zip(curves).collect()),
            None => curves,
        }
    };
    let of = |id: &str, quantity: &str, unit: &str, caption: &str, values: fn(&History) -> &[f64]| -> Chart {
        let mut chart = chart(id, quantity, caption.to_owned(), curves(values));
        chart.y.unit = unit.to_owned();
        chart
    };
    let words = "Fluid in the cracks over the stabilised passage";
    let pressure = of("fluid-pressure", "p", "MPa", "Fluid pressure in the cracks.", |h| &h.pressure);
    let volume = of("fluid-volume", "V", "mm²", "Crack volume per unit width.", |h| &h.volume);
    let mut sheet = ChartSheet::of(&summary.title, &format!("{words} · {model}"), pressure);
    sheet.rows.push(vec![volume]);
    Some(Plot::sheet("fluid.svg", sheet))
}
