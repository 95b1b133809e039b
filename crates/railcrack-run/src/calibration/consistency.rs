//! Whether the measurements at a site agree with each other: the course of one crack, and χ² about
//! the coefficient that suits them best.

use super::measured::{Finding, Measured, Site};
use super::observed::{Observations, Observed, READING, UsualError, tabulated, theta_of_tables};
use crate::statistics::student;
use railcrack_case::normal::QUANTILE_97_5;

/// Agreement of the measurements at a site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Consistency {
    /// χ² = −2 Σ ln(L/L_max) at the most likely coefficient: of readings the sum of (y − ȳ)²/σ².
    pub chi_squared: f64,
    /// Its degrees of freedom, one less than the measurements.
    pub degrees: usize,
    /// The part of it between the times of measurement, and its degrees of freedom.
    pub between: (f64, usize),
    /// The measurement (from 0) that is farthest from the others, and its distance in standard
    /// deviations.
    pub largest: (usize, f64),
}

/// Standard deviations of χ² above its mean from which measurements contradict one another: one in
/// 50 of two measurements, one in 200 of many.
const CONTRADICTION: f64 = 3.0;
/// Standard deviations of a decrease that is no error of reading.
const SHALLOWER: f64 = 2.0;

impl Consistency {
    /// Of the `observations` of `site`, with the error `usual` of readings without one; none of
    /// fewer than two.
    #[must_use]
    pub fn of(site: &Site, observations: &Observations, usual: UsualError) -> Option<Self> {
        let all: Vec<(usize, &Observed)> = observations
            .iter()
            .enumerate()
            .filter_map(|(i, observed)| Some((i, observed.as_ref()?)))
            .collect();
        if all.len() < 2 {
            return None;
        }
        let chosen = |of: &dyn Fn(usize) -> bool| -> Vec<&Observed> {
            all.iter().filter(|(i, _)| of(*i)).map(|(_, observed)| *observed).collect()
        };
        let (best, chi_squared) = most_likely(&chosen(&|_| true), usual)?;
        let time = |i: usize| site.measured.get(i).map_or(0.0, |measured| measured.mgt);
        let mut times: Vec<f64> = all.iter().map(|(i, _)| time(*i)).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let within: Option<Vec<f64>> =
            times.iter().map(|at| Some(most_likely(&chosen(&|i| time(i) == *at), usual)?.1)).collect();
        let between = (chi_squared - within?.iter().sum::<f64>()).max(0.0);
        let apart = |(i, observed): &(usize, &Observed)| (*i, distance(observed, best, usual).sqrt());
        let largest = all.iter().map(apart).max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Self { chi_squared, degrees: all.len() - 1, between: (between, times.len() - 1), largest })
    }

    /// Whether the measurements contradict one another.
    #[must_use]
    pub fn is_contradiction(&self) -> bool {
        contradicts(self.chi_squared, self.degrees) || contradicts(self.between.0, self.between.1)
    }

    /// The factor by which errors are larger than stated, with Student's distribution for few times
    /// (Birge 1932, Physical Review 40, 207–227): 1 where the times agree. Readings of one time
    /// meet between, with the errors that they state.
    #[must_use]
    pub fn widening(&self) -> f64 {
        let (chi_squared, degrees) = self.between;
        if !contradicts(chi_squared, degrees) {
            return 1.0;
        }
        (chi_squared / degrees as f64).sqrt() * student(degrees) / QUANTILE_97_5
    }

    /// The words about measurements of `site` that contradict one another; none where they agree.
    #[must_use]
    pub fn remark(&self, site: &Site) -> Option<String> {
        let (i, sigmas) = self.largest;
        let measured = site.measured.get(i).filter(|_| self.is_contradiction())?;
        Some(format!(
            "{}: the measurements contradict one another: chi-squared {:.1} of {} degree{} of freedom; the farthest is {}, {sigmas:.1} standard deviations from the others; {}",
            site.name,
            self.chi_squared,
            self.degrees,
            if self.degrees == 1 { "" } else { "s" },
            shown(measured),
            match self.widening() {
                1.0 => "those of one time meet between, as exactly as they state".to_owned(),
                factor => format!("errors are widened by {factor:.1}"),
            }
        ))
    }
}

/// Whether χ² of so many degrees of freedom is no scatter.
fn contradicts(chi_squared: f64, degrees: usize) -> bool {
    let degrees = degrees as f64;
    chi_squared > degrees + CONTRADICTION * (2.0 * degrees).sqrt()
}

/// The share in χ² of `observed` at ln(C/C0) = `theta`.
fn distance(observed: &Observed, theta: f64, usual: UsualError) -> f64 {
    match observed.reading(usual) {
        Some((y, sigma)) => ((y - theta) / sigma.max(f64::MIN_POSITIVE)).powi(2),
        None => of_class(observed, theta),
    }
}

/// The ln(C/C0) that suits `all` best, and χ² there; none of nothing.
fn most_likely(all: &[&Observed], usual: UsualError) -> Option<(f64, f64)> {
    let sum = |theta: f64| all.iter().map(|observed| distance(observed, theta, usual)).sum::<f64>();
    let readings = all.iter().filter_map(|observed| observed.reading(usual));
    let (weights, moments) = readings.fold((0.0, 0.0), |(weights, moments), (y, sigma)| {
        let weight = sigma.max(f64::MIN_POSITIVE).powi(-2);
        (weights + weight, moments + weight * y)
    });
    let mean = (weights > 0.0).then(|| moments / weights);
    let has_classes = all.iter().any(|observed| matches!(observed, Observed::Class(_)));
    let tabulated = has_classes.then(theta_of_tables).into_iter().flatten();
    let candidates = mean.into_iter().chain(tabulated).map(|theta| (theta, sum(theta)));
    candidates.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// −2 ln(P/P_max) of a class at ln(C/C0) = `theta`; 0 of a reading.
fn of_class(observed: &Observed, theta: f64) -> f64 {
    let Observed::Class(table) = observed else { return 0.0 };
    let most = table.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    2.0 * (most - tabulated(table, theta))
}

/// `0.4 mm after 11 MGT`.
fn shown(measured: &Measured) -> String {
    let size = match measured.finding {
        Finding::Size(size) => format!("{size} mm"),
        Finding::Within(from, to) if from == f64::NEG_INFINITY => format!("up to {to} mm"),
        Finding::Within(from, to) if to == f64::INFINITY => format!("above {from} mm"),
        Finding::Within(from, to) => format!("{from} to {to} mm"),
    };
    format!("{size} after {} MGT", measured.mgt)
}

/// The words about a crack of `site` that gets shallower, which it does not without wear or
/// grinding: by more than the errors of its readings.
#[must_use]
pub fn shrinking(site: &Site) -> Option<String> {
    let bounds = |measured: &Measured| {
        let (from, to) = match measured.finding {
            Finding::Size(size) => (size, size),
            Finding::Within(from, to) => (from, to),
        };
        (from, to, measured.std.unwrap_or(if from == to { READING } else { 0.0 }))
    };
    let mut ordered: Vec<&Measured> = site.measured.iter().collect();
    ordered.sort_by(|a, b| a.mgt.total_cmp(&b.mgt));
    let shrinks = |first: &&Measured, then: &&Measured| {
        let ((from, _, one), (_, to, other)) = (bounds(first), bounds(then));
        first.mgt < then.mgt && from - to > SHALLOWER * one.hypot(other)
    };
    ordered.iter().enumerate().find_map(|(i, first)| {
        let then = ordered.iter().skip(i + 1).find(|then| shrinks(first, then))?;
        Some(format!(
            "{}: {} follows {}: a crack gets shallower only by wear and grinding, which the case does not have ([maintenance]), or these are different cracks: give each a file",
            site.name,
            shown(then),
            shown(first)
        ))
    })
}

/// Names of sites with the same measurements.
#[must_use]
pub fn equal_sites(sites: &[Site]) -> Option<String> {
    let pair = sites.iter().enumerate().find_map(|(i, site)| {
        let other = sites[..i].iter().find(|other| other.measured == site.measured)?;
        Some((other, site))
    });
    pair.map(|(one, other)| {
        format!(
            "{} and {} have the same measurements: a copy of a site is no second one",
            one.name, other.name
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::course::SizeCurve;
    use crate::calibration::measured::Measure;
    use crate::calibration::observed::observations;

    fn site(measured: &[(f64, Finding, Option<f64>)]) -> Site {
        let of = |&(mgt, finding, std): &(f64, Finding, Option<f64>)| Measured { mgt, finding, std };
        Site { measured: measured.iter().map(of).collect(), ..Site::named("a.csv", Measure::Depth) }
    }

    /// A tip that is 2 + MGT/10 mm deep.
    fn consistency(site: &Site) -> Consistency {
        let curve = SizeCurve::through((0..5).map(|i| (10.0 * f64::from(i), 2.0 + f64::from(i))).collect());
        Consistency::of(site, &observations(site, &curve), UsualError::OfSize(READING)).unwrap()
    }

    #[test]
    fn chi_squared_is_that_of_the_readings() {
        // σ of ln N is 0.1/(size − 2): y is ln(10/10) and ln(30/15), with σ 0.1 and 0.1/3.
        let readings = [(10.0, Finding::Size(3.0), Some(0.1)), (15.0, Finding::Size(5.0), Some(0.1))];
        let found = consistency(&site(&readings));
        let want = 2f64.ln().powi(2) / (0.1f64.powi(2) + (0.1f64 / 3.0).powi(2));
        assert!((found.chi_squared / want - 1.0).abs() < 1e-12 && found.degrees == 1, "{found:?}");
        assert_eq!(found.largest.0, 0, "the reading with the larger error");
        assert!((found.widening() / (want.sqrt() * student(1) / QUANTILE_97_5) - 1.0).abs() < 1e-12);
        let says = found.remark(&site(&readings)).unwrap();
        assert!(says.contains("of 1 degree of freedom; the farthest is 3 mm after 10 MGT"), "{says}");
        // Of one time, only warned of.
        let at_once = [(10.0, Finding::Size(3.0), Some(0.1)), (10.0, Finding::Size(5.0), Some(0.1))];
        let found = consistency(&site(&at_once));
        assert!(found.is_contradiction() && found.widening() == 1.0, "{found:?}");
        assert!(found.remark(&site(&at_once)).unwrap().ends_with("as exactly as they state"));
        // Of a crack that grows as the run.
        let agree = [(10.0, Finding::Size(3.0), Some(0.1)), (20.5, Finding::Size(4.0), Some(0.1))];
        let found = consistency(&site(&agree));
        assert_eq!((found.widening(), found.remark(&site(&agree))), (1.0, None));
    }

    #[test]
    fn classes_contradict_one_another_too() {
        let of = |second: (f64, f64)| {
            let class = |(from, to)| Finding::Within(from, to);
            consistency(&site(&[(10.0, class((2.5, 3.0)), Some(0.1)), (20.0, class(second), Some(0.1))]))
        };
        assert!(!of((3.5, 4.0)).is_contradiction());
        assert!(of((2.0, 2.5)).is_contradiction());
    }

    #[test]
    fn cracks_do_not_get_shallower_by_themselves() {
        let of = |second: f64, std| {
            shrinking(&site(&[(11.0, Finding::Size(second), std), (6.0, Finding::Size(2.5), std)]))
        };
        let says = of(0.4, Some(0.1)).unwrap();
        assert!(says.starts_with("a.csv: 0.4 mm after 11 MGT follows 2.5 mm after 6 MGT"), "{says}");
        assert_eq!((of(2.3, Some(0.1)), of(1.5, None)), (None, None));
        let class = |from, to| Finding::Within(from, to);
        assert!(shrinking(&site(&[(1.0, class(1.0, 1.5), None), (2.0, class(0.5, 0.9), None)])).is_some());
        assert!(shrinking(&site(&[(1.0, class(1.0, 1.5), None), (2.0, class(0.5, 1.0), None)])).is_none());
    }
}
