//! Stress profiles and other tables of a case.

use super::ranges::of_column;
use super::topic::{Implausible, Topic};
use super::usual::rounded;
use crate::case::Case;
use crate::files::ProfileFile;
use crate::tables::{ContactOrigin, Detection, PlasticSource};

/// Height of a rail over which the force of a profile is balanced, mm.
const RAIL_HEIGHT: f64 = 172.0;
/// Largest mean stress over that height, MPa, that counts as balanced: what is measured near the
/// surface is balanced by a stress below, which is not measured.
const BALANCED: f64 = 10.0;

/// Unusual numbers in the tables of `case`.
pub(super) fn of_tables(case: &Case) -> Vec<Implausible> {
    let plastic =
        case.plane().and_then(|plane| plane.plastic_stress.as_ref()).and_then(|source| match source {
            PlasticSource::Profile(file) => Some(file),
            _ => None,
        });
    let mut texts = Vec::new();
    for file in
        [case.residual_stress.as_ref(), case.shakedown.initial_residual.as_ref()].into_iter().flatten()
    {
        texts.extend(of_profile(file));
        texts.extend(unbalanced(file));
    }
    texts.extend(plastic.into_iter().flat_map(of_profile));
    let contacts = case.wheels.iter().filter_map(|wheel| wheel.wheel.given());
    for given in contacts {
        if let ContactOrigin::Table(file) = &given.origin {
            let name = file.given_name();
            texts.extend(remark(
                "p_mpa",
                &format!("{name}: the largest p_mpa"),
                given.contact.peak_pressure(),
            ));
            texts.extend(remark(
                "u_mm",
                &format!("{name}: the half-width by u_mm"),
                given.contact.half_width(),
            ));
        }
    }
    let toughness = case.fracture.as_ref().filter(|fracture| fracture.file.is_some());
    texts.extend(
        toughness.and_then(|fracture| {
            remark("toughness_mpa_sqrt_m", "the toughness of the table", fracture.at_rail)
        }),
    );
    if let Some(Detection::Table(file)) =
        case.inspection_risk.as_ref().and_then(|risk| risk.detection.as_ref())
    {
        let deepest = file.content().rows().last().map_or(0.0, |(depth, _)| *depth);
        texts.extend(remark("depth_mm", &format!("{}: the last depth_mm", file.given_name()), deepest));
    }
    texts.into_iter().map(|text| Implausible { topic: Topic::Quantity, text }).collect()
}

fn remark(column: &str, name: &str, value: f64) -> Option<String> {
    of_column(column)?.remark(name, value)
}

/// Depths and stresses of a profile.
fn of_profile(file: &ProfileFile) -> Vec<String> {
    let (rows, name) = (file.content().rows(), file.given_name());
    let deepest = rows.last().map_or(0.0, |row| row.0);
    let largest = rows.iter().fold(0.0f64, |most, row| most.max(row.1.abs()).max(row.2.abs()));
    let depth = remark("depth_mm of stresses", &format!("{name}: the last depth_mm"), deepest);
    let stress = remark("sxx_mpa", &format!("{name}: the largest stress"), largest);
    depth.into_iter().chain(stress).collect()
}

/// The remark on a profile whose force along the rail nothing balances.
fn unbalanced(file: &ProfileFile) -> Option<String> {
    let rows = file.content().rows();
    let first = rows.first()?;
    let between = rows.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0));
    let force = first.0 * first.1 + between.sum::<f64>();
    let mean = force / RAIL_HEIGHT;
    (mean.abs() > BALANCED).then(|| {
        format!(
            "{}: the stresses add up to {} N per mm of width, {} MPa over the height of a rail, which nothing balances: a residual stress has no force; a constant one is that of [temperature]",
            file.given_name(),
            rounded(format!("{force:.3e}").parse().unwrap_or(force)),
            rounded(format!("{mean:.2e}").parse().unwrap_or(mean))
        )
    })
}
