//! A direction criterion of one's own: the crack kinks to where k1 is largest at the moment of the
//! largest |K_II| (the maximum tangential stress of one instant), against Hourlier and Pineau's
//! criterion over the passage.

use railcrack::fatigue::KINK_ANGLES;
use railcrack::prelude::*;
use std::error::Error;

/// The angle (radians) of the largest k1 under `sif`, to a tenth of a degree.
fn largest_opening(sif: Sif) -> Option<f64> {
    let degrees = (-1100..=1100).map(|tenths| (0.1 * f64::from(tenths)).to_radians());
    let k1 = |angle: &f64| KinkFunctions::at(*angle).kinked(sif).k1;
    degrees.filter(|angle| KINK_ANGLES.contains(angle)).max_by(|a, b| k1(a).total_cmp(&k1(b)))
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
    let wheel = HertzWheel::new(&contact, &steel)?;
    let crack = Crack::surface_breaking(0.0, 6.0, 15f64.to_radians())?;
    let body = DislocationEngine::new(steel).body(&crack.into())?;
    let faces = FaceProblem::new(&body, &[0.5])?;
    let load = RailLoad { wheel: &wheel, residual: None };
    let passage =
        stabilised_passage(&faces, &Newton::default(), load, &PassageSettings::default(), &Unobserved)?;
    let history = &passage.histories[0];

    let by_rate = HourlierPineau::default().kink(history).ok_or("the crack does not load")?;
    let sheared = history.samples.iter().max_by(|a, b| a.kii.abs().total_cmp(&b.kii.abs()));
    let own = sheared.copied().and_then(largest_opening).ok_or("no samples")?;
    println!(
        "growth rate over the passage {:.1}°, one instant {:.1}°",
        by_rate.angle.to_degrees(),
        own.to_degrees()
    );
    // A closed crack in shear opens most at 76.6° to its side; over the whole passage it shears on.
    assert!((own.to_degrees().abs() - 76.6).abs() < 0.2, "{}°", own.to_degrees());
    assert!(by_rate.angle.abs() < 1f64.to_radians(), "{}°", by_rate.angle.to_degrees());
    Ok(())
}
