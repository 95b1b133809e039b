//! Fluid in cracks in space: the pressure over the mouth, or fluid that the contact traps.
//!
//! The models are those of the plane. The pressure from the mouth acts down the dip: at the point
//! (s, ζ) of the plane of the crack it follows from the pressure of the contact over the mouth at
//! the same ζ, p(s, ζ) = p(0, ζ) (1 − s/l(ζ)), with l(ζ) the distance of the front. Trapped fluid
//! has one pressure in a crack. The contact closes a crack where it covers all points of the mouth
//! that are open; the volume of the fluid is then kept until an open point of the mouth is free.

use super::body::SpaceBody;
use super::shape::Extent;
use super::states::{SpaceFaces, SpaceStatus};
use crate::contact::{
    CrackFluid, FluidModel, FluidState, PocketState, PocketStatus, PressureProfile, compressed, reach_open,
};
use crate::math::dot;
use std::ops::Range;

/// Pressure (MPa) of the contact with the wheel at an abscissa (mm), at x and lateral position
/// (mm).
pub(super) type ContactPressure<'a> = dyn Fn(f64, [f64; 2]) -> f64 + Sync + 'a;

/// The fluid on the faces of a body, and the pressure of the wheel over their mouths.
pub(super) struct FluidUnderWheel<'a> {
    pub faces: FluidOnFaces,
    pub over: &'a ContactPressure<'a>,
}

/// A point of the mouth: its face point, x and lateral position (mm).
#[derive(Debug, Clone, Copy, PartialEq)]
struct MouthPoint {
    point: usize,
    at: [f64; 2],
}

/// The fluid in one crack.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpacePocket {
    crack: usize,
    /// Nodal forces (N per MPa, 3p) of a unit pressure; they also give the volume, V = unit · ⟦w⟧
    /// (mm³).
    pub unit: Vec<f64>,
    /// Volume of a unit pressure on free faces, mm³/MPa; zero for pressure from the mouth.
    pub free: f64,
    points: Range<usize>,
    /// Its mouth; empty for a buried crack, which is always closed.
    mouth: Vec<MouthPoint>,
    /// Pairs of adjacent points, counted from the first of the crack.
    neighbours: Vec<(usize, usize)>,
    /// Extent of the crack across the dip, mm: the volume per width refers to it.
    width: f64,
}

/// The fluid on the faces of a body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FluidOnFaces {
    pub model: FluidModel,
    pub pockets: Vec<SpacePocket>,
    profile: PressureProfile,
}

/// Relative increase of the content of leaking fluid that is attributed to rounding.
const GROWN: f64 = 1e-9;

impl CrackFluid {
    /// The fluid on the faces of `body`; its profile is that down the dip.
    pub(super) fn in_space(&self, body: &SpaceBody) -> FluidOnFaces {
        let pockets = (0..body.cracks().len()).filter(|&crack| self.wets(crack)).map(|crack| {
            let mut pocket = SpacePocket::of(body, crack);
            if let FluidModel::Trapped { .. } = self.model {
                pocket.free = dot(&pocket.unit, &body.compliance().times(&pocket.unit));
            }
            pocket
        });
        FluidOnFaces { model: self.model, pockets: pockets.collect(), profile: self.profile }
    }
}

impl SpacePocket {
    fn of(body: &SpaceBody, crack: usize) -> Self {
        let part = &body.cracks()[crack];
        let first = part.points.start;
        let pressed =
            |of: usize, _: [f64; 3]| if of == crack { [1.0, 1.0, 1.0, 0.0, 0.0, 0.0] } else { [0.0; 6] };
        let unit = body.nodal_forces_by_crack(pressed);
        let is_open = part.shape.extent == Extent::SurfaceBreaking;
        let at_mouth = |&point: &usize| is_open && body.points()[point][2] == 0.0;
        let mouth = part.points.clone().filter(at_mouth);
        let mouth =
            mouth.map(|point| MouthPoint { point, at: [body.points()[point][0], body.points()[point][1]] });
        let inside = |pair: &(usize, usize)| part.points.contains(&pair.0) && part.points.contains(&pair.1);
        let sides = body.cells().iter().flat_map(|&[a, b, c, d]| [(a, b), (b, c), (c, d), (d, a)]);
        Self {
            crack,
            unit,
            free: 0.0,
            points: part.points.clone(),
            mouth: mouth.collect(),
            neighbours: sides.filter(inside).map(|(one, other)| (one - first, other - first)).collect(),
            width: 2.0 * part.shape.half_length,
        }
    }

    /// The same fluid, where the nodal forces of a unit pressure on the faces that are solved for
    /// are `unit`.
    pub fn with_unit(&self, unit: Vec<f64>) -> Self {
        Self { unit, ..self.clone() }
    }

    /// V (mm³) at the jumps ⟦w⟧ (mm, 3p).
    pub fn volume(&self, jumps: &[f64]) -> f64 {
        dot(&self.unit, jumps)
    }

    /// V (mm³) of the fluid in `faces`: zero where they are closed everywhere.
    fn content(&self, faces: &SpaceFaces) -> f64 {
        let has_open = self.points.clone().any(|point| is_open(faces, point));
        if has_open { self.volume(&faces.jumps).max(0.0) } else { 0.0 }
    }

    /// Whether the wheel at `position` (mm) covers all open points of the mouth in `faces`.
    fn is_covered(&self, position: f64, over: &ContactPressure<'_>, faces: &SpaceFaces) -> bool {
        self.mouth.iter().all(|mouth| !is_open(faces, mouth.point) || over(position, mouth.at) > 0.0)
    }

    /// Whether the wheel at `position` (mm) covers the whole mouth.
    fn is_under(&self, position: f64, over: &ContactPressure<'_>) -> bool {
        self.mouth.iter().all(|mouth| over(position, mouth.at) > 0.0)
    }

    /// The smallest pressure over the open points of the mouth that all open points are connected
    /// with; none where closed faces block the way.
    fn outlet(&self, position: f64, over: &ContactPressure<'_>, faces: &SpaceFaces) -> Option<f64> {
        let first = self.points.start;
        let mut reached = vec![false; self.points.len()];
        let outlets: Vec<&MouthPoint> = self.mouth.iter().filter(|m| is_open(faces, m.point)).collect();
        outlets.iter().for_each(|mouth| reached[mouth.point - first] = true);
        reach_open(&mut reached, &self.neighbours, |own| is_open(faces, first + own));
        let blocked = self.points.clone().any(|point| is_open(faces, point) && !reached[point - first]);
        let pressures = outlets.iter().map(|mouth| over(position, mouth.at));
        if blocked { None } else { pressures.reduce(f64::min) }
    }
}

fn is_open(faces: &SpaceFaces, point: usize) -> bool {
    faces.status[point] == SpaceStatus::Open
}

impl FluidOnFaces {
    /// B, MPa.
    pub fn bulk_modulus(&self) -> f64 {
        match self.model {
            FluidModel::Trapped { bulk_modulus, .. } => bulk_modulus,
            FluidModel::Mouth { .. } => f64::INFINITY,
        }
    }

    /// Whether the fluid is one that the contact traps.
    pub fn is_trapped(&self) -> bool {
        matches!(self.model, FluidModel::Trapped { .. })
    }

    /// Pressure (MPa) from the mouth on the faces of `crack` of `body` at `point` (x, lateral,
    /// depth; mm), with the wheel at `position` (mm); zero for trapped fluid.
    pub fn mouth_pressure(
        &self,
        body: &SpaceBody,
        crack: usize,
        (position, over): (f64, &ContactPressure<'_>),
        point: [f64; 3],
    ) -> f64 {
        let FluidModel::Mouth { cap } = self.model else { return 0.0 };
        if !self.pockets.iter().any(|pocket| pocket.crack == crack) {
            return 0.0;
        }
        let part = &body.cracks()[crack];
        let [s, zeta] = part.coordinates(point);
        let pressure = over(position, part.mouth(zeta)).min(cap);
        let length = part.reach(zeta);
        match self.profile {
            PressureProfile::Constant => pressure,
            PressureProfile::Linear if s < length => pressure * (1.0 - s / length),
            PressureProfile::Linear => 0.0,
        }
    }

    /// The states of the pockets at the beginning of a step from `last` with the wheel at `from`
    /// (mm, not a number before it arrives) to the position `to`.
    pub fn begin(
        &self,
        (from, last): (f64, &SpaceFaces),
        to: f64,
        over: &ContactPressure<'_>,
    ) -> Vec<PocketState> {
        let FluidModel::Trapped { bulk_modulus, leak } = self.model else { return Vec::new() };
        let free = PocketState { status: PocketStatus::Vented, pressure: 0.0, content: 0.0 };
        let of = |(k, pocket): (usize, &SpacePocket)| {
            let state = last.fluid.get(k).copied().unwrap_or(free);
            let held = || pocket.content(last) / compressed(state.pressure, bulk_modulus);
            let sealed = |content: f64, pressure: f64| {
                let status = if content > 0.0 { PocketStatus::Sealed } else { PocketStatus::Cavity };
                PocketState { status, pressure: if content > 0.0 { pressure } else { 0.0 }, content }
            };
            if !pocket.is_covered(to, over, last) {
                return free;
            }
            let outlet = || if leak { pocket.outlet(to, over, last) } else { None };
            match state.status {
                // Sealed at the last instant, if it was covered then.
                PocketStatus::Vented if pocket.is_covered(from, over, last) => sealed(held(), 0.0),
                PocketStatus::Vented => free,
                PocketStatus::Sealed => match outlet() {
                    Some(pressure) if pressure < state.pressure => {
                        PocketState { status: PocketStatus::Leaking, pressure, content: held() }
                    }
                    _ => state,
                },
                PocketStatus::Leaking => match outlet() {
                    Some(pressure) => PocketState { pressure, ..state },
                    None => sealed(held(), state.pressure),
                },
                PocketStatus::Cavity => state,
            }
        };
        self.pockets.iter().enumerate().map(of).collect()
    }

    /// The states of pockets whose fluid, sealed in `faces` with the wheel at `position` (mm), has
    /// an outlet with a lower pressure; none where no pocket has one.
    pub fn released(
        &self,
        position: f64,
        over: &ContactPressure<'_>,
        faces: &SpaceFaces,
        begun: &[PocketState],
    ) -> Option<Vec<PocketState>> {
        if !matches!(self.model, FluidModel::Trapped { leak: true, .. }) {
            return None;
        }
        let mut states = begun.to_vec();
        for ((pocket, state), reached) in self.pockets.iter().zip(&mut states).zip(&faces.fluid) {
            if reached.status == PocketStatus::Sealed
                && let Some(pressure) = pocket.outlet(position, over, faces)
                && pressure < reached.pressure
            {
                (state.status, state.pressure) = (PocketStatus::Leaking, pressure);
            }
        }
        (states != begun).then_some(states)
    }

    /// The states of leaking pockets that would take up fluid in `faces`, sealed with what they
    /// held before; none where no pocket would.
    pub fn refused(&self, begun: &[PocketState], faces: &SpaceFaces) -> Option<Vec<PocketState>> {
        let mut states = begun.to_vec();
        for (pocket, state) in self.pockets.iter().zip(&mut states) {
            let now = pocket.volume(&faces.jumps) / compressed(state.pressure, self.bulk_modulus());
            if state.status == PocketStatus::Leaking && now > state.content * (1.0 + GROWN) {
                state.status = PocketStatus::Sealed;
            }
        }
        (states != begun).then_some(states)
    }

    /// Lowers the content of leaking pockets to what `faces` hold.
    pub fn follow(&self, faces: &mut SpaceFaces) {
        for (k, pocket) in self.pockets.iter().enumerate() {
            let held = pocket.content(faces);
            if let Some(state) = faces.fluid.get_mut(k)
                && state.status == PocketStatus::Leaking
            {
                state.content = held / compressed(state.pressure, self.bulk_modulus());
            }
        }
    }

    /// The fluid in crack `crack` with the wheel at `position` (mm): the pressure, with the model
    /// of the mouth the largest over it, and the volume per width of the crack.
    pub fn state_of(
        &self,
        crack: usize,
        position: f64,
        over: &ContactPressure<'_>,
        faces: &SpaceFaces,
    ) -> FluidState {
        let Some(k) = self.pockets.iter().position(|pocket| pocket.crack == crack) else {
            return FluidState::default();
        };
        let pocket = &self.pockets[k];
        let pressure = match self.model {
            FluidModel::Mouth { cap } => {
                pocket.mouth.iter().map(|mouth| over(position, mouth.at).min(cap)).fold(0.0, f64::max)
            }
            FluidModel::Trapped { .. } => faces.fluid.get(k).map_or(0.0, |state| state.pressure),
        };
        FluidState { pressure, volume: pocket.content(faces) / pocket.width }
    }

    /// Positions (mm) between those of `positions` at which the wheel begins or ceases to cover a
    /// whole mouth, on the side on which it covers it.
    pub fn stations(&self, positions: &[f64], over: &ContactPressure<'_>) -> Vec<f64> {
        if !self.is_trapped() {
            return Vec::new();
        }
        let mut stations = Vec::new();
        for pocket in self.pockets.iter().filter(|pocket| !pocket.mouth.is_empty()) {
            for pair in positions.windows(2) {
                let at = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / LOOKED as f64;
                for k in 0..LOOKED {
                    let ends = [at(k), at(k + 1)].map(|x| (x, pocket.is_under(x, over)));
                    if ends[0].1 != ends[1].1 {
                        stations
                            .push(bisected(ends.map(|end| end.0), ends[0].1, |x| pocket.is_under(x, over)));
                    }
                }
            }
        }
        stations
    }
}

/// Places between two positions at which the cover of a mouth is looked at.
const LOOKED: usize = 8;
/// Halvings of such a place.
const HALVINGS: usize = 40;

/// The last place between `ends` on the side where `holds` is true; it is `first` at their first.
fn bisected([mut one, mut other]: [f64; 2], first: bool, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (one + other);
        if holds(middle) == first { one = middle } else { other = middle }
    }
    if first { one } else { other }
}
