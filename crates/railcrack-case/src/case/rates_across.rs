//! Growth by the lateral place of the crack.

use super::case::Case;
use super::representatives::open_crack;
use super::wheel_table::TabledWheel;
use railcrack::load::Contact;
use railcrack::rolling::PlacedPatch;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

impl Case {
    /// Mean growth rate (mm per axle) of the first crack, open, under the table of wheels, and the
    /// share of the axles whose patches meet it, with the crack at each of `places` (lateral_mm);
    /// none without a table.
    #[must_use]
    pub fn rates_across(&self, places: &[f64]) -> Option<Vec<(f64, f64)>> {
        let table = self.wheel_table.as_ref()?;
        let at = |place: &f64| -> Vec<(f64, Contact)> {
            let of = |own: &TabledWheel| {
                Some((own.share, PlacedPatch::plane_contact(&own.wheel.over(*place), table.travel)?))
            };
            table.wheels.iter().filter_map(of).collect()
        };
        let all: Vec<Vec<(f64, Contact)>> = places.par_iter().map(at).collect();
        let widths: Vec<f64> = all.iter().flatten().map(|(_, contact)| contact.half_width()).collect();
        let open = open_crack(&widths, &self.cracks, *self.crack_friction.first()?, &self.steel)?;
        let mean = |contacts: &Vec<(f64, Contact)>| {
            let rate = |contact: &Contact| open.rate(&open.history(contact), &self.growth.law);
            let rates = contacts.iter().map(|(share, contact)| share * rate(contact));
            (rates.sum::<f64>(), contacts.iter().map(|(share, _)| share).sum::<f64>())
        };
        Some(all.par_iter().map(mean).collect())
    }
}
