//! Passages under a wheel that feels the cracks against passages of the same wheel that does not,
//! over dry cracks, in one run.
//!
//! `cargo bench --bench coupled`, and `-- 20` for another number of rounds. The kinds of passage
//! take turns, so that other work on the machine slows all of them; of each the shortest and the
//! median time count. A coupled passage over one crack may cost four dry ones and 0.5 s, one over
//! nine cracks 5 s.

use railcrack::body::CrackedBody;
use railcrack::contact::{CrackFluid, FluidModel, PressureProfile};
use railcrack::coupling::{CoupledContact, WheelCoupling};
use railcrack::dislocation::cracked_body;
use railcrack::field::wheel_under;
use railcrack::load::{Contact, WheelLoad};
use railcrack::prelude::*;
use std::error::Error;
use std::time::Instant;

/// Rounds without an argument.
const ROUNDS: usize = 9;

/// A wheel on cracks.
#[derive(Clone, Copy)]
enum Kind {
    /// The contact on the uncracked rail.
    Dry,
    /// A coupled wheel.
    Coupled,
    /// A coupled wheel, with fluid in the cracks.
    Wet(FluidModel, PressureProfile),
}

/// Cracks under the wheel of Table 1.
struct Cracks {
    name: &'static str,
    network: CrackNetwork,
    crack_friction: f64,
    contact: Contact,
}

impl Cracks {
    /// The time (s) of a passage of this `kind`, its surface included.
    fn time(&self, body: &CrackedBody, kind: Kind) -> Result<f64, Box<dyn Error>> {
        let steel = IsotropicElastic::new(210e3, 0.3)?;
        let load = WheelLoad { contact: self.contact.clone(), track: None, temperature: None };
        let wheel = wheel_under(&load, &steel)?;
        let coupling = WheelCoupling {
            contact: CoupledContact::new(&self.contact, &steel),
            nodes_per_half_width: WheelCoupling::NODES_PER_HALF_WIDTH,
            within: WheelCoupling::WITHIN,
        };
        let a = self.contact.half_width();
        let passage = Passage {
            from: self.network.leftmost_mouth() - 6.0 * a,
            to: self.network.rightmost_mouth() + 6.0 * a,
            ..Passage::default()
        };
        let settings = PassageSettings { passage, ..PassageSettings::default() };
        let friction = vec![self.crack_friction; self.network.cracks().len()];
        let load = RailLoad { wheel: wheel.as_ref(), residual: None };
        let start = Instant::now();
        let mut faces = FaceProblem::new(body, &friction)?;
        if let Kind::Wet(model, profile) = kind {
            let fluid = CrackFluid { model, profile, cracks: None };
            faces = faces.with_fluid(Some(fluid.on(&self.network, &body.faces)));
        }
        if !matches!(kind, Kind::Dry) {
            faces = faces.with_wheel(coupling.on(&body.faces))?;
        }
        stabilised_passage(&faces, &Newton::default(), load, &settings, &Unobserved)?;
        Ok(start.elapsed().as_secs_f64())
    }
}

fn hertz(friction: f64) -> Contact {
    Contact::Hertz(HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction })
}

fn cracks(count: usize, spacing: f64, degrees: f64) -> Result<CrackNetwork, Box<dyn Error>> {
    let crack = |i: usize| Crack::surface_breaking(spacing * i as f64, 6.0, degrees.to_radians());
    Ok(CrackNetwork::new((0..count).map(crack).collect::<Result<_, _>>()?)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let rounds = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(ROUNDS);
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let carter = CarterContact {
        peak_pressure: 845.0,
        half_width: 6.75,
        friction: 0.3,
        traction: 0.5,
        travel: Travel::Forward,
    };
    let of = |name, network, crack_friction, contact| Cracks { name, network, crack_friction, contact };
    let all = [
        of("15 degrees", cracks(1, 0.0, 15.0)?, 0.5, hertz(0.025)),
        of("60 degrees", cracks(1, 0.0, 60.0)?, 0.1, hertz(-0.2)),
        of("15 degrees, partial slip", cracks(1, 0.0, 15.0)?, 0.5, Contact::Carter(carter)),
        of("nine at 15 degrees", cracks(9, 3.375, 15.0)?, 0.5, hertz(0.1)),
        of("nine at 30 degrees", cracks(9, 3.375, 30.0)?, 0.3, hertz(0.1)),
    ];
    let trapped = FluidModel::Trapped { bulk_modulus: f64::INFINITY, leak: true };
    let mouth = FluidModel::Mouth { cap: f64::INFINITY };
    let kinds = [
        ("dry", Kind::Dry),
        ("coupled", Kind::Coupled),
        ("coupled, mouth, linear", Kind::Wet(mouth, PressureProfile::Linear)),
        ("coupled, mouth, constant", Kind::Wet(mouth, PressureProfile::Constant)),
        ("coupled, trapped", Kind::Wet(trapped, PressureProfile::Constant)),
    ];
    println!("{:<26} {:<26} {:>10} {:>10} {:>14}", "cracks", "wheel", "least ms", "median ms", "over dry");
    for own in all {
        let count = own.network.cracks().len();
        let body = cracked_body(&own.network, &steel, FaceResolution::for_cracks(count))?;
        let kinds = if count > 1 { &kinds[..2] } else { &kinds[..] };
        let mut times = vec![Vec::new(); kinds.len()];
        for _ in 0..rounds {
            for (times, (_, kind)) in times.iter_mut().zip(kinds) {
                times.push(own.time(&body, *kind)?);
            }
        }
        let mut dry = None;
        for (times, (name, _)) in times.iter_mut().zip(kinds) {
            times.sort_by(f64::total_cmp);
            let (least, median) = (times[0], times[rounds / 2]);
            let (least_dry, median_dry) = *dry.get_or_insert((least, median));
            println!(
                "{:<26} {name:<26} {:>10.1} {:>10.1} {:>6.2} {:>7.2}",
                own.name,
                1e3 * least,
                1e3 * median,
                least / least_dry,
                median / median_dry
            );
        }
    }
    Ok(())
}
