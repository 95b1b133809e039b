//! Jumps of enriched functions across the faces.

use super::basis::{CellBasis, Function};
use super::border::{Entries, merge};
use super::cuts::Cuts;
use super::interface::{Interface, Station};
use super::space::Space;
use crate::bulk::BulkRail;
use crate::math::Vec2;

/// B: for row 2 j + axis of face point j, the entries (enriched unknown, ∫ λ_j ⟦φ⟧ ds), in
/// increasing order.
pub(super) fn jumps(
    background: &BulkRail,
    cuts: &Cuts,
    space: &Space,
    interface: &Interface,
) -> Vec<Entries> {
    let mut rows = vec![Entries::new(); 2 * interface.faces.points.len()];
    let mut functions: Vec<Function> = Vec::new();
    let points = |station: &Station| station.tractions.map(|(point, _)| point);
    let together = |a: &Station, b: &Station| a.piece == b.piece && points(a) == points(b);
    for stations in interface.stations.chunk_by(together) {
        let piece = &cuts.pieces[stations[0].piece];
        for (place, sign) in [(piece.plus, 1.0), (piece.minus, -1.0)] {
            let cut = &cuts.elements[&place.element];
            let basis = CellBasis::new(cuts, space, cut, place, background.steel());
            let mut integrals = vec![[Vec2::default(); 2]; basis.targets.len()];
            for station in stations {
                basis.at(station.point, &mut functions);
                let weights = station.tractions.map(|(_, lambda)| sign * lambda * station.length);
                for (own, function) in integrals.iter_mut().zip(&functions) {
                    own.iter_mut()
                        .zip(weights)
                        .for_each(|(sum, weight)| *sum = *sum + function.value * weight);
                }
            }
            for (target, own) in basis.targets.iter().zip(&integrals) {
                let Some(enriched) = target.enriched else { continue };
                for (point, integral) in points(&stations[0]).into_iter().zip(own) {
                    for (axis, value) in [integral.x, integral.y].into_iter().enumerate() {
                        if value != 0.0 {
                            rows[2 * point + axis].push((enriched, value));
                        }
                    }
                }
            }
        }
    }
    rows.iter_mut().for_each(merge);
    rows
}
