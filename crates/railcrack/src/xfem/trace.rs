//! What the enriched functions do at the faces.

use super::basis::{CellBasis, Function};
use super::border::{Entries, merge};
use super::cuts::Cuts;
use super::interface::Interface;
use super::space::Space;
use crate::bulk::BulkRail;

/// B: for row 2 j + axis of face point j, the entries (enriched unknown, ∫ λ_j ⟦φ⟧ ds), in increasing order.
pub(super) fn jumps(
    background: &BulkRail,
    cuts: &Cuts,
    space: &Space,
    interface: &Interface,
) -> Vec<Entries> {
    let mut rows = vec![Entries::new(); 2 * interface.faces.points.len()];
    let mut functions: Vec<Function> = Vec::new();
    for stations in interface.stations.chunk_by(|a, b| a.piece == b.piece) {
        let piece = &cuts.pieces[stations[0].piece];
        for (place, sign) in [(piece.plus, 1.0), (piece.minus, -1.0)] {
            let cut = &cuts.elements[&place.element];
            let basis = CellBasis::new(cuts, space, cut, place, background.steel());
            for station in stations {
                basis.at(station.point, &mut functions);
                for (target, function) in basis.targets.iter().zip(&functions) {
                    let Some(enriched) = target.enriched else { continue };
                    for (point, lambda) in station.tractions {
                        if lambda == 0.0 {
                            continue;
                        }
                        let value = function.value * (sign * lambda * station.length);
                        for (axis, value) in [value.x, value.y].into_iter().enumerate() {
                            if value != 0.0 {
                                rows[2 * point + axis].push((enriched, value));
                            }
                        }
                    }
                }
            }
        }
    }
    rows.iter_mut().for_each(merge);
    rows
}
