//! The fields that a case requests.

use railcrack::growth::FieldSettings;
use railcrack_case::Case;
use std::num::NonZeroUsize;

/// The fields that `case` requests; none if it requests none.
pub(super) fn field_settings(case: &Case) -> Option<FieldSettings> {
    let every = NonZeroUsize::new(case.fields.every)
        .filter(|_| case.plane().is_none_or(|plane| plane.section.is_none()))?;
    let mouth = case.cracks.cracks().first()?.points()[0].x;
    let positions: Vec<f64> =
        case.fields.over_a.iter().map(|over_a| mouth + over_a * case.half_width()).collect();
    (!positions.is_empty()).then_some(FieldSettings { positions, every })
}
