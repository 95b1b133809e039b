//! The whole passage of a wheel under which the rail bends, in metres.

use super::stored::RunFolder;
use crate::chart::{Chart, Curve, CurveLook};
use crate::figures::{Plot, chart, far_chart};
use crate::numbers::fixed;
use crate::page::{Block, Section};
use railcrack::body::BodyEngine;
use railcrack::dislocation::DislocationEngine;
use railcrack::field::{BendingWheel, StressField, Wheel};
use railcrack::math::{MPA_SQRT_MM, Stress};

/// K over the whole passage, and the stress due to bending and temperature only; none for a rail
/// without bending.
pub(super) fn section(run: &RunFolder, plots: &[Plot]) -> Option<Section> {
    let first = run.case.first_wheel();
    let bending = first.wheel.bending(&run.case.steel)?;
    let thermal = first.wheel.temperature.map_or(0.0, |temperature| temperature.stress(&run.case.steel));
    let mouth = crate::figures::origin(&run.summary);
    let positions = run.case.positions(first);
    let stress = |xc: &f64| bending.stress(mouth - xc, 0.0) + thermal;
    let points: Vec<[f64; 2]> = positions.iter().map(|xc| [1e-3 * xc, stress(xc)]).collect();
    let most = points.iter().copied().reduce(|most, next| if next[1] > most[1] { next } else { most })?;
    let least = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
    let curve = Curve::line("bending and temperature only", points);
    let caption = "\u{3c3}_{xx} at the surface over the first crack, due to bending and temperature only.";
    let mut alone = far_chart("stress-far", "\u{3c3}_{xx}", caption.to_owned(), vec![curve]);
    alone.y.unit = "MPa".to_owned();
    let alone_k = k_alone(run, &positions);
    let mut k_charts: Vec<Chart> =
        ["ki-far", "kii-far"].into_iter().filter_map(|id| chart(plots, id)).collect();
    for (chart, points) in k_charts.iter_mut().zip(&alone_k) {
        let curve = Curve::line("bending and temperature only, initial crack", points.clone());
        chart.curves.push(curve.with_look(CurveLook::Dashed));
    }
    let most_k = alone_k.first().into_iter().flatten().fold(0.0, |most: f64, point| most.max(point[1]));
    let text = format!(
        "The rail bends over several metres, and the passage covers this length. Bending and temperature alone cause σ_{{xx}} from \
         {} to {} MPa at the surface above the crack, with the maximum for the wheel at x_{{c}} = {} m. For the initial crack with traction-free faces \
         they cause K_{{I}} up to {} MPa√m; negative values mean that the crack is closed.",
        fixed(least, 1),
        fixed(most[1], 1),
        fixed(most[0], 2),
        fixed(most_k, 2)
    );
    let charts = k_charts.into_iter().chain([alone]);
    Some(Section::new("far", "The whole passage, in metres", vec![Block::Text(text), Block::charts(charts)]))
}

/// K_I and K_II (MPa√m) of the first tip of the initial cracks under bending and temperature alone
/// with the wheel at each of `positions` (mm), by metres; none where the cracks make no body.
fn k_alone(run: &RunFolder, positions: &[f64]) -> Vec<Vec<[f64; 2]>> {
    let case = &run.case;
    let first = &case.first_wheel().wheel;
    let Some(track) = &first.track else { return Vec::new() };
    let body = DislocationEngine::new(case.steel).body(&case.cracks);
    let (Ok(body), Ok(wheel)) = (body, BendingWheel::new(track, &case.steel)) else { return Vec::new() };
    let thermal = first.thermal_stress(&case.steel);
    let of = |xc: &f64| {
        let stress = |point| {
            let constant = thermal.as_ref().map_or(Stress::ZERO, |field| field.stress(point));
            wheel.stress(point, *xc) + constant
        };
        let first = body.sifs_of_free_faces(stress).first().copied().unwrap_or_default();
        (1e-3 * xc, first)
    };
    let along: Vec<_> = positions.iter().map(of).collect();
    let ki = along.iter().map(|(x, k)| [*x, k.ki / MPA_SQRT_MM]).collect();
    let kii = along.iter().map(|(x, k)| [*x, k.kii / MPA_SQRT_MM]).collect();
    vec![ki, kii]
}
