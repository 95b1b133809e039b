//! Searches for a parameter in synthetic measurements.

use super::*;
use crate::calibration::{
    Coefficient, Observed, Prior, SiteLikelihood, Trial, UsualError, coefficient_at, fit_parameter, posterior,
};

const PRIOR: Prior = Prior { mean: 0.0, log_std: 1.0, discrepancy: None };

/// N at three sizes is in proportion to p^(−3), and measured with deviations of ln N.
fn trial(value: f64, truth: f64, deviations: [f64; 3]) -> Trial {
    let y = |deviation: f64| -3.0 * (value / truth).ln() - deviation;
    let of = |deviation| Some(Observed::Reading { y: y(deviation), per_mm: 1.0, std: None });
    Trial { value, sites: vec![deviations.map(of).to_vec()] }
}

/// Runs `bracket` to its end; the fit, and the values that were tried.
fn search(
    mut bracket: Bracket,
    run: impl Fn(f64) -> Trial,
    with: Coefficient,
) -> (ParameterFit, Next, Vec<f64>) {
    let mut trials: Vec<Trial> = bracket.values(f64::NAN).into_iter().map(&run).collect();
    loop {
        let fit = fit_parameter("p", &trials, PRIOR, with).unwrap();
        let tried: Vec<f64> = trials.iter().map(|trial| trial.value).collect();
        match bracket.next(&fit, &tried) {
            Next::Try(value) => trials.push(run(value)),
            end => return (fit, end, tried),
        }
    }
}

const EVERY: (f64, f64) = (0.0, 1e9);

#[test]
fn synthetic_data_give_their_parameter_back() {
    let run = |value| trial(value, 0.27, [0.1, -0.1, 0.0]);
    let (fit, end, _) = search(Bracket::about(0.25, EVERY), run, Coefficient::OfCase);
    assert_eq!((end, fit.used), (Next::Settled, 3));
    assert!((fit.value / 0.27 - 1.0).abs() < 1e-3, "{} {:?} {}", fit.value, fit.interval, fit.contrast);
    // Slopes of −3 each: s = 0.1, SE = s/(3 √3), and Student's t of two degrees of freedom.
    let reach = 4.303 * 0.1 / (3.0 * 3f64.sqrt());
    let (low, high) = (fit.interval.0.unwrap(), fit.interval.1.unwrap());
    assert!(
        ((high / low).ln() / (2.0 * reach) - 1.0).abs() < 0.02,
        "{} {:?} {}",
        fit.value,
        fit.interval,
        fit.contrast
    );
    // Negative values likewise.
    let mirrored = |value: f64| Trial { value, ..trial(-value, 0.27, [0.1, -0.1, 0.0]) };
    let (fit, _, _) = search(Bracket::about(-0.25, (-1e9, 0.0)), mirrored, Coefficient::OfCase);
    assert!((fit.value / -0.27 - 1.0).abs() < 1e-3, "{} {:?} {}", fit.value, fit.interval, fit.contrast);
}

#[test]
fn a_value_far_away_is_found_by_widening() {
    for truth in [1e-10, 4e-8] {
        let run = |value| trial(value, truth, [0.05, -0.05, 0.0]);
        let (fit, end, tried) = search(Bracket::about(2e-9, EVERY), run, Coefficient::OfCase);
        assert!(
            (fit.value / truth - 1.0).abs() < 2e-3 && end == Next::Settled,
            "{} {:?} {}",
            fit.value,
            fit.interval,
            fit.contrast
        );
        assert!(tried.len() < 20, "{tried:?}");
    }
}

#[test]
fn an_optimum_at_an_end_is_not_a_result() {
    let run = |value| trial(value, 0.5, [0.0; 3]);
    let (_, end, _) = search(Bracket::given(0.1, 0.2), run, Coefficient::OfCase);
    assert_eq!(end, Next::AtEnd(BracketEnd::High));
    let (_, end, _) = search(Bracket::about(0.2, (0.0, 0.3)), run, Coefficient::OfCase);
    assert_eq!(end, Next::AtEnd(BracketEnd::High));
    let far = |value| trial(value, 1e6, [0.0; 3]);
    let (_, end, _) = search(Bracket::about(0.2, EVERY), far, Coefficient::OfCase);
    assert_eq!(end, Next::AtEnd(BracketEnd::High));
}

#[test]
fn a_parameter_that_acts_like_the_coefficient_is_not_told_from_it() {
    let run = |value| trial(value, 0.27, [0.1, -0.1, 0.05]);
    let trials: Vec<Trial> = Bracket::about(0.25, EVERY).values(0.25).into_iter().map(run).collect();
    let fit = fit_parameter("p", &trials, PRIOR, Coefficient::Fitted).unwrap();
    assert!(fit.is_indistinct(), "{} {:?} {}", fit.value, fit.interval, fit.contrast);
    // One that also changes the shape of growth is: the third size counts twice.
    let shaped = |value: f64| {
        let mut trial = trial(value, 0.27, [0.01, -0.01, 0.0]);
        if let Some(Some(Observed::Reading { y, .. })) = trial.sites[0].get_mut(2) {
            *y *= 2.0;
        }
        trial
    };
    let (fit, end, _) = search(Bracket::about(0.25, EVERY), shaped, Coefficient::Fitted);
    assert!(
        !fit.is_indistinct() && end == Next::Settled,
        "{} {:?} {}",
        fit.value,
        fit.interval,
        fit.contrast
    );
    assert!((fit.value / 0.27 - 1.0).abs() < 0.02, "{} {:?} {}", fit.value, fit.interval, fit.contrast);
    assert!(fit.posterior.mean.abs() < 0.05, "{} {:?} {}", fit.value, fit.interval, fit.contrast);
}

/// The coefficient itself: N at three sizes is in proportion to 1/C, so that the search must find
/// what the closed form does, its prior included; the scatter of a new rail likewise.
#[test]
fn a_searched_coefficient_is_that_of_the_closed_form() {
    let prior = Prior { mean: -2.0, log_std: 0.3, discrepancy: Some(0.2) };
    let of = |y: f64| Some(Observed::Reading { y, per_mm: 1.0, std: Some(0.2) });
    let run = |value: f64| {
        let y = |deviation: f64| -(value / 0.5).ln() - deviation;
        Trial { value, sites: vec![vec![of(y(0.1)), of(y(-0.1))], vec![of(y(0.4))]] }
    };
    let closed = {
        // About the coefficient of the case, 1: y of its own run.
        let sites = run(1.0).sites;
        let sites: Vec<SiteLikelihood> =
            sites.iter().map(|site| SiteLikelihood::of(site, UsualError::OfSize(0.2))).collect();
        posterior(&sites, prior)
    };
    let mut bracket = Bracket::about(1.0, EVERY);
    let mut trials: Vec<Trial> = bracket.values(1.0).into_iter().map(run).collect();
    let fit = loop {
        let fit = fit_parameter("c", &trials, prior, Coefficient::Searched(1.0)).unwrap();
        let tried: Vec<f64> = trials.iter().map(|trial| trial.value).collect();
        let next = match bracket.next(&fit, &tried) {
            Next::Settled => bracket.closing(&fit, &tried),
            Next::Try(value) => Some(value),
            Next::AtEnd(_) => None,
        };
        let Some(value) = next else { break fit };
        trials.push(run(value));
    };
    // Its lower end is below half and a quarter of the coefficient of the case.
    assert!(fit.interval.0.unwrap() < 0.25, "{:?}", fit.interval);
    assert!((fit.value.ln() - closed.mean).abs() < 3e-3, "{} {closed:?}", fit.value.ln());
    assert!((fit.posterior.std / closed.std - 1.0).abs() < 0.01, "{:?} {closed:?}", fit.posterior);
    assert!((fit.posterior.new_std / closed.new_std - 1.0).abs() < 0.01, "{:?} {closed:?}", fit.posterior);
    // Without the prior it is the mean of the measurements alone.
    let alone = fit_parameter("c", &trials, prior, Coefficient::OfCase).unwrap();
    assert!((alone.value.ln() - closed.mean).abs() > 0.05, "{}", alone.value.ln());
}

/// Runs above 0.3 do not reach the measured sizes, and the best value lies beyond, or between 0.3
/// and the next run: it is looked for up to the last run that does, and not taken for the last.
#[test]
fn runs_that_do_not_reach_the_sizes_are_an_end() {
    let short = |limit: f64| {
        move |value: f64| match value <= limit {
            true => trial(value, 0.35, [0.02, -0.02, 0.0]),
            false => Trial { value, sites: vec![vec![None; 3]] },
        }
    };
    let (fit, end, tried) = search(Bracket::about(0.3, EVERY), short(0.31), Coefficient::OfCase);
    assert_eq!(end, Next::AtEnd(BracketEnd::High), "{} {tried:?}", fit.value);
    let last = tried.iter().copied().filter(|value| *value <= 0.31).fold(0.0, f64::max);
    let next = tried.iter().copied().filter(|value| *value > 0.31).fold(1.0, f64::min);
    assert!((next / last).ln() < 0.03 && tried.len() < 18, "{tried:?}");
    let (fit, end, tried) = search(Bracket::about(0.3, EVERY), short(0.40), Coefficient::OfCase);
    assert!(end == Next::Settled && (fit.value / 0.35 - 1.0).abs() < 5e-3, "{} {tried:?}", fit.value);
    // The value of the case is tried once, as it is.
    let bracket = Bracket::about(0.3, EVERY);
    assert_eq!(
        bracket.values(0.3).iter().filter(|value| (**value - 0.3).abs() < 1e-6).collect::<Vec<_>>(),
        [&0.3]
    );
    assert!(bracket.values(0.31).contains(&0.31) && bracket.values(0.31).len() == 6);
}

/// N is in proportion to p^(−3)/C: every p explains the measurements with its own C, ln C = 3 ln p
/// + const, so that over all p from 0.125 to 0.5 ln C has the variance of one p and 9 (ln 4)²/12.
#[test]
fn the_coefficient_over_all_values_is_weighted_by_their_evidence() {
    let of = |value: f64| {
        let y = -3.0 * (value / 0.25).ln();
        Trial { value, sites: vec![vec![Some(Observed::Reading { y, per_mm: 1.0, std: Some(0.1) })]] }
    };
    let trials: Vec<Trial> = Bracket::about(0.25, EVERY).values(0.25).into_iter().map(of).collect();
    let vague = Prior { log_std: 30.0, ..PRIOR };
    let fit = fit_parameter("p", &trials, vague, Coefficient::Fitted).unwrap();
    let (mean, std) = fit.weighted.unwrap();
    let want = (0.01 + 9.0 * 4f64.ln().powi(2) / 12.0).sqrt();
    assert!(mean.abs() < 1e-3 && (std / want - 1.0).abs() < 0.01, "{mean} {std} {want}");
    // With the value of the case it has only the error of the reading.
    let own = coefficient_at(trials.iter().find(|trial| trial.value == 0.25).unwrap(), vague);
    assert!(own.mean.abs() < 1e-9 && (own.std - 0.1).abs() < 1e-5, "{own:?}");
    let none = fit_parameter("p", &trials, PRIOR, Coefficient::OfCase).unwrap();
    assert!(none.weighted.is_none());
}

#[test]
fn a_parameter_without_influence_is_refused() {
    let flat = trial(0.1, 0.2, [0.0; 3]);
    let other = Trial { value: 0.3, ..flat.clone() };
    let error = fit_parameter("p", &[flat.clone(), other], PRIOR, Coefficient::OfCase).unwrap_err();
    assert!(error.to_string().contains("p has no effect"), "{error}");
    let none = |value| Trial { value, sites: vec![vec![None; 3]] };
    assert!(fit_parameter("p", &[none(0.1), none(0.3)], PRIOR, Coefficient::OfCase).is_err());
}
