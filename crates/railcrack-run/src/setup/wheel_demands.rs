//! The loading of the initial cracks by each wheel.

use super::demand::{DemandError, WheelDemand};
use super::engine::body_engine;
use super::prepared::PreparedRun;
use super::space_demands::demands_in_space;
use super::wheel::with_temperature;
use railcrack::contact::{CrackFluid, FaceProblem, Latin, Newton};
use railcrack::fatigue::{LoadRange, SifRanges};
use railcrack::field::{StressField, wheel_under};
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::load::{Passage, WheelLoad};
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack_case::{Case, GivenWheel, MixedWheel, TabledWheel};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::sync::Arc;

/// ΔK_eq and rate of a stabilised passage of every wheel over the cracks at the beginning: of
/// the table of wheels, if there is one and it is the whole mix, otherwise of the mix or of the
/// only wheel. A wheel that misses the cracks has none. In space, the largest range along the
/// fronts and the mean rate of their points; see the documentation of tables of wheels.
///
/// Errors: the first wheel whose passage cannot be computed.
pub fn wheel_demands(case: &Case) -> Result<Vec<WheelDemand>, DemandError> {
    let prepared = PreparedRun::new(case, None)?;
    let residual: Option<Arc<dyn StressField>> = prepared.into_residual().map(Arc::from);
    if case.engine.is_in_space() {
        return demands_in_space(case, residual.as_ref());
    }
    let body = body_engine(case).ok_or(DemandError::NoFront)?.body(&case.cracks)?;
    let of = |(number, wheel): &(usize, OneWheel<'_>)| {
        let Some(load) = &wheel.load else { return Ok(WheelDemand::default()) };
        let fluid = wheel.fluid.map(|fluid| fluid.on(&case.cracks, &body.faces));
        let faces = FaceProblem::new(&body, &case.crack_friction)?.with_fluid(fluid);
        let field = wheel_under(load, &case.steel).expect("the case is checked");
        let stays = with_temperature(case, wheel.model, residual.as_ref());
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
    single_wheels(case).into_iter().enumerate().collect::<Vec<_>>().par_iter().map(of).collect()
}

/// The wheels of which [`wheel_demands`] are.
fn single_wheels(case: &Case) -> Vec<OneWheel<'_>> {
    match &case.wheel_table {
        Some(table) => {
            let model = &case.mix[table.first];
            let mouths = (case.cracks.leftmost_mouth(), case.cracks.rightmost_mouth());
            table.wheels.iter().map(|wheel| OneWheel::of_table(wheel, model, mouths)).collect()
        }
        None if case.mix.is_empty() => vec![OneWheel {
            model: &case.wheel,
            load: Some(case.wheel.load.clone()),
            passages: case.passages,
            fluid: case.fluid.as_ref(),
        }],
        None => case.mix.iter().map(OneWheel::of_mix).collect(),
    }
}

struct OneWheel<'a> {
    /// Temperature and all else but the contact.
    model: &'a GivenWheel,
    load: Option<WheelLoad>,
    passages: PassageSettings,
    fluid: Option<&'a CrackFluid>,
}

impl<'a> OneWheel<'a> {
    fn of_mix(mixed: &'a MixedWheel) -> Self {
        Self {
            model: &mixed.wheel,
            load: Some(mixed.wheel.load.clone()),
            passages: mixed.passages,
            fluid: mixed.fluid.as_ref(),
        }
    }

    /// A wheel of a table, with all but the contact as of `model`; positions are in half-widths.
    fn of_table(wheel: &TabledWheel, model: &'a MixedWheel, (left, right): (f64, f64)) -> Self {
        let load = wheel
            .contact
            .as_ref()
            .map(|contact| WheelLoad { contact: contact.clone(), ..model.wheel.load.clone() });
        let own = wheel.contact.as_ref().map_or(1.0, |contact| contact.half_width());
        let Passage { from, to, positions } = model.passages.passage;
        let scale = own / model.wheel.half_width();
        let (first, last) = if from < to { (left, right) } else { (right, left) };
        let passage =
            Passage { from: first + scale * (from - first), to: last + scale * (to - last), positions };
        Self {
            model: &model.wheel,
            load,
            passages: PassageSettings { passage, ..model.passages },
            fluid: model.fluid.as_ref(),
        }
    }
}
