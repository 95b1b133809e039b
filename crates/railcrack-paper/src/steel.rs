//! Steels that the paper might have used: it states linear kinematic hardening without numbers.

use crate::error::PaperError;
use railcrack::load::HertzianContact;
use railcrack::material::KinematicHardening;
use railcrack::shakedown::{RolledRail, Stabilisation, StabilisedRail, Travel, stabilise};
use railcrack_case::Case;

/// A steel under the wheel of Table 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Steel {
    /// MPa.
    pub yield_stress: f64,
    /// C of the back stress, MPa.
    pub modulus: f64,
    /// Wheel–rail friction.
    pub wheel_friction: f64,
}

const fn steel(yield_stress: f64, modulus: f64, wheel_friction: f64) -> Steel {
    Steel { yield_stress, modulus, wheel_friction }
}

pub(super) static STEELS: [Steel; 5] = [
    steel(500.0, 20e3, 0.025),
    steel(430.0, 20e3, 0.025),
    steel(380.0, 20e3, 0.025),
    steel(380.0, 5e3, 0.025),
    steel(500.0, 20e3, 0.4),
];

impl Steel {
    pub(super) fn words(&self) -> String {
        let Self { yield_stress, modulus, wheel_friction } = self;
        format!("rolled: yield {yield_stress} MPa, C {modulus} MPa, friction {wheel_friction}")
    }

    /// The file of the residual stress that rolling leaves.
    pub(super) fn profile_file(&self) -> String {
        format!("rolled-{}-{}-{}.csv", self.yield_stress, self.modulus, self.wheel_friction)
    }

    /// The state that repeated passages of the wheel of `case` lead to.
    ///
    /// Errors: there is none; a steel that is none.
    pub(super) fn rolled(&self, case: &Case) -> Result<StabilisedRail, PaperError> {
        let rail = RolledRail {
            steel: case.steel,
            hardening: KinematicHardening::new(self.yield_stress, self.modulus)?,
            contact: HertzianContact {
                peak_pressure: case.wheel.contact().peak_pressure(),
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
    pub(super) fn profile_table(&self, rolled: &StabilisedRail) -> String {
        let mut text = format!("# {}\ndepth_mm,sxx_mpa,szz_mpa\n", self.words());
        for layer in &rolled.profile {
            text.push_str(&format!("{:?},{:?},{:?}\n", layer.depth, layer.stress.xx, layer.stress.zz));
        }
        text
    }
}
