//! The loading of the initial cracks by each wheel.

use super::carried::CarriedStressError;
use super::case::Case;
use super::mix::MixedWheel;
use super::prepared::with_temperature;
use super::wheel_table::TabledWheel;
use crate::tables::GivenWheel;
use railcrack::body::BodyError;
use railcrack::contact::{CrackFrictionError, FaceProblem, Latin, Newton};
use railcrack::fatigue::{LoadRange, SifRanges};
use railcrack::field::{StressField, wheel_under};
use railcrack::growth::{GrowthError, PassageError, PassageSettings, Unobserved};
use railcrack::load::{Passage, WheelLoad};
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::{CrackFluid, RailLoad, stabilised_passage};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::sync::Arc;
use thiserror::Error;

/// The loading of the fastest tip by one wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelDemand {
    /// ΔK_eq, MPa√m.
    pub delta_keq: f64,
    /// da/dN of a passage of this wheel, mm.
    pub rate: f64,
}

/// Passages that cannot be computed.
#[derive(Debug, Error)]
pub enum DemandError {
    /// Cracks in space that cannot be made.
    #[error("the cracks cannot be made")]
    NoFront,
    /// A body in space.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// The passage of a wheel over cracks in space.
    #[error("wheel {wheel}: {source}")]
    InSpace {
        /// From 1.
        wheel: usize,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The residual stress.
    #[error(transparent)]
    Stress(#[from] CarriedStressError),
    /// The body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The passage of a wheel.
    #[error("wheel {wheel}: {source}")]
    Passage {
        /// From 1.
        wheel: usize,
        /// Why.
        source: PassageError,
    },
    /// The faces.
    #[error(transparent)]
    Faces(#[from] CrackFrictionError),
}

impl Case {
    /// ΔK_eq and rate of a stabilised passage of every wheel over the cracks at the beginning: of
    /// the table of wheels, if there is one and it is the whole mix, otherwise of the mix or of the
    /// only wheel. A wheel that misses the cracks has none. In space, the largest range along the
    /// fronts and the mean rate of their points; see the documentation of tables of wheels.
    ///
    /// Errors: the first wheel whose passage cannot be computed.
    pub fn wheel_demands(&self) -> Result<Vec<WheelDemand>, DemandError> {
        let prepared = self.prepare(None)?;
        let residual: Option<Arc<dyn StressField>> = prepared.into_residual().map(Arc::from);
        if self.engine.is_in_space() {
            return self.demands_in_space(residual.as_ref());
        }
        let body = self.body_engine().ok_or(DemandError::NoFront)?.body(&self.cracks)?;
        let of = |(number, wheel): &(usize, OneWheel<'_>)| {
            let Some(load) = &wheel.load else { return Ok(WheelDemand::default()) };
            let fluid = wheel.fluid.map(|fluid| fluid.on(&self.cracks, &body.faces));
            let faces = FaceProblem::new(&body, &self.crack_friction)?.with_fluid(fluid);
            let field = wheel_under(load, &self.steel).expect("the case is checked");
            let stays = with_temperature(self, wheel.model, residual.as_ref());
            let load = RailLoad { wheel: field.as_ref(), residual: stays.as_deref() };
            let passage = stabilised_passage(&faces, &Newton::default(), load, &wheel.passages, &Unobserved)
                .or_else(|_| {
                    stabilised_passage(&faces, &Latin::default(), load, &wheel.passages, &Unobserved)
                });
            let passage = passage.map_err(|source| DemandError::Passage { wheel: number + 1, source })?;
            let law = &self.growth.law;
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
        self.single_wheels().into_iter().enumerate().collect::<Vec<_>>().par_iter().map(of).collect()
    }

    /// The wheels of which [`Case::wheel_demands`] are.
    fn single_wheels(&self) -> Vec<OneWheel<'_>> {
        match &self.wheel_table {
            Some(table) => {
                let model = &self.mix[table.first];
                let mouths = (self.cracks.leftmost_mouth(), self.cracks.rightmost_mouth());
                table.wheels.iter().map(|wheel| OneWheel::of_table(wheel, model, mouths)).collect()
            }
            None if self.mix.is_empty() => vec![OneWheel {
                model: &self.wheel,
                load: Some(self.wheel.load.clone()),
                passages: self.passages,
                fluid: self.fluid.as_ref(),
            }],
            None => self.mix.iter().map(OneWheel::of_mix).collect(),
        }
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
