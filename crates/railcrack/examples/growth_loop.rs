//! Growth of the reference crack of Trollé et al. (2014), Table 1, over four increments: it goes
//! straight on, in shear.

use railcrack::prelude::*;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
    let wheel = HertzWheel::new(&contact, &steel)?;
    let cracks = CrackNetwork::from(Crack::surface_breaking(0.0, 6.0, 15f64.to_radians())?);
    let rail = PlaneRail {
        growth: GrowthSettings { steps: 4, ..GrowthSettings::default() },
        ..PlaneRail::new(DislocationEngine::new(steel), wheel, vec![0.5])
    };
    let mut growth = Growth::new(rail, GrowthState::initial(&cracks));
    while let Some(step) = growth.next_step(&Unobserved)? {
        let tip = &step.tips[0];
        let kink = tip.kink.unwrap_or_default().to_degrees();
        println!(
            "step {}: length {:.3} mm, kink {kink:.2}°, {:.0} cycles",
            step.step, tip.length, step.load_cycles
        );
        assert!(kink.abs() < 1.5, "step {}: kink of {kink}°", step.step);
    }
    // Four increments of 4 % of the length.
    let length = growth.state().geometry.cracks()[0].length();
    assert!((length / (6.0 * 1.04f64.powi(4)) - 1.0).abs() < 1e-12, "{length} mm");
    Ok(())
}
