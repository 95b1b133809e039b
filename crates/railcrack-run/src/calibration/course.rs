//! The size of a computed crack over traffic.

use super::measured::Measure;
use crate::csv::TipRow;
use railcrack::growth::Axles;

/// The depth or length of a tip over traffic: linear between the steps of its run.
#[derive(Debug, Clone, PartialEq)]
pub struct SizeCurve {
    /// (million gross tonnes, mm), traffic ascending.
    points: Vec<(f64, f64)>,
}

impl SizeCurve {
    /// The curve of one tip by its `rows`; axles have `tonnes` in the mean.
    #[must_use]
    pub fn of(rows: &[TipRow], tonnes: f64, measure: Measure) -> Self {
        let size = |row: &TipRow| match measure {
            Measure::Depth => row.depth.unwrap_or(-row.place[1]),
            Measure::Length => row.length,
        };
        Self { points: rows.iter().map(|row| (Axles(row.load_cycles).mgt(tonnes).0, size(row))).collect() }
    }

    /// The curve through `points` of traffic (million gross tonnes, ascending) and size (mm).
    #[must_use]
    pub fn through(points: Vec<(f64, f64)>) -> Self {
        Self { points }
    }

    /// The first and the last size, mm; zeros of an empty curve.
    #[must_use]
    pub fn ends(&self) -> (f64, f64) {
        let size = |point: Option<&(f64, f64)>| point.map_or(0.0, |point| point.1);
        (size(self.points.first()), size(self.points.last()))
    }

    /// Traffic (million gross tonnes) at which `size` is first reached, and d ln N/d size there;
    /// none outside the sizes of the run, and where the crack has that size from the start.
    #[must_use]
    pub fn reaches(&self, size: f64) -> Option<(f64, f64)> {
        let pair = self.points.windows(2).find(|pair| pair[0].1 < size && pair[1].1 >= size)?;
        let slowness = (pair[1].0 - pair[0].0) / (pair[1].1 - pair[0].1);
        let mgt = pair[0].0 + slowness * (size - pair[0].1);
        (mgt > 0.0).then(|| (mgt, slowness / mgt))
    }

    /// The size after `mgt`, mm; beyond the run it grows on as in its last step.
    #[must_use]
    pub fn at(&self, mgt: f64) -> f64 {
        let next = self.points.partition_point(|point| point.0 < mgt);
        let last = self.points.len().saturating_sub(1);
        let (Some(from), Some(to)) =
            (self.points.get(next.clamp(1, last.max(1)) - 1), self.points.get(next.clamp(1, last.max(1))))
        else {
            return self.ends().0;
        };
        if mgt <= from.0 && next <= 1 {
            return from.1;
        }
        let share = if to.0 > from.0 { (mgt - from.0) / (to.0 - from.0) } else { 1.0 };
        from.1 + share * (to.1 - from.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_traffic_are_inverse() {
        let curve = SizeCurve::through(vec![(0.0, 2.0), (10.0, 3.0), (15.0, 5.0)]);
        assert_eq!(curve.reaches(2.5), Some((5.0, 2.0)));
        assert_eq!(curve.reaches(4.0), Some((12.5, 0.2)));
        assert_eq!((curve.reaches(2.0), curve.reaches(5.1)), (None, None));
        for (mgt, size) in [(-1.0, 2.0), (0.0, 2.0), (5.0, 2.5), (12.5, 4.0), (15.0, 5.0), (20.0, 7.0)] {
            assert!((curve.at(mgt) - size).abs() < 1e-12, "{mgt}: {}", curve.at(mgt));
        }
        assert_eq!(SizeCurve::through(vec![]).at(1.0), 0.0);
        assert_eq!(SizeCurve::through(vec![(0.0, 2.0)]).at(1.0), 2.0);
    }
}
