//! Probability that a crack fails before an inspection finds it.
//!
//! The rail is inspected every T million gross tonnes, from an unknown moment on. With the traffic
//! s = (w + i) T left at the inspections before the failure at N, i = 0, 1, …, and w uniform in
//! [0, 1),
//!
//! P(T) = E_lives E_w Π_i (1 − POD(depth(N − s_i))), over the inspections after the beginning.
//!
//! The w of a life are the same for all T (common random numbers), so that P grows with T wherever
//! the depth grows with the traffic: each inspection then moves to an earlier, shallower crack.

use railcrack_case::Detection;
use railcrack_case::normal::distribution;
use rayon::prelude::*;

/// Probability of detection by depth, ready for many evaluations.
#[derive(Debug, Clone, PartialEq)]
pub enum DetectionCurve {
    /// Cracks from this depth (mm) on are found, others are not.
    Step(f64),
    /// Φ(ln(depth / median) / σ).
    LogNormal {
        /// The depth (mm) at which half of the cracks are found.
        median: f64,
        /// σ.
        log_std: f64,
    },
    /// Depth (mm) and probability, the depths ascending: linear in between, zero below the first,
    /// constant beyond the last.
    Table(Vec<(f64, f64)>),
}

/// The curve that a case gives.
impl From<&Detection> for DetectionCurve {
    fn from(given: &Detection) -> Self {
        match given {
            Detection::LogNormal { median, log_std } => {
                Self::LogNormal { median: *median, log_std: *log_std }
            }
            Detection::Table(file) => Self::Table(file.content().rows().to_vec()),
        }
    }
}

impl DetectionCurve {
    /// The probability that a crack of `depth` (mm) is found.
    #[must_use]
    pub fn at(&self, depth: f64) -> f64 {
        match self {
            Self::Step(from) => f64::from(u8::from(depth >= *from)),
            Self::LogNormal { median, log_std } if depth > 0.0 => {
                distribution((depth / median).ln() / log_std)
            }
            Self::LogNormal { .. } => 0.0,
            Self::Table(rows) => interpolated(rows, depth).unwrap_or(0.0),
        }
    }
}

/// The value of `rows` at `x`: linear between them, constant beyond the last; none before the
/// first.
pub(super) fn interpolated(rows: &[(f64, f64)], x: f64) -> Option<f64> {
    before(rows, rows.partition_point(|row| row.0 <= x), x)
}

/// A number as it is stored: in single precision, a million curves take half of the memory.
pub trait Stored: Copy + Into<f64> + Sync {}

impl<T: Copy + Into<f64> + Sync> Stored for T {}

/// The same where row `next` is the first beyond `x`.
fn before<T: Stored>(rows: &[(T, T)], next: usize, x: f64) -> Option<f64> {
    let row = |i: usize| rows.get(i).map(|&(x, y)| (x.into(), y.into()));
    let from: (f64, f64) = row(next.checked_sub(1)?)?;
    let between = |to: (f64, f64)| from.1 + (x - from.0) / (to.0 - from.0) * (to.1 - from.1);
    Some(row(next).map_or(from.1, between))
}

/// Depth of a crack over traffic: linear between points, constant outside of them.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthCurve<T = f64> {
    points: Box<[(T, T)]>,
}

impl DepthCurve {
    /// The curve through `points` of traffic (MGT, not descending) and depth (mm): two at the same
    /// traffic are a grinding. Later points at less traffic than earlier ones are left out.
    #[must_use]
    pub fn through(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut kept: Vec<(f64, f64)> = Vec::new();
        for point in points {
            if kept.last().is_none_or(|last| point.0 >= last.0) {
                kept.push(point);
            }
        }
        Self { points: kept.into() }
    }

    /// A curve through fewer of its points that deviates from it by `tolerance` (mm) at most;
    /// grindings stay as they are, and so do points of exactly the depth `kept_depth` (mm).
    #[must_use]
    pub fn thinned(&self, tolerance: f64, kept_depth: Option<f64>) -> Self {
        let mut kept: Vec<(f64, f64)> = Vec::new();
        // Slopes from the last point that is kept which pass all the points since.
        let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut last: Option<(f64, f64)> = None;
        for &point in &*self.points {
            if let (Some(from), Some(before)) = (kept.last().copied(), last) {
                let slope = |depth: f64| (depth - from.1) / (point.0 - from.0);
                let (low, high) = (slope(point.1 - tolerance), slope(point.1 + tolerance));
                let through = slope(point.1);
                let is_ground = point.0 == before.0;
                let is_kept = Some(before.1) == kept_depth;
                if is_ground || is_kept || point.0 <= from.0 || through < least || through > most {
                    if before != from {
                        kept.push(before);
                    }
                    (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
                    if is_ground {
                        kept.push(point);
                    } else {
                        let slope = |depth: f64| (depth - before.1) / (point.0 - before.0);
                        (least, most) = (slope(point.1 - tolerance), slope(point.1 + tolerance));
                    }
                } else {
                    (least, most) = (least.max(low), most.min(high));
                }
            } else {
                kept.push(point);
            }
            last = Some(point);
        }
        if let Some(point) = last.filter(|point| kept.last() != Some(point)) {
            kept.push(point);
        }
        Self { points: kept.into() }
    }

    /// The same in single precision.
    #[must_use]
    pub fn in_single_precision(&self) -> DepthCurve<f32> {
        DepthCurve { points: self.points.iter().map(|(mgt, depth)| (*mgt as f32, *depth as f32)).collect() }
    }
}

impl<T: Stored> DepthCurve<T> {
    /// The depths, to be read backwards.
    fn backwards(&self) -> Backwards<'_, T> {
        Backwards { points: &self.points, next: self.points.len() }
    }

    /// The traffic up to `end` during which the depth is at least `depth`.
    fn deeper_than(&self, depth: f64, end: f64) -> Vec<(f64, f64)> {
        let outer = |point: Option<&(T, T)>, mgt: f64| point.map(|point| (mgt, point.1.into()));
        let first = outer(self.points.first(), 0.0);
        let last = outer(self.points.last(), f64::INFINITY);
        let points = self.points.iter().map(|&(mgt, depth)| (mgt.into(), depth.into()));
        let all: Vec<(f64, f64)> = first.into_iter().chain(points).chain(last).collect();
        let piece = |pair: &[(f64, f64)]| {
            let ((t0, d0), (t1, d1)) = (pair[0], pair[1]);
            let crossing = || t0 + (depth - d0) / (d1 - d0) * (t1 - t0);
            let (from, to) = match (d0 >= depth, d1 >= depth) {
                (true, true) => (t0, t1),
                (true, false) => (t0, crossing()),
                (false, true) => (crossing(), t1),
                (false, false) => return None,
            };
            let (from, to) = (from.max(0.0), to.min(end));
            (to > from).then_some((from, to))
        };
        all.windows(2).filter_map(piece).collect()
    }
}

/// A depth curve that is read at less and less traffic, without a search.
struct Backwards<'a, T> {
    points: &'a [(T, T)],
    /// The first point beyond the traffic read last.
    next: usize,
}

impl<T: Stored> Backwards<'_, T> {
    /// The depth (mm) at `mgt`, which is not more than that read before.
    fn at(&mut self, mgt: f64) -> f64 {
        while self.next > 0 && self.points[self.next - 1].0.into() > mgt {
            self.next -= 1;
        }
        let first = || self.points.first().map_or(0.0, |first| first.1.into());
        before(self.points, self.next, mgt).unwrap_or_else(first)
    }
}

/// A crack that nobody inspects: a run, or a sample.
#[derive(Debug, Clone, Copy)]
pub struct Life<'a, T = f64> {
    /// Million gross tonnes until failure; infinite where it does not fail.
    pub failure: f64,
    /// Its depth over traffic.
    pub depths: &'a DepthCurve<T>,
    /// The depth (mm) from which this crack is found; without it, that of the step.
    pub found_from: Option<f64>,
}

/// The largest interval that keeps a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum IntervalForTarget {
    /// Any interval: even without inspections no more fail.
    Any,
    /// Million gross tonnes.
    Mgt(f64),
    /// None: the most frequent inspections computed do not keep it.
    None,
}

/// The risk of lives under inspections.
#[derive(Debug, Clone)]
pub struct Risk<'a, T = f64> {
    lives: &'a [Life<'a, T>],
    detection: DetectionCurve,
    /// 1 − POD of the lognormal curve.
    missed: MissedByDepth,
    /// Positions w of the inspections of each life.
    phases: usize,
}

/// Positions of the inspections in all, shared by the lives, and limits for each of them.
const PHASES: usize = 1 << 16;
const PHASES_OF_A_LIFE: (usize, usize) = (4, 4096);
/// Places of the traffic of a life at which 1 − POD is kept where a life has more positions than
/// one in so many of them.
const TABULATED: usize = 2048;
const MANY: usize = 16;
/// Lives that a thread takes at a time: their sums do not depend on the number of threads.
const AT_A_TIME: usize = 1024;
/// Golden ratio: the positions of successive lives fill the gaps of each other.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// A crack that is missed with a smaller probability is found.
const FOUND: f64 = 1e-12;
/// The most frequent inspections, over the longest life.
const MOST_FREQUENT: f64 = 1e-3;
/// Relative accuracy of the interval for a target, and ratio of intervals in the search for it.
const ACCURACY: f64 = 1e-3;
const SEARCH: f64 = 1.1;
/// Lives by which the search begins.
const THINNED: usize = 1000;

impl<'a, T: Stored> Risk<'a, T> {
    /// The risk of `lives`, each with the same weight.
    #[must_use]
    pub fn of(lives: &'a [Life<'a, T>], detection: DetectionCurve) -> Self {
        let missed = match detection {
            DetectionCurve::LogNormal { median, log_std } => MissedByDepth::of(median, log_std),
            _ => MissedByDepth::default(),
        };
        let phases = (PHASES / lives.len().max(1)).clamp(PHASES_OF_A_LIFE.0, PHASES_OF_A_LIFE.1);
        Self { lives, detection, missed, phases }
    }

    /// The probability of failure before detection with inspections every `interval` million gross
    /// tonnes; for zero or less, as for a millionth of each life.
    #[must_use]
    pub fn probability(&self, interval: f64) -> f64 {
        self.over(interval, 1)
    }

    /// The probability over every `stride`-th life.
    fn over(&self, interval: f64, stride: usize) -> f64 {
        let count = self.lives.len().div_ceil(stride);
        let failing = |i: usize| {
            let life = &self.lives[i];
            if life.failure.is_finite() { self.of_life(i, life, interval) } else { 0.0 }
        };
        let sum = |piece: usize| {
            let taken = AT_A_TIME * piece..(AT_A_TIME * (piece + 1)).min(count);
            taken.map(|i| failing(i * stride)).sum::<f64>()
        };
        let sums = (0..count.div_ceil(AT_A_TIME)).into_par_iter().map(sum);
        sums.collect::<Vec<f64>>().into_iter().sum::<f64>() / count.max(1) as f64
    }

    fn of_life(&self, index: usize, life: &Life<'_, T>, interval: f64) -> f64 {
        let interval = interval.max(1e-6 * life.failure);
        if !(interval > 0.0 && life.failure > 0.0) {
            return 1.0;
        }
        if let DetectionCurve::Step(depth) = self.detection {
            let found = life.depths.deeper_than(life.found_from.unwrap_or(depth), life.failure);
            let left = found.iter().map(|(from, to)| (life.failure - to, life.failure - from));
            return uncovered(left, interval);
        }
        let shift = (GOLDEN * index as f64 + 0.5).fract();
        let count = self.phases as f64;
        let by_traffic = (self.phases > TABULATED / MANY).then(|| self.missed_by_traffic(life));
        let missed = (0..self.phases).map(|k| {
            let w = (k as f64 + shift) / count;
            let mut depths = life.depths.backwards();
            let mut at = |left: f64| match &by_traffic {
                Some(table) => between(table, left / life.failure * TABULATED as f64),
                None => self.missed(depths.at(life.failure - left)),
            };
            let mut missed = 1.0;
            let mut left = w * interval;
            while left <= life.failure && missed > FOUND {
                missed *= at(left);
                left += interval;
            }
            if missed > FOUND { missed } else { 0.0 }
        });
        missed.sum::<f64>() / count
    }

    /// 1 − POD with even shares of the traffic left until the failure of `life`.
    fn missed_by_traffic(&self, life: &Life<'_, T>) -> Vec<f64> {
        let mut depths = life.depths.backwards();
        let passed = |i: usize| life.failure * (1.0 - i as f64 / TABULATED as f64);
        (0..=TABULATED).map(|i| self.missed(depths.at(passed(i)))).collect()
    }

    /// 1 − POD of a crack of `depth` (mm).
    fn missed(&self, depth: f64) -> f64 {
        match self.detection {
            DetectionCurve::LogNormal { .. } => self.missed.at(depth),
            _ => 1.0 - self.detection.at(depth),
        }
    }

    /// The largest interval up to which the probability stays at or below `target`, to 0.1 %. It is
    /// bracketed by a thousand of the lives and found with all of them.
    #[must_use]
    pub fn interval_for(&self, target: f64) -> IntervalForTarget {
        let failures = || self.lives.iter().map(|life| life.failure).filter(|mgt| mgt.is_finite());
        let share = failures().count() as f64 / self.lives.len().max(1) as f64;
        if share <= target {
            return IntervalForTarget::Any;
        }
        let longest = failures().fold(0.0, f64::max);
        let least = MOST_FREQUENT * longest;
        // P(T) is at least share (1 − longest / T).
        let most = SEARCH * longest / (1.0 - target / share);
        let keeps = |interval: f64| self.probability(interval) <= target;
        let stride = self.lives.len().div_ceil(THINNED).max(1);
        let (mut low, mut beyond) = (least, most);
        while beyond > SEARCH * low {
            let middle = (low * beyond).sqrt();
            if self.over(middle, stride) <= target { low = middle } else { beyond = middle }
        }
        while low > least && !keeps(low) {
            low = (low / SEARCH).max(least);
        }
        if !(longest > 0.0 && keeps(low)) {
            return IntervalForTarget::None;
        }
        let mut high = SEARCH * low;
        while high < most && keeps(high) {
            (low, high) = (high, SEARCH * high);
        }
        while high > (1.0 + ACCURACY) * low {
            let middle = (low * high).sqrt();
            if keeps(middle) { low = middle } else { high = middle }
        }
        IntervalForTarget::Mgt(low)
    }
}

/// 1 − POD of the lognormal curve, linear in depth between depths with the same leading bits: their
/// ratio is constant, and no logarithm is needed.
#[derive(Debug, Clone, Default)]
struct MissedByDepth {
    /// Bits of a depth behind the leading ones.
    rest: u32,
    /// Leading bits of the first depth.
    first: u64,
    values: Vec<f64>,
}

/// Depths in σ, as a power of two: an error of 2e-7.
const PARTS_OF_DEVIATION: f64 = 9.0;
/// The depths ln(depth / median) = ± `REACH` σ, beyond which 1 − POD is 1 and 0.
const REACH: f64 = 8.0;

impl MissedByDepth {
    fn of(median: f64, log_std: f64) -> Self {
        let bits = (PARTS_OF_DEVIATION - log_std.log2()).ceil().clamp(1.0, 40.0) as u32;
        let rest = f64::MANTISSA_DIGITS - 1 - bits;
        let depth = |z: f64| (median * (z * log_std).exp()).clamp(f64::MIN_POSITIVE, f64::MAX);
        let [first, last] = [-REACH, REACH].map(|z| depth(z).to_bits() >> rest);
        let at = |leading: u64| distribution((median / f64::from_bits(leading << rest)).ln() / log_std);
        Self { rest, first, values: (first..=last).map(at).collect() }
    }

    fn at(&self, depth: f64) -> f64 {
        let bits = depth.max(0.0).to_bits();
        let Some(i) = (bits >> self.rest).checked_sub(self.first) else { return 1.0 };
        let Some([here, next]) = self.values.get(i as usize..i as usize + 2) else { return 0.0 };
        let one = 1u64 << self.rest;
        here + (bits & (one - 1)) as f64 / one as f64 * (next - here)
    }
}

/// Linear between the values of a `table` at 0, 1, ….
fn between(table: &[f64], place: f64) -> f64 {
    let i = (place as usize).min(table.len() - 2);
    table[i] + (place - i as f64) * (table[i + 1] - table[i])
}

/// The share of w in [0, 1) of which no (w + i) `interval` lies in one of `found`.
fn uncovered(found: impl Iterator<Item = (f64, f64)>, interval: f64) -> f64 {
    let mut folded: Vec<(f64, f64)> = Vec::new();
    for (from, to) in found {
        let (from, length) = ((from / interval).rem_euclid(1.0), (to - from) / interval);
        if length >= 1.0 {
            return 0.0;
        }
        folded.push((from, (from + length).min(1.0)));
        if from + length > 1.0 {
            folded.push((0.0, from + length - 1.0));
        }
    }
    folded.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut covered, mut up_to) = (0.0, 0.0);
    for (from, to) in folded {
        covered += (to - f64::max(from, up_to)).max(0.0);
        up_to = f64::max(up_to, to);
    }
    (1.0 - covered).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A crack that grows by 0.1 mm per MGT until it fails after `failure`.
    fn steady() -> DepthCurve {
        DepthCurve::through([(0.0, 0.0), (1000.0, 100.0)])
    }

    fn life(depths: &DepthCurve, failure: f64) -> Life<'_> {
        Life { failure, depths, found_from: None }
    }

    fn close(got: f64, want: f64, tolerance: f64) {
        assert!((got - want).abs() <= tolerance, "{got} {want}");
    }

    #[test]
    fn detection_by_depth() {
        let lognormal = DetectionCurve::LogNormal { median: 2.0, log_std: 0.5 };
        close(lognormal.at(2.0), 0.5, 1e-15);
        close(lognormal.at(2.0 * 0.5f64.exp()), 0.841344746068543, 1e-14);
        assert_eq!((lognormal.at(0.0), lognormal.at(-1.0)), (0.0, 0.0));
        let table = DetectionCurve::Table(vec![(1.0, 0.1), (3.0, 0.9)]);
        assert_eq!([0.9, 1.0, 2.0, 3.0, 9.0].map(|depth| table.at(depth)), [0.0, 0.1, 0.5, 0.9, 0.9]);
        assert_eq!([1.9, 2.0].map(|depth| DetectionCurve::Step(2.0).at(depth)), [0.0, 1.0]);
    }

    #[test]
    fn a_step_finds_every_crack_that_is_inspected_after_it_is_detectable() {
        let depths = steady();
        // Detectable after 20 MGT, failed after 50.
        let lives = [life(&depths, 50.0)];
        let risk = Risk::of(&lives, DetectionCurve::Step(2.0));
        for interval in [1.0, 10.0, 29.9, 30.0, 31.0, 45.0, 60.0, 1e3] {
            close(risk.probability(interval), (1.0 - 30.0 / interval).max(0.0), 1e-12);
        }
        // As fast again: 10 and 25 MGT.
        let faster = DepthCurve::through([(0.0, 0.0), (500.0, 100.0)]);
        let lives = [life(&faster, 25.0)];
        close(Risk::of(&lives, DetectionCurve::Step(2.0)).probability(30.0), 0.5, 1e-12);
        // Detectable from the beginning.
        let lives = [life(&depths, 50.0)];
        close(Risk::of(&lives, DetectionCurve::Step(0.0)).probability(80.0), 1.0 - 50.0 / 80.0, 1e-12);
        assert_eq!(Risk::of(&lives, DetectionCurve::Step(6.0)).probability(1.0), 1.0, "never detectable");
    }

    #[test]
    fn a_step_under_grinding_finds_between_grindings_only() {
        // Deeper than 2 mm from 10 to 15 and from 30 to 35 MGT, by grindings after 15 and 35.
        let points =
            [(0.0, 1.0), (10.0, 2.0), (15.0, 2.5), (15.0, 1.5), (30.0, 2.0), (35.0, 2.5), (35.0, 1.0)];
        let depths = DepthCurve::through(points);
        let lives = [life(&depths, 40.0)];
        let risk = Risk::of(&lives, DetectionCurve::Step(2.0));
        // The windows are 20 MGT apart: every 20 MGT meets both or neither, every 25 one of them.
        for (interval, want) in [(20.0, 0.75), (25.0, 0.6), (10.0, 0.5), (5.0, 0.0), (100.0, 0.9)] {
            close(risk.probability(interval), want, 1e-12);
        }
    }

    #[test]
    fn a_constant_probability_misses_with_its_power() {
        let depths = steady();
        let lives = [life(&depths, 60.0)];
        let q = 0.3;
        let risk = Risk::of(&lives, DetectionCurve::Table(vec![(0.0, q)]));
        for n in [1, 2, 5, 60] {
            close(risk.probability(60.0 / f64::from(n)), (1.0 - q).powi(n), 1e-12);
        }
        // n inspections or one more.
        let mean = |x: f64| (1.0 - q).powf(x.floor()) * (1.0 - q * x.fract());
        for interval in [7.0, 25.0, 70.0, 400.0] {
            close(risk.probability(interval), mean(60.0 / interval), q / 4096.0);
        }
    }

    #[test]
    fn a_lognormal_curve_against_direct_integration() {
        let depths = steady();
        let lives = [life(&depths, 60.0)];
        let curve = DetectionCurve::LogNormal { median: 3.0, log_std: 0.4 };
        let risk = Risk::of(&lives, curve.clone());
        for interval in [6.0, 20.0, 45.0, 90.0] {
            // By the moment u of the first inspection, in small steps.
            let steps = 200_000;
            let missed = |k: i32| {
                let mut at = (f64::from(k) + 0.5) / f64::from(steps) * interval;
                let mut missed = 1.0;
                while at < 60.0 {
                    missed *= 1.0 - curve.at(0.1 * at);
                    at += interval;
                }
                missed
            };
            let want = (0..steps).map(missed).sum::<f64>() / f64::from(steps);
            close(risk.probability(interval), want, 2e-6);
        }
    }

    /// Cracks with a spread of their pace, by a sequence of the golden ratio, and when they fail.
    fn scattered(count: usize) -> Vec<(f64, DepthCurve)> {
        let spread = |i: usize| {
            let p = (GOLDEN * (i as f64 + 0.5)).fract();
            let pace = (p / (1.0 - p)).powf(0.3);
            (50.0 / pace, DepthCurve::through([(0.0, 0.0), (1000.0 / pace, 100.0)]))
        };
        (0..count).map(spread).collect()
    }

    fn lives(cracks: &[(f64, DepthCurve)]) -> Vec<Life<'_>> {
        cracks.iter().map(|(failure, depths)| life(depths, *failure)).collect()
    }

    #[test]
    fn a_curve_with_fewer_points_is_the_curve_within_the_tolerance() {
        let at = |i: usize| (0.1 * i as f64, (0.1 * i as f64).powi(2));
        let whole = DepthCurve::through((0..=100).map(at).chain([(10.0, 99.0), (12.0, 130.0)]));
        let thin = whole.thinned(0.1, None);
        assert!(thin.points.len() < 30, "{}", thin.points.len());
        for i in 0..=1200 {
            let mgt = 0.01 * i as f64;
            close(thin.backwards().at(mgt), whole.backwards().at(mgt), 0.1 + 1e-9);
        }
        // A depth that is asked for stays exact.
        let exact = whole.thinned(0.1, Some(at(37).1));
        close(exact.backwards().at(3.7), at(37).1, 1e-12);
        // The grinding stays where it is.
        assert_eq!((thin.backwards().at(10.0 - 1e-12) - thin.backwards().at(10.0)).round(), 1.0);
    }

    #[test]
    fn a_life_with_its_own_detectable_depth() {
        let depths = steady();
        let lives = [Life { found_from: Some(4.0), ..life(&depths, 50.0) }];
        close(Risk::of(&lives, DetectionCurve::Step(2.0)).probability(20.0), 0.5, 1e-12);
    }

    #[test]
    fn the_risk_grows_with_the_interval_to_the_share_that_fails() {
        let cracks = scattered(2000);
        let mut lives = lives(&cracks);
        lives.iter_mut().step_by(4).for_each(|life| life.failure = f64::INFINITY);
        let curves = [
            DetectionCurve::Step(2.0),
            DetectionCurve::LogNormal { median: 2.0, log_std: 0.6 },
            DetectionCurve::Table(vec![(0.5, 0.0), (3.0, 0.8)]),
        ];
        for curve in curves {
            let risk = Risk::of(&lives, curve.clone());
            let all: Vec<f64> = (0..60).map(|i| risk.probability(1.2f64.powi(i - 10))).collect();
            assert!(all.windows(2).all(|pair| pair[1] >= pair[0]), "{curve:?}: {all:?}");
            assert!(all[0] < 1e-3 && (all[59] - 0.75).abs() < 0.02, "{curve:?}: {all:?}");
        }
    }

    #[test]
    fn fewer_positions_for_each_of_many_lives_give_the_same_risk() {
        let curve = DetectionCurve::LogNormal { median: 2.0, log_std: 0.6 };
        let cracks = scattered(1000);
        let few = lives(&cracks);
        let many: Vec<Life> = (0..100).flat_map(|_| few.iter().copied()).collect();
        for interval in [5.0, 15.0, 40.0] {
            let few = Risk::of(&few, curve.clone()).probability(interval);
            let many = Risk::of(&many, curve.clone()).probability(interval);
            assert!((few / many - 1.0).abs() < 0.02, "{interval}: {few} {many}");
        }
    }

    #[test]
    fn the_interval_for_a_target() {
        let depths = steady();
        let one = [life(&depths, 50.0)];
        let risk = Risk::of(&one, DetectionCurve::Step(2.0));
        for target in [0.0, 0.001, 0.1, 0.5, 0.999] {
            let IntervalForTarget::Mgt(interval) = risk.interval_for(target) else { panic!("{target}") };
            assert!((interval / (30.0 / (1.0 - target)) - 1.0).abs() < 1.1e-3, "{target}: {interval}");
            assert!(risk.probability(interval) <= target);
        }
        assert_eq!(risk.interval_for(1.0), IntervalForTarget::Any);
        assert_eq!(Risk::of(&one, DetectionCurve::Step(6.0)).interval_for(0.1), IntervalForTarget::None);
        assert_eq!(Risk::<f64>::of(&[], DetectionCurve::Step(6.0)).interval_for(0.1), IntervalForTarget::Any);

        let cracks = scattered(20_000);
        let many = lives(&cracks);
        let risk = Risk::of(&many, DetectionCurve::LogNormal { median: 2.0, log_std: 0.6 });
        let IntervalForTarget::Mgt(interval) = risk.interval_for(0.01) else { panic!() };
        let (at, above) = (risk.probability(interval), risk.probability(1.002 * interval));
        assert!(at <= 0.01 && above > 0.01, "{interval}: {at} {above}");
    }

    #[test]
    fn intervals_that_are_no_intervals_do_not_hang() {
        let depths = steady();
        let lives = [life(&depths, 50.0), life(&depths, 0.0)];
        for curve in [DetectionCurve::Step(2.0), DetectionCurve::Table(vec![(0.0, 0.5)])] {
            let risk = Risk::of(&lives, curve);
            close(risk.probability(0.0), 0.5, 1e-9);
            assert!((0.0..=1.0).contains(&risk.probability(f64::NAN)));
        }
    }
}
