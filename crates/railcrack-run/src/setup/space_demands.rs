//! The loading of cracks in space at the beginning by each wheel.

use super::coarse_front::CoarseFront;
use super::demand::{DemandError, WheelDemand};
use super::space::space_rail;
use railcrack::fatigue::GrowthLaw;
use railcrack::field::StressField;
use railcrack::growth::{CrackedRail, GrowthState, StepStart, TipRecord, Unobserved, WornSurface};
use railcrack::interruption::Interruption;
use railcrack::math::MPA_SQRT_MM;
use railcrack::space::{CracksInSpace, SpaceRail, StandingStress};
use railcrack_case::{Case, SpaceCase, TabledWheel, WheelGroups, WheelTable};
use std::sync::Arc;

/// The largest ΔK_eq along the fronts and the mean rate of their points, by which their area
/// grows, of every wheel of `wheel_demands`. Of a table, the representatives are
/// computed; every other wheel has the loading of the coarse crack times what that of its
/// representative falls short of.
pub(super) fn demands_in_space(
    case: &Case,
    residual: Option<&Arc<dyn StressField>>,
    standing: Option<&Arc<dyn StandingStress>>,
) -> Result<Vec<WheelDemand>, DemandError> {
    let space = case.space().ok_or(DemandError::NoFront)?;
    let computed = passages_in_space(space, space_rail(case, space, residual, standing))?;
    let Some((table, groups)) =
        case.wheel_table.as_ref().and_then(|table| Some((table, table.groups.as_ref()?)))
    else {
        return Ok(computed);
    };
    let chosen = &groups.representatives;
    let computed = &computed[table.first..table.first + chosen.len()];
    if chosen.len() == table.wheels.len() {
        let mut own = vec![WheelDemand::default(); table.wheels.len()];
        chosen.iter().zip(computed).for_each(|(wheel, demand)| own[*wheel] = *demand);
        return Ok(own);
    }
    scaled(case, (table, groups), computed).ok_or(DemandError::NoFront)
}

/// The loading by every wheel of the mix, or by the only one.
fn passages_in_space(space: &SpaceCase, mut rail: SpaceRail) -> Result<Vec<WheelDemand>, DemandError> {
    let state = GrowthState::initial_in_space(space.shapes.clone()).map_err(|_| DemandError::NoFront)?;
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
fn scaled(
    case: &Case,
    (table, groups): (&WheelTable, &WheelGroups),
    computed: &[WheelDemand],
) -> Option<Vec<WheelDemand>> {
    let space = case.space()?;
    let front = CoarseFront::new(space.shapes.first()?, *case.crack_friction.first()?, &case.steel)?;
    let wheels: Vec<&TabledWheel> = table.wheels.iter().collect();
    let law: &GrowthLaw = &case.growth.law;
    let histories = front.histories(&wheels, table.travel, 0.0);
    let coarse: Vec<WheelDemand> = histories
        .iter()
        .map(|own| WheelDemand {
            delta_keq: front.largest_range(own, law) / MPA_SQRT_MM,
            rate: front.rate(own, law),
        })
        .collect();
    let over = |a: f64, b: f64| if b > 0.0 { a / b } else { 1.0 };
    let of = |(group, own): (&Option<usize>, &WheelDemand)| {
        let Some(group) = *group else { return WheelDemand::default() };
        let (fine, coarse) = (computed[group], coarse[groups.representatives[group]]);
        WheelDemand {
            delta_keq: own.delta_keq * over(fine.delta_keq, coarse.delta_keq),
            rate: own.rate * over(fine.rate, coarse.rate),
        }
    };
    Some(groups.group_of.iter().zip(&coarse).map(of).collect())
}

/// The loading by the only wheel of `rail`.
fn of_one(
    rail: &mut SpaceRail,
    body: &CracksInSpace,
) -> Result<WheelDemand, Box<dyn std::error::Error + Send + Sync>> {
    let worn = WornSurface::default();
    let start = StepStart {
        step: 0,
        counted: 0,
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
