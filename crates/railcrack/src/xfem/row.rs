//! A of long rows of cracks in finite elements, from overlapping parts of the row.

use super::body::{Discretisation, Reduced, of_some_cracks, of_thin_flaps};
use super::columns::ColumnStore;
use super::error::XfemError;
use super::refined_region::{OUTER_GRADING, RefinedRegion};
use super::row_part::{PartOfRow, Taken, UnitOfPart};
use super::settings::XfemSettings;
use super::size::{XfemSize, factor_entries};
use crate::body::{BlockStiffness, BodyTimes, CrackedBody, FaceMesh, FaceSample, TipGain};
use crate::bulk::{Boundary, BulkRail};
use crate::crack::{CrackCurve, CrackNetwork};
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use crate::math::{Matrix, RailBox};
use crate::mesh::{MeshError, QuadMesh};
use crate::nuclei::{FarRow, Source, Units};
use crate::stopwatch::Stopwatch;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// Number of units in a part of the row; a part has more if one of its units has more neighbours.
/// The force between two cracks is independent of all other cracks; parts differ in where their
/// mesh becomes coarse.
const UNITS: usize = 10;
/// Length of the fine mesh beyond each end of a part, over its largest unit.
const BESIDE: f64 = 0.3;

/// A row of cracks in the half-plane and the mesh that is fine in the region `refined`.
pub(super) struct MeshedRow<'a> {
    pub network: &'a CrackNetwork,
    pub steel: &'a IsotropicElastic,
    pub refined: &'a RefinedRegion,
    pub extent: RailBox,
    pub settings: XfemSettings,
}

/// The parts of a row, each as a range of units. Any two units that are near to each other share a
/// part.
fn parts(units: &Units) -> Vec<Range<usize>> {
    let count = units.cracks.len();
    let last_near: Vec<usize> =
        (0..count).map(|k| (k..count).rev().find(|&l| units.are_near(k, l)).unwrap_or(k)).collect();
    let mut parts = Vec::new();
    let mut first = 0;
    loop {
        let end = (first + UNITS).max(last_near[first] + 1).min(count);
        parts.push(first..end);
        if end == count {
            return parts;
        }
        first = (first + 1..end).find(|&k| last_near[k] >= end).unwrap_or(end);
    }
}

/// Of the `parts` of a row of `count` units that hold units `k` ≤ `l`, the part in which they are
/// farthest from an end beyond which the row continues.
fn home(parts: &[Range<usize>], count: usize, k: usize, l: usize) -> usize {
    let margin = |part: &Range<usize>| {
        let before = if part.start == 0 { count } else { k - part.start };
        before.min(if part.end == count { count } else { part.end - 1 - l })
    };
    let holding = parts.iter().enumerate().filter(|(_, part)| part.start <= k && l < part.end);
    holding.rev().max_by_key(|(_, part)| margin(part)).map_or(0, |(i, _)| i)
}

impl MeshedRow<'_> {
    /// The body, with A in blocks.
    pub(crate) fn body(&self, interruption: Interruption<'_>) -> Result<CrackedBody, XfemError> {
        let started = Stopwatch::start();
        let curves = self.network.curves();
        let units = Units::new(self.network, &curves);
        let parts = parts(&units);
        let whole = self.refined.mesh_lines(self.extent)?;
        let taken = |i: usize| self.taken(&units, &parts, i, &whole, interruption);
        // Each thread has the mesh and factor of one part in memory.
        let mut all: Vec<Taken> = Vec::new();
        let numbers: Vec<usize> = (0..parts.len()).collect();
        for some in numbers.chunks(rayon::current_num_threads()) {
            let some: Vec<Taken> = some.par_iter().map(|&i| taken(i)).collect::<Result<_, _>>()?;
            all.extend(some);
        }
        let made = started.seconds();
        let mut body = self.assembled(&curves, &units, all);
        // Remarks of parts that were computed simultaneously.
        let BodyTimes { mesh_s, enrichment_s, border_s, sif_s, condensation_s } = body.times;
        let share = made / (mesh_s + enrichment_s + border_s + sif_s + condensation_s);
        body.times = BodyTimes {
            mesh_s: share * mesh_s,
            enrichment_s: share * enrichment_s,
            border_s: share * border_s,
            sif_s: share * sif_s,
            condensation_s: share * condensation_s,
        };
        Ok(body)
    }

    /// Total size of all parts; the entries of the factor are those of two parts, which two threads
    /// hold in memory simultaneously.
    pub(crate) fn size(&self) -> Result<XfemSize, XfemError> {
        let units = Units::new(self.network, &self.network.curves());
        let parts = parts(&units);
        let whole = self.refined.mesh_lines(self.extent)?;
        let mut size = XfemSize::default();
        for (i, own) in parts.iter().enumerate() {
            let mesh = self.mesh_of(&units, own, &whole)?;
            let part = PartOfRow::new(self.network, &units, own.clone());
            let made = Discretisation::new(&mesh, &part.network, &self.settings);
            let Discretisation { space, interface, .. } = made.map_err(|error| part.in_row(error))?;
            let at_home = |crack: usize| {
                let unit = part.unit(crack);
                home(&parts, units.cracks.len(), unit, unit) == i
            };
            let points = interface.faces.points.iter();
            let own = XfemSize {
                mesh_unknowns: 2 * mesh.node_count(),
                enriched_unknowns: space.unknowns(),
                face_points: points.filter(|point| at_home(point.crack)).count(),
                factor_entries: 0,
            };
            size.mesh_unknowns += own.mesh_unknowns;
            size.enriched_unknowns += own.enriched_unknowns;
            size.face_points += own.face_points;
            size.factor_entries = size.factor_entries.max(2 * factor_entries(own.mesh_unknowns));
        }
        Ok(size)
    }

    /// The mesh of the part `own`, of the lines of the `whole` row.
    fn mesh_of(
        &self,
        units: &Units,
        own: &Range<usize>,
        (x, y): &(Vec<f64>, Vec<f64>),
    ) -> Result<QuadMesh, MeshError> {
        let spans = own.clone().map(|k| units.span(k));
        let (low, high, size) = spans.fold((f64::INFINITY, f64::NEG_INFINITY, 0.0f64), |all, span| {
            (all.0.min(span.0), all.1.max(span.1), all.2.max(span.1 - span.0))
        });
        QuadMesh::new(lines_around(x, (low - BESIDE * size, high + BESIDE * size)), y.clone())
    }

    /// The blocks of part `i` that are used in the row.
    fn taken(
        &self,
        units: &Units,
        parts: &[Range<usize>],
        i: usize,
        lines: &(Vec<f64>, Vec<f64>),
        interruption: Interruption<'_>,
    ) -> Result<Taken, XfemError> {
        let started = Stopwatch::start();
        let (own, count) = (parts[i].clone(), units.cracks.len());
        let mesh = self.mesh_of(units, &own, lines)?;
        let rail = Arc::new(BulkRail::unfactored(mesh, self.steel, Boundary::HalfPlane)?);
        let part = PartOfRow::new(self.network, units, own.clone());
        let mesh_s = started.seconds();
        let mut columns = ColumnStore::default();
        let number = |crack: usize| part.number(crack);
        let made = of_some_cracks(&rail, &part.network, &number, self.settings, &mut columns, interruption);
        let Reduced { mut body, inside, remarks } = made.map_err(|error| part.in_row(error))?;
        body.times.mesh_s = mesh_s;
        let at_home = |k: usize, l: usize| units.are_near(k, l) && home(parts, count, k, l) == i;
        Ok(part.taken(&body, inside.interface.elements(), &remarks, &at_home)?)
    }

    fn assembled(&self, curves: &[CrackCurve], units: &Units, all: Vec<Taken>) -> CrackedBody {
        let count = units.cracks.len();
        let tips = self.network.tips();
        let mut near: Vec<Vec<(usize, Matrix)>> = vec![Vec::new(); count];
        let mut of_units: Vec<Option<UnitOfPart>> = (0..count).map(|_| None).collect();
        let mut times = BodyTimes::default();
        let mut dofs = 0;
        for Taken { pairs, units, times: own, dofs: of_part } in all {
            for ((k, l), block) in pairs {
                if k != l {
                    near[l].push((k, block.transposed()));
                }
                near[k].push((l, block));
            }
            for (k, unit) in units {
                of_units[k] = Some(unit);
            }
            times.mesh_s += own.mesh_s;
            times.enrichment_s += own.enrichment_s;
            times.border_s += own.border_s;
            times.sif_s += own.sif_s;
            times.condensation_s += own.condensation_s;
            dofs += of_part;
        }
        near.iter_mut().for_each(|blocks| blocks.sort_by_key(|(l, _)| *l));
        let of_units: Vec<UnitOfPart> = of_units.into_iter().flatten().collect();
        // Points and samples crack by crack, and the index of each unit's points.
        let unit_of = units.of_cracks();
        let mut faces = FaceMesh::default();
        let mut points: Vec<Vec<usize>> = of_units.iter().map(|u| vec![0; u.points.len()]).collect();
        for (crack, &k) in unit_of.iter().enumerate() {
            for (own, point) in of_units[k].points.iter().enumerate().filter(|(_, p)| p.crack == crack) {
                points[k][own] = faces.points.len();
                faces.points.push(*point);
            }
        }
        for (crack, &k) in unit_of.iter().enumerate() {
            for (_, sample) in of_units[k].samples.iter().filter(|(on, _)| *on == crack) {
                let place = |(point, length): (usize, f64)| {
                    if length == 0.0 { (0, 0.0) } else { (points[k][point], length) }
                };
                faces.samples.push(FaceSample { shares: sample.shares.map(place), ..*sample });
            }
        }
        let mut remarks = of_thin_flaps(self.network);
        let mut gains = Vec::with_capacity(tips.len());
        for tip in &tips {
            let unit = &of_units[unit_of[tip.crack]];
            let Some(own) = unit.tips.iter().find(|own| own.tip == tip.crack_end()) else { continue };
            let gain = own.gains.iter().map(|&(l, point, gains)| (points[l][point], gains));
            gains.push(TipGain { points: gain.collect() });
            remarks.extend(own.remarks.iter().cloned());
        }
        let dislocations: Vec<Vec<Source<'_>>> =
            of_units.iter().map(|unit| unit.sources(self.network, curves)).collect();
        let modulus = self.steel.plane_strain_modulus();
        let far = FarRow { units, curves, faces: &faces, points: &points, sources: &dislocations, modulus }
            .stiffness();
        let extents = (0..count).map(|k| units.span(k)).collect();
        let blocks = BlockStiffness { units: points, extents, near, far, tips: gains };
        CrackedBody { dofs, times, remarks, ..CrackedBody::by_groups(faces, tips, blocks) }
    }
}

/// The grid `lines` between `from` and `to`, continued beyond both at increasing distances.
fn lines_around(lines: &[f64], (from, to): (f64, f64)) -> Vec<f64> {
    let last = lines.len() - 1;
    let first = lines.partition_point(|&x| x <= from).clamp(1, last) - 1;
    let end = lines.partition_point(|&x| x < to).clamp(first + 1, last);
    // `distances` of lines from an end of the part, and the `step` there.
    let beyond = |distances: Vec<f64>, step: f64| {
        let mut chosen = Vec::new();
        let (mut at, mut next) = (0.0, 0);
        while next < distances.len() {
            let reach = at + step + OUTER_GRADING * at;
            next = distances.partition_point(|&d| d <= reach).max(next + 1);
            at = distances[next - 1];
            chosen.push(next);
        }
        chosen
    };
    let left = lines[..first].iter().rev().map(|x| lines[first] - x).collect();
    let right = lines[end + 1..].iter().map(|x| x - lines[end]).collect();
    let before = beyond(left, lines[first + 1] - lines[first]).into_iter().rev().map(|i| first - i);
    let after = beyond(right, lines[end] - lines[end - 1]).into_iter().map(|i| end + i);
    before.chain(first..=end).chain(after).map(|i| lines[i]).collect()
}
