//! The ratio of shear to pressure under a wheel in partial slip.

use crate::load::{CarterContact, Contact};
use std::f64::consts::PI;

/// Number of intervals between the edges of a contact.
const INTERVALS: usize = 800;
/// Distance from an edge, over a, at which pressure and shear are so small that their ratio is that
/// at the edge.
const AT_EDGE: f64 = 1e-6;

/// q/p − Q′/P′ of `contact` by u = x − x_c (mm), increasing; empty where shear and pressure are
/// proportional.
pub(super) fn uneven_shear(contact: &Contact) -> Vec<(f64, f64)> {
    let mean = contact.adhesion();
    let beyond_mean = |(u, p, q): (f64, f64, f64)| (u, q / p - mean);
    match contact {
        Contact::Hertz(_) => Vec::new(),
        Contact::Carter(carter) if carter.edges().len() == 2 => Vec::new(),
        Contact::Carter(carter) => {
            places(carter).map(|u| beyond_mean((u, carter.pressure(u), carter.shear(u)))).collect()
        }
        Contact::Table(table) => {
            let pressed = table.rows().iter().filter(|row| row.pressure > 0.0);
            pressed.map(|row| beyond_mean((row.u, row.pressure, row.shear))).collect()
        }
    }
}

/// Places between the edges, dense at these.
fn places(contact: &CarterContact) -> impl Iterator<Item = f64> {
    let reach = (1.0 - AT_EDGE) * contact.half_width;
    (0..=INTERVALS).map(move |k| -reach * (PI * k as f64 / INTERVALS as f64).cos())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Travel;

    #[test]
    fn partial_slip_has_the_friction_of_the_slip_zone_and_less_where_it_sticks() {
        let carter = CarterContact {
            peak_pressure: 845.0,
            half_width: 6.75,
            friction: 0.3,
            traction: -0.75,
            travel: Travel::Forward,
        };
        let ratios = uneven_shear(&Contact::Carter(carter));
        let (trailing, leading) = (ratios[0], ratios[INTERVALS]);
        // c = a/2: slip in the rear half, and μ (1 − √(c/a)) at the leading edge.
        let mean = -0.75 * 0.3;
        assert!((trailing.1 - (-0.3 - mean)).abs() < 1e-12);
        assert!((leading.1 - (-0.3 * (1.0 - 0.5f64.sqrt()) - mean)).abs() < 1e-5);
        let sliding = CarterContact { traction: 1.0, ..carter };
        assert!(uneven_shear(&Contact::Carter(sliding)).is_empty());
    }
}
