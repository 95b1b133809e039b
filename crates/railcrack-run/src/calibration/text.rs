//! The result of a calibration in words.

use super::fit::Calibration;
use super::measured::{Finding, Measured, Site};
use super::observed::UsualError;
use super::posterior::Posterior;
use super::result::{CalibrationResult, Fitted, NewRail, interval_95};

impl CalibrationResult<'_> {
    /// The result, a sentence in each line: the first one is the verdict.
    pub fn text(&self) -> String {
        match &self.fitted {
            Fitted::Coefficient { calibration, new } => self.coefficient_text(calibration, *new),
            Fitted::Parameter { .. } => self.parameter_text(),
        }
    }

    fn measured(&self) -> usize {
        self.sites.iter().map(|site| site.measured.len()).sum()
    }

    fn coefficient_text(&self, calibration: &Calibration, new: NewRail) -> String {
        let posterior = &calibration.posterior;
        let mut text = of_coefficient(self.key.trim_start_matches("growth."), self.value, posterior);
        text.push_str(&of_new_rail(self.value, posterior, new, self.sites));
        text.push_str(&self.discrepancy_text(posterior));
        match calibration.usual {
            UsualError::OfLife(sigma) if sigma > 0.0 && has_unknown(self.sites) => text.push_str(&format!(
                "errors of reading by their scatter: {sigma:.4} in ln N, widened by Student's distribution\n"
            )),
            UsualError::OfSize(std) if has_unknown(self.sites) => {
                text.push_str(&format!("errors of reading taken as {std} mm: the file gives no std_mm\n"));
            }
            _ => (),
        }
        let used: usize =
            calibration.sites.iter().map(|site| site.observations.iter().flatten().count()).sum();
        text.push_str(&format!("{used} of {} measurements used\n", self.measured()));
        text
    }

    fn parameter_text(&self) -> String {
        let Fitted::Parameter { fit, runs, coefficient, new } = &self.fitted else { return String::new() };
        let mut text = if fit.is_indistinct() {
            format!(
                "the measurements do not determine {}: no value that was tried is excluded; it stays {}\n",
                self.key,
                number(self.value)
            )
        } else {
            format!(
                "{} = {}, {} in the case, 95 % {}\n",
                self.key,
                number(fit.value),
                number(self.value),
                ends(fit.interval)
            )
        };
        if let Some((key, value)) = coefficient {
            let key = key.trim_start_matches("growth.");
            text.push_str(&of_coefficient(key, *value, &fit.posterior));
            text.push_str(
                &fit.weighted
                    .map_or_else(String::new, |over_all| of_all_values(&self.key, key, *value, over_all)),
            );
        }
        if let Some(new) = new {
            let value = coefficient.as_ref().map_or(fit.value, |(_, value)| *value);
            text.push_str(&of_new_rail(value, &fit.posterior, *new, self.sites));
        }
        text.push_str(&self.discrepancy_text(&fit.posterior));
        text.push_str(&format!("{} of {} measurements used, {runs} runs\n", fit.used, self.measured()));
        text
    }

    /// By how much sites differ; empty for one site.
    fn discrepancy_text(&self, posterior: &Posterior) -> String {
        if self.sites.len() < 2 {
            return String::new();
        }
        let by = if self.prior.discrepancy.is_some() { "as given" } else { "by the largest evidence" };
        format!("sites differ by {:.4} in ln C ({by})\n", posterior.discrepancy)
    }
}

fn has_unknown(sites: &[Site]) -> bool {
    let is_unknown =
        |measured: &Measured| measured.std.is_none() && matches!(measured.finding, Finding::Size(_));
    sites.iter().flat_map(|site| &site.measured).any(is_unknown)
}

fn of_coefficient(key: &str, value: f64, posterior: &Posterior) -> String {
    let factor = posterior.mean.exp();
    let (low, high) = posterior.interval;
    format!(
        "{key} = {:.4e}, {factor:.4} times that of the case, 95 % from {:.4e} to {:.4e}\n",
        value * factor,
        value * low.exp(),
        value * high.exp()
    )
}

/// The coefficient `value` over all values of `other` that were tried.
fn of_all_values(other: &str, key: &str, value: f64, (mean, std): (f64, f64)) -> String {
    let [low, high] = interval_95(value, mean, std);
    format!(
        "over all values of {other}, weighted by their evidence: {key} = {:.4e}, 95 % from {low:.4e} to {high:.4e}\n",
        value * mean.exp()
    )
}

fn of_new_rail(value: f64, posterior: &Posterior, new: NewRail, sites: &[Site]) -> String {
    let [low, high] = interval_95(value, posterior.mean, new.std);
    let why = match (new.is_of_case, sites.len()) {
        (false, _) => "",
        (true, 1) => "; one site does not show how rails differ, so that the scatter of the case is kept",
        (true, _) => {
            "; these sites do not show that rails differ by less than the scatter of the case, which is kept"
        }
    };
    format!(
        "a rail that was not measured: 95 % from {low:.4e} to {high:.4e}, sd of ln C {:.4}{why}\n",
        new.std
    )
}

fn ends((low, high): (Option<f64>, Option<f64>)) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!("from {} to {}", number(low), number(high)),
        (Some(low), None) => format!("above {}", number(low)),
        (None, Some(high)) => format!("below {}", number(high)),
        (None, None) => "not bounded".to_owned(),
    }
}

/// Four digits behind the point, or of a number that is small or large.
pub fn number(value: f64) -> String {
    if value == 0.0 || (0.01..1e5).contains(&value.abs()) {
        format!("{value:.4}")
    } else {
        format!("{value:.4e}")
    }
}
