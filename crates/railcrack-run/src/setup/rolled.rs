//! The rail that the wheels of a case roll plastically: its heaviest wheel, and the bounds of
//! shakedown under a contact.

use railcrack::field::wheel_under;
use railcrack::load::WheelLoad;
use railcrack::material::IsotropicElastic;
use railcrack::shakedown::{ContactBounds, RolledRail, Stabilisation};
use railcrack_case::{Case, GivenWheel, ShakedownSettings, TrafficWheel};

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
        let shear_yield = case.shakedown.hardening.shear_yield_stress();
        let of = |(wheel, given): (usize, &TrafficWheel)| {
            let peak = given.wheel.contact()?.peak_pressure();
            let limit = contact_bounds(&given.wheel, &case.steel, |bounds| bounds.shakedown_limit().ratio);
            Some(Self { wheel, of_limit: limit.map_or(0.0, |limit| peak / shear_yield / limit) })
        };
        let heavier = |most: Self, next: Self| {
            if next.of_limit > most.of_limit { next } else { most }
        };
        case.wheels.iter().enumerate().filter_map(of).reduce(heavier).unwrap_or_default()
    }
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

/// Settings of the computation of the stabilised state of `case`.
#[must_use]
pub fn stabilisation(case: &Case) -> Stabilisation {
    let ShakedownSettings { method, max_passes, .. } = case.shakedown;
    Stabilisation { method, max_passes, ..Stabilisation::default() }
}

/// First yield and shakedown of a rail of `steel` under the contact of `wheel` alone, as `of` asks
/// for them; none where it misses the cracks.
#[must_use]
pub fn contact_bounds<T>(
    wheel: &GivenWheel,
    steel: &IsotropicElastic,
    of: impl FnOnce(&ContactBounds) -> T,
) -> Option<T> {
    let contact = wheel.contact()?;
    let load = WheelLoad { contact: contact.clone(), track: None, temperature: None };
    let wheel = wheel_under(&load, steel).ok()?;
    Some(of(&ContactBounds::new(contact, wheel.as_ref())))
}
