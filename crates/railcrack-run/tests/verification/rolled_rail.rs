//! The rail of the shipped case of shakedown.

use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{RolledRail, Stabilisation, Travel};
use railcrack_case::Case;
use railcrack_run::setup::{rolled_rail, stabilisation};
use std::path::Path;

/// The case is the rail whose residual stress the mechanics verify.
#[test]
fn the_case_file_describes_the_same_rail() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/shakedown.toml");
    let case = Case::read(&path).unwrap();
    let rail = RolledRail {
        steel: IsotropicElastic::new(210e3, 0.3).unwrap(),
        hardening: KinematicHardening::new(500.0, 20e3).unwrap(),
        contact: HertzianContact { peak_pressure: 1100.0, half_width: 6.75, friction: 0.1 }.into(),
        travel: Travel::Forward,
        initial: None,
    };
    assert_eq!(rolled_rail(&case), rail);
    assert_eq!(stabilisation(&case), Stabilisation::default());
}
