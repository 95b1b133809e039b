//! Profiles of rail and wheel: points, smoothed.

use thiserror::Error;

/// A profile across the rail: y across, z downwards, as a smooth curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    points: Vec<ProfilePoint>,
}

/// A point of a smoothed profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ProfilePoint {
    /// y, z, mm.
    pub at: [f64; 2],
    /// Derivatives of y and z by the arc length.
    pub tangent: [f64; 2],
}

/// Points that are no profile.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ProfileShapeError {
    /// Too few points.
    #[error("{count} points; a profile needs at least {FEWEST}")]
    TooFew {
        /// Their number.
        count: usize,
    },
    /// Points far apart.
    #[error(
        "row {row} lies {apart:.3} mm from the row before; the points of a profile follow one another at most {FARTHEST} mm apart"
    )]
    Gap {
        /// From 1.
        row: usize,
        /// mm.
        apart: f64,
    },
    /// A rail head with its crown down.
    #[error("the rail head is hollow, {hollow:.3} mm below its ends: z_mm is measured downwards")]
    UpsideDown {
        /// mm.
        hollow: f64,
    },
    /// A wheel with its flange up.
    #[error(
        "the profile rises {rise:.3} mm above its tread and falls {fall:.3} mm below it: z_mm is measured downwards, and the flange lies below"
    )]
    FlangeUp {
        /// mm.
        rise: f64,
        /// mm.
        fall: f64,
    },
    /// A profile of a few millimetres.
    #[error(
        "the profile is {width} mm wide, where rail heads and wheels have 60 mm and more: are its coordinates in metres?"
    )]
    Narrow {
        /// mm.
        width: f64,
    },
    /// A parameter of the smoothing.
    #[error("the half-length of the smoothing is {half_length} mm; must be positive")]
    Smoothing {
        /// mm.
        half_length: f64,
    },
}

/// Fewest points of a profile.
const FEWEST: usize = 10;
/// Farthest distance of points that follow one another, mm.
const FARTHEST: f64 = 5.0;
/// Points of the smoothed curve, mm apart: a chord of the gauge corner, radius 13 mm, is 1e-4 mm
/// from its arc.
const SPACING: f64 = 0.1;
/// Fewest points of a local fit: where there are fewer within the half-length, it is wider.
const FITTED: usize = 5;
/// A narrower profile is part of none, mm.
const NARROWEST: f64 = 10.0;
/// Least depth of a flange below the tread, mm: a chamfer at the field side rises by 5 mm.
const LEAST_FLANGE: f64 = 8.0;
/// By how much more a wheel rises above its tread than it falls below if its flange is up.
const FLANGE_UP: f64 = 2.0;
/// Least slope across the middle of a rail head that shows an inclination: rails are inclined by
/// 1:20 to 1:40.
const INCLINED: f64 = 1.0 / 60.0;
/// Least width of a rail head whose inclination can be seen, and half the width of its middle, mm.
const HEAD_WIDTH: f64 = 50.0;
const HEAD_MIDDLE: f64 = 15.0;
/// Parts of a rail's profile deeper than this below its top are not its head, mm.
pub const RAIL_HEAD_DEPTH: f64 = 20.0;

impl Profile {
    /// The curve through `points` (y, z in mm, in their order along it), smoothed: at every place a
    /// parabola in the arc length is fitted to the points within `half_length` (mm, positive), or
    /// to the five nearest ones, with weights (1 − |u|³)³ that fall to zero there.
    ///
    /// Source of the local fit: Cleveland 1979, Journal of the American Statistical Association
    /// 74, 829–836.
    ///
    /// Errors: fewer than ten points, or points more than 5 mm apart.
    pub fn smoothed(points: &[[f64; 2]], half_length: f64) -> Result<Self, ProfileShapeError> {
        if half_length.is_nan() || half_length <= 0.0 {
            return Err(ProfileShapeError::Smoothing { half_length });
        }
        let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
        let mut arc: Vec<f64> = Vec::with_capacity(points.len());
        for (i, point) in points.iter().enumerate() {
            let Some(last) = kept.last() else {
                kept.push(*point);
                arc.push(0.0);
                continue;
            };
            let apart = (point[0] - last[0]).hypot(point[1] - last[1]);
            if apart > FARTHEST || apart.is_nan() {
                return Err(ProfileShapeError::Gap { row: i + 1, apart });
            }
            if apart > 1e-9 {
                arc.push(arc[arc.len() - 1] + apart);
                kept.push(*point);
            }
        }
        if kept.len() < FEWEST {
            return Err(ProfileShapeError::TooFew { count: kept.len() });
        }
        let across = || kept.iter().map(|point| point[0]);
        let width = across().fold(f64::NEG_INFINITY, f64::max) - across().fold(f64::INFINITY, f64::min);
        if width < NARROWEST {
            return Err(ProfileShapeError::Narrow { width });
        }
        let length = arc[arc.len() - 1];
        let count = (length / SPACING).ceil() as usize;
        let place = |i: usize| length * i as f64 / count as f64;
        let points = (0..=count).map(|i| fitted(&kept, &arc, place(i), half_length)).collect();
        Ok(Self { points })
    }

    pub(super) fn points(&self) -> &[ProfilePoint] {
        &self.points
    }

    /// The smallest z, mm.
    #[must_use]
    pub fn top(&self) -> f64 {
        self.points.iter().map(|point| point.at[1]).fold(f64::INFINITY, f64::min)
    }

    /// Rejects a rail head whose ends lie above its middle.
    pub fn check_rail(&self) -> Result<(), ProfileShapeError> {
        let ends = [self.points[0].at[1], self.points[self.points.len() - 1].at[1]];
        let middle = self.points[self.points.len() / 2].at[1];
        let hollow = middle - ends[0].max(ends[1]);
        if hollow > 0.0 { Err(ProfileShapeError::UpsideDown { hollow }) } else { Ok(()) }
    }

    /// How far the profile of a wheel rises above its tread and falls below it, mm: its median is
    /// the height of the tread.
    fn rise_and_fall(&self) -> [f64; 2] {
        let mut heights: Vec<f64> = self.points.iter().map(|point| point.at[1]).collect();
        heights.sort_by(f64::total_cmp);
        let tread = heights[heights.len() / 2];
        [tread - heights[0], heights[heights.len() - 1] - tread]
    }

    /// Rejects a wheel whose flange lies above its tread.
    pub fn check_wheel(&self) -> Result<(), ProfileShapeError> {
        let [rise, fall] = self.rise_and_fall();
        let is_up = rise > LEAST_FLANGE && rise > FLANGE_UP * fall;
        if is_up { Err(ProfileShapeError::FlangeUp { rise, fall }) } else { Ok(()) }
    }

    /// The lowest point of the flange of a wheel: y and the depth below the tread, mm; none where
    /// the profile has no flange.
    #[must_use]
    pub fn flange(&self) -> Option<[f64; 2]> {
        let [_, fall] = self.rise_and_fall();
        let lowest = self.points.iter().max_by(|a, b| a.at[1].total_cmp(&b.at[1]))?;
        (fall > LEAST_FLANGE).then_some([lowest.at[0], fall])
    }

    /// The side to which an inclined rail falls, that of its gauge face: −1 or 1 as y there; none
    /// where the head is not inclined, or not wide enough to show it.
    #[must_use]
    pub fn gauge_side(&self) -> Option<f64> {
        let top = self.top();
        let head = || self.points.iter().filter(|point| point.at[1] < top + RAIL_HEAD_DEPTH);
        let from = head().map(|point| point.at[0]).fold(f64::INFINITY, f64::min);
        let to = head().map(|point| point.at[0]).fold(f64::NEG_INFINITY, f64::max);
        let nearest = |y: f64| {
            let distance = |point: &&ProfilePoint| (point.at[0] - y).abs();
            head().min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|point| point.at)
        };
        let middle = 0.5 * (from + to);
        let [left, right] = [nearest(middle - HEAD_MIDDLE)?, nearest(middle + HEAD_MIDDLE)?];
        let slope = (right[1] - left[1]) / (right[0] - left[0]);
        (to - from >= HEAD_WIDTH && slope.abs() >= INCLINED).then(|| slope.signum())
    }
}

/// The weighted parabola around the arc length `place`.
fn fitted(points: &[[f64; 2]], arc: &[f64], place: f64, half_length: f64) -> ProfilePoint {
    let (mut first, mut last) = (
        arc.partition_point(|s| *s <= place - half_length),
        arc.partition_point(|s| *s < place + half_length),
    );
    while last - first < FITTED {
        let before = if first > 0 { place - arc[first - 1] } else { f64::INFINITY };
        let after = if last < arc.len() { arc[last] - place } else { f64::INFINITY };
        if before <= after { first -= 1 } else { last += 1 }
    }
    let widest = (place - arc[first]).abs().max((arc[last - 1] - place).abs());
    // Beyond the farthest of the fit, so that none has no weight.
    let reach = half_length.max(1.05 * widest);
    let mut moments = [0.0; 5];
    let mut sums = [[0.0; 2]; 3];
    for (point, s) in points[first..last].iter().zip(&arc[first..last]) {
        let u = (s - place) / reach;
        let weight = (1.0 - u.abs().powi(3)).powi(3);
        let mut power = weight;
        for (order, moment) in moments.iter_mut().enumerate() {
            *moment += power;
            if order < 3 {
                (0..2).for_each(|k| sums[order][k] += power * point[k]);
            }
            power *= u;
        }
    }
    let [m0, m1, m2, m3, m4] = moments;
    let determinant = m0 * (m2 * m4 - m3 * m3) - m1 * (m1 * m4 - m2 * m3) + m2 * (m1 * m3 - m2 * m2);
    let solved = |k: usize| {
        let [a, b, c] = [sums[0][k], sums[1][k], sums[2][k]];
        let value = a * (m2 * m4 - m3 * m3) - b * (m1 * m4 - m2 * m3) + c * (m1 * m3 - m2 * m2);
        let slope = -a * (m1 * m4 - m2 * m3) + b * (m0 * m4 - m2 * m2) - c * (m0 * m3 - m1 * m2);
        [value / determinant, slope / determinant / reach]
    };
    let ([y, dy], [z, dz]) = (solved(0), solved(1));
    ProfilePoint { at: [y, z], tangent: [dy, dz] }
}

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
