//! Rules of a single statement each.

use crate::case_run::{CrackGrowth, SifCurve};
use crate::measure::Measure;
use crate::path_shape::{PathCourse, PathShape};
use crate::results::SetupResults;
use crate::rules::Decision;
use serde::Deserialize;

/// A rule of one statement, named after it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SingleRule {
    /// K of Fig. 13 within 5 % of the peak of that by dislocations in the half-plane.
    Agreement,
    /// With higher wheel–rail friction |K_II| rises and falls by 5 % of the peak.
    Superposition,
    /// Paths that branch down have inclinations within 15°.
    SameDirection,
    /// ΔK_I of each crack of the pair grows by a larger share than ΔK_II changes.
    MainlyOpening,
    /// K_I of a crack of the pair gains most where the wheel is beyond a position.
    Gain {
        /// The number of the crack.
        crack: usize,
        /// The position over a; the wheel is farther from x = 0.
        beyond: f64,
    },
    /// ΔK_II is smallest in the middle of the network.
    ShieldingInTheMiddle,
    /// The outer cracks of the network branch as a single crack does.
    OuterAsSingle,
    /// Crack 9 branches otherwise than most of the others.
    NinthDiffers,
}

impl SingleRule {
    /// The decision in the set-up of `r`; none where it lacks a run that the rule needs.
    pub fn decide(&self, r: SetupResults) -> Option<Decision> {
        match *self {
            Self::Agreement => agreement(r),
            Self::Superposition => superposition(r),
            Self::SameDirection => same_direction(r),
            Self::MainlyOpening => mainly_opening(r),
            Self::Gain { crack, beyond } => gain(r, crack, beyond),
            Self::ShieldingInTheMiddle => shielding_in_the_middle(r),
            Self::OuterAsSingle => outer_as_single(r),
            Self::NinthDiffers => ninth_differs(r),
        }
    }
}

fn paths(r: SetupResults, curve: &str) -> Option<Vec<PathShape>> {
    Some(r.grown(curve)?.cracks.iter().map(PathShape::new).collect())
}

/// Change of `measure` from `from` to `to`, per cent.
fn change(measure: Measure, from: &CrackGrowth, to: &CrackGrowth) -> Option<f64> {
    Some(100.0 * (measure.value(to)? / measure.value(from)? - 1.0))
}

fn agreement(r: SetupResults) -> Option<Decision> {
    let way = r.setup().name.rsplit(", ").next()?;
    let reference = format!("half-plane, {way}");
    if r.setup().name == reference {
        return None;
    }
    let reference = &r.elsewhere(&reference)?.crack("fig13")?.sif;
    let difference = 100.0 * r.crack("fig13")?.sif.difference(reference);
    Some(Decision::new(difference <= 5.0).with("difference %", difference).with("peak", reference.peak()))
}

/// How far |K_II| at the wheel positions rises and falls when the friction changes from that of
/// `from` to that of `to`, MPa√m.
fn rise_and_fall(from: &SifCurve, to: &SifCurve) -> [f64; 2] {
    let size = |curve: &SifCurve, x: f64| curve.at(x).map_or(0.0, |[_, kii]| kii.abs());
    let changes = to.minus(from).into_iter().map(|[x, ..]| size(to, x) - size(from, x));
    changes.fold([0.0, 0.0], |[up, down]: [f64; 2], change| [up.max(change), down.min(change)])
}

fn superposition(r: SetupResults) -> Option<Decision> {
    let sif = |curve: &str| Some(&r.crack(curve)?.sif);
    let [up, down] = rise_and_fall(sif("reference")?, sif("wheel+0.4")?);
    let [up_driving, down_driving] = rise_and_fall(sif("wheel-0.025")?, sif("wheel-0.4")?);
    let share = 0.05 * sif("wheel+0.4")?.peak();
    let changes = [up, -down, up_driving, -down_driving];
    let decision = Decision::new(changes.iter().filter(|change| **change >= share).count() >= 3);
    let decision = decision.with("braking rises", up).with("falls", down);
    Some(decision.with("driving rises", up_driving).with("falls", down_driving))
}

fn same_direction(r: SetupResults) -> Option<Decision> {
    let all: Option<Vec<PathShape>> = r
        .paper
        .series("inclination")
        .iter()
        .map(|(_, curve)| Some(PathShape::new(r.grown(curve)?.cracks.first()?)))
        .collect();
    let all = all?;
    let down = all.iter().filter(|path| path.is(PathCourse::Down, r.setup().travel.sign()));
    let angles: Vec<f64> = down.filter_map(|path| path.inclination_after).collect();
    let low = angles.iter().copied().fold(f64::INFINITY, f64::min);
    let high = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let decision = Decision::new(angles.len() >= 2 && high - low <= 15.0);
    let decision = decision.with("paths down", angles.len() as f64);
    Some(if angles.is_empty() { decision } else { decision.with("from °", low).with("to °", high) })
}

/// The cracks of the pair, each with the same crack alone.
fn pair<'a>(r: SetupResults<'a>) -> Option<[(&'a CrackGrowth, &'a CrackGrowth); 2]> {
    let [first, second] = r.run("pair")?.cracks.as_slice() else { return None };
    Some([(first, r.crack("reference")?), (second, r.crack("crack-2-alone")?)])
}

fn mainly_opening(r: SetupResults) -> Option<Decision> {
    let mut decision = Decision::new(true);
    for (i, (crack, alone)) in pair(r)?.into_iter().enumerate() {
        let opening = change(Measure::DeltaKi, alone, crack)?;
        decision.holds &= opening > change(Measure::DeltaKii, alone, crack)?.abs();
        decision = decision.with(&format!("change of ΔK_I %, crack {}", i + 1), opening);
    }
    Some(decision)
}

fn gain(r: SetupResults, crack: usize, beyond: f64) -> Option<Decision> {
    let (crack, alone) = *pair(r)?.get(crack.checked_sub(1)?)?;
    let larger = |best: (f64, f64), [x, ki, _]: [f64; 3]| if ki > best.1 { (x, ki) } else { best };
    let (at, gain) = crack.sif.minus(&alone.sif).into_iter().fold((0.0, 0.0), larger);
    let is_beyond = at * beyond.signum() > beyond.abs();
    let decision = Decision::new(is_beyond && gain >= 0.1 * alone.sif.largest_ki());
    Some(decision.with("gain of K_I", gain).with("at x_c/a", at))
}

fn shielding_in_the_middle(r: SetupResults) -> Option<Decision> {
    let alone = r.crack("wheel+0.1")?;
    let nine = &r.run("nine")?.cracks;
    let mean = |numbers: &[usize]| -> Option<f64> {
        let changes = numbers.iter().map(|i| change(Measure::DeltaKii, alone, nine.get(i - 1)?));
        Some(changes.sum::<Option<f64>>()? / numbers.len() as f64)
    };
    let (middle, outer) = (mean(&[3, 4, 5, 6])?, mean(&[1, 2, 8, 9])?);
    Some(Decision::new(middle < 0.0 && middle < outer).with("middle %", middle).with("outer %", outer))
}

fn outer_as_single(r: SetupResults) -> Option<Decision> {
    /// Increments of the network.
    const INCREMENTS: usize = 5;
    let (nine, alone) = (paths(r, "nine")?, paths(r, "wheel+0.1")?);
    let side = |path: Option<&PathShape>| {
        Some(path?.branch.filter(|branch| branch.increment <= INCREMENTS).map(|branch| branch.side))
    };
    let holds = [1, 2, 8, 9].iter().all(|i| side(nine.get(i - 1)) == side(alone.first()));
    Some(Decision::new(holds).with_paths(&nine))
}

fn ninth_differs(r: SetupResults) -> Option<Decision> {
    let paths = paths(r, "nine-stress")?;
    let (ninth, others) = paths.split_last()?;
    let side = |path: &PathShape| path.branch.map(|branch| branch.side);
    let same = others.iter().filter(|path| side(path) == side(ninth)).count();
    Some(Decision::new(2 * same < others.len()).with_paths(&paths))
}
