//! Records of a step of growth in space, in the form of those in the plane.

use super::body::SpaceBody;
use super::front_motion::FrontSpeeds;
use super::passage::SpaceHistory;
use super::stabilised::StabilisedSpace;
use super::states::SpaceStatus;
use super::tips::FrontDrive;
use super::way::Way;
use crate::body::FacePoint;
use crate::contact::{FaceState, FaceStatus};
use crate::fracture::Sif;
use crate::growth::{FaceAcross, FaceRecord, FrontShape, PassageRecord, RunStop, TipRecord, TipStop};
use crate::math::Vec2;

/// Shapes and body of a step.
pub(super) struct StepOf<'a> {
    pub shapes: &'a [FrontShape],
    pub body: &'a SpaceBody,
}

impl StepOf<'_> {
    /// The points of the fronts with their increments and stops.
    pub fn tips(&self, drive: FrontDrive, speeds: &[FrontSpeeds], way: &Way) -> Vec<TipRecord> {
        let toughness_of =
            |tip: &TipRecord| way.stop == Some(RunStop::Fracture) && tip.rate >= crate::fatigue::RUNAWAY;
        let FrontDrive { tips, growing, .. } = drive;
        let points = self.body.front();
        tips.into_iter()
            .zip(growing)
            .zip(points)
            .map(|((mut tip, rate), point)| {
                let crack = point.crack;
                let cycles = way.cycles_of(crack);
                tip.increment = cycles * speeds[crack].at(&self.shapes[crack], point);
                if let Some(front) =
                    tip.front.as_mut().filter(|front| front.counts && rate > 0.0 && cycles > 0.0)
                {
                    front.followed = Some(tip.increment / (cycles * rate));
                }
                tip.stop = if toughness_of(&tip) {
                    Some(TipStop::Fracture)
                } else if rate > 0.0 {
                    way.stopped[crack]
                } else {
                    Some(TipStop::Arrest)
                };
                tip
            })
            .collect()
    }
}

/// K of each front point over a passage.
pub(super) fn passage_record(history: &SpaceHistory) -> PassageRecord {
    let points = history.sifs.first().map_or(0, Vec::len);
    let of_point = |q: usize| history.sifs.iter().map(move |sifs| sifs[q]);
    PassageRecord {
        xc: history.positions.clone(),
        sifs: (0..points).map(|q| of_point(q).map(|k| Sif { ki: k.ki, kii: k.kii }).collect()).collect(),
        fluid: Vec::new(),
        kiii: (0..points).map(|q| of_point(q).map(|k| k.kiii).collect()).collect(),
    }
}

/// The faces during the stabilised passage: stresses are nodal forces over the areas of the hats.
pub(super) fn face_record(body: &SpaceBody, passage: &StabilisedSpace) -> FaceRecord {
    let areas = body.areas();
    // Down the dip, as seen from the side of the rail.
    let points = body.points().iter().zip(&areas).enumerate().map(|(a, ([x, _, depth], area))| {
        let crack = body.crack_of(a);
        let [along, _, down] = body.cracks()[crack].frame.position(1.0, 0.0);
        FacePoint {
            crack,
            segment: 0,
            s: depth / down,
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
                // The faces transmit what they exert on each other.
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
        }),
    }
}
