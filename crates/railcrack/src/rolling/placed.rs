//! Patches of one wheel over one crack.

use super::RollingPatch;
use crate::load::{Contact, ContactRow, TableContact, Travel};

/// A patch, and where a crack lies in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedPatch {
    /// The patch.
    pub patch: RollingPatch,
    /// y of the crack in the patch, mm.
    pub y: f64,
    /// x of the middle of the patch from the wheel's centre, with the travel, mm.
    pub x: f64,
}

/// Intervals of each strip where several are added.
const INTERVALS: usize = 160;

impl PlacedPatch {
    /// The load of all `patches` of a wheel that runs towards `travel` over a crack: one contact,
    /// whose centre is that of the wheel; of a single patch, the middle of the patch. None where
    /// the patches miss the crack.
    #[must_use]
    pub fn plane_contact(patches: &[Self], travel: Travel) -> Option<Contact> {
        let over: Vec<&Self> = patches.iter().filter(|own| own.patch.half_length(own.y) > 0.0).collect();
        match over[..] {
            [] => None,
            [one] => one.patch.plane_contact(one.y, travel).ok(),
            _ => Self::sum(&over, travel),
        }
    }

    /// Strips added between all their points, in which each is linear.
    fn sum(patches: &[&Self], travel: Travel) -> Option<Contact> {
        let strip = |own: &&Self| {
            let rows = own.patch.strip(own.y, INTERVALS).ok()?.table()?;
            let shifted = |row: &ContactRow| ContactRow { u: row.u + own.x, ..*row };
            Some(rows.rows().iter().map(shifted).collect::<Vec<_>>())
        };
        let strips: Vec<Vec<ContactRow>> = patches.iter().map(strip).collect::<Option<_>>()?;
        let mut places: Vec<f64> = strips.iter().flatten().map(|row| row.u).collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|next, before| *next - *before < 1e-9);
        let row = |&u: &f64| {
            let all = strips.iter().map(|strip| at(strip, u));
            let (pressure, shear) = all.fold((0.0, 0.0), |sum, own| (sum.0 + own.0, sum.1 + own.1));
            ContactRow { u, pressure, shear }
        };
        let mut rows: Vec<ContactRow> = places.iter().map(row).collect();
        // The outermost points carry nothing but what rounding of their places leaves.
        let last = rows.len() - 1;
        for end in [0, last] {
            (rows[end].pressure, rows[end].shear) = (0.0, 0.0);
        }
        let sum = Contact::Table(TableContact::new(rows, None).ok()?);
        Some(match travel {
            Travel::Forward => sum,
            Travel::Backward => sum.mirrored(),
        })
    }
}

/// Pressure and shear of a strip at `u`, linear between its rows.
fn at(strip: &[ContactRow], u: f64) -> (f64, f64) {
    let next = strip.partition_point(|row| row.u < u);
    let (Some(b), true) = (strip.get(next), next > 0 || strip.first().is_some_and(|row| row.u == u)) else {
        return (0.0, 0.0);
    };
    let a = strip[next.saturating_sub(1)];
    let part = if b.u > a.u { (u - a.u) / (b.u - a.u) } else { 1.0 };
    (a.pressure + part * (b.pressure - a.pressure), a.shear + part * (b.shear - a.shear))
}
