//! The cracks of a case: copies, meetings, and whether they fit the rail.

use super::error::{Fault, Report};
use super::section::{SectionValues, shown};
use super::validated::Rail;
use railcrack::crack::{Crack, CrackError, CrackNetwork};
use railcrack::math::Vec2;
use std::ops::Range;

/// Most cracks of a case, copies included: each brings a dense block of unknowns, and ten times as many as the
/// largest published network has are enough.
const MOST_CRACKS: usize = 100;

/// All cracks of a case, copies written out.
#[derive(Debug, Clone)]
pub(super) struct PlacedCracks {
    pub network: CrackNetwork,
    pub friction: Vec<f64>,
    /// For each crack the index of its section.
    pub owner: Vec<usize>,
}

/// Builds the cracks of all sections, and reports those that are impossible or meet.
pub(super) fn place_cracks(sections: &[&SectionValues], report: &mut Report) -> Option<PlacedCracks> {
    let mut cracks = Vec::new();
    let mut friction = Vec::new();
    let mut owner = Vec::new();
    let mut complete = true;
    for (index, section) in sections.iter().enumerate() {
        let Some((crack, coefficient, shifts)) = place_row(section, report) else {
            complete = false;
            continue;
        };
        if cracks.len() + shifts.len() > MOST_CRACKS {
            report.add(Fault {
                message: format!("`{}`: more than {MOST_CRACKS} cracks in the case", section.path),
                key: Some(section.path.clone()),
                span: Some(section.span_of("count")),
                ..Fault::default()
            });
            return None;
        }
        for shift in shifts {
            cracks.push(crack.moved(shift));
            friction.push(coefficient);
            owner.push(index);
        }
    }
    if !report_meetings(&cracks, &owner, sections, report) || !complete {
        return None;
    }
    CrackNetwork::new(cracks).ok().map(|network| PlacedCracks { network, friction, owner })
}

/// The first crack of a section, the friction of its faces, and how far each copy is moved.
fn place_row(section: &SectionValues, report: &mut Report) -> Option<(Crack, f64, Vec<f64>)> {
    let shifts = shifts(section, report);
    let crack = place_first(section, report);
    Some((crack?, section.number("friction")?, shifts?))
}

fn place_first(section: &SectionValues, report: &mut Report) -> Option<Crack> {
    if let Some(entry) = section.entry("points_mm") {
        let super::accept::Value::Points(points) = &entry.value else { return None };
        let points = points.iter().map(|p| Vec2::new(p[0], p[1])).collect();
        return Crack::polyline(points)
            .map_err(|error| {
                let part = blamed_point(&error).and_then(|i| entry.parts.get(i).cloned());
                report.add(Fault {
                    message: format!("`{}.points_mm`: {error}", section.path),
                    key: Some(format!("{}.points_mm", section.path)),
                    span: part.or(entry.span.clone()),
                    help: Some(
                        "y points up and the rail is y < 0; the first point lies on the surface (y = 0), or below \
                         it for a buried crack"
                            .into(),
                    ),
                    also: None,
                });
            })
            .ok();
    }
    let (mouth, length) = (section.number("mouth_mm")?, section.number("length_mm")?);
    let angle = section.number("angle_deg")?;
    Crack::surface_breaking(mouth, length, angle.to_radians())
        .map_err(|error| {
            report.add(Fault {
                message: format!("`{}`: {error}", section.path),
                key: Some(format!("{}.angle_deg", section.path)),
                span: Some(section.span_of("angle_deg")),
                ..Fault::default()
            });
        })
        .ok()
}

/// The point (from 0) that an error is about.
fn blamed_point(error: &CrackError) -> Option<usize> {
    match error {
        CrackError::NotFinite { index, .. } | CrackError::OutsideRail { index, .. } => index.checked_sub(1),
        CrackError::RepeatedPoint { index } => Some(*index),
        CrackError::SelfCrossing { second, .. } => Some(*second),
        _ => None,
    }
}

fn shifts(section: &SectionValues, report: &mut Report) -> Option<Vec<f64>> {
    let count = section.integer("count")?;
    let is_written = |key: &str| section.entry(key).is_some_and(|e| e.span.is_some());
    if section.is_refused("spacing_mm") {
        return None;
    }
    let spacing = section.number("spacing_mm");
    let mut refuse = |key: &str, other: &str, message: String| {
        report.add(Fault {
            message,
            key: Some(format!("{}.{key}", section.path)),
            span: Some(section.span_of(other)),
            help: Some("count copies stand spacing_mm apart: give both or neither".into()),
            also: None,
        });
        None
    };
    match spacing {
        None if count > 1 => refuse(
            "spacing_mm",
            "count",
            format!("`{0}.spacing_mm` is missing: `{0}.count = {count}` needs it", section.path),
        ),
        Some(spacing) if !is_written("count") => refuse(
            "count",
            "spacing_mm",
            format!("`{0}.count` is missing: `{0}.spacing_mm = {spacing}` needs it", section.path),
        ),
        None => Some(vec![0.0]),
        Some(spacing) => Some((0..count).map(|i| i as f64 * spacing).collect()),
    }
}

/// Reports, once for each pair of sections, cracks that meet; whether there are none.
fn report_meetings(
    cracks: &[Crack],
    owner: &[usize],
    sections: &[&SectionValues],
    report: &mut Report,
) -> bool {
    let mut reported: Vec<(usize, usize)> = Vec::new();
    for (i, one) in cracks.iter().enumerate() {
        for (j, other) in cracks.iter().enumerate().skip(i + 1) {
            let owners = (owner[i], owner[j]);
            if reported.contains(&owners) || CrackNetwork::new(vec![one.clone(), other.clone()]).is_ok() {
                continue;
            }
            reported.push(owners);
            let (first, second) = (sections[owners.0], sections[owners.1]);
            let copies = owners.0 == owners.1;
            let (message, key) = if copies {
                (format!("`{}`: its copies cross, touch or overlap", first.path), "spacing_mm")
            } else {
                (format!("`{}` and `{}` cross, touch or overlap", first.path, second.path), "mouth_mm")
            };
            report.add(Fault {
                message,
                key: Some(if copies { format!("{}.{key}", first.path) } else { second.path.clone() }),
                span: Some(second.span_of(if copies { key } else { "" })),
                help: Some(format!(
                    "cracks {} and {} of the network, copies counted, must not meet",
                    i + 1,
                    j + 1
                )),
                also: (!copies).then(|| (first.span.clone(), "the other crack")),
            });
        }
    }
    reported.is_empty()
}

/// Reports, once for each section, cracks that are longer than the rail or leave it.
pub(super) fn check_fit(
    placed: &PlacedCracks,
    rail: &Rail,
    sections: &[&SectionValues],
    report: &mut Report,
) {
    let mut reported: Vec<usize> = Vec::new();
    for (crack, &owner) in placed.network.cracks().iter().zip(&placed.owner) {
        if reported.contains(&owner) {
            continue;
        }
        let section = sections[owner];
        if let Some((message, key)) = misfit(crack, rail) {
            let key = if section.entry(key).is_some() { key } else { "points_mm" };
            let span: Range<usize> = section.span_of(key);
            let given = shown(report, &span);
            reported.push(owner);
            report.add(Fault {
                message: format!("`{0}.{key} = {given}`: {message}", section.path),
                key: Some(format!("{}.{key}", section.path)),
                span: Some(span),
                help: Some("[rail] width_mm, depth_mm and centre_mm say how far the rail reaches".into()),
                also: None,
            });
        }
    }
}

/// Why a crack does not fit, and the key to blame.
fn misfit(crack: &Crack, rail: &Rail) -> Option<(String, &'static str)> {
    let length = crack.length();
    if length > rail.width {
        let message = format!("a crack of {length} mm is longer than the rail, width_mm = {}", rail.width);
        return Some((message, "length_mm"));
    }
    let (left, right) = (rail.centre - 0.5 * rail.width, rail.centre + 0.5 * rail.width);
    for point in crack.points() {
        if point.y <= -rail.depth {
            let message = format!(
                "the crack leaves the rail at depth {} mm, the rail ends at depth {} mm",
                -point.y, rail.depth
            );
            return Some((message, "length_mm"));
        }
        if point.x <= left || point.x >= right {
            let message = format!(
                "the crack leaves the rail at x = {} mm, the rail reaches from {left} to {right} mm",
                point.x
            );
            return Some((message, "mouth_mm"));
        }
    }
    None
}
