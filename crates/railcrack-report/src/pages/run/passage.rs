//! The charts of the passage explorer in the plane. Their axes hold for all steps, wheels and wheel
//! positions, so that the script of the page only moves curves on them.

use super::data::{explored_steps, mouth};
use super::stored::RunFolder;
use super::wheels::{PassedWheel, wheels};
use crate::chart::{Chart, ChartAspect, ChartAxis, ChartRange, Curve};
use crate::figures::{Plot, chart, mouth_over_a};
use crate::page::Block;
use crate::page_data::PageData;
use crate::row::NamedCrack;
use crate::svg::ends;
use railcrack_run::run_folder::History;

/// Extent of the contact pressures about the mouth over a, and their height over p0.
const CONTACT_REACH: f64 = 2.0;
const CONTACT_HEIGHT: f64 = 1.6;

/// The charts: cracks and wheel, deformed crack, K, faces, contact pressure, residual stress.
pub(super) fn charts(
    run: &RunFolder,
    page_data: &PageData,
    named: Option<&[NamedCrack]>,
    plots: &[Plot],
) -> Vec<Block> {
    let wheels = wheels(run, page_data, named);
    let steps = explored_steps(run, page_data, named);
    let over_a = positions(run, &wheels, named);
    let mut charts = vec![scene(run, &wheels, named, plots), deformed(run)];
    charts.extend(k_charts(page_data, &steps, &over_a, plots));
    charts.extend(face_maps(run, &over_a));
    charts.extend(contact(run, &wheels));
    charts.extend(residual(run));
    let mut blocks = vec![Block::charts(charts)];
    let under_each: Vec<Chart> =
        ["wheels-ki", "wheels-kii"].into_iter().filter_map(|id| chart(plots, id)).collect();
    if !under_each.is_empty() {
        blocks.push(Block::charts(under_each));
    }
    blocks
}

/// Wheel positions near the cracks over a; of many cracks about the mouth of each.
fn positions(run: &RunFolder, wheels: &[PassedWheel], named: Option<&[NamedCrack]>) -> ChartAxis {
    let ends_of = |wheel: &PassedWheel| -> Vec<f64> {
        let about = |window: &std::ops::Range<usize>, mouth: f64| {
            let inside = wheel.xc_over_a.get(window.clone()).unwrap_or_default();
            ends(inside.iter().map(|x| x - mouth))
        };
        if named.is_none() {
            return about(&wheel.near, 0.0).to_vec();
        }
        let cracks = 1..=run.summary.cracks.len();
        let of_crack = |crack: usize| {
            // The mouth over the half-width of this wheel.
            let mouth = mouth_over_a(&run.summary, crack) * run.summary.half_width_mm / wheel.half_width;
            Some(about(wheel.window(crack)?, mouth))
        };
        cracks.filter_map(of_crack).flatten().collect()
    };
    let label = if named.is_some() {
        "Wheel position relative to the mouth, over a"
    } else {
        "Wheel position x_{c}/a"
    };
    ChartAxis::linear(label, "").over(ChartRange::Exact(ends(wheels.iter().flat_map(ends_of))))
}

/// K over the passage: the curves of some steps, to which the script adds that of the slider.
fn k_charts(page_data: &PageData, steps: &[usize], over_a: &ChartAxis, plots: &[Plot]) -> Vec<Chart> {
    let span = |of: fn(&History) -> &[f64]| {
        let all = steps.iter().flat_map(|step| page_data.by_wheel(*step)).flatten();
        let [low, high] = ends(all.flat_map(|history| of(history).iter().copied()).chain([0.0]));
        let air = 0.05 * (high - low).max(1e-9);
        [low - air, high + air]
    };
    let (mut ki, kii) = (span(|history| &history.ki), span(|history| &history.kii));
    let largest = ki.iter().chain(&kii).map(|k| k.abs()).fold(0.0, f64::max);
    // A K_I that is hardly there gets the scale of something, not that of noise.
    if ki[1] - ki[0] < 0.1 * largest {
        ki = [-0.01 * largest, 0.1 * largest];
    }
    let drawn = |(id, range): (&str, [f64; 2])| {
        let chart = chart(plots, id)?;
        let caption =
            format!("{} Thick: the growth step of the slider; ring: the wheel position.", chart.caption);
        let y = chart.y.clone().over(ChartRange::Exact(range));
        Some(Chart { caption, x: over_a.clone(), y, ..chart })
    };
    [("ki", ki), ("kii", kii)].into_iter().filter_map(drawn).collect()
}

/// Points of every crack with what the surface has lost, about `from` of each crack.
fn places(run: &RunFolder, from: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
    let cracks = run.summary.cracks.iter().enumerate();
    let points = cracks.flat_map(|(i, crack)| {
        let from = from(i + 1);
        let whole = crack.points_mm.iter().chain(crack.path_mm.iter().flatten());
        whole.map(move |[x, y]| [x - from, *y]).collect::<Vec<_>>()
    });
    points.collect()
}

/// The cracks to scale below the wheel; of many cracks the surroundings of one.
fn scene(run: &RunFolder, wheels: &[PassedWheel], named: Option<&[NamedCrack]>, plots: &[Plot]) -> Chart {
    let widest = wheels.iter().map(|wheel| wheel.half_width).fold(0.0, f64::max);
    let is_row = named.is_some();
    let mut points = places(run, |crack| if is_row { mouth(run, crack) } else { 0.0 });
    if !is_row {
        points.extend(run.summary.pieces.iter().flat_map(|piece| &piece.outline_mm));
    }
    let [left, right] = ends(points.iter().map(|point| point[0]));
    let deepest = points.iter().map(|point| -point[1]).fold(0.0, f64::max);
    let beside = (0.12 * (right - left)).max(if is_row { 2.2 } else { 1.4 } * widest);
    let across = right - left + 2.0 * beside;
    let mut caption =
        "Cracks and wheel, to scale. Thick: the cracks in this growth step. Above the surface: the Hertzian \
                       pressure; the arrow shows the direction of the shear traction on the rail."
            .to_owned();
    if run.case.has_fluid() {
        caption.push_str(" Blue bands: fluid in the cracks, wider at higher pressure.");
    }
    let curves = chart(plots, "paths").filter(|_| !is_row).map_or_else(Vec::new, |paths| paths.curves);
    Chart {
        id: "scene".to_owned(),
        caption,
        x: ChartAxis::linear(if is_row { "x from the mouth" } else { "x" }, "mm")
            .over(ChartRange::Exact([left - beside, right + beside])),
        y: ChartAxis::depth().over(ChartRange::Exact([-0.19 * across, (1.15 * deepest).max(0.16 * across)])),
        curves,
        aspect: ChartAspect::Equal,
        ..Chart::default()
    }
}

/// Room for each crack, about its mouth, with its displacement jump.
fn deformed(run: &RunFolder) -> Chart {
    let points = places(run, |crack| mouth(run, crack));
    let longest = (1..=run.summary.cracks.len()).map(|crack| length(run, crack)).fold(0.0, f64::max);
    let air = 0.09 * longest.max(1e-6);
    let [left, right] = ends(points.iter().map(|point| point[0]));
    let [top, bottom] = ends(points.iter().map(|point| -point[1]));
    Chart {
        id: "deformed".to_owned(),
        caption: "Deformed crack.".to_owned(),
        x: ChartAxis::linear("x from the mouth", "mm").over(ChartRange::Exact([left - air, right + air])),
        y: ChartAxis::depth().over(ChartRange::Exact([(top - air).max(-air), bottom + air])),
        curves: [("+ face", 0), ("\u{2212} face", 1)]
            .map(|(name, colour)| {
                Curve::line(name, Vec::new()).with_colour(crate::chart::CurveColour::Category(colour))
            })
            .to_vec(),
        aspect: ChartAspect::Equal,
        ..Chart::default()
    }
}

/// Length of a crack in the last step along its whole path, mm.
fn length(run: &RunFolder, crack: usize) -> f64 {
    let lengths = run.growth.iter().filter(|row| row.crack == crack).map(|row| row.length);
    let crack = crack.checked_sub(1).and_then(|place| run.summary.cracks.get(place));
    let path = crack.map_or(&[][..], |crack| &crack.points_mm);
    let of_path = path.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum();
    lengths.fold(of_path, f64::max)
}

/// Status and pressure of the faces over wheel position and arc length.
fn face_maps(run: &RunFolder, over_a: &ChartAxis) -> [Chart; 2] {
    let longest = (1..=run.summary.cracks.len()).map(|crack| length(run, crack)).fold(1e-6, f64::max);
    let captions = [
        ("face-status", "Status of the crack faces over the passage; click to move the wheel."),
        ("face-pressure", "Contact pressure on the crack faces over the passage; click to move the wheel."),
    ];
    captions.map(|(id, caption)| Chart {
        id: id.to_owned(),
        caption: caption.to_owned(),
        x: over_a.clone(),
        y: ChartAxis::linear("Arc length s", "mm").over(ChartRange::Exact([0.0, longest])),
        ..Chart::default()
    })
}

/// Contact pressure over the mouth; none of wheels that are not coupled to the cracks.
fn contact(run: &RunFolder, wheels: &[PassedWheel]) -> Option<Chart> {
    let coupled = || wheels.iter().filter(|wheel| wheel.wheel.wheel.coupling().is_some());
    coupled().next()?;
    let reach = CONTACT_REACH * coupled().map(|wheel| wheel.half_width).fold(0.0, f64::max);
    let peaks = coupled().filter_map(|wheel| Some(wheel.wheel.wheel.contact()?.peak_pressure()));
    let whose = if run.case.is_mix() { "a wheel that feels the cracks" } else { "the wheel" };
    Some(Chart {
        id: "contact".to_owned(),
        caption: format!("Contact pressure of {whose} over the mouth."),
        x: ChartAxis::linear("x from the mouth", "mm").over(ChartRange::Exact([-reach, reach])),
        y: ChartAxis::linear("p", "MPa")
            .over(ChartRange::Exact([0.0, CONTACT_HEIGHT * peaks.fold(0.0, f64::max)])),
        ..Chart::default()
    })
}

/// Residual stress by depth.
fn residual(run: &RunFolder) -> Option<Chart> {
    let points: Vec<[f64; 2]> = run.residual.iter().map(|row| [row[1], row[0]]).collect();
    let deepest = points.last()?[1];
    Some(Chart {
        id: "residual-stress".to_owned(),
        caption: "Residual stress by depth; zero below.".to_owned(),
        x: ChartAxis::linear("\u{3c3}_{xx}", "MPa").over(ChartRange::AroundZero),
        y: ChartAxis::depth().over(ChartRange::Exact([0.0, deepest])),
        curves: vec![Curve::line("", points)],
        ..Chart::default()
    })
}
