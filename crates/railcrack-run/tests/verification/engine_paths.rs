//! Paths of the two engines over 25 increments that each kink.

use crate::common::measured;
use railcrack::growth::Unobserved;
use railcrack::math::Vec2;
use railcrack_case::{Case, Overrides};
use railcrack_run::setup::PreparedRun;
use std::path::Path;

/// Distance between the tips of the two engines, mm: as promised to users, unless a near tie of
/// directions explains more.
const PROMISED: f64 = 0.1;

/// A crack of 6 mm under the wheel of the reference case.
struct Rolled {
    angle_deg: f64,
    crack_friction: f64,
    wheel_friction: f64,
}

impl Rolled {
    /// The tip in every growth step.
    fn path(&self, engine: &str) -> Vec<Vec2> {
        let text = format!(
            "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = {:?}\n\
             [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = {:?}\nfriction = {:?}\n\
             [growth]\nturning = \"kink\"\n",
            self.wheel_friction, self.angle_deg, self.crack_friction
        );
        let overrides = Overrides { engine: Some(engine.into()), ..Overrides::default() };
        let case = Case::parse_with(&text, "case.toml", Path::new(""), &overrides).unwrap();
        let mut run = PreparedRun::new(&case, None).unwrap().growth(None);
        let mut path = Vec::new();
        while let Some(step) = run.next_step(&Unobserved).unwrap() {
            path.push(Vec2::new(step.tips[0].x, step.tips[0].y));
        }
        path
    }

    #[track_caller]
    fn agrees(&self, name: &str) {
        let (elements, dislocations) = (self.path("xfem"), self.path("dislocation"));
        assert_eq!((elements.len(), dislocations.len()), (26, 26), "{name}: 25 increments and the end");
        let apart = elements.iter().zip(&dislocations).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
        println!("{name}: tips at most {apart:.4} mm apart, end {:?}", elements[25]);
        measured(apart, PROMISED, "mm; promised to users after 25 increments");
        assert!(apart < PROMISED, "{name}: {apart} mm");
    }
}

#[test]
fn reference_case() {
    Rolled { angle_deg: 15.0, crack_friction: 0.5, wheel_friction: 0.025 }.agrees("Table 1");
}

#[test]
fn branch_downwards() {
    Rolled { angle_deg: 15.0, crack_friction: 0.1, wheel_friction: 0.4 }.agrees("Fig. 13 grown");
}

#[test]
fn steep_cracks() {
    Rolled { angle_deg: 45.0, crack_friction: 0.3, wheel_friction: 0.3 }.agrees("45 degrees");
    Rolled { angle_deg: 60.0, crack_friction: 0.5, wheel_friction: 0.025 }.agrees("60 degrees");
}
