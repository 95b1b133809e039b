//! A coarse crack under many wheels, as a surrogate for the fine one.

use railcrack::body::BodyEngine;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::fatigue::{GrowthLaw, LoadRange, SifRanges};
use railcrack::field::{Wheel, wheel_under};
use railcrack::fracture::SifHistory;
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::load::{Contact, Passage, TableContact, Travel, WheelLoad};
use railcrack::material::IsotropicElastic;
use railcrack::plane::{RailLoad, stabilised_passage};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Elements along the crack.
const ELEMENTS: usize = 8;
/// Positions of a passage, which reaches so many half-widths to both sides of the mouth.
const POSITIONS: usize = 31;
const REACH: f64 = 3.0;
/// Tolerance of the load steps, in terms of K over its peak.
const STEPS: f64 = 0.05;
/// Passages over virgin faces: the second one is close to the repeated history.
const PASSAGES: usize = 2;
/// Every so many rows of a tabulated strip are used: 20 intervals of 160.
const THINNED: usize = 8;

/// A wheel over the coarse crack.
pub(super) struct CoarseWheel {
    /// a, mm: the unit of its positions.
    pub half_width: f64,
    /// Its field.
    pub field: Box<dyn Wheel>,
}

/// The histories of the tips of the first crack of `network` during a passage of each of `wheels`
/// towards `travel`: with contact and friction of its faces, on few
/// elements and in long load steps; at positions in half-widths of the wheel. Rates of the wheels
/// of a curve by it are lower than those of the fine crack by 2 %, with a scatter of 1 % from wheel
/// to wheel. Fluid, temperature and residual stress are absent.
///
/// None where a passage does not converge.
pub(super) fn coarse_histories(
    wheels: &[CoarseWheel],
    (network, friction): (&CrackNetwork, f64),
    steel: &IsotropicElastic,
    travel: Travel,
) -> Option<Vec<Vec<SifHistory>>> {
    let first: Crack = network.cracks().first()?.clone();
    let mouth = first.points()[0].x;
    let mut engine = DislocationEngine { steel: *steel, resolution: FaceResolution { elements: ELEMENTS } };
    let body = engine.body(&first.into()).ok()?;
    let faces = FaceProblem::new(&body, &[friction]).ok()?;
    let of = |CoarseWheel { half_width, field }: &CoarseWheel| {
        let reach = REACH * half_width;
        let reach = if travel == Travel::Forward { reach } else { -reach };
        let settings = PassageSettings {
            passage: Passage { from: mouth - reach, to: mouth + reach, positions: POSITIONS },
            max_passages: PASSAGES,
            step_tolerance: STEPS,
            ..PassageSettings::default()
        };
        let load = RailLoad { wheel: field.as_ref(), residual: None };
        let passage = stabilised_passage(&faces, &Newton::default(), load, &settings, &Unobserved).ok()?;
        Some(passage.histories)
    };
    wheels.par_iter().map(of).collect()
}

/// A line `contact` on few rows.
pub(super) fn coarse_line(contact: &Contact, steel: &IsotropicElastic) -> Option<CoarseWheel> {
    let load = WheelLoad { contact: thinned(contact), track: None, temperature: None };
    Some(CoarseWheel { half_width: contact.half_width(), field: wheel_under(&load, steel).ok()? })
}

/// The rate (mm per cycle) of the fastest tip with these `histories` by `law`.
pub(super) fn coarse_rate(histories: &[SifHistory], law: &GrowthLaw) -> f64 {
    let of_tip = |tip: &SifHistory| {
        let SifRanges { ki_max, delta_ki, delta_kii } = SifRanges::of(tip);
        law.rate(LoadRange::new(delta_ki, delta_kii, ki_max))
    };
    histories.iter().map(of_tip).fold(0.0, f64::max)
}

/// The contact with fewer rows, where it is tabulated.
fn thinned(contact: &Contact) -> Contact {
    let Contact::Table(table) = contact else { return contact.clone() };
    let rows = table.rows();
    let last = rows.len() - 1;
    let kept = rows.iter().enumerate().filter(|(i, _)| i % THINNED == 0 || *i == last);
    TableContact::new(kept.map(|(_, row)| *row).collect(), None)
        .map_or_else(|_| contact.clone(), Contact::Table)
}
