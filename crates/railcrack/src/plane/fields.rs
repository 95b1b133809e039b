//! Stress and displacement around the cracks at selected wheel positions: the sum of the fields of
//! the uncracked rail and of the cracked body.

use super::face_load::{FaceLoad, LoadPhase, RailLoad};
use crate::body::{BodyError, Face, FacePoint, FieldGrid, FieldLoad};
use crate::contact::{FaceState, LoadPath, SurfaceState};
use crate::coupling::CoupledContact;
use crate::field::{TableWheel, Wheel};
use crate::growth::{FieldRecord, FieldSettings, FieldSnapshot, StabilisedPassage};
use crate::load::{ContactRow, TableContact};
use crate::math::{Vec2, axpy};

/// The fields at `positions` (mm) in the stabilised `passage`, under a wheel that feels the cracks
/// as `felt`, if it does; `None` where the engine provides none.
///
/// Errors: fields that the engine cannot compute.
pub(super) fn record_fields(
    face_load: &FaceLoad,
    (load, felt): (RailLoad, Option<&CoupledContact>),
    passage: &StabilisedPassage,
    settings: &FieldSettings,
) -> Result<Option<FieldRecord>, BodyError> {
    let body = face_load.problem.body();
    let Some(solver) = &body.fields else { return Ok(None) };
    let Some(xc) = passage.passages.last().map(|record| &record.xc) else { return Ok(None) };
    let chosen = settings.nearest(xc);
    let faces = &body.faces.points;
    let coupled: Vec<Option<TableWheel>> =
        chosen.iter().map(|&i| felt_wheel(passage.faces.surface.get(i)?, xc[i], felt?)).collect();
    let wheels: Vec<&dyn Wheel> = coupled
        .iter()
        .map(|coupled| coupled.as_ref().map_or(load.wheel, |wheel| wheel as &dyn Wheel))
        .collect();
    let forces = chosen.iter().zip(&coupled);
    let forces: Vec<Vec<f64>> =
        forces.map(|(&i, wheel)| forces_at(face_load, passage, i, wheel.as_ref())).collect();
    let loads: Vec<FieldLoad> = (chosen.iter().zip(&forces).zip(&wheels))
        .map(|((&i, forces), &wheel)| FieldLoad { forces, wheel: Some((wheel, xc[i])) })
        .collect();
    let cracked = solver.fields(&loads)?;
    let grid = cracked.grid;
    let snapshots = chosen
        .iter()
        .zip(cracked.loads)
        .zip(&wheels)
        .map(|((&position, mut field), wheel)| {
            let xc = xc[position];
            for (u, point) in field.displacement.iter_mut().zip(&grid.points) {
                *u = *u + wheel.displacement(*point, xc);
            }
            for (stress, &point) in field.stress.iter_mut().zip(&grid.inside) {
                *stress = *stress + wheel.stress(point, xc);
                if let Some(residual) = load.residual {
                    *stress = *stress + residual.stress(point);
                }
            }
            let traction = tractions(&grid, faces, &passage.faces.states[position]);
            FieldSnapshot { position, xc, displacement: field.displacement, stress: field.stress, traction }
        })
        .collect();
    Ok(Some(FieldRecord { grid, snapshots }))
}

/// Nodal forces (N/mm) on the cracked body at output position `i` of `passage`, under a coupled
/// `wheel` or that of `face_load`.
fn forces_at(
    face_load: &FaceLoad,
    passage: &StabilisedPassage,
    i: usize,
    wheel: Option<&TableWheel>,
) -> Vec<f64> {
    let faces = &face_load.problem.body().faces;
    let Some(record) = passage.passages.last() else { return Vec::new() };
    let xc = record.xc[i];
    let in_crack = |tip: usize| record.fluid.get(tip)?.get(i).copied();
    let removed = match wheel {
        Some(wheel) => {
            let mut forces = faces.graded_nodal_forces(|point| wheel.stress(point, xc));
            axpy(1.0, face_load.residual(), &mut forces);
            face_load.press_from_mouth(&mut forces, in_crack);
            forces
        }
        None => face_load.along(LoadPhase::Over).nodal_forces(xc),
    };
    let states = faces.points.iter().zip(&passage.faces.states[i]);
    let contact = states.flat_map(|(point, s)| [-s.s12 * point.weight, -s.s22 * point.weight]);
    let mut forces: Vec<f64> =
        removed.into_iter().zip(contact).map(|(removed, contact)| removed + contact).collect();
    face_load.press_trapped(&mut forces, in_crack);
    forces
}

/// Traction exerted by the opposite face at the points of the faces, MPa: the contact traction on
/// the + face, its negative on the − face.
fn tractions(grid: &FieldGrid, faces: &[FacePoint], states: &[FaceState]) -> Vec<Vec2> {
    let at_face_point = |j: usize| {
        let tangent = faces[j].tangent;
        tangent * -states[j].s12 + tangent.left() * -states[j].s22
    };
    let mut tractions = vec![Vec2::default(); grid.points.len()];
    for line in &grid.lines {
        let sign = match line.face {
            Face::Plus => 1.0,
            Face::Minus => -1.0,
        };
        for (&end, shares) in line.ends.iter().zip(&line.tractions) {
            let used = shares.iter().filter(|(_, share)| *share != 0.0);
            tractions[end] =
                used.fold(Vec2::default(), |sum, &(j, share)| sum + at_face_point(j) * (sign * share));
        }
    }
    tractions
}

/// Distance (mm) of the two nodes of a mouth in a table, whose abscissae increase.
const BETWEEN_LIPS: f64 = 1e-5;

/// The wheel with the pressures of the surface `nodes`, centred at `xc` (mm); `None` without
/// pressure.
pub(super) fn felt_wheel(nodes: &[SurfaceState], xc: f64, contact: &CoupledContact) -> Option<TableWheel> {
    let mut before = f64::NEG_INFINITY;
    let mut rows = Vec::with_capacity(nodes.len());
    for node in nodes {
        let x = if node.x > before { node.x } else { before + BETWEEN_LIPS };
        before = x;
        // Round-off is neither tension nor pressure at the ends.
        let pressure = node.pressure.max(0.0);
        let u = x - xc;
        rows.push(ContactRow { u, pressure, shear: contact.shear_ratio(u) * pressure });
    }
    if let [first, .., last] = &mut rows[..] {
        for end in [first, last] {
            (end.pressure, end.shear) = (0.0, 0.0);
        }
    }
    let table = TableContact::new(rows, None).ok()?;
    Some(TableWheel::new(&table, &contact.steel))
}
