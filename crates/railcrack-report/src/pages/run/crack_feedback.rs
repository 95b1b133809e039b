//! The section on a wheel that feels the cracks.

use super::stored::RunFolder;
use crate::chart::{Chart, ChartAxis, ChartRange, Curve, CurveColour, CurveLook};
use crate::page::{Block, Section};
use crate::page_data::PageData;
use railcrack_run::CrackSummary;
use railcrack_run::run_folder::History;

/// Distance from the mouth over a within which the contact load is that at the mouth.
const NEAR_MOUTH: f64 = 0.1;
/// Largest number of cracks that are drawn.
const MOST: usize = 6;

/// Load on the lips and approach of a wheel that feels the cracks; none for other wheels.
pub(super) fn section(run: &RunFolder, page_data: &PageData) -> Option<Section> {
    let drawn = drawn(page_data);
    let first = *drawn.first()?;
    let is_single = drawn.iter().all(|history| history.crack == first.crack);
    let mut loads = curves(&drawn, |history| &history.lip_load);
    loads.extend(is_single.then(|| uncracked(run, first)).flatten());
    let chart = |id: &str, caption: &str, (label, unit): (&str, &str), curves| Chart {
        id: id.to_owned(),
        caption: caption.to_owned(),
        x: ChartAxis::linear("Wheel position x_{c}/a", "").over(ChartRange::Tight),
        y: ChartAxis::linear(label, unit).over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    };
    let caption = "Load on the lips: contact pressure within 0.1 a of the mouth, integrated.";
    let load = chart("lip-load", caption, ("Load", "N/mm"), loads);
    let caption = "How much farther the wheel approaches the rail than without cracks.";
    let approaches = curves(&drawn, |history| &history.approach);
    let approach = chart("approach", caption, ("Approach", "µm"), approaches);
    let lead = format!(
        "The wheel feels the cracks. Over {} mm, 0.2 a, the load on the lips is the mean pressure over the mouth, that of fluid from it.",
        crate::numbers::fixed(2.0 * NEAR_MOUTH * run.summary.half_width_mm, 2)
    );
    let blocks = vec![Block::List(vec![lead]), Block::charts([load, approach])];
    Some(Section::new("coupled", "Contact over the mouth", blocks))
}

/// The histories with an approach, of the first cracks in the first and in the last step.
fn drawn(page_data: &PageData) -> Vec<&History> {
    let steps = page_data.steps();
    let mut drawn: Vec<&History> = Vec::new();
    for step in [steps.first(), steps.last()].into_iter().flatten() {
        let of_step = page_data.histories(*step).iter();
        let new = of_step.filter(|history| history.tip == 1 && history.approach.iter().any(Option::is_some));
        drawn.extend(new.take(MOST).filter(|history| !drawn.contains(history)).collect::<Vec<_>>());
    }
    drawn
}

/// A curve of each of `drawn`.
fn curves(drawn: &[&History], values: fn(&History) -> &[Option<f64>]) -> Vec<Curve> {
    let is_single = drawn.iter().all(|history| history.crack == drawn[0].crack);
    let curve = |(place, history): (usize, &&History)| {
        let words = match (is_single, history.step) {
            (true, 0) => "initial crack".to_owned(),
            (true, step) => format!("step {step}"),
            (false, step) => format!("crack {}, step {step}", history.crack),
        };
        let all = history.xc_over_a.iter().zip(values(history));
        let points = all.filter_map(|(&x, value)| Some([x, (*value)?])).collect();
        let along = CurveColour::Along(1.1 * place as f64 / drawn.len().max(2) as f64);
        Curve::line(&words, points).with_colour(along)
    };
    drawn.iter().enumerate().map(curve).collect()
}

/// The load over the mouth of the crack of `history` on the uncracked rail.
fn uncracked(run: &RunFolder, history: &History) -> Option<Curve> {
    let a = run.summary.half_width_mm;
    let mouth = |crack: &CrackSummary| Some(crack.initial_points_mm.first()?[0]);
    let crack = run.summary.cracks.get(history.crack.checked_sub(1)?)?;
    let mouth = (mouth(crack)? - mouth(run.summary.cracks.first()?)?) / a;
    let p0 = run.case.first_wheel().wheel.contact().map_or(0.0, |contact| contact.peak_pressure());
    let over_mouth = 2.0 * NEAR_MOUTH * a * p0;
    let hertz = history.xc_over_a.iter().map(|&x| [x, over_mouth * mean_of_half_ellipse(mouth - x)]);
    let hertz = hertz.filter(|point| (point[0] - mouth).abs() < 2.0).collect();
    Some(Curve::line("uncracked rail", hertz).with_look(CurveLook::Dashed))
}

/// The mean of √(1 − u²), zero beyond |u| = 1, over |u − `at`| ≤ 0.1.
fn mean_of_half_ellipse(at: f64) -> f64 {
    let below = |u: f64| {
        let u = u.clamp(-1.0, 1.0);
        0.5 * (u * ((1.0 - u) * (1.0 + u)).sqrt() + u.asin())
    };
    (below(at + NEAR_MOUTH) - below(at - NEAR_MOUTH)) / (2.0 * NEAR_MOUTH)
}

#[cfg(test)]
mod tests {
    use super::mean_of_half_ellipse;

    #[test]
    fn mean_of_a_half_ellipse_in_the_middle_and_beyond_its_edge() {
        assert!((mean_of_half_ellipse(0.0) - (1.0 - 0.01 / 6.0)).abs() < 1e-5);
        assert_eq!(mean_of_half_ellipse(1.2), 0.0);
        assert!(mean_of_half_ellipse(1.05) > 0.0);
    }
}
