//! The loading of the initial cracks by each wheel.

use super::demand::{DemandError, WheelDemand};
use super::engine::body_engine;
use super::prepared::PreparedRun;
use super::space_demands::demands_in_space;
use super::wheel::{plane_field, with_temperature};
use railcrack::contact::{FaceProblem, Latin, Newton};
use railcrack::fatigue::{LoadRange, SifRanges};
use railcrack::growth::Unobserved;
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack_case::{Case, TrafficWheel};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// ΔK_eq and rate of a stabilised passage of every wheel over the cracks at the beginning: of the
/// table of wheels, if there is one, otherwise of the wheels of `case`. A wheel that misses the
/// cracks has none. In space, the largest range along the fronts and the mean rate of their points,
/// from those of `run`, the case with the representatives of its table; see the documentation of
/// tables of wheels.
///
/// Errors: the first wheel whose passage cannot be computed.
pub fn wheel_demands(case: &Case, run: &Case) -> Result<Vec<WheelDemand>, DemandError> {
    let prepared = PreparedRun::new(case, None)?;
    let carried = prepared.into_residual();
    let residual = carried.field;
    if case.space().is_some() {
        return demands_in_space(run, residual.as_ref(), carried.standing.as_ref());
    }
    let body = body_engine(case).ok_or(DemandError::NoFront)?.body(&case.cracks)?;
    let body = body.with_widths(case.plane().map_or(&[], |plane| &plane.widths));
    let first = case.wheel_table.as_ref().map_or(0, |table| table.first);
    let of = |(number, wheel): &(usize, &TrafficWheel)| {
        if wheel.wheel.contact().is_none() {
            return Ok(WheelDemand::default());
        }
        let fluid = wheel.fluid.as_ref().map(|fluid| fluid.on(&case.cracks, &body.faces));
        let faces = FaceProblem::new(&body, &case.crack_friction)?.with_fluid(fluid);
        let field = plane_field(case, first + number).expect("the case is checked");
        let stays = with_temperature(case, &wheel.wheel, residual.as_ref());
        let load = RailLoad { wheel: field.as_ref(), residual: stays.as_deref() };
        let passage = stabilised_passage(&faces, &Newton::default(), load, &wheel.passages, &Unobserved)
            .or_else(|_| stabilised_passage(&faces, &Latin::default(), load, &wheel.passages, &Unobserved));
        let passage = passage.map_err(|source| DemandError::Passage { wheel: number + 1, source })?;
        let law = &case.growth.law;
        let demand = |history| {
            let SifRanges { ki_max, delta_ki, delta_kii } = SifRanges::of(history);
            WheelDemand {
                delta_keq: law.equivalent_range(delta_ki, delta_kii) / MPA_SQRT_MM,
                rate: law.rate(LoadRange::new(delta_ki, delta_kii, ki_max)),
            }
        };
        let faster = |a: WheelDemand, b: WheelDemand| if b.delta_keq > a.delta_keq { b } else { a };
        Ok(passage.histories.iter().map(demand).reduce(faster).unwrap_or_default())
    };
    case.wheels.iter().skip(first).enumerate().collect::<Vec<_>>().par_iter().map(of).collect()
}
