//! The field of a wheel that feels the cracks.

use crate::contact::SurfaceState;
use crate::coupling::CoupledContact;
use crate::field::TableWheel;
use crate::load::{ContactRow, TableContact};

/// Distance (mm) of the two nodes of a mouth in a table, whose abscissae increase.
const BETWEEN_LIPS: f64 = 1e-5;

/// The wheel with the pressures of the surface `nodes`, centred at `xc` (mm); `None` without
/// pressure.
pub(super) fn felt_wheel(nodes: &[SurfaceState], xc: f64, contact: &CoupledContact) -> Option<TableWheel> {
    let mut before = f64::NEG_INFINITY;
    let mut rows = Vec::with_capacity(nodes.len());
    for node in nodes {
        let x = if node.x > before { node.x } else { before + BETWEEN_LIPS };
        before = x;
        // Round-off is neither tension nor pressure at the ends.
        let pressure = node.pressure.max(0.0);
        let u = x - xc;
        rows.push(ContactRow { u, pressure, shear: contact.shear_ratio(u) * pressure });
    }
    if let [first, .., last] = &mut rows[..] {
        for end in [first, last] {
            (end.pressure, end.shear) = (0.0, 0.0);
        }
    }
    let table = TableContact::new(rows, None).ok()?;
    Some(TableWheel::new(&table, &contact.steel))
}
