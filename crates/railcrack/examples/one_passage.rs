//! One passage of a braking wheel over a crack whose faces are slippery: K_I and K_II of Fig. 13 of
//! Trollé et al. (2014).

use railcrack::prelude::*;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };
    let wheel = HertzWheel::new(&contact, &steel)?;
    let crack = Crack::surface_breaking(0.0, 6.0, 15f64.to_radians())?;
    let body = DislocationEngine::new(steel).body(&crack.into())?;
    let faces = FaceProblem::new(&body, &[0.1])?;
    let load = RailLoad { wheel: &wheel, residual: None };
    let passage =
        stabilised_passage(&faces, &Newton::default(), load, &PassageSettings::default(), &Unobserved)?;
    let last = passage.passages.last().ok_or("no passage")?;

    let k_i = last.sifs[0].iter().map(|k| k.ki_mpa_sqrt_m()).fold(0.0, f64::max);
    let k_ii = last.sifs[0].iter().map(|k| k.kii_mpa_sqrt_m()).fold(0.0, f64::max);
    println!("largest K_I {k_i:.3}, largest K_II {k_ii:.3} MPa√m");
    // Of an independent code (verification/half-plane-histories/fig13.csv): 0.1 % of the peak of
    // K_II.
    assert!((k_i - 8.928).abs() < 0.035, "largest K_I {k_i}");
    assert!((k_ii - 35.463).abs() < 0.035, "largest K_II {k_ii}");
    Ok(())
}
