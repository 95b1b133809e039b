//! Invariance under the unit of length, the unit of stress, and reflection.

use super::{rail, stabilised};
use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{RolledRail, Travel};

/// Doubling is exact in floating point, except for the sines of the wave numbers.
const ROUNDING: f64 = 1e-6;

#[test]
fn results_do_not_depend_on_the_units() {
    let one = rail(1050.0, 0.15, 20e3);
    let longer = RolledRail {
        contact: HertzianContact { half_width: 13.5, ..*one.contact.sliding().unwrap() }.into(),
        ..one.clone()
    };
    let stronger = RolledRail {
        steel: IsotropicElastic::new(420e3, 0.3).unwrap(),
        hardening: KinematicHardening::new(1000.0, 40e3).unwrap(),
        contact: HertzianContact { peak_pressure: 2100.0, ..*one.contact.sliding().unwrap() }.into(),
        ..one.clone()
    };
    let result = stabilised(&one);
    for (other, length, stress) in [(longer, 2.0, 1.0), (stronger, 1.0, 2.0)] {
        let other = stabilised(&other);
        assert_eq!(other.passes.len(), result.passes.len());
        for (a, b) in result.profile.iter().zip(&other.profile) {
            assert!((length * a.depth - b.depth).abs() < ROUNDING);
            assert!((stress * a.stress.xx - b.stress.xx).abs() < ROUNDING * 1e3, "{a:?} {b:?}");
            assert!((a.strain.xy - b.strain.xy).abs() < ROUNDING * 1e-2, "{a:?} {b:?}");
        }
    }
}

/// A mirrored wheel (friction and travel) leaves the mirrored rail: shears change sign, nothing
/// else does. The travel alone matters: a braking wheel that rolls the other way is a driving one.
#[test]
fn mirror_and_travel() {
    let one = rail(1050.0, 0.15, 20e3);
    let contact = one.contact.mirrored();
    let mirrored = RolledRail { contact, travel: Travel::Backward, ..one.clone() };
    let (a, b) = (stabilised(&one), stabilised(&mirrored));
    for (a, b) in a.profile.iter().zip(&b.profile) {
        assert_eq!((a.stress, a.strain.xx, a.strain.zz), (b.stress, b.strain.xx, b.strain.zz));
        assert_eq!(a.strain.xy, -b.strain.xy);
    }
    assert_eq!(a.cycle.abscissae[0], -b.cycle.abscissae[0]);
    let (here, there) = (a.cycle.stress[10_000], b.cycle.stress[10_000]);
    assert_eq!((here.xx, here.xy), (there.xx, -there.xy));
    // The wheel of a forward passage comes from upstream, that is, from larger abscissae of the
    // rail point.
    assert!(a.cycle.abscissae[0] > 0.0);
    let backward = stabilised(&RolledRail { travel: Travel::Backward, ..one });
    assert!(a.stress_difference(&backward) > 1.0);
}

/// Without friction the two directions of travel leave the same residual stress, and opposite
/// shears.
#[test]
fn travel_has_no_effect_without_friction() {
    let forward = rail(1150.0, 0.0, 20e3);
    let backward = RolledRail { travel: Travel::Backward, ..forward.clone() };
    assert_eq!(stabilised(&forward).stress_difference(&stabilised(&backward)), 0.0);
}
