//! The gap that a wheel leaves over a crack which it does not feel, against that in the plane.

use crate::common::{Relative, body, close, default_elements, steel, surface_crack};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::coupling::gap_in_plane;
use railcrack::field::{HertzWheel, Wheel};
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::load::{HertzianContact, Passage};
use railcrack::math::Vec2;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack::space::{
    EllipticWheel, SpaceBody, SpaceContact, SpaceCrack, SpaceResolution, Surroundings, UncoupledWheel,
};

const LINE: HertzianContact = HertzianContact { peak_pressure: 845.0, half_width: 6.0, friction: 0.0 };
const LENGTH: f64 = 6.0;

/// The gap (mm) under a line contact at `xc` over frictionless faces of a crack whose mouth is
/// 2 · `width` lengths wide.
fn in_space(degrees: f64, xc: f64, width: f64, cells: usize) -> f64 {
    let crack = SpaceCrack::surface_breaking(degrees.to_radians(), width * LENGTH, LENGTH).unwrap();
    let resolution = SpaceResolution::new(cells, cells);
    let body = SpaceBody::new(&[crack], &steel(), Surroundings::HalfSpace, resolution).unwrap();
    let contact = SpaceContact { body: &body, friction: &[0.0] };
    let line = HertzWheel::new(&LINE, &steel()).unwrap();
    let forces = body.nodal_forces(|[x, _, depth]| {
        let s = line.stress(Vec2::new(x, -depth), xc);
        [s.xx, s.zz, s.yy, 0.0, -s.xy, 0.0]
    });
    let faces = contact.step(&contact.virgin(), &forces).unwrap().0;
    // The sinking does not depend on the lateral position near the middle of a wide crack.
    let wheel = EllipticWheel {
        peak_pressure: LINE.peak_pressure,
        half_width: LINE.half_width,
        lateral_half_width: 0.25 * width * LENGTH,
        lateral: 0.0,
        friction: 0.0,
        lateral_friction: 0.0,
    };
    UncoupledWheel::new(&body, &wheel, steel().poisson()).gap(xc, &faces.jumps)
}

fn in_the_plane(degrees: f64, xc: f64) -> f64 {
    let body = body(&[surface_crack(0.0, LENGTH, degrees)], default_elements());
    let problem = FaceProblem::new(&body, &[0.0]).unwrap();
    // Without friction there is no history: the first position counts.
    let passage = Passage { from: xc, to: xc + 1.0, positions: 2 };
    let settings = PassageSettings { passage, ..PassageSettings::default() };
    let line = HertzWheel::new(&LINE, &steel()).unwrap();
    let load = RailLoad { wheel: &line, residual: None };
    let passed = stabilised_passage(&problem, &Newton::default(), load, &settings, &Unobserved).unwrap();
    let jumps: Vec<f64> =
        passed.faces.states[0].iter().flat_map(|state| [state.slip, state.opening]).collect();
    gap_in_plane(&body.faces, &jumps, &LINE, &steel(), xc).unwrap()
}

#[test]
fn wide_cracks_have_that_of_the_plane() {
    // The sides hold a narrow crack: at half the width the gap is smaller by a tenth.
    let (xc, cells) = (-0.2 * LINE.half_width, 4);
    let plane = in_the_plane(60.0, xc);
    let depth = LINE.peak_pressure * LINE.half_width / (0.5 * steel().plane_strain_modulus());
    assert!(plane > 0.05 * depth, "{plane} mm of {depth} mm");
    let [narrow, wide] = [(2.0, 3), (8.0, cells)].map(|(width, cells)| in_space(60.0, xc, width, cells));
    assert!(narrow < 0.95 * plane, "{narrow} mm, {plane} mm in the plane");
    close(wide, plane, Relative(0.02), "a mouth of 16 lengths");
    let xc = 0.3 * LINE.half_width;
    let (shallow, plane) = (in_space(30.0, xc, 8.0, cells), in_the_plane(30.0, xc));
    close(shallow, plane, Relative(0.1), "a mouth of 16 lengths; cells that are coarse for the flap");
}
