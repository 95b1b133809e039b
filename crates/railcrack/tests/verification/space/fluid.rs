//! Fluid in cracks in space: closed forms, superposition, the 2D engine.

use super::body;
use crate::common::Rolling;
use crate::common::{Absolute, Of, close, largest, steel, surface_crack};
use railcrack::contact::{CrackFluid, FaceProblem, FluidModel, Newton, PressureProfile};
use railcrack::crack::CrackNetwork;
use railcrack::field::HertzWheel;
use railcrack::fracture::Sif;
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::load::{HertzianContact, Passage};
use railcrack::math::Vec2;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack::space::{
    EllipticWheel, SpaceBody, SpaceContact, SpaceCrack, SpaceFluidLoad, SpaceHistory, SpaceLoad,
    SpacePassageSettings, SpaceResolution, Surroundings, Symmetric, space_passage,
};
use std::f64::consts::FRAC_PI_2;

/// From −10 to 10 mm; the contact covers the mouth within ±5 mm, between two positions.
const OVER: Passage = Passage { from: -10.2, to: 10.2, positions: 35 };
const EDGE: f64 = 5.0;
/// Pressure over the mouth, MPa.
const OUTSIDE: f64 = 7.0;
const WHOLE_STEPS: SpacePassageSettings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };

/// Tension across the crack with the wheel at `position`: 100 MPa up to the cover, compression
/// under the wheel, more than 100 MPa before the cover ends.
fn tension(position: f64) -> f64 {
    match position {
        x if x <= -EDGE => 100.0,
        x if x <= 0.0 => 100.0 - 30.0 * (x + EDGE),
        x if x <= EDGE => -50.0 + 40.0 * x,
        _ => 150.0,
    }
}

fn wet(model: FluidModel) -> CrackFluid {
    CrackFluid { model, profile: PressureProfile::Linear, cracks: None }
}

/// A passage of that tension over a vertical crack without friction.
fn pressed(body: &SpaceBody, fluid: &CrackFluid, passage: Passage) -> SpaceHistory {
    let wheel = |position: f64, _: [f64; 3]| [tension(position), 0.0, 0.0, 0.0, 0.0, 0.0];
    let over = |position: f64, _: [f64; 2]| if position.abs() < EDGE { OUTSIDE } else { 0.0 };
    let fluid = Some(SpaceFluidLoad { fluid, over: &over });
    let load = SpaceLoad { wheel: &wheel, bending: None, constant: None, fluid };
    let contact = SpaceContact { body, friction: &[0.0] };
    space_passage(&contact, &load, passage, &WHOLE_STEPS, &mut contact.virgin()).unwrap()
}

fn vertical() -> SpaceBody {
    let crack = SpaceCrack::surface_breaking(FRAC_PI_2, 4.0, 3.0).unwrap();
    body(&crack, Surroundings::HalfSpace, 2)
}

/// p of (p + t)/100 = e^(−p/B), by bisection.
fn compressible(tension: f64, bulk: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e4);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (middle + tension) / 100.0 < (-middle / bulk).exp() { low = middle } else { high = middle }
    }
    if tension >= 100.0 { 0.0 } else { low }
}

#[test]
fn trapped_fluid_keeps_its_volume() {
    let body = vertical();
    let unit = body.sifs(&body.nodal_forces(|_| [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let scale = 150.0 * largest(unit.iter().map(|k| k.ki));
    for (bulk_modulus, leak) in [(f64::INFINITY, false), (300.0, false), (f64::INFINITY, true)] {
        let fluid = wet(FluidModel::Trapped { bulk_modulus, leak });
        let forwards = pressed(&body, &fluid, OVER);
        let stations = [-EDGE, EDGE];
        for station in stations {
            let at = |x: &&f64| (**x - station).abs() < 1e-9;
            assert_eq!(forwards.positions.iter().filter(at).count(), 1, "the cover is a position");
        }
        for (k, &position) in forwards.positions.iter().enumerate() {
            let tension = tension(position);
            let is_covered = position.abs() < EDGE;
            let pressure = match (is_covered, leak) {
                (false, _) => 0.0,
                (true, false) => compressible(tension, bulk_modulus),
                // Through open faces fluid leaves until its pressure is that over the mouth; all of
                // it has left when the crack has closed under the wheel.
                (true, true) if position < 0.0 => (100.0 - tension).clamp(0.0, OUTSIDE),
                (true, true) => 0.0,
            };
            // Faces that have just closed hold nothing from the next position on.
            if leak && is_covered && position <= 0.0 && tension < -OUTSIDE {
                continue;
            }
            let want = (tension + pressure).max(0.0);
            let got = forwards.fluid[k][0];
            let reason = format!("{bulk_modulus} {leak}, wheel at {position} mm under {tension} MPa");
            close(got.pressure, pressure, Absolute(1e-4), &reason);
            for (q, k1) in unit.iter().enumerate() {
                close(forwards.sifs[k][q].ki, want * k1.ki, Of(1e-6, scale), &reason);
            }
        }
    }
    // A wheel from the other side traps the 150 MPa under which the crack is open there.
    let back = Passage { from: OVER.to, to: OVER.from, ..OVER };
    let fluid = wet(FluidModel::Trapped { bulk_modulus: f64::INFINITY, leak: false });
    let history = pressed(&body, &fluid, back);
    for (k, &position) in history.positions.iter().enumerate() {
        let want = if position.abs() < EDGE { 150.0 - tension(position) } else { 0.0 };
        close(history.fluid[k][0].pressure, want, Absolute(1e-4), "traffic towards −x");
    }
}

#[test]
fn pressure_from_the_mouth_is_a_load() {
    let (c, l) = (4.0f64, 3.0f64);
    let body = vertical();
    let wheel = EllipticWheel {
        peak_pressure: 200.0,
        half_width: 3.0,
        lateral_half_width: 3.0,
        lateral: 1.0,
        friction: 0.0,
        lateral_friction: 0.0,
    };
    let none = |_: f64, _: [f64; 3]| [0.0; 6];
    let open = |_: [f64; 3]| [1000.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let over = |position: f64, at: [f64; 2]| wheel.pressure(position, at);
    let contact = SpaceContact { body: &body, friction: &[0.2] };
    let rest = body.sifs(&body.nodal_forces(open));
    let scale = largest(rest.iter().map(|k| k.ki));
    for (profile, cap) in [(PressureProfile::Linear, 150.0), (PressureProfile::Constant, f64::INFINITY)] {
        let fluid = CrackFluid { model: FluidModel::Mouth { cap }, profile, cracks: None };
        let fluid = Some(SpaceFluidLoad { fluid: &fluid, over: &over });
        let load = SpaceLoad { wheel: &none, bending: None, constant: Some(&open), fluid };
        let passage = Passage { from: -4.0, to: 4.0, positions: 9 };
        let history = space_passage(&contact, &load, passage, &WHOLE_STEPS, &mut contact.virgin()).unwrap();
        for (k, &position) in history.positions.iter().enumerate() {
            // Of the column: the mouth at the same lateral position, the front below it.
            let forces = body.nodal_forces(|[_, lateral, depth]| {
                let (u, v) = (position / 3.0, (lateral - 1.0) / 3.0);
                let mouth = (200.0 * (1.0 - u * u - v * v).max(0.0).sqrt()).min(cap);
                let front = l * (1.0 - (lateral / c).powi(2)).sqrt();
                let share = if profile == PressureProfile::Linear { 1.0 - depth / front } else { 1.0 };
                [1000.0 + mouth * share, 0.0, 0.0, 0.0, 0.0, 0.0]
            });
            for (got, want) in history.sifs[k].iter().zip(body.sifs(&forces)) {
                close(got.difference(&want), 0.0, Of(1e-9, scale), "superposition");
            }
            let most = (200.0 * (1.0 - (position / 3.0).powi(2)).max(0.0).sqrt()).min(cap);
            let pressure = history.fluid[k][0].pressure;
            // Points of the mouth lie beside the middle of the contact.
            assert!(pressure <= most && pressure >= 0.9 * most - 1e-9, "{pressure} {most}");
        }
    }
}

/// Positions of the plane between two of space, as for dry cracks.
const FINER: usize = 20;
const POSITIONS: usize = 121;

/// A wide crack of 4 mm at 30° under a driven wheel, which opens it before it comes. Trapped fluid
/// has no such limit: at one pressure, it moves from the shallower sides of an elliptical crack to
/// the middle.
#[test]
#[ignore = "extra: minutes"]
fn pressure_from_the_mouth_of_a_wide_crack() {
    let model = FluidModel::Mouth { cap: 100.0 };
    let line = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: -0.2 };
    let (length, degrees, friction, cells) = (4.0, 30.0f64, 0.1, 6);
    let passage = |positions| Passage { from: -4.0 * line.half_width, to: 4.0 * line.half_width, positions };
    let wheel = HertzWheel::new(&line, &steel()).unwrap();
    let stress = |position: f64, [x, _, depth]: [f64; 3]| -> Symmetric {
        let s = railcrack::field::Wheel::stress(&wheel, Vec2::new(x, -depth), position);
        [s.xx, s.zz, s.yy, 0.0, -s.xy, 0.0]
    };
    let over = |position: f64, [x, _]: [f64; 2]| {
        let u = (x - position) / line.half_width;
        line.peak_pressure * (1.0 - u * u).max(0.0).sqrt()
    };
    let crack = SpaceCrack::surface_breaking(degrees.to_radians(), 6.0 * length, length).unwrap();
    let resolution = SpaceResolution::new(cells, cells);
    let body = SpaceBody::new(&[crack], &steel(), Surroundings::HalfSpace, resolution).unwrap();
    let contact = SpaceContact { body: &body, friction: &[friction] };
    let profile = PressureProfile::Linear;
    let fluid = CrackFluid { model, profile, cracks: None };
    let fluid = Some(SpaceFluidLoad { fluid: &fluid, over: &over });
    let load = SpaceLoad { wheel: &stress, bending: None, constant: None, fluid };
    let settings = SpacePassageSettings { tolerance: 0.3, halvings: 8 };
    let space = space_passage(&contact, &load, passage(POSITIONS), &settings, &mut contact.virgin()).unwrap();

    let cracks = vec![surface_crack(0.0, length, degrees)];
    let plane = Rolling::over(cracks.clone(), friction, 0.0).body();
    let network = CrackNetwork::new(cracks).unwrap();
    let fluid = CrackFluid { model, profile, cracks: None }.on(&network, &plane.faces);
    let problem = FaceProblem::new(&plane, &[friction]).unwrap().with_fluid(Some(fluid));
    let passage = passage(FINER * (POSITIONS - 1) + 1);
    let settings = PassageSettings { passage, max_passages: 1, ..PassageSettings::default() };
    let load = RailLoad { wheel: &wheel, residual: None };
    let plane = stabilised_passage(&problem, &Newton::default(), load, &settings, &Unobserved).unwrap();
    let plane: &[Sif] = &plane.passages[0].sifs[0];
    let step = passage.abscissae()[1] - passage.abscissae()[0];
    for (of_space, of_plane) in [(|k: &railcrack::space::FrontSif| k.ki) as fn(&_) -> f64, |k| k.kii]
        .into_iter()
        .zip([(|k: &Sif| k.ki) as fn(&Sif) -> f64, |k| k.kii])
    {
        let peak = largest(plane.iter().map(of_plane));
        for (position, sifs) in space.positions.iter().zip(&space.sifs) {
            let got = of_space(&sifs[sifs.len() / 2]);
            let at = ((position - passage.from) / step).round() as usize;
            let near = plane[at.saturating_sub(2)..(at + 3).min(plane.len())].iter().map(of_plane);
            let (least, most) = near.fold((f64::MAX, f64::MIN), |(l, m), k| (l.min(k), m.max(k)));
            // K_I is within 1 %; K_II as in dry cracks, and 2.2 % where the contact leaves the
            // mouth (1.9 % with 10 cells).
            let reason = format!("6 cells, releases by their position, wheel at {position} mm");
            close(got, got.clamp(least, most), Of(0.025, peak), &reason);
        }
    }
}
