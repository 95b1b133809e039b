//! Growth by the lateral place of the crack.

use super::coarse_crack::{CoarseWheel, coarse_histories, coarse_rate};
use super::coarse_front::{CoarseFront, coarse_wheel};
use super::grouping::open_crack;
use railcrack::load::Contact;
use railcrack::rolling::PlacedPatch;
use railcrack_case::{Case, TabledWheel, WheelTable};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Passages of the coarse crack in space over all places, at most about so many: of a longer table
/// every so many wheels across the rail are taken.
const PASSAGES: usize = 1000;

/// Mean growth rate (mm per axle) of the first crack, open, under the table of wheels, and the
/// share of the axles whose patches meet it, with the crack at each of `places` (lateral_mm);
/// none without a table. In space, the mean rate along the front of the coarse crack.
#[must_use]
pub fn rates_across(case: &Case, places: &[f64]) -> Option<Vec<(f64, f64)>> {
    let table = case.wheel_table.as_ref()?;
    if case.space().is_some() {
        return front_rates_across(case, table, places);
    }
    if table.is_whole {
        return patch_rates_across(case, table, places);
    }
    let at = |place: &f64| -> Vec<(f64, Contact)> {
        let of = |own: &TabledWheel| {
            Some((own.share, PlacedPatch::plane_contact(&own.wheel.over(*place), table.travel)?))
        };
        table.wheels.iter().filter_map(of).collect()
    };
    let all: Vec<Vec<(f64, Contact)>> = places.par_iter().map(at).collect();
    let widths: Vec<f64> = all.iter().flatten().map(|(_, contact)| contact.half_width()).collect();
    let open = open_crack(&widths, &case.cracks, *case.crack_friction.first()?, &case.steel)?;
    let mean = |contacts: &Vec<(f64, Contact)>| {
        let rate = |contact: &Contact| open.rate(&open.history(contact), &case.growth.law);
        let rates = contacts.iter().map(|(share, contact)| share * rate(contact));
        (rates.sum::<f64>(), contacts.iter().map(|(share, _)| share).sum::<f64>())
    };
    Some(all.par_iter().map(mean).collect())
}

/// Mean rates of the coarse crack under the patches, and the share of the axles over it.
fn patch_rates_across(case: &Case, table: &WheelTable, places: &[f64]) -> Option<Vec<(f64, f64)>> {
    let crack = (&case.cracks, *case.crack_friction.first()?);
    let (taken, scale) = every_so_many(table, places.len());
    let mean = |place: &f64| {
        let wheels: Vec<CoarseWheel> =
            taken.iter().map(|own| coarse_wheel(own, table.travel, *place, &case.steel)).collect();
        let histories = coarse_histories(&wheels, crack, &case.steel, table.travel)?;
        let rates = taken.iter().zip(&histories);
        let rate = rates.map(|(own, tips)| own.share * coarse_rate(tips, &case.growth.law)).sum::<f64>();
        Some((scale * rate, meeting(table, *place)))
    };
    places.iter().map(mean).collect()
}

/// Share of the axles with a patch over a crack at `place` (mm).
fn meeting(table: &WheelTable, place: f64) -> f64 {
    let meets =
        |wheel: &&TabledWheel| wheel.wheel.over(place).iter().any(|own| own.patch.half_length(own.y) > 0.0);
    table.wheels.iter().filter(meets).map(|wheel| wheel.share).sum()
}

/// Every so many wheels across the rail, for passages over all of so many `places`, and the share
/// of all wheels over theirs.
fn every_so_many(table: &WheelTable, places: usize) -> (Vec<&TabledWheel>, f64) {
    let mut wheels: Vec<&TabledWheel> = table.wheels.iter().collect();
    let y = |wheel: &TabledWheel| wheel.wheel.heaviest().y_rail;
    wheels.sort_by(|a, b| y(a).total_cmp(&y(b)));
    let stride = (wheels.len() * places).div_ceil(PASSAGES);
    let taken: Vec<&TabledWheel> = wheels.iter().copied().skip(stride / 2).step_by(stride.max(1)).collect();
    let whole = |wheels: &[&TabledWheel]| wheels.iter().map(|wheel| wheel.share).sum::<f64>();
    let scale = whole(&wheels) / whole(&taken);
    (taken, scale)
}

fn front_rates_across(case: &Case, table: &WheelTable, places: &[f64]) -> Option<Vec<(f64, f64)>> {
    let shape = case.space()?.shapes.first()?;
    let front = CoarseFront::new(shape, *case.crack_friction.first()?, &case.steel)?;
    let (taken, scale) = every_so_many(table, places.len());
    let mean = |place: &f64| {
        let histories = front.histories(&taken, table.travel, place - table.lateral);
        let rates = taken.iter().zip(&histories);
        let rate = rates.map(|(wheel, own)| wheel.share * front.rate(own, &case.growth.law)).sum::<f64>();
        (scale * rate, meeting(table, *place))
    };
    Some(places.iter().map(mean).collect())
}
