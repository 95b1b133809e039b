//! Engine and residual stress of a run, built once from its case.

use super::carried::{CarriedStress, CarriedStressError, RolledStress, plastic_field};
use super::engine::{engine_with, finite_elements};
use super::plane::plane_rail;
use super::shared::SharedRail;
use super::space::space_rail;
use railcrack::bulk::Boundary;
use railcrack::growth::{CrackedRail, Growth, GrowthState, StepSource, TipJudge};
use railcrack::plane::{KnownRail, KnownStraight};
use railcrack::xfem::XfemEngine;
use railcrack_case::{Case, Geometry};
use std::sync::Arc;

/// A run before its first step.
pub struct PreparedRun<'a> {
    case: &'a Case,
    /// The finite elements that carry its stress, whichever engine computes the cracks; none for a
    /// run in space.
    meshed: Option<XfemEngine>,
    residual: CarriedStress,
}

impl<'a> PreparedRun<'a> {
    /// Everything that is made once for the run of `case`. `rolled` is the stress of the
    /// stabilised state, for a case that requires it
    /// ([`PlasticSource::Rolled`](railcrack_case::PlasticSource)).
    ///
    /// Errors: the residual stress cannot be computed.
    pub fn new(case: &'a Case, rolled: Option<&RolledStress>) -> Result<Self, CarriedStressError> {
        Self::sharing(case, rolled, None)
    }

    /// [`PreparedRun::new`] with mesh, factor and columns of another run, or with the stress that
    /// its rail carries, then without `rolled`: the same bits, sooner.
    ///
    /// Errors: the same.
    pub fn sharing(
        case: &'a Case,
        rolled: Option<&RolledStress>,
        shared: Option<&SharedRail>,
    ) -> Result<Self, CarriedStressError> {
        if let Some(carried) = shared.and_then(SharedRail::carried) {
            let meshed = case.plane().map(|plane| finite_elements(case, plane, None));
            return Ok(Self { case, meshed, residual: carried.clone() });
        }
        let plastic = plastic_field(case, rolled)?;
        let mut meshed = case.plane().map(|plane| finite_elements(case, plane, plastic.as_ref()));
        if let Some((rail, meshed)) = shared.zip(meshed.as_mut()) {
            rail.give_to(meshed);
        }
        let residual = CarriedStress::balanced(case, rolled, plastic.as_ref(), meshed.as_mut())?;
        Ok(Self { case, meshed, residual })
    }

    /// The stress that the rail carries, for other runs by dislocations under the same one.
    pub(crate) fn carrying_rail(&self) -> SharedRail {
        SharedRail::Carrying(self.residual.clone())
    }

    /// The residual stress that the rail carries.
    #[must_use]
    pub fn residual(&self) -> &CarriedStress {
        &self.residual
    }

    /// That residual stress.
    pub(super) fn into_residual(self) -> CarriedStress {
        self.residual
    }

    /// The growth loop from `state` on, or from the beginning where there is none.
    #[must_use]
    pub fn growth(self, state: Option<GrowthState>) -> Box<dyn StepSource> {
        self.growth_judged(state, None, None)
    }

    /// [`PreparedRun::growth`] with a `judge` that gives direction and rate of every tip; in space
    /// the rate of every front point. What other runs of this rail have `known` of its crack is not
    /// computed again.
    #[must_use]
    pub(crate) fn growth_judged(
        self,
        state: Option<GrowthState>,
        judge: Option<Arc<dyn TipJudge>>,
        known: Option<Arc<KnownStraight>>,
    ) -> Box<dyn StepSource> {
        let Self { case, meshed, residual } = self;
        let standing = residual.standing;
        let residual = residual.field;
        match &case.geometry {
            Geometry::Space(space) => {
                let initial =
                    || GrowthState::initial_in_space(space.shapes.clone()).expect("the case is checked");
                let rail = space_rail(case, space, residual.as_ref(), standing.as_ref());
                boxed(rail, state.unwrap_or_else(initial), judge)
            }
            Geometry::Plane(plane) => {
                let engine = engine_with(case, plane, meshed.expect("cracks in the plane"));
                let rail = plane_rail(case, plane, engine, residual.as_ref());
                let state = state.unwrap_or_else(|| GrowthState::initial(&case.cracks));
                match known {
                    Some(known) => boxed(KnownRail::new(rail, known), state, judge),
                    None => boxed(rail, state, judge),
                }
            }
        }
    }
}

/// The crack of `case` as runs of its rail that differ in wear, grinding and speed alone know it
/// together, filled as they compute it; none where K depends on more than the length.
pub fn known_straight(case: &Case) -> Option<Arc<KnownStraight>> {
    let plane = case.plane()?;
    let has_profile = case.residual_stress.is_some() || case.plastic_stress().is_some();
    let is_half_plane = case.boundary() == Boundary::HalfPlane && plane.section.is_none();
    let known = KnownStraight::of(&case.cracks, &case.growth)?;
    (is_half_plane && !has_profile).then(|| Arc::new(known))
}

/// The growth of `rail` from `state` on, with directions and rates from `judge` if there is one.
fn boxed<R: CrackedRail + 'static>(
    rail: R,
    state: GrowthState,
    judge: Option<Arc<dyn TipJudge>>,
) -> Box<dyn StepSource> {
    let growth = Growth::new(rail, state);
    Box::new(match judge {
        Some(judge) => growth.judged_by(judge),
        None => growth,
    })
}
