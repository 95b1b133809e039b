//! Estimate of how much a wheel that feels the cracks would change their growth.

use super::coarse_front::CoarseFront;
use super::wheel_patch::wheel_patch;
use railcrack::bulk::Boundary;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::coupling::{CoupledContact, WheelCoupling, gap_in_plane};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::{FaceResolution, cracked_body};
use railcrack::fatigue::SifRanges;
use railcrack::field::wheel_under;
use railcrack::growth::{PassageSettings, StabilisedPassage, Unobserved};
use railcrack::load::{Passage, WheelLoad};
use railcrack::math::Vec2;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack_case::{Case, ContactOrigin, GivenContact};

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
    let length = crack.length() / half_width;
    is_steep(first, next) && (LENGTHS.0..=LENGTHS.1).contains(&length) && crack.segment_count() <= SEGMENTS
}

/// Whether a crack that begins with the segment from `first` to `next` is steep enough for it.
fn is_steep(first: Vec2, next: Vec2) -> bool {
    (ANGLES.0..=ANGLES.1).contains(&(next - first).angle().to_degrees().abs())
}

/// Distance of the wheel from the mouth, over a, within which the gap under it is computed.
const GAP_REACH: f64 = 1.5;

/// Effect in the plane of a wheel that feels the first crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectInPlane {
    /// The growth rate under it over that under the contact on the uncracked rail.
    pub rate: f64,
    /// The largest gap that this contact leaves open, over a²/2R.
    pub gap: f64,
}

/// The largest gap, over a²/2R, that opens under the first wheel over the first crack of a `case`
/// in space, dry and on few cells, since the contact of that engine does not feel the cracks;
/// `None` in the plane, for a buried crack and for a very flat one.
#[must_use]
pub fn uncoupled_gap(case: &Case) -> Option<f64> {
    let space = case.space()?;
    let shape = space.shapes.first().filter(|shape| shape.buried.is_none())?;
    let section = shape.section().ok()?;
    let patch = wheel_patch(case, 0)?;
    let wheel = patch.outline();
    // A flap that is thinner than a cell takes many times as long.
    let (first, next) = section.segment(0);
    if !is_steep(first, next) {
        return None;
    }
    let front = CoarseFront::new(shape, *case.crack_friction.first()?, &case.steel)?;
    let gap = front.gap_under(wheel, case.first_wheel().passages.passage.travel());
    Some(gap / wheel.ellipse().depth_along(&case.steel))
}

impl EffectInPlane {
    /// The effect of a wheel that feels the first surface-breaking crack, against the contact on
    /// the uncracked rail: of the crack alone, dry, without residual stress, in the plane. `None`
    /// for a coupled wheel, for a block, for a measured contact, without such a crack, for one that
    /// is very flat, short, long or bent, and for one that does not grow.
    #[must_use]
    pub fn of_case(case: &Case) -> Option<Self> {
        let first = case.first_wheel();
        let GivenContact { contact, origin, .. } = first.wheel.given()?;
        let measured = matches!(origin, ContactOrigin::Table(_));
        if case.has_coupled_wheel() || measured || case.boundary() != Boundary::HalfPlane {
            return None;
        }
        let place = case.cracks.cracks().iter().position(|crack| crack.is_surface_breaking())?;
        let crack = case.cracks.cracks()[place].clone();
        if !is_ordinary(&crack, contact.half_width()) {
            return None;
        }
        let mouth = crack.points()[0].x;
        let network = CrackNetwork::new(vec![crack]).ok()?;
        let body = cracked_body(&network, &case.steel, FaceResolution::default()).ok()?;
        let coupling = WheelCoupling {
            contact: CoupledContact::new(contact, &case.steel),
            nodes_per_half_width: NODES,
            within: WheelCoupling::WITHIN,
        };
        let travel = first.passages.passage.travel().sign();
        let reach = REACH * contact.half_width() * travel;
        let passage = Passage { from: mouth - reach, to: mouth + reach, positions: POSITIONS };
        let load = WheelLoad { contact: contact.clone(), track: None, temperature: None };
        let wheel = wheel_under(&load, &case.steel).ok()?;
        let friction = *case.crack_friction.get(place)?;
        let passed = |coupling: Option<&WheelCoupling>| {
            let problem = FaceProblem::new(&body, &[friction]).ok()?;
            let problem = problem.with_wheel(coupling.and_then(|coupling| coupling.on(&body.faces))).ok()?;
            let load = RailLoad { wheel: wheel.as_ref(), residual: None };
            let settings = PassageSettings { passage, ..PassageSettings::default() };
            stabilised_passage(&problem, &Newton::default(), load, &settings, &Unobserved).ok()
        };
        let (without, with) = (passed(None)?, passed(Some(&coupling))?);
        let hertz = coupling.contact.contact;
        let mut gap = 0.0f64;
        let record = without.passages.last()?;
        for (&xc, states) in record.xc.iter().zip(&without.faces.states) {
            if (xc - mouth).abs() < GAP_REACH * hertz.half_width {
                let jumps: Vec<f64> = states.iter().flat_map(|state| [state.slip, state.opening]).collect();
                gap = gap.max(gap_in_plane(&body.faces, &jumps, &hertz, &case.steel, xc).ok()?);
            }
        }
        let depth = hertz.peak_pressure * hertz.half_width / (0.5 * case.steel.plane_strain_modulus());
        let (without, with) = (range(&without)?, range(&with)?);
        let rate = (with / without).powf(EXPONENT);
        (without > 0.0).then_some(Self { rate, gap: gap / depth })
    }
}

/// ΔK_eq (MPa √mm) of the first tip.
fn range(passed: &StabilisedPassage) -> Option<f64> {
    let SifRanges { delta_ki, delta_kii, .. } = SifRanges::of(passed.histories.first()?);
    Some((delta_ki * delta_ki + MODE_2_WEIGHT * delta_kii * delta_kii).sqrt())
}
