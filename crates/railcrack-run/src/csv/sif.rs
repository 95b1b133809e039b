//! `sif.csv`: K_I and K_II of every tip at every wheel position.

use super::table;
use railcrack::growth::{PassageRecord, StepRecord};
use railcrack::math::MPA_SQRT_MM;

table! {
    /// K of a tip at a wheel position, in the units of `sif.csv`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct SifRow in "sif.csv", [
        "Stress intensity factors of every tip at every wheel position, all passages of each step",
        "step: 0 is the initial geometry; passage, position, crack: from 1; tip: from 1 within its crack",
        "the last passage of a step is the stabilised one",
        "xc_mm: x coordinate of the contact centre, mm; xc_over_a: distance from the mouth of the first crack (its initial first point if buried), divided by the half-width a",
        "ki, kii: MPa sqrt(m); K_II > 0: shear stress > 0 ahead of the tip, the + face moves along the crack's walk",
    ] {
        /// Growth step.
        step: usize = "step";
        /// Passage on the fixed cracks; the last one of a step is the stabilised passage.
        passage: usize = "passage";
        /// Crack and tip.
        crack: usize = "crack";
        /// Crack and tip.
        tip: usize = "tip";
        /// Number of the wheel position, in the order of travel.
        position: usize = "position";
        /// x coordinate of the contact centre, mm.
        xc: f64 = "xc_mm";
        /// (x_c − x_m)/a: x_m the mouth of the first crack in step 0 (its first point if it is
        /// buried), a the half-width of the contact.
        xc_over_a: f64 = "xc_over_a";
        /// K_I, MPa√m.
        ki: f64 = "ki_mpa_sqrt_m";
        /// K_II, MPa√m.
        kii: f64 = "kii_mpa_sqrt_m";
        /// Wheel of a mix, from 1: the last passage of each wheel is its stabilised one.
        wheel: Option<usize> = "wheel", with "wheel";
        /// Pressure of the fluid in the crack of the tip, MPa; that at the mouth where it falls
        /// along the crack.
        fluid_pressure: Option<f64> = "fluid_mpa", with "fluid";
        /// Volume of the crack per unit width, in space over the length of its mouth, mm².
        fluid_volume: Option<f64> = "fluid_mm2", with "fluid";
        /// Parametric angle of a front point in space, degrees: 0 and 180 at the surface, 90
        /// deepest; on the sides of the strip of a folded crack −90 at the mouth to 0 at the fold,
        /// and 180 to 270.
        phi_deg: Option<f64> = "phi_deg", with "space";
        /// K_III of a front point in space, MPa√m.
        kiii: Option<f64> = "kiii_mpa_sqrt_m", with "space";
        /// How much farther a wheel that feels the cracks approaches the rail than without them,
        /// µm; empty where it does not feel them.
        approach: Option<f64> = "approach_um", with "coupled";
        /// Contact load within 0.1 a of the mouth of the crack, N/mm; empty where the wheel does
        /// not feel the cracks, and for buried cracks.
        lip_load: Option<f64> = "lip_load_n_per_mm", with "coupled";
        /// Abscissae of the outermost surface nodes under pressure, mm; empty where the wheel does
        /// not feel the cracks.
        contact_from: Option<f64> = "contact_from_mm", with "coupled";
        /// Abscissae of the outermost surface nodes under pressure, mm; empty where the wheel does
        /// not feel the cracks.
        contact_to: Option<f64> = "contact_to_mm", with "coupled";
    }
}

/// Micrometres per millimetre.
const MICROMETRES: f64 = 1e3;

/// Scale of the wheel positions x_c/a.
#[derive(Debug, Clone)]
pub struct SifScale {
    /// Mouth of the first crack in the initial geometry (its first point if it is buried), mm.
    pub origin: f64,
    /// Half-widths a of the contacts of all wheels, mm.
    pub half_widths: Vec<f64>,
}

impl SifScale {
    /// x_c/a of the position `xc` (mm) of a `wheel`, from 0.
    fn over_a(&self, xc: f64, wheel: usize) -> f64 {
        (xc - self.origin) / self.half_widths.get(wheel).copied().unwrap_or(1.0)
    }
}

impl SifRow {
    /// The rows of a step: wheel by wheel, passage by passage, tip by tip, position by position.
    pub fn of_step<'a>(record: &'a StepRecord, scale: &'a SifScale) -> impl Iterator<Item = Self> + 'a {
        let all = std::iter::once(&record.passages).chain(&record.other_wheels).enumerate();
        all.flat_map(move |(wheel, passages)| Self::under(record, passages, wheel, scale))
    }

    fn under<'a>(
        record: &'a StepRecord,
        passages: &'a [PassageRecord],
        wheel: usize,
        scale: &'a SifScale,
    ) -> impl Iterator<Item = Self> + 'a {
        passages.iter().enumerate().flat_map(move |(p, passage)| {
            record.tips.iter().zip(&passage.sifs).enumerate().flat_map(move |(t, (tip, history))| {
                let fluid = passage.fluid.get(t);
                let kiii = passage.kiii.get(t);
                let coupled = |i: usize| passage.wheel.get(i).and_then(Option::as_ref);
                passage.xc.iter().zip(history).enumerate().map(move |(i, (&xc, sif))| Self {
                    step: record.step,
                    passage: p + 1,
                    crack: tip.tip.crack + 1,
                    tip: tip.tip.tip + 1,
                    position: i + 1,
                    xc,
                    xc_over_a: scale.over_a(xc, wheel),
                    ki: sif.ki_mpa_sqrt_m(),
                    kii: sif.kii_mpa_sqrt_m(),
                    wheel: Some(wheel + 1),
                    fluid_pressure: fluid.and_then(|fluid| Some(fluid.get(i)?.pressure)),
                    fluid_volume: fluid.and_then(|fluid| Some(fluid.get(i)?.volume)),
                    phi_deg: tip.front().map(|front| front.phi.to_degrees()),
                    kiii: kiii.and_then(|kiii| Some(kiii.get(i)? / MPA_SQRT_MM)),
                    approach: coupled(i).map(|state| MICROMETRES * state.approach),
                    lip_load: coupled(i).and_then(|state| *state.lip_loads.get(t)?),
                    contact_from: coupled(i).map(|state| state.from),
                    contact_to: coupled(i).map(|state| state.to),
                })
            })
        })
    }
}
