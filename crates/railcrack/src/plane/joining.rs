//! The cracks of the next step, extended by the increments, with new junctions and enclosed pieces.

use super::coalescence::Coalescence;
use super::step_state::{Step, StepState};
use crate::crack::{Crack, CrackEnd, CrackNetwork, End, Junction, point_to_segment};
use crate::growth::{BreakOut, Piece, PieceKind};
use crate::math::Vec2;

/// Outcome of the increments of a step.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outcome {
    /// The cracks of the next step.
    Grown {
        /// The cracks.
        cracks: Vec<Crack>,
        /// All their junctions.
        junctions: Vec<Junction>,
    },
    /// Pieces of the rail become detached.
    Detached(Vec<Piece>),
    /// The steps with these indices lead to no valid network.
    Impossible(Vec<usize>),
}

/// Extends the cracks by `steps`, each up to its coalescence if it has one. Without any step the
/// cracks stay as they are, even if they form no valid network, since no step is then to blame.
pub(super) fn grow(
    state: &StepState<'_>,
    steps: &[Option<Step>],
    coalescences: &[Option<Coalescence>],
) -> Outcome {
    if steps.iter().all(Option::is_none) {
        let (cracks, junctions) = (state.cracks.to_vec(), state.junctions.to_vec());
        return Outcome::Grown { cracks, junctions };
    }
    let mut paths: Vec<Vec<Vec2>> = state.cracks.iter().map(|crack| crack.points().to_vec()).collect();
    for (i, step) in steps.iter().enumerate() {
        let Some(step) = step else { continue };
        let to = coalescences[i].map_or(step.to, |coalescence| coalescence.at);
        let is_junction = |coalescence: &Coalescence| coalescence.at == step.from;
        let short = coalescences[i].is_some()
            && (to - step.from).length() < state.resolution
            && !coalescences.iter().flatten().any(is_junction);
        let path = &mut paths[step.tip.crack];
        match step.via.filter(|_| coalescences[i].is_none()) {
            Some(via) => {
                // The point of the former tip lies on the straight part before the turn.
                let is_kept = state.is_junction(step.from) || coalescences.iter().flatten().any(is_junction);
                lengthen(path, step.tip.end, via, if is_kept { Last::Stays } else { Last::Moves });
                lengthen(path, step.tip.end, to, if is_straight(step) { Last::Moves } else { Last::Stays });
            }
            None => lengthen(path, step.tip.end, to, if short { Last::Moves } else { Last::Stays }),
        }
    }
    for (step, coalescence) in steps.iter().zip(coalescences) {
        if let (Some(step), Some(coalescence)) = (step, coalescence) {
            let own =
                (coalescence.onto == step.tip.crack && coalescence.with.is_none()).then_some(step.tip.end);
            insert(&mut paths[coalescence.onto], coalescence.at, own);
        }
    }
    let pieces = detached(state, steps, coalescences, &paths);
    if !pieces.is_empty() {
        return Outcome::Detached(pieces);
    }
    let mut cracks = Vec::new();
    for (crack, path) in paths.into_iter().enumerate() {
        let Ok(longer) = Crack::polyline(path) else {
            return impossible(steps, coalescences, |i| {
                steps[i].is_some_and(|step| step.tip.crack == crack)
                    || coalescences[i].is_some_and(|coalescence| coalescence.onto == crack)
            });
        };
        cracks.push(longer);
    }
    let junctions = junctions(state, steps, coalescences);
    if CrackNetwork::joined(cracks.clone(), junctions.clone()).is_err() {
        return impossible(steps, coalescences, |i| coalescences[i].is_some());
    }
    Outcome::Grown { cracks, junctions }
}

/// Whether a step does not turn, but for round-off.
fn is_straight(step: &Step) -> bool {
    let Some(via) = step.via else { return true };
    let (before, after) = (via - step.from, step.to - via);
    before.cross(after).abs() <= STRAIGHT * before.length() * after.length()
}

/// Sine of a turn that counts as none.
const STRAIGHT: f64 = 1e-9;

/// The steps to `blame`; all of them where there are none.
fn impossible(
    steps: &[Option<Step>],
    coalescences: &[Option<Coalescence>],
    blame: impl Fn(usize) -> bool,
) -> Outcome {
    let made: Vec<usize> = (0..coalescences.len()).filter(|&i| steps[i].is_some()).collect();
    let blamed: Vec<usize> = made.iter().copied().filter(|&i| blame(i)).collect();
    Outcome::Impossible(if blamed.is_empty() { made } else { blamed })
}

/// Fate of the former tip point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Last {
    /// It becomes a vertex of the extended crack.
    Stays,
    /// It moves with the end, so that no segment shorter than the resolution remains at a junction.
    Moves,
}

fn lengthen(path: &mut Vec<Vec2>, end: End, to: Vec2, last: Last) {
    let tip = if end == End::First { 0 } else { path.len() - 1 };
    match (last, end) {
        (Last::Moves, _) => path[tip] = to,
        _ if path[tip] == to => {}
        (Last::Stays, End::First) => path.insert(0, to),
        (Last::Stays, End::Last) => path.push(to),
    }
}

/// Makes `at` a vertex of `path` on the segment that contains it; if the end `own` of the path lies
/// there, the vertex is inserted in addition to it.
fn insert(path: &mut Vec<Vec2>, at: Vec2, own: Option<End>) {
    let (mut first, mut last) = (0, path.len() - 1);
    match own {
        Some(End::First) => first = 1,
        Some(End::Last) => last -= 1,
        None => {}
    }
    if path[first..=last].contains(&at) {
        return;
    }
    let distance = |i: usize| point_to_segment(at, path[i], path[i + 1]);
    let nearest = (first..last).min_by(|&i, &j| distance(i).total_cmp(&distance(j)));
    if let Some(segment) = nearest {
        path.insert(segment + 1, at);
    }
}

/// The existing junctions and those of `coalescences`; where two tips meet, the junction of the
/// earlier one is kept.
fn junctions(
    state: &StepState<'_>,
    steps: &[Option<Step>],
    coalescences: &[Option<Coalescence>],
) -> Vec<Junction> {
    let mut junctions = state.junctions.to_vec();
    for (i, (step, coalescence)) in steps.iter().zip(coalescences).enumerate() {
        if let (Some(step), Some(coalescence)) = (step, coalescence)
            && coalescence.with.is_none_or(|other| other > i)
        {
            let joining = CrackEnd { crack: step.tip.crack, end: step.tip.end };
            junctions.push(Junction { joining, onto: coalescence.onto });
        }
    }
    junctions
}

/// The pieces enclosed by the last segments before `coalescences`.
fn detached(
    state: &StepState<'_>,
    steps: &[Option<Step>],
    coalescences: &[Option<Coalescence>],
    paths: &[Vec<Vec2>],
) -> Vec<Piece> {
    let mut graph = CrackGraph::default();
    let mut closing = Vec::new();
    for (crack, path) in paths.iter().enumerate() {
        let meets = |end: End| {
            let of_end = |step: &Step| (step.tip.crack, step.tip.end) == (crack, end);
            steps
                .iter()
                .zip(coalescences)
                .any(|(step, coalescence)| step.as_ref().is_some_and(of_end) && coalescence.is_some())
        };
        let (mut from, mut to) = (0, path.len() - 1);
        if meets(End::First) {
            from += 1;
            closing.push((crack, path[1], path[0]));
        }
        if meets(End::Last) && to > from {
            to -= 1;
            closing.push((crack, path[to], path[to + 1]));
        }
        graph.add_line(&path[from..=to]);
    }
    for BreakOut { tip, surface } in state.break_outs {
        graph.add_line(&[state.cracks[tip.crack].tip(tip.end), *surface]);
    }
    let outline = |(crack, from, to)| {
        let outline = graph.close(from, to)?;
        Some(Piece::new(PieceKind::Detached, state.at.step, crack, outline))
    };
    closing.into_iter().filter_map(outline).collect()
}

/// The spall cut off by a tip at `from` that breaks out at the point `surface` of the running
/// surface; `None` where the crack is not yet connected to the surface. The break-outs `before`
/// count as connections.
pub(super) fn spall(state: &StepState<'_>, before: &[BreakOut], new: BreakOut) -> Option<Piece> {
    let mut graph = CrackGraph::default();
    for crack in state.cracks {
        graph.add_line(crack.points());
    }
    for BreakOut { tip, surface } in before {
        graph.add_line(&[state.cracks[tip.crack].tip(tip.end), *surface]);
    }
    let from = state.cracks[new.tip.crack].tip(new.tip.end);
    let outline = graph.close(from, new.surface)?;
    Some(Piece::new(PieceKind::Spall, state.at.step, new.tip.crack, outline))
}

/// Graph of cracks and the running surface: points with identical bits are one node, and all points
/// of the surface are connected. It contains no loops: an edge that would close a loop yields its
/// outline instead.
#[derive(Debug, Clone, Default)]
pub(super) struct CrackGraph {
    points: Vec<Vec2>,
    edges: Vec<(usize, usize)>,
}

impl CrackGraph {
    /// Adds the edges along `points`, which must close no loop.
    pub fn add_line(&mut self, points: &[Vec2]) {
        for pair in points.windows(2) {
            let edge = (self.node(pair[0]), self.node(pair[1]));
            self.edges.push(edge);
        }
    }

    /// Adds the edge from `from` to `to`, or returns the outline that it closes, which begins with
    /// `to` and ends with `from`.
    pub fn close(&mut self, from: Vec2, to: Vec2) -> Option<Vec<Vec2>> {
        let (start, goal) = (self.node(from), self.node(to));
        let path = self.path(goal, start);
        if path.is_none() {
            self.edges.push((start, goal));
        }
        let outline: Vec<Vec2> = path?.into_iter().map(|node| self.points[node]).collect();
        // Of a path along the surface, only the ends are corners.
        let surface = |i: usize| outline.get(i).is_some_and(|p| p.y == 0.0);
        let corner = |i: &usize| *i == 0 || !(surface(i - 1) && surface(*i) && surface(i + 1));
        Some((0..outline.len()).filter(corner).map(|i| outline[i]).collect())
    }

    fn node(&mut self, point: Vec2) -> usize {
        if let Some(node) = self.points.iter().position(|&p| p == point) {
            return node;
        }
        self.points.push(point);
        let node = self.points.len() - 1;
        if point.y == 0.0 {
            // The surface is continuous: its points are chained to each other.
            if let Some(other) = self.points[..node].iter().position(|p| p.y == 0.0) {
                self.edges.push((other, node));
            }
        }
        node
    }

    /// The nodes from `start` to `goal`, both included, if they are connected.
    fn path(&self, start: usize, goal: usize) -> Option<Vec<usize>> {
        let mut before: Vec<Option<usize>> = vec![None; self.points.len()];
        before[start] = Some(start);
        let mut reached = vec![start];
        let mut next = 0;
        while next < reached.len() && before[goal].is_none() {
            let node = reached[next];
            for &(a, b) in &self.edges {
                let other = if a == node { b } else { a };
                if (a == node || b == node) && before[other].is_none() {
                    before[other] = Some(node);
                    reached.push(other);
                }
            }
            next += 1;
        }
        let mut path = vec![goal];
        let mut node = goal;
        while node != start {
            node = before[node]?;
            path.push(node);
        }
        path.reverse();
        Some(path)
    }
}
