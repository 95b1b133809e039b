//! The loading of cracks in space at the beginning by each wheel.

use super::case::Case;
use super::coarse_front::CoarseFront;
use super::wheel_demands::{DemandError, WheelDemand};
use super::wheel_table::{TabledWheel, WheelTable};
use railcrack::fatigue::GrowthLaw;
use railcrack::field::StressField;
use railcrack::growth::{CrackedRail, GrowthState, StepStart, TipRecord, Unobserved, WornSurface};
use railcrack::interruption::Interruption;
use railcrack::math::MPA_SQRT_MM;
use railcrack::space::{CracksInSpace, SpaceRail};
use std::sync::Arc;

impl Case {
    /// The largest ΔK_eq along the fronts and the mean rate of their points, by which their area
    /// grows, of every wheel of [`Case::wheel_demands`]. Of a table, the representatives are
    /// computed; every other wheel has the loading of the coarse crack times what that of its
    /// representative falls short of.
    pub(super) fn demands_in_space(
        &self,
        residual: Option<&Arc<dyn StressField>>,
    ) -> Result<Vec<WheelDemand>, DemandError> {
        let rail = self.space_rail(residual).ok_or(DemandError::NoFront)?;
        let computed = self.passages_in_space(rail)?;
        let Some(table) = &self.wheel_table else { return Ok(computed) };
        let computed = &computed[table.first..table.first + table.representatives];
        if table.chosen.len() == table.wheels.len() {
            let mut own = vec![WheelDemand::default(); table.wheels.len()];
            table.chosen.iter().zip(computed).for_each(|(wheel, demand)| own[*wheel] = *demand);
            return Ok(own);
        }
        self.scaled(table, computed).ok_or(DemandError::NoFront)
    }

    /// The loading by every wheel of the mix, or by the only one.
    fn passages_in_space(&self, mut rail: SpaceRail) -> Result<Vec<WheelDemand>, DemandError> {
        let shapes = self.space.as_ref().map_or_else(Vec::new, |space| space.shapes.clone());
        let state = GrowthState::initial_in_space(shapes).map_err(|_| DemandError::NoFront)?;
        let body = rail.body(&state, Interruption::NEVER)?;
        let wheels = std::mem::take(&mut rail.wheels);
        let alone = |(number, wheel)| {
            rail.wheels = vec![wheel];
            of_one(&mut rail, &body).map_err(|source| DemandError::InSpace { wheel: number + 1, source })
        };
        wheels.into_iter().enumerate().map(alone).collect()
    }

    /// Every wheel of the table by the coarse crack, times what the `computed` loading by its
    /// representative is of that of the coarse crack.
    fn scaled(&self, table: &WheelTable, computed: &[WheelDemand]) -> Option<Vec<WheelDemand>> {
        let space = self.space.as_ref()?;
        let front = CoarseFront::new(space.shapes.first()?, *self.crack_friction.first()?, &self.steel)?;
        let wheels: Vec<&TabledWheel> = table.wheels.iter().collect();
        let law: &GrowthLaw = &self.growth.law;
        let histories = front.histories(&wheels, table.travel, 0.0);
        let coarse: Vec<WheelDemand> = histories
            .iter()
            .map(|own| WheelDemand {
                delta_keq: front.largest_range(own, law) / MPA_SQRT_MM,
                rate: front.rate(own, law),
            })
            .collect();
        let over = |a: f64, b: f64| if b > 0.0 { a / b } else { 1.0 };
        let of = |(wheel, own): (&TabledWheel, &WheelDemand)| {
            let group = wheel.represented_by - table.first;
            let (fine, coarse) = (computed[group], coarse[table.chosen[group]]);
            WheelDemand {
                delta_keq: own.delta_keq * over(fine.delta_keq, coarse.delta_keq),
                rate: own.rate * over(fine.rate, coarse.rate),
            }
        };
        Some(table.wheels.iter().zip(&coarse).map(of).collect())
    }
}

/// The loading by the only wheel of `rail`.
fn of_one(
    rail: &mut SpaceRail,
    body: &CracksInSpace,
) -> Result<WheelDemand, Box<dyn std::error::Error + Send + Sync>> {
    let worn = WornSurface::default();
    let start = StepStart {
        step: 0,
        load_cycles: 0.0,
        worn: &worn,
        passed: 0.0,
        earlier: None,
        share: 0.0,
        cycles_at_most: f64::INFINITY,
        turns: &[],
    };
    let passages = rail.passages(body, &start, &Unobserved, &mut Vec::new())?;
    let tips = rail.demands(body, &passages);
    let counted: Vec<&TipRecord> =
        tips.iter().filter(|tip| tip.front().is_some_and(|front| front.counts)).collect();
    let most = counted.iter().map(|tip| tip.delta_keq).fold(0.0, f64::max);
    let sum: f64 = counted.iter().map(|tip| tip.rate).sum();
    Ok(WheelDemand { delta_keq: most / MPA_SQRT_MM, rate: sum / counted.len().max(1) as f64 })
}
