//! Passages of the wheel over a row of many cracks, in windows that go along with it.

use super::face_load::{FaceLoad, Part};
use super::passage::{
    EDGE_STATIONS, FAR_STATIONS, Mark, Pass, RAMP_STATIONS, mouths, places, until_stabilised,
};
use super::positions::output_positions;
use super::tip_sifs::TipSifs;
use super::windows::{RowFaces, Span};
use super::{Observer, PassageError, PassageRecord, PassageSettings, RailLoad, StabilisedPassage};
use crate::body::BlockStiffness;
use crate::contact::{ContactSolver, StepControl};
use std::ops::Range;

/// [`super::stabilised_passage`] of a body by groups.
pub(super) fn passages_along(
    face_load: &FaceLoad,
    blocks: &BlockStiffness,
    load: RailLoad,
    solver: &dyn ContactSolver,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    let problem = face_load.problem;
    let xc = output_positions(&settings.passage, load.wheel.bending(), &places(problem));
    let expected = face_load.expected_slip(&xc);
    let interrupted = || observer.interrupted();
    let faces = RowFaces::new(
        face_load,
        blocks,
        load,
        solver,
        (settings.step_tolerance, settings.step_control),
        &expected,
        &interrupted,
    );
    let mut row = RowPassage {
        faces,
        xc: &xc,
        edges: load.wheel.edges(),
        half_width: load.wheel.half_width(),
        mouths: mouths(problem),
        control: settings.step_control,
        edge_steps: 0,
    };
    let mut tips = TipSifs::virgin(problem);
    if load.residual.is_some() {
        let stations: Vec<(f64, bool)> =
            (1..=RAMP_STATIONS).map(|k| (k as f64 / RAMP_STATIONS as f64, false)).collect();
        row.far(Part::Ramp, 0.0, &stations, 0.5 * (xc[0] + xc[xc.len() - 1]), &mut tips)?;
    }
    let passed = until_stabilised(settings, problem, |_, before| row.pass(before, &mut tips, observer))?;
    Ok(passed.record(row.faces.counts, row.edge_steps, problem, Some(row.faces.coupling_error)))
}

/// Distance over a, beside the way of the wheel in a span, up to which cracks are in the window:
/// they change their statuses from 3 a before the wheel to 3 a behind it.
const MARGIN: f64 = 3.0;
/// Length of a span, over a.
const SPAN: f64 = 1.0;
/// Difference of K over its peak at which a passage joins the one before.
const ALIKE: f64 = 5e-4;
/// Share of the first station of an approach at which virgin faces take their first statuses.
const FIRST: f64 = 1e-3;

struct RowPassage<'a> {
    faces: RowFaces<'a>,
    xc: &'a [f64],
    edges: &'a [f64],
    half_width: f64,
    mouths: Vec<f64>,
    control: StepControl,
    edge_steps: usize,
}

impl RowPassage<'_> {
    /// The groups around wheel positions from `one` to `other`, mm.
    fn window(&self, one: f64, other: f64) -> Range<usize> {
        let reach = MARGIN * self.half_width;
        let (low, high) = (one.min(other) - reach, one.max(other) + reach);
        let extents = &self.faces.blocks.extents;
        let near: Vec<usize> =
            (0..extents.len()).filter(|&k| extents[k].1 >= low && extents[k].0 <= high).collect();
        match (near.first(), near.last()) {
            (Some(&first), Some(&last)) => {
                let range = first..last + 1;
                if range.len() >= 2 { range } else { first.saturating_sub(1)..(last + 2).min(extents.len()) }
            }
            _ => {
                let distance = |k: usize| (extents[k].0 - high).max(low - extents[k].1);
                let nearest = (0..extents.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
                let k = nearest.unwrap_or(0);
                k.saturating_sub(1)..(k + 2).min(extents.len())
            }
        }
    }

    fn far(
        &mut self,
        part: Part,
        start: f64,
        stations: &[(f64, bool)],
        x: f64,
        tips: &mut TipSifs,
    ) -> Result<(), PassageError> {
        let mut from = start;
        for stations in stations.chunks(1) {
            let window = self.window(x, x);
            self.faces.follow(&Span { part, from, stations, window }, tips)?;
            from = stations[stations.len() - 1].0;
        }
        Ok(())
    }

    fn distance(&self, x: f64) -> f64 {
        let samples = self.faces.problem.body().faces.samples.iter();
        samples.map(|s| (s.point.x - x).abs()).fold(f64::INFINITY, f64::min).max(self.half_width)
    }

    fn pass(
        &mut self,
        before: Option<&Pass>,
        tips: &mut TipSifs,
        observer: &dyn Observer,
    ) -> Result<Pass, PassageError> {
        self.faces.passage += 1;
        let problem = self.faces.problem;
        let (first, last) = (self.xc[0], self.xc[self.xc.len() - 1]);
        let travel = (last - first).signum();
        tips.begin();
        let near = self.distance(first);
        let share = |k: usize| k as f64 / FAR_STATIONS as f64 / near;
        let approach = Part::Far { origin: first + travel * near, side: -travel };
        // Virgin faces take their first statuses under almost no load.
        let stations: Vec<(f64, bool)> = std::iter::once(FIRST * share(1))
            .chain((1..=FAR_STATIONS).map(share))
            .map(|share| (share, false))
            .collect();
        self.far(approach, 0.0, &stations, first, tips)?;

        let record = PassageRecord {
            xc: self.xc.to_vec(),
            sifs: vec![Vec::new(); problem.body().tips.len()],
            fluid: Vec::new(),
            kiii: Vec::new(),
        };
        let mut pass =
            Pass { record, histories: Vec::new(), states: Vec::new(), marks: Vec::new(), joins: false };
        let step = SPAN * self.half_width;
        let spans = (((last - first).abs() / step).ceil() as usize).max(1);
        let joint = |k: usize| first + (last - first) * k as f64 / spans as f64;
        let mut next = 0;
        for k in 0..spans {
            let (from, to) = (joint(k), if k + 1 == spans { last } else { joint(k + 1) });
            let outputs: Vec<f64> =
                self.xc[next..].iter().copied().take_while(|x| (to - x) * travel >= 0.0).collect();
            let mut stations: Vec<(f64, bool)> =
                self.edges_between(from, to).into_iter().map(|x| (x, false)).collect();
            self.edge_steps += stations.len();
            stations.extend(outputs.iter().map(|&x| (x, true)));
            if stations.iter().all(|station| station.0 != to) {
                stations.push((to, false));
            }
            stations.sort_by(|a, b| (a.0 * travel).total_cmp(&(b.0 * travel)));
            stations.dedup_by(|a, b| a.0 == b.0 && !a.1);
            let window = self.window(from, to);
            let span = Span { part: Part::Over, from, stations: &stations, window };
            let known = self.faces.follow(&span, tips)?;
            for (solution, mark) in known {
                pass.record.sifs.iter_mut().zip(mark.sifs()).for_each(|(tip, k)| tip.push(k));
                pass.states.push(solution.face_states(problem));
                pass.marks.push(Mark { faces: solution, tips: mark });
                let done = pass.marks.len();
                observer.progress(done as f64 / self.xc.len() as f64);
                if let Some(before) = before
                    && self.faces.are_alike(&pass.marks[done - 1].faces, &before.marks[done - 1].faces)
                    && pass.marks[done - 1].tips.is_within(ALIKE, &before.marks[done - 1].tips, tips)
                {
                    pass.histories = tips.histories_until(&pass.marks[done - 1].tips);
                    pass.join(before);
                    return Ok(pass);
                }
            }
            next += outputs.len();
        }
        let near = self.distance(last);
        let share = |k: usize| k as f64 / FAR_STATIONS as f64 / near;
        let departure = Part::Far { origin: last - travel * near, side: travel };
        let stations: Vec<(f64, bool)> = (0..FAR_STATIONS).rev().map(|k| (share(k), false)).collect();
        self.far(departure, share(FAR_STATIONS), &stations, last, tips)?;
        pass.histories = tips.histories();
        Ok(pass)
    }

    fn edges_between(&self, from: f64, to: f64) -> Vec<f64> {
        let travel = (to - from).signum();
        let within = |x: &f64| (x - from) * travel > 0.0 && (to - x) * travel > 0.0;
        if !(self.faces.problem.has_friction() && self.control == StepControl::Adaptive) {
            return Vec::new();
        }
        let edges = self.mouths.iter().flat_map(|mouth| self.edges.iter().map(move |edge| mouth - edge));
        edges
            .flat_map(|edge| EDGE_STATIONS.map(|share| edge + share * self.half_width))
            .filter(within)
            .collect()
    }
}
