//! The whole passage of a wheel under which the rail bends, in metres.

use super::stored::RunFolder;
use crate::chart::Curve;
use crate::figures::{Plot, chart, far_chart};
use crate::numbers::fixed;
use crate::page::{Block, Section};

/// K over the whole passage, and the stress of bending and temperature alone; none where the rail
/// does not bend.
pub(super) fn section(run: &RunFolder, plots: &[Plot]) -> Option<Section> {
    let bending = run.case.wheel.bending(&run.case.steel)?;
    let thermal =
        run.case.wheel.load.temperature.map_or(0.0, |temperature| temperature.stress(&run.case.steel));
    let mouth = crate::figures::origin(&run.summary);
    let positions = run.case.positions();
    let stress = |xc: &f64| bending.stress(mouth - xc, 0.0) + thermal;
    let points: Vec<[f64; 2]> = positions.iter().map(|xc| [1e-3 * xc, stress(xc)]).collect();
    let most = points.iter().copied().reduce(|most, next| if next[1] > most[1] { next } else { most })?;
    let least = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
    let curve = Curve::line("bending and temperature alone", points);
    let caption = "\u{3c3}_{xx} at the surface over the first crack, of bending and temperature alone.";
    let mut alone = far_chart("stress-far", "\u{3c3}_{xx}", caption.to_owned(), vec![curve]);
    alone.y.unit = "MPa".to_owned();
    let text = format!(
        "The rail bends over metres, and the passage goes as far. Bending and temperature alone put the surface over the crack \
         under {} to {} MPa, the most with the wheel at x_{{c}} = {} m.",
        fixed(least, 1),
        fixed(most[1], 1),
        fixed(most[0], 2)
    );
    let charts = ["ki-far", "kii-far"].into_iter().filter_map(|id| chart(plots, id)).chain([alone]);
    Some(Section {
        id: "far".to_owned(),
        heading: "The whole passage, in metres".to_owned(),
        blocks: vec![Block::Text(text), Block::charts(charts)],
    })
}
