//! Cracks of a case: copies of a row, contact with one another, and their place in the rail.

use super::beside::{Beside, GAP, beside};
use super::limits::RESOLVED;
use super::row_scatter::RowScatter;
use crate::schema::{Fault, KeyRow, Report, SectionValues, short};
use crate::tables::{
    ANGLE, ANGLES, COUNT, CRACK_DEPTH, CRACK_FRICTION, Engine, LENGTH, MOUTH, POINTS, SPACING,
    SURFACE_HALF_LENGTH,
};
use railcrack::crack::{Crack, CrackError, CrackNetwork, segment_distance};
use railcrack::math::{RailBox, Vec2};

/// Maximum number of cracks of a case, copies included: in groups, the cost was measured up to half
/// of it.
const MOST_CRACKS: usize = 256;

/// All cracks of a case, copies written out.
#[derive(Debug, Clone)]
pub(super) struct PlacedCracks {
    pub network: CrackNetwork,
    pub friction: Vec<f64>,
    /// For each crack the index of its section.
    pub owner: Vec<usize>,
}

impl PlacedCracks {
    /// Half the extent along the surface over the length of each crack of `sections`, infinite
    /// where it is not given; empty where it never is.
    pub fn widths(&self, sections: &[&SectionValues]) -> Vec<f64> {
        let half_length = |owner: &usize| sections.get(*owner)?.get(SURFACE_HALF_LENGTH);
        if self.owner.iter().all(|owner| half_length(owner).is_none()) {
            return Vec::new();
        }
        let width = |(crack, owner): (&Crack, &usize)| {
            half_length(owner).map_or(f64::INFINITY, |half_length| half_length / crack.length())
        };
        self.network.cracks().iter().zip(&self.owner).map(width).collect()
    }
}

/// Builds the cracks of all sections for the `engine`, and reports those that are impossible or
/// meet.
pub(super) fn place_cracks(
    sections: &[&SectionValues],
    engine: Option<Engine>,
    report: &mut Report,
) -> Option<PlacedCracks> {
    let mut cracks = Vec::new();
    let mut friction = Vec::new();
    let mut owner = Vec::new();
    let mut complete = true;
    for (index, section) in sections.iter().enumerate() {
        let Some((row, coefficient)) = place_row(section, report) else {
            complete = false;
            continue;
        };
        if cracks.len() + row.len() > MOST_CRACKS {
            let fault = section.fault_of_all(format!("more than {MOST_CRACKS} cracks in the case"));
            return report.refuse(Fault { span: Some(section.span_of(COUNT)), ..fault });
        }
        friction.resize(friction.len() + row.len(), coefficient);
        owner.resize(owner.len() + row.len(), index);
        cracks.extend(row);
    }
    let network = match engine {
        // They may be offset laterally: their own reader checks whether they meet.
        Some(Engine::Space) => CrackNetwork::sections(cracks),
        _ => {
            if !report_meetings(&cracks, &owner, sections, report) {
                return None;
            }
            CrackNetwork::new(cracks)
        }
    };
    network.ok().filter(|_| complete).map(|network| PlacedCracks { network, friction, owner })
}

/// The cracks of a section, and their crack-face friction.
fn place_row(section: &SectionValues, report: &mut Report) -> Option<(Vec<Crack>, f64)> {
    let first = place_first(section, report);
    let scatter = RowScatter::of(section, report);
    let count = section.get(COUNT)?;
    let spacing = match section.get(SPACING) {
        None if count > 1 || section.is_refused(SPACING) => return None,
        spacing => spacing.unwrap_or_default(),
    };
    let (first, friction) = (first?, section.get(CRACK_FRICTION)?);
    let Some(mut scatter) = scatter? else {
        let copies = (0..count).map(|i| first.moved(i as f64 * spacing));
        return Some((copies.collect(), friction));
    };
    let mut shift = 0.0;
    let mut row = Vec::with_capacity(count);
    for _ in 0..count {
        let own = scatter.draw();
        let copy = match (section.get(MOUTH), length_of(section), section.get(ANGLE)) {
            (Some(mouth), Some(length), Some(angle)) => {
                straight(section, (mouth, length + own.length, angle + own.angle), report)?
            }
            _ => first.clone(),
        };
        row.push(copy.moved(shift));
        shift += spacing + own.spacing;
    }
    Some((row, friction))
}

fn place_first(section: &SectionValues, report: &mut Report) -> Option<Crack> {
    if let Some(points) = section.get(POINTS) {
        let points = points.iter().map(|p| Vec2::new(p[0], p[1])).collect();
        let refuse = |error: CrackError| {
            let parts = section.entry(POINTS).map(|entry| entry.parts.as_slice()).unwrap_or_default();
            let part = blamed_point(&error).and_then(|i| parts.get(i).cloned());
            let key = section.dotted(POINTS.key.name);
            let help = "y points up and the rail is y < 0; the first point lies on the surface (y = 0), or below it \
                        for a buried crack";
            let message = format!("`{key}`: {error}");
            report.add(Fault::of(key, part.unwrap_or(section.span_of(POINTS)), message).help(help));
        };
        let crack = Crack::polyline(points).map_err(refuse).ok()?;
        return is_resolved(&crack, section, report).then_some(crack);
    }
    straight(section, (section.get(MOUTH)?, length_of(section)?, section.get(ANGLE)?), report)
}

/// The length (mm) of the straight crack of `section`, which gives it or its depth.
fn length_of(section: &SectionValues) -> Option<f64> {
    let of_depth = || Some(section.get(CRACK_DEPTH)? / section.get(ANGLE)?.to_radians().sin());
    section.get(LENGTH).or_else(of_depth)
}

/// A straight crack from its mouth (mm), its length (mm) and its angle (degrees).
fn straight(
    section: &SectionValues,
    (mouth, length, angle): (f64, f64, f64),
    report: &mut Report,
) -> Option<Crack> {
    Crack::surface_breaking(mouth, length, angle.to_radians())
        .map_err(|error| report.add(section.fault(ANGLE, error)))
        .ok()
}

/// Reports a segment or a depth below the surface that no engine resolves, and a crack that enters
/// the rail at a flatter angle than `angle_deg` accepts; returns whether there is none.
fn is_resolved(crack: &Crack, section: &SectionValues, report: &mut Report) -> bool {
    let least = RESOLVED * crack.length();
    let says = |i: usize, point: Vec2| {
        let before = i.checked_sub(1).map(|i| crack.points()[i]);
        let from_surface = (point.y != 0.0).then_some(-point.y);
        match before.map(|before| point - before) {
            Some(step) if step.length() < least => {
                Some(format!("is {:e} mm from the point before it, {}", step.length(), too_close(least)))
            }
            Some(step) if i == 1 && crack.is_surface_breaking() && !accepts_angle(step) => Some(format!(
                "makes the crack enter the rail at {:e} degrees, which must be in {}",
                -step.angle().to_degrees(),
                ANGLES
            )),
            _ => from_surface
                .filter(|depth| *depth < least && !(i == 1 && crack.is_surface_breaking()))
                .map(|depth| format!("is {depth:e} mm below the surface, {}", too_close(least))),
        }
    };
    let Some((i, why)) = crack.points().iter().enumerate().find_map(|(i, p)| Some((i, says(i, *p)?))) else {
        return true;
    };
    let part = section.entry(POINTS).and_then(|entry| entry.parts.get(i).cloned());
    let key = section.dotted(POINTS.key.name);
    let message = format!("`{key}`: point {} {why}", i + 1);
    report.add(Fault::of(key, part.unwrap_or(section.span_of(POINTS)), message).help(TOO_CLOSE));
    false
}

fn accepts_angle(step: Vec2) -> bool {
    ANGLES.contains(-step.angle().to_degrees())
}

fn too_close(least: f64) -> String {
    format!("less than {least:e} mm, a thousandth of the crack")
}

const TOO_CLOSE: &str = "no engine resolves cracks, points and surfaces that are closer together";

/// The smallest and the largest x of a crack, and its length, mm.
fn extent(crack: &Crack) -> (f64, f64, f64) {
    let x = || crack.points().iter().map(|point| point.x);
    (x().fold(f64::INFINITY, f64::min), x().fold(f64::NEG_INFINITY, f64::max), crack.length())
}

/// Whether two cracks that do not meet are closer than an engine resolves.
fn are_too_close(one: &Crack, other: &Crack) -> bool {
    let least = RESOLVED * one.length().min(other.length());
    one.points()
        .windows(2)
        .any(|a| other.points().windows(2).any(|b| segment_distance(a[0], a[1], b[0], b[1]) < least))
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

/// Reports, once for each pair of sections, cracks that meet; whether there are none.
fn report_meetings(
    cracks: &[Crack],
    owner: &[usize],
    sections: &[&SectionValues],
    report: &mut Report,
) -> bool {
    let mut reported: Vec<(usize, usize)> = Vec::new();
    let extents: Vec<(f64, f64, f64)> = cracks.iter().map(extent).collect();
    for (i, one) in cracks.iter().enumerate() {
        for (j, other) in cracks.iter().enumerate().skip(i + 1) {
            let owners = (owner[i], owner[j]);
            let ((left, right, length), (other_left, other_right, other_length)) = (extents[i], extents[j]);
            let apart = (other_left - right).max(left - other_right);
            let far = apart > 0.0 && apart > RESOLVED * length.min(other_length);
            if far || reported.contains(&owners) {
                continue;
            }
            let meet = CrackNetwork::new(vec![one.clone(), other.clone()]).is_err();
            if !meet && !are_too_close(one, other) {
                continue;
            }
            reported.push(owners);
            let what =
                if meet { "cross, touch or overlap" } else { "are closer than a thousandth of their length" };
            let (first, second) = (sections[owners.0], sections[owners.1]);
            let must = if meet { "must not meet" } else { "must be further apart" };
            let mut help = format!("cracks {} and {} of the network (counting copies) {must}", i + 1, j + 1);
            help.push_str(&way_round(one, other, &second.path));
            let fault = if owners.0 == owners.1 {
                let key = first.dotted(SPACING.key.name);
                let message = format!("`{}`: its copies {what}", first.path);
                Fault::of(key, first.span_of(SPACING), message)
            } else {
                let message = format!("`{}` and `{}` {what}", first.path, second.path);
                Fault::of(second.path.clone(), second.span.clone(), message)
                    .also(first.span.clone(), "the other crack")
            };
            report.add(fault.help(help));
        }
    }
    reported.is_empty()
}

/// How the crack of the section `path`, which meets the first one, is computed beside it.
fn way_round(first: &Crack, second: &Crack, path: &str) -> String {
    let gap =
        format!("a V from one mouth, or a branch, is computed with a gap of {} % of the length", 100.0 * GAP);
    match beside(second, first) {
        Some(Beside::Mouth(x)) => format!("; {gap}: mouth_mm = {} of {path}", short(rounded(x))),
        Some(Beside::Buried(point)) => {
            let [x, y] = [point.x, point.y].map(|value| short(rounded(value)));
            format!("; {gap}: points_mm of {path} from [{x}, {y}]")
        }
        None => String::new(),
    }
}

/// A coordinate to a micrometre.
fn rounded(value: f64) -> f64 {
    (1e3 * value).round() * 1e-3
}

/// Reports, once for each section, cracks that are longer than the rail or leave it.
pub(super) fn check_fit(
    placed: &PlacedCracks,
    rail: RailBox,
    sections: &[&SectionValues],
    report: &mut Report,
) {
    let mut reported: Vec<usize> = Vec::new();
    for (crack, &owner) in placed.network.cracks().iter().zip(&placed.owner) {
        if reported.contains(&owner) {
            continue;
        }
        let section = sections[owner];
        let Some((says, row)) = misfit(crack, rail) else { continue };
        reported.push(owner);
        let name = if section.entry(row).is_some() { row.key.name } else { POINTS.key.name };
        let span = if section.entry(row).is_some() { section.span_of(row) } else { section.span_of(POINTS) };
        let key = section.dotted(name);
        let message = format!("`{key} = {}`: {says}", report.shown(&span));
        let help = "[rail] width_mm, depth_mm and centre_mm define the extent of the rail";
        report.add(Fault::of(key, span, message).help(help));
    }
}

/// Why a crack does not fit, and the key to blame.
fn misfit(crack: &Crack, rail: RailBox) -> Option<(String, KeyRow<f64>)> {
    let length = crack.length();
    if length > rail.width {
        let [length, width] = [length, rail.width].map(short);
        let message = format!("a crack of {length} mm is longer than the rail, width_mm = {width}");
        return Some((message, LENGTH));
    }
    let (left, right) = rail.ends();
    for point in crack.points() {
        if point.y <= -rail.depth {
            let message = format!(
                "the crack leaves the rail at depth {} mm, the rail ends at depth {} mm",
                short(-point.y),
                short(rail.depth)
            );
            return Some((message, LENGTH));
        }
        if point.x <= left || point.x >= right {
            let [x, left, right] = [point.x, left, right].map(short);
            let message = format!(
                "the crack leaves the rail at x = {x} mm, the rail reaches from {left} to {right} mm"
            );
            return Some((message, MOUTH));
        }
    }
    None
}
