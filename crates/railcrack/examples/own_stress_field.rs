//! A residual stress of one's own: compression along the rail that fades with depth. It closes the
//! crack, and the wheel opens it less.

use railcrack::prelude::*;
use std::error::Error;

/// σ_xx = −s exp(−d / h) at depth d = −y: in equilibrium, since it depends on depth alone.
struct Peened {
    /// s, MPa.
    surface: f64,
    /// h, mm.
    depth: f64,
}

impl StressField for Peened {
    fn stress(&self, point: Vec2) -> Stress {
        Stress { xx: -self.surface * (point.y / self.depth).exp(), ..Stress::ZERO }
    }
}

/// The largest K_I of a steep crack under a braking wheel, MPa√m.
fn largest_ki(residual: Option<&dyn StressField>) -> Result<f64, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };
    let wheel = HertzWheel::new(&contact, &steel)?;
    let crack = Crack::surface_breaking(0.0, 2.0, 60f64.to_radians())?;
    let body = DislocationEngine::new(steel).body(&crack.into())?;
    let faces = FaceProblem::new(&body, &[0.1])?;
    let load = RailLoad { wheel: &wheel, residual };
    let passage =
        stabilised_passage(&faces, &Newton::default(), load, &PassageSettings::default(), &Unobserved)?;
    Ok(SifRanges::of(&passage.histories[0]).ki_max / 1000f64.sqrt())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let (as_rolled, peened) = (largest_ki(None)?, largest_ki(Some(&Peened { surface: 200.0, depth: 2.0 }))?);
    println!("largest K_I {as_rolled:.2} MPa√m, peened {peened:.2} MPa√m");
    assert!((peened / as_rolled - 0.324).abs() < 0.005, "{} of that without", peened / as_rolled);
    Ok(())
}
