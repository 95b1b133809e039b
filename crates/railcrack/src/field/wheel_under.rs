//! The field of a wheel for any description of its load.

use super::{BendingWheel, CarterWheel, HertzWheel, PlacedWheel, TableWheel, Wheel, Wheels};
use crate::load::{Contact, Track, WheelLoad};
use crate::material::IsotropicElastic;
use crate::math::OutOfRange;

/// The field of a wheel with `load` on a rail of `steel`: that of its contact, and bending where
/// there is a track. The stress of temperature is not included, because it remains between passages
/// ([`super::Uniform::along_rail`]).
///
/// Errors: [`Contact::check`], [`crate::load::Track::check`].
pub fn wheel_under(load: &WheelLoad, steel: &IsotropicElastic) -> Result<Box<dyn Wheel>, OutOfRange> {
    let contact: Box<dyn Wheel> = match &load.contact {
        Contact::Hertz(contact) => Box::new(HertzWheel::new(contact, steel)?),
        Contact::Carter(contact) => Box::new(CarterWheel::new(contact, steel)?),
        Contact::Table(contact) => Box::new(TableWheel::new(contact, steel)),
    };
    on_track(contact, load.track.as_ref(), steel)
}

/// The field of a `contact` and of the bending of a rail of `steel`, if it lies on a `track`.
///
/// Errors: [`crate::load::Track::check`].
pub fn on_track(
    contact: Box<dyn Wheel>,
    track: Option<&Track>,
    steel: &IsotropicElastic,
) -> Result<Box<dyn Wheel>, OutOfRange> {
    let Some(track) = track else { return Ok(contact) };
    let bending: Box<dyn Wheel> = Box::new(BendingWheel::new(track, steel)?);
    let parts = [contact, bending].map(|wheel| PlacedWheel { wheel, at: 0.0 });
    Ok(Box::new(Wheels::of_one_beam(parts.into())))
}
