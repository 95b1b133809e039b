//! Statements about the plastic state itself, decided by rolled rails.

use crate::profile::StressProfile;
use railcrack::shakedown::RailState;

/// A statement that a rolled rail decides.
pub(super) struct RolledClaim {
    pub id: &'static str,
    pub place: &'static str,
    pub statement: &'static str,
    pub rule: &'static str,
    decide: fn(&StressProfile) -> bool,
}

/// A stress of less, MPa, makes no layer.
const LAYER: f64 = 5.0;
/// Just beneath the surface: a layer of Fig. 21, mm.
const BENEATH: f64 = 2.0;
/// Two half-widths of the contact, mm.
const DEEP: f64 = 13.5;

pub(super) static ROLLED_CLAIMS: &[RolledClaim] = &[
    RolledClaim {
        id: "6-shakedown",
        place: "6",
        statement: "The stabilised state of the rail is likely to be elastic shakedown.",
        rule: "repeated passages lead to elastic shakedown",
        decide: |rail| rail.state == Some(RailState::ElasticShakedown),
    },
    RolledClaim {
        id: "5.4.1-layers",
        place: "5.4.1, Fig. 21",
        statement: "From the running surface downwards, \u{3c3}_xx is tensile, compressive, tensile, compressive.",
        rule: "signs of \u{3c3}_xx where it is larger than 5 MPa, from the surface down: + \u{2212} + \u{2212}",
        decide: |rail| layers(rail) == [1, -1, 1, -1],
    },
    RolledClaim {
        id: "5.4.1-shear",
        place: "5.4.1, Fig. 21",
        statement: "Plastic shear occurs only just beneath the running surface.",
        rule: "\u{3b5}_p,xy is largest above a depth of 2 mm, and below 2 a it is less than 5 % of that value",
        decide: |rail| {
            let largest = |from: f64, to: f64| {
                let inside = rail.plastic_shear.iter().filter(|[depth, _]| (from..to).contains(depth));
                inside.fold(0.0, |most: f64, [_, shear]| most.max(shear.abs()))
            };
            let above = largest(0.0, BENEATH);
            above > largest(BENEATH, DEEP) && largest(DEEP, f64::INFINITY) < 0.05 * above
        },
    },
];

/// Signs of the layers of σ_xx.
fn layers(rail: &StressProfile) -> Vec<i8> {
    let mut signs: Vec<i8> =
        rail.sxx.iter().filter(|s| s.abs() > LAYER).map(|s| if *s > 0.0 { 1 } else { -1 }).collect();
    signs.dedup();
    signs
}

impl RolledClaim {
    /// For each rolled rail of `profiles`, whether it holds.
    pub(super) fn decisions<'a>(&self, profiles: &'a [StressProfile]) -> Vec<(&'a str, bool)> {
        let rolled = profiles.iter().filter(|profile| profile.state.is_some());
        rolled.map(|profile| (profile.name.as_str(), (self.decide)(profile))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rail(sxx: &[f64], plastic_shear: &[[f64; 2]]) -> StressProfile {
        let state = Some(RailState::ElasticShakedown);
        StressProfile { name: "rail".into(), sxx: sxx.to_vec(), plastic_shear: plastic_shear.to_vec(), state }
    }

    fn holds(id: &str, profile: StressProfile) -> bool {
        let claim = ROLLED_CLAIMS.iter().find(|claim| claim.id == id).unwrap();
        claim.decisions(&[profile])[0].1
    }

    #[test]
    fn layers_count_where_there_is_a_stress() {
        assert!(holds("5.4.1-layers", rail(&[25.0, 2.0, -110.0, -110.0, 50.0, -50.0, -4.0, 3.0], &[])));
        assert!(!holds("5.4.1-layers", rail(&[4.0, -110.0, 50.0, -50.0], &[])));
    }

    #[test]
    fn shear_has_its_largest_value_beneath_the_surface() {
        assert!(holds("5.4.1-shear", rail(&[], &[[0.5, -1e-3], [4.0, 2e-4], [20.0, 1e-6]])));
        assert!(!holds("5.4.1-shear", rail(&[], &[[0.5, -1e-3], [4.0, 2e-3]])));
        assert!(!holds("5.4.1-shear", rail(&[], &[[0.5, 0.0]])), "no plastic strain at all");
    }
}
