//! The stabilised passage over cracks in space, its history and its record.

use super::body::{FrontPoint, FrontSif, SpaceBody};
use super::contact::SpaceContactError;
use super::passage::SpacePassages;
use super::states::{SpaceFaces, SpaceHistory, SpacePassageSettings, SpaceStatus};
use crate::body::FacePoint;
use crate::contact::{FaceState, FaceStatus, StepControl};
use crate::fracture::{Sif, SifHistory};
use crate::growth::{
    FaceAcross, FaceRecord, GroupsError, Memory, PassageRecord, PassageSettings, Repeats, SolverCounts,
    StabilisedPassage, until_repeated,
};
use crate::linear::LinearError;
use crate::math::Vec2;
use std::rc::Rc;

/// Largest number of times that two intervals between output positions are halved.
const HALVINGS: usize = 8;

/// Passages computed until the history repeats.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StabilisedSpace {
    /// All passages, the stabilised one last.
    pub passages: Vec<SpaceHistory>,
    /// K after the last passage, without the wheel, MPa √mm.
    pub between: Vec<FrontSif>,
    /// Effort of all passages.
    pub counts: SolverCounts,
    /// Change of K between the last two passages, relative to its peak; `None` after a single one.
    pub last_change: Option<f64>,
    /// The estimated error of K, where cracks are solved for in groups.
    pub groups: Option<GroupsError>,
}

/// Passages over cracks that are solved for together or in groups.
pub(super) trait Passages {
    /// The largest K (MPa √mm) in a trial passage over virgin faces, which is not counted.
    ///
    /// Errors: contact that does not converge; an interruption.
    fn trial(&mut self, settings: &SpacePassageSettings) -> Result<f64, SpaceContactError>;

    /// A passage over the faces `faces`, which are updated to their state after it, without the
    /// wheel.
    ///
    /// Errors: contact that does not converge; an interruption.
    fn pass(
        &mut self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError>;

    /// The estimated error of K; none where all cracks are solved for together.
    ///
    /// Errors: matrices whose shapes do not match.
    fn error(&self) -> Result<Option<GroupsError>, LinearError>;
}

impl Passages for SpacePassages<'_> {
    fn trial(&mut self, settings: &SpacePassageSettings) -> Result<f64, SpaceContactError> {
        Ok(Self::pass(self, settings, &mut self.virgin())?.peak())
    }

    fn pass(
        &mut self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError> {
        Self::pass(self, settings, faces)
    }

    fn error(&self) -> Result<Option<GroupsError>, LinearError> {
        Ok(None)
    }
}

/// Computes passages over the faces of `body`, with friction in the cracks or without any, until K
/// changes by less than the tolerance.
///
/// The step control is scaled by the peak of K in a trial passage with one step between positions.
///
/// Errors: contact that does not converge; an interruption.
pub(super) fn stabilised_space_passage(
    body: &SpaceBody,
    memory: Memory,
    passages: &mut impl Passages,
    settings: &PassageSettings,
) -> Result<StabilisedSpace, SpaceContactError> {
    let mut faces = SpaceFaces::virgin(body.points().len());
    let coarse = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let fine = match settings.step_control {
        StepControl::Fixed => coarse,
        StepControl::Adaptive => {
            let guarded = SpacePassageSettings { halvings: HALVINGS, ..coarse };
            let peak = match passages.trial(&coarse) {
                Err(SpaceContactError::NotConverged { .. }) => passages.trial(&guarded),
                peak => peak,
            }?;
            let tolerance = (settings.step_tolerance * peak).max(f64::MIN_POSITIVE);
            SpacePassageSettings { tolerance, halvings: HALVINGS }
        }
    };
    let repeated = until_repeated(settings, memory, |_, _| passages.pass(&fine, &mut faces).map(Rc::new))?;
    drop(repeated.last);
    let histories: Vec<SpaceHistory> = repeated.records.into_iter().map(Rc::unwrap_or_clone).collect();
    let outputs = settings.passage.positions;
    let counts = histories.iter().fold(SolverCounts::default(), |sum, history| {
        let one = SolverCounts {
            passages: 0,
            substeps: history.steps.saturating_sub(outputs + 2),
            solves: history.steps,
            iterations: history.iterations,
            iterations_max: history.iterations_max,
            complementarity_max: history.violation,
        };
        sum.and(one)
    });
    Ok(StabilisedSpace {
        between: body.sifs_of_jumps(&faces.jumps),
        counts: SolverCounts { passages: histories.len(), ..counts },
        passages: histories,
        last_change: repeated.change,
        groups: passages.error()?,
    })
}

impl Repeats for Rc<SpaceHistory> {
    type Record = Self;

    fn record(&self) -> Self {
        Self::clone(self)
    }

    fn change_from(&self, before: &Self) -> f64 {
        self.difference(before) / self.peak().max(f64::MIN_POSITIVE)
    }
}

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
        let part = &body.cracks()[crack];
        let [along, _, down] = body.frame_of(a).position(1.0, 0.0);
        let [s, _] = part.coordinates(body.points()[a]);
        FacePoint {
            crack,
            segment: part.sheet.way().part(s),
            s,
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
