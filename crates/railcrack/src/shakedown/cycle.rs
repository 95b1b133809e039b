//! Stabilised cycle of stress and strain from the columns of the last passage.

use super::eigenstress::Columns;
use super::error::ShakedownError;
use super::grid::RailGrid;
use super::rail::{RolledRail, Travel};
use super::state::{Admissibility, Cycle};
use super::steady::{SteadyPassage, SteadyProblem, first_column};
use super::strain::PlasticStrain;
use crate::material::IsotropicElastic;
use crate::math::Stress;

/// Zero strain or stress on all columns of `grid`.
pub(super) fn zeros(grid: &RailGrid) -> Columns {
    let size = grid.columns * grid.layers.count();
    [vec![0.0; size], vec![0.0; size], vec![0.0; size]]
}

/// The residual stress of a rail in which `strain` depends on depth alone: σ_xx = −E′ (ε_xx + ν
/// ε_zz), σ_zz = −E′ (ε_zz + ν ε_xx), σ_yy = σ_xy = 0.
pub(super) fn layer_stress(steel: &IsotropicElastic, strain: PlasticStrain) -> Stress {
    let (modulus, poisson) = (steel.plane_strain_modulus(), steel.poisson());
    Stress {
        xx: -modulus * (strain.xx + poisson * strain.zz),
        zz: -modulus * (strain.zz + poisson * strain.xx),
        ..Stress::ZERO
    }
}

/// −1 if the computation is the mirror image of the rail: the factor of abscissae and shears.
pub(super) fn mirror(travel: Travel) -> f64 {
    match travel {
        Travel::Forward => 1.0,
        Travel::Backward => -1.0,
    }
}

/// Stress and strain of `passage`, and their admissibility. Errors: an invalid contact.
pub(super) fn of(
    rail: &RolledRail,
    grid: &RailGrid,
    problem: &mut SteadyProblem,
    passage: &SteadyPassage,
) -> Result<(Cycle, Admissibility), ShakedownError> {
    let depths = grid.layers.middles();
    let layers = depths.len();
    let strain_at = |at: usize| [0, 1, 2].map(|c| passage.strain[c][at]);
    let entering = &passage.entering;
    let mut residual = zeros(grid);
    problem.eigenstress.stress(&passage.strain, entering, &mut residual);
    let imbalance = problem.eigenstress.imbalance(&passage.strain, entering);
    let field = rail.forward_field()?;
    let (poisson, young) = (rail.steel.poisson(), rail.steel.young());
    let (radius, back) = (rail.hardening.yield_radius(), rail.hardening.back_stress_modulus());
    let side = mirror(rail.travel);
    let mut cycle = Cycle {
        abscissae: (0..grid.columns).rev().map(|i| side * grid.abscissa(i)).collect(),
        stress: Vec::with_capacity(grid.columns * layers),
        strain: Vec::with_capacity(grid.columns * layers),
    };
    let mut overshoot = f64::NEG_INFINITY;
    for i in (0..grid.columns).rev() {
        for (j, &depth) in depths.iter().enumerate() {
            let at = i * layers + j;
            let strain = PlasticStrain::from_deviator(strain_at(at));
            let (xx, yy) = (residual[0][at], residual[1][at]);
            let own = Stress { xx, yy, zz: poisson * (xx + yy) - young * strain.zz, xy: residual[2][at] };
            let wheel = field.stress(grid.abscissa(i), depth);
            let stress = own + wheel + rail.initial_stress(depth);
            let (s, e) = (stress.deviator(), strain_at(at));
            let size = [0, 1, 2].map(|c| s[c] - back * e[c]).iter().map(|c| c * c).sum::<f64>().sqrt();
            overshoot = overshoot.max(size / radius - 1.0);
            cycle.stress.push(Stress { xy: side * stress.xy, ..stress });
            cycle.strain.push(PlasticStrain { xy: side * strain.xy, ..strain });
        }
    }
    let drift = first_column(&passage.strain, layers)
        .iter()
        .zip(entering)
        .map(|(a, b)| PlasticStrain::from_deviator([0, 1, 2].map(|c| a[c] - b[c])).equivalent())
        .fold(0.0, f64::max);
    Ok((cycle, Admissibility { overshoot, drift, imbalance: imbalance / radius }))
}
