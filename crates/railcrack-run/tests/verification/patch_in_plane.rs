//! Cracks in the plane under an ellipse against their deepest point in space; the table of more
//! cases is that of `tools/patch_in_plane.py`.

use crate::common::{Relative, close};
use railcrack::growth::{TipRecord, Unobserved};
use railcrack_case::Case;
use railcrack_run::setup::PreparedRun;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// A head check at 25° under a wheel of 1000 MPa with a = 6 mm.
struct HeadCheck {
    depth: f64,
    friction: f64,
    /// Length on the surface over that down the dip.
    width: f64,
    /// b of the contact, and where its middle lies beside the crack, mm.
    across: f64,
    beside: f64,
}

const SPACE: &str = "[mesh]\nspace_cells = 6\nspace_rings = 6\n[solver]\nengine = \"space\"\n";
const PLANE: &str = "[mesh]\ninterface_elements = 24\n[solver]\nengine = \"dislocation\"\n";

impl HeadCheck {
    /// ΔK_eq of the deepest point, MPa √mm.
    fn delta_k(&self, engine: &str) -> f64 {
        let Self { depth, friction, width, across, beside } = self;
        let length = depth / 25f64.to_radians().sin();
        let text = format!(
            "[contact]\npeak_pressure_mpa = 1000.0\nhalf_width_mm = 6.0\nlateral_half_width_mm = {across:?}\n\
             lateral_mm = {beside:?}\nfriction = 0.2\n\
             [passage]\nfrom_over_a = -6.0\nto_over_a = 7.0\npositions = 53\nstep_tolerance = 0.01\n\
             [[crack]]\nmouth_mm = 0.0\nlength_mm = {length:?}\nsurface_half_length_mm = {:?}\n\
             angle_deg = 25.0\nfriction = {friction:?}\n[growth]\nsteps = 0\n{engine}",
            0.5 * width * length
        );
        let case = Case::parse(&text, "case.toml", Path::new("")).unwrap();
        let step = PreparedRun::new(&case, None).unwrap().growth(None).next_step(&Unobserved).unwrap();
        let above = |tip: &TipRecord| tip.front().map_or(0.0, |front| (front.phi - FRAC_PI_2).abs());
        let tips = step.unwrap().tips;
        tips.iter().min_by(|a, b| above(a).total_cmp(&above(b))).unwrap().delta_keq
    }

    /// ΔK_eq in the plane over that in space.
    fn ratio(&self) -> f64 {
        self.delta_k(PLANE) / self.delta_k(SPACE)
    }
}

const USUAL: HeadCheck = HeadCheck { depth: 5.0, friction: 0.3, width: 4.0, across: 6.0, beside: 0.0 };

#[test]
fn under_a_centred_wheel() {
    let reason = "the table: 5 % in the median; six cells are 1 to 3 % above eight";
    for (check, within) in [
        (USUAL, 0.05),
        (HeadCheck { depth: 2.0, width: 2.0, ..USUAL }, 0.08),
        (HeadCheck { depth: 9.0, across: 3.0, ..USUAL }, 0.08),
    ] {
        close(check.ratio(), 1.0, Relative(within), reason);
    }
}

/// This is warned of: the front is also sheared sideways, in space only.
#[test]
fn a_wheel_beside_the_crack_also_tears_it() {
    let ratio = HeadCheck { beside: 3.0, ..USUAL }.ratio();
    assert!(ratio > 0.65 && ratio < 0.9, "{ratio}");
}
