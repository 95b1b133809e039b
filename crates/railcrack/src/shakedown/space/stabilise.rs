//! The state to which repeated passages in space lead.

use super::super::rail::ShakedownError;
use super::super::stabilise::EXTENSIONS;
use super::super::state::PassRecord;
use super::choice::{Reached, Zone};
use super::grid::SpaceGrid;
use super::passes::SpacePasses;
use super::rail::RailInSpace;
use super::settings::SpaceStabilisation;
use super::state::StabilisedSpace;
use crate::interruption::Interruption;

/// The state to which repeated passages over `rail` lead, each from the state that the previous one
/// has left. `watch` receives every passage, and starts again with the first one if the plastic
/// zone turns out to need more layers or rows.
///
/// Errors: a load or contact outside the range of the model; a passage that does not converge; an
/// interruption.
///
/// Source: Dang Van & Maitournam 1993, J. Mech. Phys. Solids 41, 1691–1710 (steady flow under
/// moving loads).
pub fn stabilise_in_space(
    interruption: Interruption<'_>,
    rail: &RailInSpace,
    settings: &SpaceStabilisation,
    mut watch: impl FnMut(&PassRecord),
) -> Result<StabilisedSpace, ShakedownError> {
    rail.check()?;
    let mut zone = Zone::of(rail);
    for _ in 0..EXTENSIONS {
        let grid = SpaceGrid::around(rail, settings.resolution, zone);
        let mut run = SpacePasses::new(rail, settings, grid, zone);
        let reached = run.all(interruption, &mut watch)?;
        if reached == Reached::default() {
            return Ok(run.finish());
        }
        zone = zone.enlarged(reached);
    }
    Err(ShakedownError::Bottomless { depth: zone.depth })
}

#[cfg(test)]
mod tests {
    use super::super::super::fourier::{RailGrid, Resolution};
    use super::super::super::rail::RolledRail;
    use super::super::super::stabilise::{Stabilisation, stabilise};
    use super::super::grid::Across;
    use super::super::rail::{RolledPatch, Symmetry};
    use super::*;
    use crate::field::HertzField;
    use crate::load::{HertzianContact, Travel};
    use crate::material::{IsotropicElastic, KinematicHardening};
    use crate::math::{Tensor, Vec2};
    use std::sync::Arc;

    /// A load that is the same in every row leaves the state of the plane, on the same columns and
    /// layers: to what the extrapolation of the longest waves differs by.
    #[test]
    fn a_line_load_leaves_the_state_of_the_plane() {
        const DIFFERENCE: f64 = 1e-3;
        let contact = HertzianContact { peak_pressure: 1100.0, half_width: 6.75, friction: 0.1 };
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let hardening = KinematicHardening::new(500.0, 20e3).unwrap();
        let travel = Travel::Backward;
        let plane = RolledRail { steel, hardening, contact: contact.into(), travel, initial: None };
        let resolution = Resolution { per_half_width: 16, period: 16 };
        let settings = Stabilisation { resolution, max_passes: 3, ..Stabilisation::default() };
        let want = stabilise(&plane, &settings, |_| ()).unwrap();
        let field = HertzField::new(&contact, 0.3);
        let stress = move |x: f64, _: f64, depth: f64| {
            let own = field.stress(Vec2::new(x, -depth), 0.0);
            Tensor { xx: own.xx, yy: own.zz, zz: own.yy, xz: -own.xy, ..Tensor::ZERO }
        };
        let patch = RolledPatch {
            peak_pressure: 1100.0,
            half_width: 6.75,
            lateral_half_width: 6.75,
            lateral: 0.0,
            symmetry: Symmetry::None,
            travel,
            stress: Arc::new(stress),
        };
        let rail = RailInSpace { steel, hardening, patches: vec![patch], initial: None };
        let RailGrid { columns, spacing, layers, fine_depth } = RailGrid::of(&plane, resolution).unwrap();
        let (rows, row_spacing, middle, active) = (4, 1.0, 0.0, 0..4);
        let (across, symmetry) = (Across::Periodic, Symmetry::None);
        let grid =
            SpaceGrid { columns, spacing, rows, row_spacing, middle, active, layers, across, symmetry };
        let zone = Zone { depth: fine_depth, from: f64::NEG_INFINITY, to: f64::INFINITY };
        let settings = SpaceStabilisation { max_passes: 3, ..SpaceStabilisation::default() };
        let mut run = SpacePasses::new(&rail, &settings, grid, zone);
        run.all(Interruption::NEVER, &mut |_| ()).unwrap();
        let got = run.finish();
        let peak = want.profile.iter().map(|own| own.stress.xx.abs()).fold(0.0, f64::max);
        for y in [-2.0, -1.0, 0.0, 1.0] {
            for (got, want) in got.profile(y).iter().zip(&want.profile) {
                let apart = got.stress - want.stress;
                let most = apart.xx.abs().max(apart.zz.abs()).max(apart.yy.abs()).max(apart.xy.abs());
                assert!(most < DIFFERENCE * peak, "{y} {}: {most} of {peak}", want.depth);
                let shear = got.strain.xy - want.strain.xy;
                assert!(shear.abs() < 1e-3 * want.strain.xy.abs().max(1e-4), "{}: {shear}", want.depth);
            }
        }
    }
}
