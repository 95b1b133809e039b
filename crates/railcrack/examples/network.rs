//! Three parallel cracks half a contact half-width apart: where its neighbours slip as well, the
//! crack in the middle slips more than alone.

use railcrack::prelude::*;
use std::error::Error;

/// ΔK_II of each of `cracks` under a braking wheel, MPa√m.
fn ranges(cracks: &CrackNetwork) -> Result<Vec<f64>, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.1 };
    let wheel = HertzWheel::new(&contact, &steel)?;
    let body = DislocationEngine::new(steel).body(cracks)?;
    let faces = FaceProblem::new(&body, &vec![0.5; cracks.cracks().len()])?;
    let load = RailLoad { wheel: &wheel, residual: None };
    let passage =
        stabilised_passage(&faces, &Newton::default(), load, &PassageSettings::default(), &Unobserved)?;
    Ok(passage.histories.iter().map(|history| SifRanges::of(history).delta_kii / 1000f64.sqrt()).collect())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let crack = |mouth| Crack::surface_breaking(mouth, 6.0, 15f64.to_radians());
    let alone = ranges(&crack(0.0)?.into())?[0];
    let three = ranges(&CrackNetwork::new(vec![crack(-3.375)?, crack(0.0)?, crack(3.375)?])?)?;
    println!("ΔK_II alone {alone:.3}, of three {three:.3?} MPa√m");
    assert!((three[1] / alone - 1.270).abs() < 0.005, "{} of that alone", three[1] / alone);
    Ok(())
}
