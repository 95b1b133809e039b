//! What the enriched functions do at the faces.

use super::basis::{CellBasis, Function};
use super::cuts::Cuts;
use super::interface::Interface;
use super::space::Space;
use crate::bulk::BulkRail;
use crate::math::Matrix;

/// Adds B: row 2 j + axis, column of an enriched unknown: ∫ λ_j ⟦φ⟧ ds.
pub(super) fn jumps(
    background: &BulkRail,
    cuts: &Cuts,
    space: &Space,
    interface: &Interface,
    b: &mut Matrix,
) {
    let mut functions: Vec<Function> = Vec::new();
    for station in &interface.stations {
        let piece = &cuts.pieces[station.piece];
        for (place, sign) in [(piece.plus, 1.0), (piece.minus, -1.0)] {
            let cut = &cuts.elements[&place.element];
            let basis = CellBasis::new(cuts, space, cut, place, background.steel());
            basis.at(station.point, &mut functions);
            for (target, function) in basis.targets.iter().zip(&functions) {
                let Some(enriched) = target.enriched else { continue };
                for (point, lambda) in station.tractions {
                    let value = function.value * (sign * lambda * station.length);
                    b[(2 * point, enriched)] += value.x;
                    b[(2 * point + 1, enriched)] += value.y;
                }
            }
        }
    }
}
