//! Records of passages in space, in the form used for the plane.

use super::body::{FrontPoint, SpaceBody};
use super::history::SpaceHistory;
use super::stabilised::StabilisedSpace;
use super::states::SpaceStatus;
use crate::body::FacePoint;
use crate::contact::{FaceState, FaceStatus};
use crate::fracture::{Sif, SifHistory};
use crate::growth::{FaceAcross, FaceRecord, PassageRecord, StabilisedPassage};
use crate::math::Vec2;

/// The stabilised passage in the form used for the plane; `written` lists the output positions
/// (from 0) whose jumps are written.
pub(super) fn stabilised_record(
    body: &SpaceBody,
    passage: &StabilisedSpace,
    written: Vec<usize>,
) -> StabilisedPassage {
    let last = passage.passages.last();
    let of_point = |q: usize| {
        // Unloaded ends: before the wheel arrives and after it has left.
        let ends = last.map(|history| history.before[q]).into_iter().chain([passage.between[q]]);
        ends.chain(last.into_iter().flat_map(move |history| history.sifs.iter().map(move |sifs| sifs[q])))
    };
    let points = 0..body.front().len();
    let range = |q: usize| {
        let (low, high) = of_point(q)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), k| (low.min(k.kiii), high.max(k.kiii)));
        (high - low).max(0.0)
    };
    let history =
        |q: usize| SifHistory { samples: of_point(q).map(|k| Sif { ki: k.ki, kii: k.kii }).collect() };
    StabilisedPassage {
        passages: passage.passages.iter().map(|history| passage_record(body, history)).collect(),
        histories: points.clone().map(history).collect(),
        faces: face_record(body, passage, written),
        counts: passage.counts,
        last_change: passage.last_change,
        coupling: passage.groups,
        delta_kiii: points.map(range).collect(),
    }
}

/// K of each front point over a passage.
fn passage_record(body: &SpaceBody, history: &SpaceHistory) -> PassageRecord {
    let points = history.sifs.first().map_or(0, Vec::len);
    let of_point = |q: usize| history.sifs.iter().map(move |sifs| sifs[q]);
    let fluid = |point: &FrontPoint| history.fluid.iter().map(|cracks| cracks[point.crack]).collect();
    PassageRecord {
        xc: history.positions.clone(),
        sifs: (0..points).map(|q| of_point(q).map(|k| Sif { ki: k.ki, kii: k.kii }).collect()).collect(),
        fluid: if history.fluid.is_empty() { Vec::new() } else { body.front().iter().map(fluid).collect() },
        kiii: (0..points).map(|q| of_point(q).map(|k| k.kiii).collect()).collect(),
        wheel: Vec::new(),
    }
}

/// The faces during the stabilised passage: stresses are nodal forces over the areas of the hats.
fn face_record(body: &SpaceBody, passage: &StabilisedSpace, written: Vec<usize>) -> FaceRecord {
    let areas = body.areas();
    // Direction down the dip, seen from the side of the rail.
    let points = body.points().iter().zip(&areas).enumerate().map(|(a, ([x, _, depth], area))| {
        let crack = body.crack_of(a);
        let (plane, frame) = body.plane_of(a);
        let [along, _, down] = frame.position(1.0, 0.0);
        FacePoint {
            crack,
            segment: plane,
            s: body.cracks()[crack].coordinates(body.points()[a])[0],
            position: Vec2::new(*x, -depth),
            tangent: Vec2::new(along, -down),
            weight: *area,
        }
    });
    let positions = passage.passages.last().map_or(&[][..], |history| &history.faces[..]);
    let states = positions.iter().map(|faces| {
        faces
            .status
            .iter()
            .enumerate()
            .map(|(a, status)| FaceState {
                opening: faces.jumps[3 * a].max(0.0),
                slip: faces.jumps[3 * a + 1],
                // The transmitted stress is the force between the faces over the area.
                s22: (-faces.reactions[3 * a] / areas[a]).min(0.0),
                s12: -faces.reactions[3 * a + 1] / areas[a],
                status: match status {
                    SpaceStatus::Open => FaceStatus::Open,
                    SpaceStatus::Stick => FaceStatus::Stick,
                    SpaceStatus::Slip { .. } => FaceStatus::Slip,
                },
            })
            .collect()
    });
    let across = positions.iter().map(|faces| {
        let of = |a: usize| [faces.jumps[3 * a + 2], -faces.reactions[3 * a + 2] / areas[a]];
        (0..areas.len()).map(of).collect()
    });
    FaceRecord {
        points: points.collect(),
        states: states.collect(),
        across: Some(FaceAcross {
            lateral: body.points().iter().map(|point| point[1]).collect(),
            states: across.collect(),
            cells: body.cells().to_vec(),
            written,
        }),
        surface: Vec::new(),
    }
}
