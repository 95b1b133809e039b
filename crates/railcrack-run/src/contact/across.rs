//! Growth by the lateral place of the crack.

use crate::setup::rates_across;
use railcrack_case::Case;

/// Mean growth rate by the lateral place of the crack, over that at its place in the case, by a
/// surrogate.
#[derive(Debug, Clone, PartialEq)]
pub struct GrowthAcross {
    /// Lateral place (mm), rate over that of the case, share of the axles that meet the crack.
    pub places: Vec<[f64; 3]>,
    /// The place of the case, mm.
    pub here: f64,
    /// The crack that compares them, in words.
    pub by: &'static str,
}

/// Places of the crack: strips in the plane, passages in space.
const STRIP_PLACES: usize = 61;
const FRONT_PLACES: usize = 25;

impl GrowthAcross {
    /// For a case with a table of wheels; none without, and where nothing grows here.
    pub fn of(case: &Case) -> Option<Self> {
        let table = case.wheel_table.as_ref()?;
        let ends = || {
            table.wheels.iter().flat_map(|wheel| &wheel.wheel.patches).map(|own| {
                let b = own.patch.ellipse.across;
                [own.y_rail - b, own.y_rail + b]
            })
        };
        let low = ends().map(|[low, _]| low).fold(f64::INFINITY, f64::min).min(table.lateral);
        let high = ends().map(|[_, high]| high).fold(f64::NEG_INFINITY, f64::max).max(table.lateral);
        let count = if table.is_whole { FRONT_PLACES } else { STRIP_PLACES };
        let place = |i: usize| low + (high - low) * i as f64 / (count - 1) as f64;
        let mut all: Vec<f64> = (0..count).map(place).collect();
        all.push(table.lateral);
        let rates = rates_across(case, &all)?;
        let here = rates.last().filter(|(rate, _)| *rate > 0.0)?.0;
        let places = all
            .iter()
            .zip(&rates)
            .take(count)
            .map(|(place, (rate, met))| [*place, rate / here, *met])
            .collect();
        Some(Self { places, here: table.lateral, by: table.compared_by() })
    }

    /// The place where the crack would grow fastest, and how much faster than here.
    pub fn worst(&self) -> (f64, f64) {
        let most = self.places.iter().copied().reduce(|a, b| if b[1] > a[1] { b } else { a });
        most.map_or((self.here, 1.0), |[place, rate, _]| (place, rate))
    }
}
