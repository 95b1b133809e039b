//! A run as its decision sees it: what all its cracks have reached over traffic.

use super::path::GrowthPath;
use crate::log::StepDigest;
use railcrack::growth::{Axles, Piece, PieceKind, RunStop, SurfaceRemoval, TipRecord, TipStop, WheelShares};
use railcrack::math::MPA_SQRT_MM;
use railcrack::words::{Choice, Word};
use serde::{Deserialize, Serialize};

/// All cracks at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CoursePoint {
    /// Axles so far.
    pub axles: f64,
    /// Their estimated error by the increments.
    pub axles_error: f64,
    /// Growth of the fastest tip and removal of the surface so far, summed, mm: it never decreases.
    pub work: f64,
    /// Removal of the surface so far, mm.
    pub removed: f64,
    /// The largest da/dN of all tips, mm per axle.
    pub rate: f64,
    /// ΔK_eq of that tip, MPa√m.
    pub delta_keq: f64,
    /// The largest k1 of a virtual kink of all tips, MPa√m.
    pub largest_k1: f64,
    /// Depth of the deepest tip, mm.
    pub depth: f64,
    /// Crack and tip of it, from 0.
    pub deepest: (usize, usize),
    /// Length of the longest crack, mm.
    pub length: f64,
    /// That crack, from 0.
    pub longest: usize,
    /// Depth of the deepest tip of the crack that is looked for, mm.
    pub own_depth: f64,
    /// Its length, mm.
    pub own_length: f64,
    /// Shares of the wheels of a mix in the rate.
    pub shares: WheelShares,
}

/// How the rail fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FailureMode {
    /// A tip reaches the critical depth.
    Depth,
    /// A crack reaches the critical length.
    Length,
    /// The rail breaks.
    Fracture,
    /// A crack breaks out at the running surface: a piece of it is lost.
    Spall,
    /// A piece is wholly cut off.
    Detached,
}

impl Choice for FailureMode {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Depth, Word::now("depth", "critical depth")),
        (Self::Length, Word::now("length", "critical length")),
        (Self::Fracture, Word::now("fracture", "fracture")),
        (Self::Spall, Word::now("spall", "spall")),
        (Self::Detached, Word::now("detached", "detached piece")),
    ];
}

impl FailureMode {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        self.meaning()
    }
}

/// An event on a course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CourseEvent {
    /// Growth and removal at which it takes place, mm.
    pub work: f64,
    /// Axles until then.
    pub axles: f64,
    /// The mode of failure; none: the last crack is worn away.
    pub mode: Option<FailureMode>,
    /// Crack and tip, from 0.
    pub tip: (usize, usize),
}

/// The end of a course.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CourseEnd {
    /// Nothing more: no crack grows any longer.
    Rest,
    /// Nothing more: the last crack is worn away.
    Worn,
    /// Something that was not computed.
    Unknown,
}

/// A run over traffic.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Course {
    /// At the start of each step; a grinding lies between two of them with the same axles.
    pub points: Vec<CoursePoint>,
    /// Its events, in order.
    pub events: Vec<CourseEvent>,
    /// Its end.
    pub end: CourseEnd,
}

impl Course {
    /// The course of `steps` with `removal`; `found` is the crack (from 0) that an inspection looks
    /// for.
    pub fn of(steps: &[StepDigest], removal: &SurfaceRemoval<Axles>, found: usize) -> Self {
        let mut points: Vec<CoursePoint> = Vec::with_capacity(steps.len());
        let mut events: Vec<CourseEvent> = Vec::new();
        let (mut grown, mut ground) = (0.0, 0.0);
        let mut before: Option<&StepDigest> = None;
        // Cracks whose flakes come off without a failure.
        let mut come_off: Vec<usize> = Vec::new();
        for (i, step) in steps.iter().enumerate() {
            // A grinding is a step without cycles.
            if let Some(before) = before.filter(|before| before.load_cycles == step.load_cycles) {
                ground += (step.removed - before.removed).max(0.0);
            }
            before = Some(step);
            // The wear of a step was that of its predicted cycles, and the next one makes up for
            // the difference.
            let removed = removal.wear * step.load_cycles + ground;
            let Some(point) = point(step, grown, removed, found) else { continue };
            points.push(point);
            let flaked: Vec<usize> = harmless(&step.pieces, removal).collect();
            come_off.extend(flaked);
            for event in events_of(step, point.work, &come_off) {
                let is_known = |known: &CourseEvent| (known.mode, known.tip) == (event.mode, event.tip);
                if !events.iter().any(is_known) {
                    events.push(event);
                }
            }
            let largest = step.tips.iter().map(|tip| tip.increment).fold(0.0, f64::max);
            // The increment of the last step was not made.
            if i + 1 < steps.len() {
                grown += largest;
            }
        }
        let end = match steps.last().and_then(|step| step.stop) {
            Some(RunStop::NoTipGrows(TipStop::WornAway)) => CourseEnd::Worn,
            Some(RunStop::NoTipGrows(TipStop::BreakOut)) if !come_off.is_empty() => CourseEnd::Rest,
            Some(RunStop::NoTipGrows(TipStop::Arrest | TipStop::Coalescence)) => CourseEnd::Rest,
            _ => CourseEnd::Unknown,
        };
        Self { points, events, end }
    }

    /// The course of one crack along `path`.
    pub fn of_path(path: &GrowthPath) -> Self {
        let first = path.points.first().map_or(0.0, |point| point.length);
        let tip = (path.tip.0.saturating_sub(1), path.tip.1.saturating_sub(1));
        let points: Vec<CoursePoint> = path
            .points
            .iter()
            .map(|point| CoursePoint {
                axles: point.axles,
                axles_error: 0.0,
                work: point.length - first,
                removed: 0.0,
                rate: point.rate,
                delta_keq: point.delta_keq,
                largest_k1: point.largest_k1,
                depth: point.depth,
                deepest: tip,
                length: point.length,
                longest: tip.0,
                own_depth: point.depth,
                own_length: point.length,
                shares: point.shares,
            })
            .collect();
        let breaks = points.last().filter(|_| path.breaks);
        let mode = Some(FailureMode::Fracture);
        let events =
            breaks.map(|last| CourseEvent { work: last.work, axles: last.axles, mode, tip }).into_iter();
        Self { events: events.collect(), points, end: CourseEnd::Unknown }
    }

    /// Axles until `mode` first happens as an event.
    pub fn event(&self, mode: Option<FailureMode>) -> Option<&CourseEvent> {
        self.events.iter().find(|event| event.mode == mode)
    }
}

/// All cracks of `step`, whose fastest tip has `grown` and whose surface has lost `removed` (mm) so
/// far.
fn point(step: &StepDigest, grown: f64, removed: f64, found: usize) -> Option<CoursePoint> {
    let fastest = step.tips.iter().max_by(|a, b| a.rate.total_cmp(&b.rate))?;
    let deepest = step.tips.iter().max_by(|a, b| a.depth().total_cmp(&b.depth()))?;
    let longest = step.tips.iter().max_by(|a, b| a.length.total_cmp(&b.length))?;
    let own = || step.tips.iter().filter(|tip| tip.tip.crack == found);
    let k1 = step.tips.iter().map(TipRecord::compared_k1).fold(0.0, f64::max);
    Some(CoursePoint {
        axles: step.load_cycles,
        axles_error: step.cycles_error,
        work: grown + removed,
        removed,
        rate: fastest.rate,
        delta_keq: fastest.delta_keq / MPA_SQRT_MM,
        largest_k1: k1 / MPA_SQRT_MM,
        depth: deepest.depth(),
        deepest: (deepest.tip.crack, deepest.tip.tip),
        length: longest.length,
        longest: longest.tip.crack,
        own_depth: own().map(TipRecord::depth).fold(0.0, f64::max),
        own_length: own().map(|tip| tip.length).fold(0.0, f64::max),
        shares: fastest.shares,
    })
}

/// The cracks (from 0) of those of `pieces` whose loss is no failure under `removal`.
fn harmless(pieces: &[Piece], removal: &SurfaceRemoval<Axles>) -> impl Iterator<Item = usize> {
    pieces.iter().filter(|piece| !removal.is_loss(piece)).map(|piece| piece.crack)
}

/// The events of `step`, which begins with `work`; flakes of the cracks `come_off` (from 0) are
/// none.
fn events_of(step: &StepDigest, work: f64, come_off: &[usize]) -> Vec<CourseEvent> {
    let axles = step.load_cycles;
    let event = |mode, tip| CourseEvent { work, axles, mode, tip };
    let mut events: Vec<CourseEvent> = Vec::new();
    let stopped = |stop: TipStop| step.tips.iter().find(move |tip| tip.stop == Some(stop));
    let is_flake = |crack: usize| come_off.contains(&crack);
    if step.stop == Some(RunStop::Fracture) {
        let breaks = stopped(TipStop::Fracture)
            .or_else(|| step.tips.iter().max_by(|a, b| a.compared_k1().total_cmp(&b.compared_k1())));
        events.extend(breaks.map(|tip| event(Some(FailureMode::Fracture), (tip.tip.crack, tip.tip.tip))));
    }
    let broken_out = |tip: &&TipRecord| tip.stop == Some(TipStop::BreakOut) && !is_flake(tip.tip.crack);
    if let Some(tip) = step.tips.iter().find(broken_out) {
        events.push(event(Some(FailureMode::Spall), (tip.tip.crack, tip.tip.tip)));
    }
    let lost = |piece: &&Piece| piece.kind == PieceKind::Detached || !is_flake(piece.crack);
    for piece in step.pieces.iter().filter(lost) {
        let mode = match piece.kind {
            PieceKind::Spall => FailureMode::Spall,
            PieceKind::Detached => FailureMode::Detached,
        };
        if !events.iter().any(|event| event.mode == Some(mode)) {
            let last = step.tips.iter().filter(|tip| tip.tip.crack == piece.crack).map(|tip| tip.tip.tip);
            events.push(event(Some(mode), (piece.crack, last.max().unwrap_or(0))));
        }
    }
    if step.stop == Some(RunStop::NoTipGrows(TipStop::WornAway))
        && let Some(tip) = stopped(TipStop::WornAway)
    {
        events.push(event(None, (tip.tip.crack, tip.tip.tip)));
    }
    events
}
