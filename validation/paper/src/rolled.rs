//! Fig. 21: the stress by depth described in the paper, read in two ways, and the residual stress
//! of rolled rails.

use crate::error::PaperError;
use crate::files::write;
use crate::tables::{RolledClaim, home};
use railcrack::field::StressField;
use railcrack::load::HertzianContact;
use railcrack::material::KinematicHardening;
use railcrack::math::Vec2;
use railcrack::shakedown::{RailState, RolledRail, Stabilisation, StabilisedRail, Travel, stabilise};
use railcrack_case::Case;
use serde::Deserialize;
use std::path::Path;

/// Depths of the table and the picture, mm.
const DEEPEST: f64 = 16.0;
const SPACING: f64 = 0.1;

/// A steel under the wheel of Table 1: the paper states linear kinematic hardening without numbers.
pub struct Steel {
    /// MPa.
    yield_stress: f64,
    /// C of the back stress, MPa.
    modulus: f64,
    wheel_friction: f64,
}

/// Steels that the paper might have used.
pub static STEELS: [Steel; 5] = [
    Steel { yield_stress: 500.0, modulus: 20e3, wheel_friction: 0.025 },
    Steel { yield_stress: 430.0, modulus: 20e3, wheel_friction: 0.025 },
    Steel { yield_stress: 380.0, modulus: 20e3, wheel_friction: 0.025 },
    Steel { yield_stress: 380.0, modulus: 5e3, wheel_friction: 0.025 },
    Steel { yield_stress: 500.0, modulus: 20e3, wheel_friction: 0.4 },
];

impl Steel {
    fn words(&self) -> String {
        let Self { yield_stress, modulus, wheel_friction } = self;
        format!("rolled: yield {yield_stress} MPa, C {modulus} MPa, friction {wheel_friction}")
    }

    /// The file of the residual stress that rolling leaves.
    pub fn profile_file(&self) -> String {
        format!("rolled-{}-{}-{}.csv", self.yield_stress, self.modulus, self.wheel_friction)
    }

    /// The state that repeated passages of the wheel of `case` lead to.
    fn rolled(&self, case: &Case) -> Result<StabilisedRail, PaperError> {
        let rail = RolledRail {
            steel: case.steel,
            hardening: KinematicHardening::new(self.yield_stress, self.modulus)?,
            contact: HertzianContact {
                peak_pressure: case
                    .first_wheel()
                    .wheel
                    .contact()
                    .map_or(0.0, |contact| contact.peak_pressure()),
                half_width: case.half_width(),
                friction: self.wheel_friction,
            }
            .into(),
            travel: Travel::Forward,
            initial: None,
        };
        Ok(stabilise(&rail, &Stabilisation::default(), |_| ())?)
    }

    /// Its residual stress as the table of a case.
    fn profile_table(&self, rolled: &StabilisedRail) -> String {
        let mut text = format!("# {}\ndepth_mm,sxx_mpa,szz_mpa\n", self.words());
        for layer in &rolled.profile {
            text.push_str(&format!("{:?},{:?},{:?}\n", layer.depth, layer.stress.xx, layer.stress.zz));
        }
        text
    }
}

/// A profile of Fig. 21.
#[derive(Default)]
pub struct StressProfile {
    /// The reading, or the steel.
    pub name: String,
    /// σ_xx at every multiple of 0.1 mm down to 16 mm, MPa.
    sxx: Vec<f64>,
    /// Depth, mm, and plastic shear ε_p,xy of every layer, where it was computed.
    plastic_shear: Vec<[f64; 2]>,
    /// The state that repeated passages lead to, where it was computed.
    pub state: Option<RailState>,
}

/// The profiles of Fig. 21; the tables that cases name are written to the folder `cases`.
///
/// Errors: there is no stabilised state; the system refuses.
pub fn profiles(cases: &Path) -> Result<Vec<StressProfile>, PaperError> {
    let case = Case::read(&home().join("cases/table1.toml"))?;
    let given = Case::read(&home().join("cases/fig22.toml"))?;
    let mut profiles = Vec::new();
    if let Some(given) = &given.residual_stress {
        // A plastic stress along the rail that depends on depth alone is balanced by its opposite
        // in a half-plane.
        for (name, factor) in
            [("read as balanced stress", 1.0), ("read as plastic stress, balanced in a half-plane", -1.0)]
        {
            let stress = |depth: f64| factor * given.content().stress(Vec2::new(0.0, -depth)).xx;
            let (name, sxx) = (name.to_owned(), depths().map(stress).collect());
            profiles.push(StressProfile { name, sxx, ..StressProfile::default() });
        }
    }
    for steel in &STEELS {
        let rail = steel.rolled(&case)?;
        write(&cases.join(steel.profile_file()), &steel.profile_table(&rail))?;
        profiles.push(StressProfile {
            name: steel.words(),
            sxx: depths().map(|depth| rail.residual_stress(depth).xx).collect(),
            plastic_shear: rail.profile.iter().map(|layer| [layer.depth, layer.strain.xy]).collect(),
            state: Some(rail.state),
        });
    }
    Ok(profiles)
}

fn depths() -> impl Iterator<Item = f64> {
    (0..=(DEEPEST / SPACING).round() as usize).map(|i| i as f64 * SPACING)
}

impl StressProfile {
    /// σ_xx (MPa) and depth (mm).
    pub fn points(&self) -> Vec<[f64; 2]> {
        self.sxx.iter().copied().zip(depths()).map(|(stress, depth)| [stress, depth]).collect()
    }

    /// Value (MPa) and depth (mm) of the largest |σ_xx|.
    pub fn extreme(&self) -> [f64; 2] {
        let larger =
            |best: [f64; 2], point: [f64; 2]| if point[0].abs() > best[0].abs() { point } else { best };
        self.points().into_iter().fold([0.0; 2], larger)
    }

    /// Signs of the layers of σ_xx, from the surface down.
    fn layers(&self) -> Vec<i8> {
        /// A stress of less, MPa, makes no layer.
        const LAYER: f64 = 5.0;
        let stressed = self.sxx.iter().filter(|s| s.abs() > LAYER);
        let mut signs: Vec<i8> = stressed.map(|s| if *s > 0.0 { 1 } else { -1 }).collect();
        signs.dedup();
        signs
    }

    /// Whether the plastic shear is largest just beneath the surface and nearly zero far below.
    fn shear_is_near_the_surface(&self) -> bool {
        /// A layer of Fig. 21, mm.
        const BENEATH: f64 = 2.0;
        /// Two half-widths of the contact, mm.
        const DEEP: f64 = 13.5;
        let largest = |from: f64, to: f64| {
            let inside = self.plastic_shear.iter().filter(|[depth, _]| (from..to).contains(depth));
            inside.fold(0.0, |most: f64, [_, shear]| most.max(shear.abs()))
        };
        let above = largest(0.0, BENEATH);
        above > largest(BENEATH, DEEP) && largest(DEEP, f64::INFINITY) < 0.05 * above
    }
}

/// A rule that a rolled rail decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RolledRule {
    /// Repeated passages lead to elastic shakedown.
    ElasticShakedown,
    /// σ_xx is tensile, compressive, tensile, compressive from the surface down.
    Layers,
    /// Plastic shear is largest just beneath the surface.
    ShearNearSurface,
}

impl RolledClaim {
    /// For each rolled rail of `profiles`, its name and whether the statement holds.
    pub fn decisions<'a>(&self, profiles: &'a [StressProfile]) -> Vec<(&'a str, bool)> {
        let holds = |rail: &StressProfile| match self.decide {
            RolledRule::ElasticShakedown => rail.state == Some(RailState::ElasticShakedown),
            RolledRule::Layers => rail.layers() == [1, -1, 1, -1],
            RolledRule::ShearNearSurface => rail.shear_is_near_the_surface(),
        };
        let rolled = profiles.iter().filter(|profile| profile.state.is_some());
        rolled.map(|profile| (profile.name.as_str(), holds(profile))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_count_where_there_is_a_stress() {
        let layers = |sxx: &[f64]| StressProfile { sxx: sxx.to_vec(), ..Default::default() }.layers();
        assert_eq!(layers(&[25.0, 2.0, -110.0, -110.0, 50.0, -50.0, -4.0, 3.0]), [1, -1, 1, -1]);
        assert_eq!(layers(&[4.0, -110.0, 50.0, -50.0]), [-1, 1, -1]);
    }

    #[test]
    fn shear_has_its_largest_value_beneath_the_surface() {
        let holds = |plastic_shear: &[[f64; 2]]| {
            StressProfile { plastic_shear: plastic_shear.to_vec(), ..Default::default() }
                .shear_is_near_the_surface()
        };
        assert!(holds(&[[0.5, -1e-3], [4.0, 2e-4], [20.0, 1e-6]]));
        assert!(!holds(&[[0.5, -1e-3], [4.0, 2e-3]]));
        assert!(!holds(&[[0.5, 0.0]]), "no plastic strain at all");
    }
}
