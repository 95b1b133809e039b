//! Groups of cracks in space that are solved for together: each crack with those to which it is
//! strongly coupled.

use super::body::SpaceBody;
use super::error::SpaceError;
use crate::interruption::Interruption;
use crate::linear::{LinearError, coupling, spd_inverse_unless};
use crate::math::Matrix;
use rayon::prelude::*;

/// Coupling above which two cracks are solved for together, as the root of the sum of squared
/// correlations of their jumps.
const STRONG: f64 = 0.3;

/// A crack together with those to which it is strongly coupled.
#[derive(Debug, Clone)]
pub(super) struct CrackGroup {
    /// The cracks (from 0), in their order.
    pub members: Vec<usize>,
    /// The place among them of the crack whose results count.
    pub own: usize,
    /// The members alone.
    pub body: SpaceBody,
}

/// Groups around every crack of `body`.
///
/// Errors: cracks whose A is not positive definite; the interruption.
pub(super) fn groups(
    body: &SpaceBody,
    interruption: Interruption<'_>,
) -> Result<Vec<CrackGroup>, SpaceError> {
    let count = body.cracks().len();
    let alone = |k: usize| {
        spd_inverse_unless(interruption, &body.stiffness_between([k, k])).map_err(|error| match error {
            LinearError::NotPositiveDefinite { .. } => {
                SpaceError::TooCoarse { crack: k, shape: Box::new(body.cracks()[k].shape.clone()) }
            }
            error => error.into(),
        })
    };
    let alone: Vec<Matrix> = (0..count).into_par_iter().map(alone).collect::<Result<_, _>>()?;
    let pairs: Vec<[usize; 2]> = (0..count).flat_map(|k| (0..k).map(move |l| [l, k])).collect();
    let is_strong = |&[l, k]: &[usize; 2]| -> Result<bool, SpaceError> {
        interruption.check()?;
        let coupling = coupling(&alone[l], &body.stiffness_between([l, k]), &alone[k])?;
        Ok(coupling >= STRONG)
    };
    let strong: Vec<bool> = pairs.par_iter().map(is_strong).collect::<Result<_, _>>()?;
    let group = |k: usize| {
        let coupled = |[one, other]: [usize; 2]| match k {
            _ if k == one => Some(other),
            _ if k == other => Some(one),
            _ => None,
        };
        let mut members: Vec<usize> = pairs
            .iter()
            .zip(&strong)
            .filter(|(_, strong)| **strong)
            .filter_map(|(pair, _)| coupled(*pair))
            .collect();
        members.push(k);
        members.sort_unstable();
        let own = members.iter().position(|&member| member == k).unwrap_or(0);
        Ok(CrackGroup { own, body: body.part(&members, interruption)?, members })
    };
    (0..count).into_par_iter().map(group).collect()
}
