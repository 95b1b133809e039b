//! The closed form against published check numbers and direct integration.

use super::*;
use crate::calibration::{Finding, Measure, Measured, Site, SizeCurve, observe};
use railcrack_case::normal::{density, distribution};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Three sites of three, two and one readings.
fn three() -> Vec<SiteLikelihood> {
    vec![
        SiteLikelihood::of_readings(&[(-0.60, 0.40), (-0.75, 0.25), (-0.68, 0.15)]),
        SiteLikelihood::of_readings(&[(-0.10, 0.30), (-0.25, 0.20)]),
        SiteLikelihood::of_readings(&[(-1.30, 0.20)]),
    ]
}

/// Half of the last digit of the check numbers.
const DIGITS: f64 = 5.1e-7;

fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got} and {want}");
}

#[test]
fn means_of_sites() {
    let want = [(-0.689_296, 0.122_449), (-0.203_846, 0.166_410), (-1.3, 0.2)];
    for (site, (mean, std)) in three().iter().zip(want) {
        let got = site.mean().unwrap();
        close(got.0, mean, DIGITS);
        close(got.1, std, DIGITS);
    }
}

#[test]
fn posterior_of_three_sites() {
    let with = |s| posterior(&three(), Prior { mean: 0.0, log_std: 1.0, discrepancy: Some(s) });
    let fit = with(0.5);
    close(fit.mean, -0.661_251, DIGITS);
    close(fit.std, 0.290_827, DIGITS);
    close(fit.mean.exp(), 0.51621, 5e-6);
    close(fit.interval.0.exp(), 0.29192, 5e-6);
    close(fit.interval.1.exp(), 0.91280, 5e-6);
    close(fit.new_std, 0.578_429, DIGITS);
    close((fit.mean - QUANTILE_97_5 * fit.new_std).exp(), 0.1661, 5e-5);
    close((fit.mean + QUANTILE_97_5 * fit.new_std).exp(), 1.6039, 5e-5);
    let without = with(0.0);
    close(without.mean, -0.666_379, DIGITS);
    close(without.std, 0.088_112, DIGITS);
    // Without discrepancy every site has the coefficient of all.
    assert!(without.sites.iter().all(|site| (site.mean - without.mean).abs() < 1e-12));
}

#[test]
fn evidence_of_three_sites_and_its_maximum() {
    let sites = three();
    for (s, want) in [(0.0, -8.583_820), (0.25, -4.053_292), (0.5, -3.148_446), (1.0, -3.749_900)] {
        close(log_evidence(&sites, (0.0, 1.0), s), want, DIGITS);
    }
    let fit = posterior(&sites, Prior { mean: 0.0, log_std: 1.0, discrepancy: None });
    for away in [-1e-3, 1e-3] {
        assert!(log_evidence(&sites, (0.0, 1.0), fit.discrepancy + away) < fit.log_evidence);
    }
    // One site does not show how sites differ.
    let one = posterior(&sites[..1], Prior { mean: 0.0, log_std: 1.0, discrepancy: None });
    assert_eq!(one.discrepancy, 0.0);
}

/// A poor reading next to a good one does not show that sites differ by less than 0.3, ten good
/// ones that agree do; the evidence of the largest s is that of 95 %.
#[test]
fn the_largest_discrepancy_is_what_the_sites_do_not_exclude() {
    let prior = Prior { mean: 0.0, log_std: 1.0, discrepancy: None };
    let poor = [SiteLikelihood::of_readings(&[(-0.6, 0.04)]), SiteLikelihood::of_readings(&[(-0.8, 0.4)])];
    let fit = posterior(&poor, prior);
    assert!(fit.discrepancy < 0.05 && fit.largest_discrepancy > 0.6, "{fit:?}");
    let of_site = |i: i32| SiteLikelihood::of_readings(&[(-0.6 + 0.01 * f64::from(i % 3), 0.04)]);
    let good = posterior(&(0..10).map(of_site).collect::<Vec<_>>(), prior);
    assert!(good.discrepancy < 0.01 && good.largest_discrepancy < 0.1, "{good:?}");
    let three = three();
    let fit = posterior(&three, prior);
    close(log_evidence(&three, (0.0, 1.0), fit.largest_discrepancy), fit.log_evidence - 1.920_729, 0.02);
    // One site excludes none; an s that is given is itself.
    assert_eq!(posterior(&three[..1], prior).largest_discrepancy, LARGEST_DISCREPANCY);
    assert_eq!(posterior(&three, Prior { discrepancy: Some(0.1), ..prior }).largest_discrepancy, 0.1);
}

/// ln P of a class that has the probability Φ((θ − from)/width).
fn soft_class(from: f64, width: f64) -> Vec<f64> {
    (0..=4000)
        .map(|i| (distribution((12.0 * (f64::from(i) / 2000.0 - 1.0) - from) / width)).max(1e-300).ln())
        .collect()
}

/// ∫ N(θ; b, s²) Φ((θ − c)/w) dθ = Φ((b − c)/√(w² + s²)): a site of one class, and the integral
/// over b with the prior likewise.
#[test]
fn a_censored_site_in_closed_form() {
    let (c, w, s, tau) = (0.4, 0.3, 0.5, 1.0);
    let site = SiteLikelihood { classes: vec![soft_class(c, w)], ..SiteLikelihood::default() };
    for b in [-1.0, 0.0, 0.7] {
        close(site.given(b, s).0, distribution((b - c) / f64::hypot(w, s)).ln(), 1e-4);
    }
    let whole = distribution(-c / (w * w + s * s + tau * tau).sqrt()).ln();
    close(log_evidence(std::slice::from_ref(&site), (0.0, tau), s), whole, 1e-4);
    // Mean of b: τ² φ(z)/(q Φ(z)), z = −c/q, q² = w² + s² + τ².
    let q = (w * w + s * s + tau * tau).sqrt();
    let mean = tau * tau / q * density(-c / q) / distribution(-c / q);
    let fit = posterior(&[site], Prior { mean: 0.0, log_std: tau, discrepancy: Some(s) });
    close(fit.mean, mean, 1e-4);
}

/// A class that every coefficient satisfies changes nothing, so that the integration must agree
/// with the closed form.
#[test]
fn the_integration_agrees_with_the_closed_form() {
    let prior = Prior { mean: 0.0, log_std: 1.0, discrepancy: None };
    let exact = posterior(&three(), prior);
    let sites: Vec<SiteLikelihood> =
        three().into_iter().map(|site| SiteLikelihood { classes: vec![vec![0.0; 11]], ..site }).collect();
    let numeric = posterior(&sites, prior);
    close(numeric.mean, exact.mean, 1e-6);
    close(numeric.std, exact.std, 1e-6);
    close(numeric.discrepancy, exact.discrepancy, 1e-5);
    close(numeric.log_evidence, exact.log_evidence, 1e-6);
    close(numeric.interval.0, exact.interval.0, 1e-3);
    for (a, b) in numeric.sites.iter().zip(&exact.sites) {
        close(a.mean, b.mean, 1e-6);
        close(a.std, b.std, 1e-6);
    }
}

/// A prior about another mean is that of sites about it: everything moves with it, the evidence
/// stays; and far from the measurements it is known by its precision.
#[test]
fn the_mean_of_the_prior() {
    let moved = |by: f64| {
        vec![
            SiteLikelihood::of_readings(&[(-0.60 + by, 0.40), (-0.75 + by, 0.25), (-0.68 + by, 0.15)]),
            SiteLikelihood::of_readings(&[(-0.10 + by, 0.30), (-0.25 + by, 0.20)]),
            SiteLikelihood::of_readings(&[(-1.30 + by, 0.20)]),
        ]
    };
    let about = |mean: f64| Prior { mean, log_std: 1.0, discrepancy: Some(0.5) };
    let (here, there) = (posterior(&moved(0.0), about(0.0)), posterior(&moved(1.5), about(1.5)));
    close(there.mean - 1.5, here.mean, 1e-12);
    close(there.log_evidence, here.log_evidence, 1e-12);
    // μ/τ² over the precision, 1/0.290827².
    let pulled = posterior(&moved(0.0), about(-0.5));
    close(pulled.mean, here.mean - 0.5 * 0.290_827_f64.powi(2), 1e-6);
    let blurred: Vec<SiteLikelihood> =
        moved(0.0).into_iter().map(|site| SiteLikelihood { classes: vec![vec![0.0; 11]], ..site }).collect();
    close(posterior(&blurred, about(-0.5)).mean, pulled.mean, 1e-6);
}

/// A standard normal deviate.
fn deviate(source: &mut Pcg64Mcg) -> f64 {
    let mut uniform = || ((source.next_u64() >> 11) + 1) as f64 / (1u64 << 53) as f64;
    let radius = (-2.0 * uniform().ln()).sqrt();
    radius * (2.0 * std::f64::consts::PI * uniform()).cos()
}

/// Each of many sites is left out in turn and predicted by the others as a new rail: the share
/// within its 95 % interval is 95 %, up to the chance of so many trials.
#[test]
fn a_site_left_out_is_within_its_interval_at_the_stated_rate() {
    const LINES: usize = 60;
    const SITES: usize = 8;
    let mut source = Pcg64Mcg::seed_from_u64(7);
    let (s, sigma) = (0.6, 0.25);
    let mut inside = 0;
    let mut recovered = 0;
    for _ in 0..LINES {
        let b = deviate(&mut source);
        let of_site = |source: &mut Pcg64Mcg| {
            let theta = b + s * deviate(source);
            let readings: Vec<(f64, f64)> =
                (0..3).map(|_| (theta + sigma * deviate(source), sigma)).collect();
            (theta, SiteLikelihood::of_readings(&readings))
        };
        let sites: Vec<(f64, SiteLikelihood)> = (0..SITES).map(|_| of_site(&mut source)).collect();
        let all: Vec<SiteLikelihood> = sites.iter().map(|site| site.1.clone()).collect();
        let fit = posterior(&all, Prior { mean: 0.0, log_std: 1.0, discrepancy: None });
        recovered += usize::from(fit.interval.0 <= b && b <= fit.interval.1);
        for left in 0..SITES {
            let others: Vec<SiteLikelihood> =
                (0..SITES).filter(|j| *j != left).map(|j| all[j].clone()).collect();
            let fit = posterior(&others, Prior { mean: 0.0, log_std: 1.0, discrepancy: None });
            inside += usize::from(fit.new_interval.0 <= sites[left].0 && sites[left].0 <= fit.new_interval.1);
        }
    }
    // 95 % of 480 is 456 ± 5, a little more since sites of one line are not independent; by the
    // normal distribution instead of Student's it would be 434.
    assert!((445..=470).contains(&inside), "{inside} of 480");
    assert!((50..=60).contains(&recovered), "{recovered} of 60");
}

/// Depths of sites with coefficients of their own, read with errors, in classes, and as no
/// indication, come back.
#[test]
fn synthetic_sites_come_back() {
    // 2 mm + a growing rate: depth = 2 e^(MGT/20).
    let curve = SizeCurve::through(
        (0..400).map(|i| (f64::from(i) * 0.25, 2.0 * (f64::from(i) / 80.0).exp())).collect(),
    );
    let mut source = Pcg64Mcg::seed_from_u64(3);
    let factor: f64 = 0.55;
    let mut sites = Vec::new();
    for j in 0..6 {
        let own = factor.ln() + 0.2 * deviate(&mut source);
        let mut measured = Vec::new();
        for i in 1..=4 {
            let mgt = 8.0 * f64::from(i);
            let depth = curve.at(mgt * own.exp()) + 0.15 * deviate(&mut source);
            let finding = match (j + i) % 3 {
                0 => Finding::Size(depth),
                1 => Finding::Within((2.0 * depth).floor() / 2.0, (2.0 * depth).floor() / 2.0 + 0.5),
                _ if depth < 2.7 => Finding::Within(f64::NEG_INFINITY, 2.7),
                _ => Finding::Size(depth),
            };
            measured.push(Measured { mgt, finding, std: Some(0.15) });
        }
        sites.push(Site { measured, ..Site::named(&format!("{j}"), Measure::Depth) });
    }
    let likelihoods: Vec<SiteLikelihood> = sites
        .iter()
        .map(|site| SiteLikelihood::of(&observe(site, &curve), UsualError::OfSize(0.3)))
        .collect();
    let fit = posterior(&likelihoods, Prior { mean: 0.0, log_std: 1.0, discrepancy: None });
    assert!(fit.interval.0 < factor.ln() && factor.ln() < fit.interval.1, "{fit:?}");
    assert!(fit.std < 0.2, "{fit:?}");
    assert!((fit.mean - factor.ln()).abs() < 0.25, "{fit:?}");
}
