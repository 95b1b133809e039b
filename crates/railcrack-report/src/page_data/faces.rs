//! The crack faces: all steps shown in packed form, the first and the last step also unpacked. For
//! many cracks only these two are kept, and a page shows some of the cracks. Under the other wheels
//! of a mix, too, there are these two.

use super::pack::{Deflated, Quantised, every, every_count, within};
use super::step_table::StepTable;
use super::thinned::Thinned;
use crate::row::is_many;
use railcrack::contact::FaceStatus;
use railcrack::growth::StepRecord;
use railcrack_run::OutputError;
use railcrack_run::csv::{FaceRow, StepBlock};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;

/// Maximum number of face states shown (points × positions × steps), of about half a byte each in a
/// page: of more, positions are omitted, and of still more, steps.
const STATES: [usize; 2] = [150_000, 1_000_000];
/// Highest level of a number of the faces: they are drawn, and said for a place on a map.
const LEVELS: u16 = 255;
/// Minimum number of positions kept.
const POSITIONS: usize = 61;

/// Cracks by number, each with the wheel positions near it.
pub(crate) type CrackWindows = Vec<(usize, Range<usize>)>;

/// The faces of one crack; what has a value per position and point is in that order.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct CrackFaces {
    /// From 1.
    pub crack: usize,
    /// Arc length of the points, mm.
    pub s: Vec<f64>,
    opening: Vec<f64>,
    slip: Vec<f64>,
    /// −s22, MPa.
    pressure: Vec<f64>,
    status: Vec<FaceStatus>,
}

impl CrackFaces {
    /// Number of wheel positions.
    pub(crate) fn positions(&self) -> usize {
        self.status.len() / self.s.len().max(1)
    }

    /// Status and pressure (MPa) at a position and a point, both from 0.
    pub(crate) fn state(&self, position: usize, point: usize) -> (FaceStatus, f64) {
        let at = position * self.s.len() + point;
        (self.status[at], self.pressure[at])
    }

    /// The faces at some of the positions, from 0.
    fn within(&self, positions: Range<usize>) -> Self {
        let points = self.s.len();
        let of = |values: &[f64]| {
            values
                .get(positions.start * points..positions.end * points)
                .map_or_else(Vec::new, <[f64]>::to_vec)
        };
        let status = self.status.get(positions.start * points..positions.end * points);
        Self {
            crack: self.crack,
            s: self.s.clone(),
            opening: of(&self.opening),
            slip: of(&self.slip),
            pressure: of(&self.pressure),
            status: status.map_or_else(Vec::new, <[FaceStatus]>::to_vec),
        }
    }

    /// Status and pressure (MPa) everywhere.
    pub(crate) fn states(&self) -> impl Iterator<Item = (FaceStatus, f64)> {
        self.status.iter().copied().zip(self.pressure.iter().copied())
    }
}

/// The faces of all cracks in one step under one wheel, with the numbers of `faces.csv`.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct StepFaces {
    pub cracks: Vec<CrackFaces>,
}

impl StepFaces {
    /// Under every wheel, the first wheel first.
    ///
    /// Errors: the first row that is one.
    fn by_wheel(rows: impl Iterator<Item = Result<FaceRow, OutputError>>) -> Result<Vec<Self>, OutputError> {
        let mut wheels: BTreeMap<usize, BTreeMap<usize, CrackFaces>> = BTreeMap::new();
        for row in rows {
            let row = row?;
            let faces = wheels.entry(row.wheel.unwrap_or(1)).or_default().entry(row.crack).or_default();
            if row.position == 1 {
                faces.s.push(row.s);
            }
            faces.opening.push(row.opening);
            faces.slip.push(row.slip);
            faces.pressure.push(-row.s22);
            faces.status.push(row.status);
        }
        let of_wheel = |cracks: BTreeMap<usize, CrackFaces>| Self {
            cracks: cracks.into_iter().map(|(crack, faces)| CrackFaces { crack, ..faces }).collect(),
        };
        Ok(wheels.into_values().map(of_wheel).collect())
    }

    /// Whether only some of its cracks are on a page.
    fn is_many(&self) -> bool {
        is_many(self.cracks.len())
    }

    /// Its status and pressure alone, for a face map.
    fn drawn(self) -> Self {
        let drawn = |faces: CrackFaces| CrackFaces { opening: Vec::new(), slip: Vec::new(), ..faces };
        Self { cracks: self.cracks.into_iter().map(drawn).collect() }
    }
}

/// The faces of one crack as a page holds them: rows by point, in them the positions.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct PackedCrack {
    crack: usize,
    /// The first position, from 0.
    #[serde(skip_serializing_if = "is_none")]
    first: usize,
    s: Quantised,
    opening: Quantised,
    slip: Quantised,
    pressure: Quantised,
    status: Deflated,
    #[serde(skip)]
    points: usize,
    #[serde(skip)]
    positions: usize,
}

fn is_none(first: &usize) -> bool {
    *first == 0
}

impl PackedCrack {
    fn of(faces: &CrackFaces, stride: usize) -> Self {
        let (points, positions) = (faces.s.len(), faces.positions());
        let along = |values: &[f64]| Quantised::rounded(LEVELS, stride, &by_point(values, points), positions);
        let status: Vec<u8> = every(stride, &by_point(&faces.status, points), positions).map(code).collect();
        Self {
            crack: faces.crack,
            first: 0,
            s: Quantised::of(&faces.s, faces.s.len()),
            opening: along(&faces.opening),
            slip: along(&faces.slip),
            pressure: along(&faces.pressure),
            status: Deflated::of(&status),
            points,
            positions: every_count(stride, positions),
        }
    }

    /// At these positions, from 0; all of them must be packed.
    fn within(&self, positions: &Range<usize>) -> Self {
        let status: Vec<u8> = within(&self.status.inflated(), self.positions, positions).collect();
        Self {
            crack: self.crack,
            first: positions.start,
            s: self.s.clone(),
            opening: self.opening.within(positions),
            slip: self.slip.within(positions),
            pressure: self.pressure.within(positions),
            status: Deflated::of(&status),
            points: self.points,
            positions: positions.len(),
        }
    }

    /// At every other position and the last.
    fn halved(&self) -> Self {
        let status: Vec<u8> = every(2, &self.status.inflated(), self.positions).collect();
        Self {
            crack: self.crack,
            first: self.first,
            s: self.s.clone(),
            opening: self.opening.halved(),
            slip: self.slip.halved(),
            pressure: self.pressure.halved(),
            status: Deflated::of(&status),
            points: self.points,
            positions: every_count(2, self.positions),
        }
    }
}

/// The faces of all cracks in one step as a page holds them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct PackedFaces(Vec<PackedCrack>);

impl PackedFaces {
    fn of(faces: &StepFaces, stride: usize) -> Self {
        Self(faces.cracks.iter().map(|crack| PackedCrack::of(crack, stride)).collect())
    }

    /// For many cracks, those in `windows`, by number, at the positions given there.
    fn near(faces: &StepFaces, windows: &[(usize, Range<usize>)]) -> Self {
        let of = |(crack, window): &(usize, Range<usize>)| {
            let faces = faces.cracks.iter().find(|faces| faces.crack == *crack)?;
            Some(PackedCrack { first: window.start, ..PackedCrack::of(&faces.within(window.clone()), 1) })
        };
        Self(windows.iter().filter_map(of).collect())
    }

    /// Those of some cracks, by number, at the positions given there.
    fn within(&self, windows: &[(usize, Range<usize>)]) -> Self {
        let of = |(crack, window): &(usize, Range<usize>)| {
            Some(self.0.iter().find(|faces| faces.crack == *crack)?.within(window))
        };
        Self(windows.iter().filter_map(of).collect())
    }

    /// Omits every other position.
    fn halve(&mut self) {
        self.0.iter_mut().for_each(|crack| *crack = crack.halved());
    }

    fn states(&self) -> usize {
        self.0.iter().map(|crack| crack.points * crack.positions).sum()
    }

    /// Number of wheel positions, the same for all cracks.
    fn positions(&self) -> usize {
        self.0.first().map_or(0, |crack| crack.positions)
    }
}

/// A status in a page.
fn code(status: FaceStatus) -> u8 {
    match status {
        FaceStatus::Open => 0,
        FaceStatus::Stick => 1,
        FaceStatus::Slip => 2,
    }
}

/// Values by position and point as values by point and position: along the passage they change
/// little.
pub(super) fn by_point<T: Copy>(values: &[T], points: usize) -> Vec<T> {
    (0..points).flat_map(|point| values.iter().skip(point).step_by(points.max(1)).copied()).collect()
}

/// The faces of a step, packed when needed.
#[derive(Debug)]
pub(crate) struct FacesOfStep {
    faces: StepFaces,
    packed: PackedFaces,
    stride: usize,
    /// Under the other wheels of a mix, at all positions.
    others: Vec<PackedFaces>,
}

/// The faces under the other wheels of a mix, in the first and the last step, within the same size
/// limit as those under the first wheel.
#[derive(Debug, Clone)]
pub(crate) struct OtherFaces {
    /// By step and wheel.
    steps: Vec<(usize, Vec<PackedFaces>)>,
    /// Stride of the positions.
    pub stride: usize,
}

impl OtherFaces {
    /// Under `wheel`, from 0, in a step, if it has them.
    pub(crate) fn under(&self, wheel: usize, step: usize) -> Option<&PackedFaces> {
        let (_, wheels) = self.steps.iter().find(|(at, _)| *at == step)?;
        wheels.get(wheel.checked_sub(1)?)
    }

    fn states(&self) -> usize {
        self.steps.iter().flat_map(|(_, wheels)| wheels).map(PackedFaces::states).sum()
    }
}

/// The faces of the steps shown, within the size limit: all steps and positions if possible,
/// otherwise every 2ⁿ-th position, then every 2ⁿ-th step.
#[derive(Debug, Clone)]
pub(crate) struct FacesData {
    pub steps: Thinned<PackedFaces>,
    /// Stride of the packed positions.
    pub stride: usize,
    /// The first step, and the last if different: status and pressure for face maps, everything for
    /// many cracks.
    pub ends: Vec<(usize, StepFaces)>,
    /// The same under the other wheels of a mix, at all positions.
    others: Vec<(usize, Vec<PackedFaces>)>,
    /// Most states before positions, and before steps are omitted.
    most: [usize; 2],
}

impl Default for FacesData {
    fn default() -> Self {
        Self { steps: Thinned::default(), stride: 1, ends: Vec::new(), others: Vec::new(), most: STATES }
    }
}

impl FacesData {
    pub(crate) fn of_record(&self, record: &StepRecord) -> Result<FacesOfStep, OutputError> {
        Ok(self.packed(StepFaces::by_wheel(FaceRow::of_step(record).map(Ok))?))
    }

    /// The part of a step with these faces by wheel.
    fn packed(&self, wheels: Vec<StepFaces>) -> FacesOfStep {
        let mut wheels = wheels.into_iter();
        let faces = wheels.next().unwrap_or_default();
        let packed = match faces.is_many() {
            true => PackedFaces(Vec::new()),
            false => PackedFaces::of(&faces, self.stride),
        };
        let others = wheels.map(|faces| PackedFaces::of(&faces, 1)).collect();
        FacesOfStep { faces, packed, stride: self.stride, others }
    }

    /// The faces under the other wheels of a mix; for many cracks, of those in the windows of each
    /// wheel.
    pub(crate) fn others(&self, windows: Option<&[CrackWindows]>) -> OtherFaces {
        let seen = |(wheel, faces): (usize, &PackedFaces)| match windows {
            Some(windows) => faces.within(windows.get(wheel + 1).map_or(&[], Vec::as_slice)),
            None => faces.clone(),
        };
        let of_step = |(step, wheels): &(usize, Vec<PackedFaces>)| {
            (*step, wheels.iter().enumerate().map(seen).collect())
        };
        let mut others = OtherFaces { steps: self.others.iter().map(of_step).collect(), stride: 1 };
        let most_positions = |others: &OtherFaces| {
            others.steps.iter().flat_map(|(_, wheels)| wheels).map(PackedFaces::positions).max()
        };
        while others.states() > self.most[0] && most_positions(&others).is_some_and(|count| count > 2) {
            others.stride *= 2;
            others.steps.iter_mut().flat_map(|(_, wheels)| wheels).for_each(PackedFaces::halve);
        }
        others
    }

    /// For many cracks, the faces of the cracks in `windows` in `step`, the first or the last.
    pub(crate) fn near(&self, step: usize, windows: &[(usize, Range<usize>)]) -> Option<PackedFaces> {
        let (_, faces) = self.ends.iter().find(|(at, _)| *at == step)?;
        Some(PackedFaces::near(faces, windows))
    }

    /// Omits every other position; false if too few would remain.
    fn halve(&mut self) -> bool {
        let positions = self.steps.iter().next().map_or(0, |(_, faces)| faces.positions());
        if every_count(2, positions) < POSITIONS {
            return false;
        }
        self.stride *= 2;
        self.steps.values_mut().for_each(PackedFaces::halve);
        true
    }
}

impl StepTable for FacesData {
    type OfStep = FacesOfStep;
    type TableRow = FaceRow;

    fn keeps(&self, step: usize) -> bool {
        self.steps.is_kept(step)
    }

    fn read(&self, block: &StepBlock<FaceRow>) -> Result<FacesOfStep, OutputError> {
        Ok(self.packed(StepFaces::by_wheel(block.rows())?))
    }

    fn push(&mut self, step: usize, part: FacesOfStep) {
        let FacesOfStep { faces, mut packed, stride, others } = part;
        // Packed while there was more room.
        for _ in stride.ilog2()..self.stride.ilog2() {
            packed.halve();
        }
        self.steps.push(step, packed);
        if !others.is_empty() {
            self.others.truncate(1);
            self.others.push((step, others));
        }
        self.ends.truncate(1);
        self.ends.push((step, if faces.is_many() { faces } else { faces.drawn() }));
        while self.steps.weight(PackedFaces::states) > self.most[0] && self.halve() {}
        self.steps.thin_to(self.most[1], PackedFaces::states);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faces of two cracks at `positions`, another number of points in each.
    fn faces(step: usize, positions: usize) -> StepFaces {
        let crack = |crack: usize, points: usize| {
            let state = |i: usize| (0.01 * i as f64 + step as f64).sin();
            let values: Vec<f64> = (0..positions * points).map(state).collect();
            let statuses = [FaceStatus::Open, FaceStatus::Stick, FaceStatus::Slip];
            CrackFaces {
                crack,
                s: (0..points).map(|j| j as f64).collect(),
                opening: values.clone(),
                slip: values.iter().map(|value| -2.0 * value).collect(),
                pressure: values.iter().map(|value| value * value).collect(),
                status: (0..values.len()).map(|i| statuses[i * i % 3]).collect(),
            }
        };
        StepFaces { cracks: vec![crack(1, 4), crack(3, 3)] }
    }

    fn shown(steps: usize, positions: usize, most: usize) -> FacesData {
        let mut shown = FacesData { most: [most; 2], ..FacesData::default() };
        for step in 0..steps {
            let part = shown.packed(vec![faces(step, positions)]);
            shown.push(step, part);
        }
        shown
    }

    #[test]
    fn everything_is_shown_where_it_fits() {
        let shown = shown(26, 241, 26 * 241 * 7);
        assert_eq!((shown.steps.iter().count(), shown.stride), (26, 1));
    }

    #[test]
    fn positions_go_first_then_steps() {
        let most = 26 * 241 * 7;
        for (steps, stride, count) in [(27, 2, 27), (104, 4, 52 + 1), (105, 4, 53)] {
            let shown = shown(steps, 241, most);
            let there: Vec<usize> = shown.steps.iter().map(|(step, _)| step).collect();
            assert_eq!((shown.stride, there.len()), (stride, count), "{steps} steps");
            assert_eq!((there[0], there[count - 1]), (0, steps - 1));
            assert_eq!(shown.ends.iter().map(|(step, _)| *step).collect::<Vec<_>>(), [0, steps - 1]);
            assert_eq!(shown.ends[1].1, faces(steps - 1, 241).drawn());
        }
        // Fewer than twice the positions that are wanted at least.
        assert_eq!([120, 119].map(|positions| shown(27, positions, 1).stride), [2, 1]);
    }

    #[test]
    fn other_wheels_have_the_first_and_the_last_step() {
        let mut shown = FacesData::default();
        for step in 0..=4 {
            let mut wheels = vec![faces(step, 241)];
            if [0, 4].contains(&step) {
                wheels.extend([faces(10 + step, 121), faces(20 + step, 241)]);
            }
            let part = shown.packed(wheels);
            shown.push(step, part);
        }
        let others = shown.others(None);
        assert_eq!(others.stride, 1);
        for step in 0..=4 {
            let packed = |seed: usize, positions: usize| PackedFaces::of(&faces(seed + step, positions), 1);
            let is_end = [0, 4].contains(&step);
            assert_eq!(others.under(1, step), is_end.then(|| packed(10, 121)).as_ref(), "step {step}");
            assert_eq!(others.under(2, step), is_end.then(|| packed(20, 241)).as_ref(), "step {step}");
            assert_eq!(shown.steps.get(step), Some(&packed(0, 241)), "the first wheel, step {step}");
        }
        // Of some cracks at some positions.
        let window = vec![(3, 10..31)];
        let near = shown.others(Some(&[Vec::new(), window.clone(), Vec::new()]));
        let PackedFaces(of_first) = near.under(1, 4).unwrap();
        let whole = PackedFaces::of(&faces(14, 121), 1);
        assert_eq!(of_first[..], [whole.0[1].within(&(10..31))]);
        let (cut, packed) = (&of_first[0], PackedFaces::near(&faces(14, 121), &window));
        assert_eq!((cut.first, cut.positions, cut.points), (10, 21, 3));
        assert_eq!((&cut.s, &cut.status), (&packed.0[0].s, &packed.0[0].status));
        assert_eq!(near.under(2, 0), Some(&PackedFaces(Vec::new())));
        // Fewer positions where there is no room: those of wheel 3 with the last one.
        shown.most = [2 * (61 + 121) * 7; 2];
        let others = shown.others(None);
        assert_eq!(others.stride, 2);
        assert_eq!(others.under(2, 4), Some(&PackedFaces::of(&faces(24, 241), 2)));
    }

    #[test]
    fn what_was_thinned_out_later_is_what_was_never_packed() {
        let shown = shown(104, 241, 26 * 241 * 7);
        for (step, packed) in shown.steps.iter() {
            assert!(*packed == PackedFaces::of(&faces(step, 241), shown.stride), "step {step}");
        }
    }
}
