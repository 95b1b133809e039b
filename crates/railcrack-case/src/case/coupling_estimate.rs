//! Estimate of how much a wheel that feels the cracks would change their growth.

use super::Case;
use crate::tables::ContactOrigin;
use railcrack::bulk::Boundary;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::coupling::{CoupledContact, WheelCoupling};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::{FaceResolution, cracked_body};
use railcrack::fatigue::SifRanges;
use railcrack::field::wheel_under;
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::load::{Passage, WheelLoad};
use railcrack::plane::{RailLoad, stabilised_passage};

/// Extent of the passage over a, and number of its positions.
const REACH: f64 = 4.0;
const POSITIONS: usize = 81;
/// Surface nodes per half-width: half of the default.
const NODES: f64 = 20.0;
/// Weight of ΔK_II² and exponent of ΔK_eq in the growth rate, those of the default law.
const MODE_2_WEIGHT: f64 = 0.772;
const EXPONENT: f64 = 3.33;

/// Angles (degrees), lengths over a and numbers of segments of cracks for which the estimate is a
/// matter of a moment.
const ANGLES: (f64, f64) = (10.0, 170.0);
const LENGTHS: (f64, f64) = (0.05, 3.0);
const SEGMENTS: usize = 20;

/// Whether the estimate for `crack` under a contact of this half-width (mm) takes a moment only.
fn is_ordinary(crack: &Crack, half_width: f64) -> bool {
    let (first, next) = crack.segment(0);
    let angle = (next - first).angle().to_degrees().abs();
    let length = crack.length() / half_width;
    (ANGLES.0..=ANGLES.1).contains(&angle)
        && (LENGTHS.0..=LENGTHS.1).contains(&length)
        && crack.segment_count() <= SEGMENTS
}

impl Case {
    /// The growth rate of the first surface-breaking crack under a wheel that feels it, over that
    /// under the contact on the uncracked rail: of the crack alone, dry, without residual stress,
    /// in the plane. `None` for a coupled wheel, for a block, for a measured contact, without such
    /// a crack, for one that is very flat, short, long or bent, and for one that does not grow.
    #[must_use]
    pub fn effect_of_coupling(&self) -> Option<f64> {
        let measured = matches!(self.wheel.origin, ContactOrigin::Table(_));
        let in_half_plane = self.rail.boundary == Boundary::HalfPlane || self.engine.is_in_space();
        if self.has_coupled_wheel() || measured || !in_half_plane {
            return None;
        }
        let place = self.cracks.cracks().iter().position(|crack| crack.is_surface_breaking())?;
        let crack = self.cracks.cracks()[place].clone();
        let contact = self.wheel.contact();
        if !is_ordinary(&crack, contact.half_width()) {
            return None;
        }
        let mouth = crack.points()[0].x;
        let network = CrackNetwork::new(vec![crack]).ok()?;
        let body = cracked_body(&network, &self.steel, FaceResolution::default()).ok()?;
        let coupling = WheelCoupling {
            contact: CoupledContact::new(contact, &self.steel),
            nodes_per_half_width: NODES,
            within: WheelCoupling::WITHIN,
        };
        let travel = self.passages.passage.travel().sign();
        let reach = REACH * contact.half_width() * travel;
        let passage = Passage { from: mouth - reach, to: mouth + reach, positions: POSITIONS };
        let load = WheelLoad { contact: contact.clone(), track: None, temperature: None };
        let wheel = wheel_under(&load, &self.steel).ok()?;
        let friction = *self.crack_friction.get(place)?;
        let range = |coupling: Option<&WheelCoupling>| {
            let problem = FaceProblem::new(&body, &[friction]).ok()?;
            let problem = problem.with_wheel(coupling.and_then(|coupling| coupling.on(&body.faces))).ok()?;
            let load = RailLoad { wheel: wheel.as_ref(), residual: None };
            let settings = PassageSettings { passage, ..PassageSettings::default() };
            let solver = Newton::default();
            let passed = stabilised_passage(&problem, &solver, load, &settings, &Unobserved).ok()?;
            let SifRanges { delta_ki, delta_kii, .. } = SifRanges::of(passed.histories.first()?);
            Some((delta_ki * delta_ki + MODE_2_WEIGHT * delta_kii * delta_kii).sqrt())
        };
        let (without, with) = (range(None)?, range(Some(&coupling))?);
        (without > 0.0).then(|| (with / without).powf(EXPONENT))
    }
}
