//! The rail that the wheels of a case roll plastically, and the order of its wheels.

use super::wheel_bounds::WheelBounds;
use super::wheel_patch::rolled_patch;
use railcrack::shakedown::space::{RailInSpace, RolledPatch, SpaceStabilisation};
use railcrack::shakedown::{RolledRail, Stabilisation};
use railcrack_case::{Case, RollingWheels, ShakedownSettings, TrafficWheel};

/// The wheel of a mix that comes nearest to its limit of elastic shakedown, or exceeds it most.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HeaviestWheel {
    /// Its number, from 0.
    pub wheel: usize,
    /// Its peak pressure over that at its limit of elastic shakedown.
    pub of_limit: f64,
}

impl HeaviestWheel {
    /// The wheel of `case` with the largest peak pressure relative to its limit of elastic
    /// shakedown, the first of equals.
    ///
    /// A lighter wheel rolls over a rail that the heaviest one has already hardened. Within the
    /// limit of shakedown the backstress and the residual stress that make the passage of the
    /// heaviest wheel elastic leave room for the smaller paths of the others.
    #[must_use]
    pub fn of_case(case: &Case) -> Self {
        let heavier = |most: Self, next: Self| {
            if next.of_limit > most.of_limit { next } else { most }
        };
        let shear_yield = case.shakedown.hardening.shear_yield_stress();
        let of = |(wheel, given): (usize, &TrafficWheel)| {
            let peak = given.wheel.contact()?.peak_pressure();
            let limit = WheelBounds::of(case, wheel).map(|bounds| bounds.shakedown.ratio);
            Some(Self { wheel, of_limit: limit.map_or(0.0, |limit| peak / shear_yield / limit) })
        };
        case.wheels.iter().enumerate().filter_map(of).reduce(heavier).unwrap_or_default()
    }
}

/// The patches of the wheels of `case` that roll the rail, by the numbers of the wheels: the
/// heaviest first, the others by their peak pressure. A wheel that misses the
/// cracks leaves stress beside them, and rolls too.
///
/// None where the heaviest wheel has a line contact.
fn rolling_patches(case: &Case) -> Option<Vec<(usize, RolledPatch)>> {
    let heaviest = HeaviestWheel::of_case(case).wheel;
    let first = (heaviest, rolled_patch(case, heaviest)?);
    if case.shakedown.wheels == RollingWheels::Heaviest {
        return Some(vec![first]);
    }
    let others = (0..case.wheels.len()).filter(|wheel| *wheel != heaviest);
    let mut others: Vec<(usize, RolledPatch)> =
        others.filter_map(|wheel| Some((wheel, rolled_patch(case, wheel)?))).collect();
    others.sort_by(|a, b| b.1.peak_pressure.total_cmp(&a.1.peak_pressure));
    Some(std::iter::once(first).chain(others).collect())
}

/// The numbers of the wheels of `case` that roll the rail in turn, in their order; one in the
/// plane.
#[must_use]
pub fn rolling_wheels(case: &Case) -> Vec<usize> {
    let one = || vec![HeaviestWheel::of_case(case).wheel];
    rolling_patches(case).map_or_else(one, |patches| patches.iter().map(|own| own.0).collect())
}

/// The rail of `case` without its cracks under the repeated passage of the contact of one wheel,
/// the [heaviest](HeaviestWheel) of a mix. Bending and thermal stress are not part of it: they are
/// added to the plastic stress that it leaves.
#[must_use]
pub fn rolled_rail(case: &Case) -> RolledRail {
    let wheel = &case.wheels[HeaviestWheel::of_case(case).wheel];
    RolledRail {
        steel: case.steel,
        hardening: case.shakedown.hardening,
        contact: wheel.wheel.contact().expect("not all wheels miss the cracks").clone(),
        travel: wheel.passages.passage.travel(),
        initial: case.shakedown.initial_residual.as_ref().map(|file| file.content().clone()),
    }
}

/// The same in space under the patches of all wheels that roll it; none where the heaviest has a
/// line contact.
#[must_use]
pub fn rail_in_space(case: &Case) -> Option<RailInSpace> {
    Some(RailInSpace {
        steel: case.steel,
        hardening: case.shakedown.hardening,
        patches: rolling_patches(case)?.into_iter().map(|own| own.1).collect(),
        initial: case.shakedown.initial_residual.as_ref().map(|file| file.content().clone()),
    })
}

/// Settings of the computation of the stabilised state of `case` in space.
#[must_use]
pub fn stabilisation_in_space(case: &Case) -> SpaceStabilisation {
    SpaceStabilisation { max_passes: case.shakedown.max_passes, ..SpaceStabilisation::default() }
}

/// Settings of the computation of the stabilised state of `case`.
#[must_use]
pub fn stabilisation(case: &Case) -> Stabilisation {
    let ShakedownSettings { method, max_passes, .. } = case.shakedown;
    Stabilisation { method, max_passes, ..Stabilisation::default() }
}
