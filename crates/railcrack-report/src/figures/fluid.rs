//! Pressure and volume of the fluid in the cracks against the wheel position.

use super::near::near;
use super::plot::Plot;
use super::row::bundle;
use super::sif::chart;
use crate::chart::{Chart, ChartSheet, Curve, CurveColour};
use crate::row::NamedCrack;
use railcrack_run::Summary;
use railcrack_run::run_folder::History;

/// The plot for the run with this `summary` on the model `model`; none for dry cracks. For many
/// cracks only the last step is shown, with the `named` cracks highlighted.
pub(super) fn plot(
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
