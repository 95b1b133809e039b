//! Curves across the rail as heights over a grid.

/// A point of a curve, with what belongs to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CurvePoint {
    /// Across and downwards, mm.
    pub at: [f64; 2],
    /// Of a wheel: x of the point ahead of the axle, and the rolling radius, mm.
    pub ahead: f64,
    pub radius: f64,
}

/// Which of several heights over one place counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// The uppermost: a rail.
    Upper,
    /// The lowest: a wheel.
    Lower,
}

/// Height of the curve of `points`, in their order, over `count` places from `from` (mm), `step`
/// (mm) apart; NaN where there is none.
pub(super) fn heights(
    points: &[CurvePoint],
    from: f64,
    step: f64,
    count: usize,
    side: Side,
) -> Vec<CurvePoint> {
    let none = CurvePoint { at: [f64::NAN; 2], ahead: 0.0, radius: 0.0 };
    let mut all = vec![none; count];
    for pair in points.windows(2) {
        let [a, b] = pair else { continue };
        let (a, b) = if a.at[0] <= b.at[0] { (a, b) } else { (b, a) };
        let width = b.at[0] - a.at[0];
        if width <= 0.0 {
            continue;
        }
        let first = ((a.at[0] - from) / step).ceil().max(0.0) as usize;
        for (k, kept) in all.iter_mut().enumerate().skip(first) {
            let place = from + k as f64 * step;
            if place > b.at[0] {
                break;
            }
            let part = (place - a.at[0]) / width;
            let mix = |a: f64, b: f64| a + part * (b - a);
            let height = mix(a.at[1], b.at[1]);
            let counts = kept.at[1].is_nan()
                || match side {
                    Side::Upper => height < kept.at[1],
                    Side::Lower => height > kept.at[1],
                };
            if counts {
                *kept = CurvePoint {
                    at: [place, height],
                    ahead: mix(a.ahead, b.ahead),
                    radius: mix(a.radius, b.radius),
                };
            }
        }
    }
    all
}
