//! `calibration.json`.

use super::fit::{Calibration, SiteFit};
use super::measured::Site;
use super::posterior::Posterior;
use super::result::{CalibrationResult, Fitted, NewRail, interval_95};
use serde_json::{Value, json};

impl CalibrationResult<'_> {
    /// The text of `calibration.json`.
    pub fn json(&self) -> String {
        let head = json!({ "key": self.key, "of_case": self.value, "prior_log_mean": self.prior.mean, "prior_log_std": self.prior.log_std });
        let fitted = match &self.fitted {
            Fitted::Coefficient { calibration, new } => self.coefficient(calibration, *new),
            Fitted::Parameter { .. } => self.parameter(),
        };
        let mut text = serde_json::to_string_pretty(&joined([head, fitted])).unwrap_or_default();
        text.push('\n');
        text
    }

    fn coefficient(&self, calibration: &Calibration, new: NewRail) -> Value {
        let posterior = &calibration.posterior;
        let sites: Vec<Value> = self.sites.iter().zip(&calibration.sites).map(of_site).collect();
        joined([
            json!({ "value": self.value * posterior.mean.exp() }),
            of_posterior(posterior, self.value),
            json!({ "new_rail": new_rail(posterior.mean, new, self.value), "sites": sites }),
        ])
    }

    fn parameter(&self) -> Value {
        let Fitted::Parameter { fit, runs, coefficient, new } = &self.fitted else { return json!({}) };
        let profile: Vec<[f64; 2]> =
            fit.profile.iter().map(|(value, deviance)| [*value, *deviance]).collect();
        let number = json!({
            "value": fit.value,
            "interval": [fit.interval.0, fit.interval.1],
            "is_determined": !fit.is_indistinct(),
            "used": fit.used,
            "runs": runs,
            "deviance": profile,
        });
        let Some((key, value)) = coefficient else {
            let new = new.map_or(json!({}), |new| json!({ "new_rail": new_rail(0.0, new, fit.value) }));
            return joined([number, new]);
        };
        let mean = fit.posterior.mean;
        let over_all = fit.weighted.map_or(
            json!({}),
            |(mean, std)| json!({ "over_all_values": { "log_mean": mean, "log_std": std } }),
        );
        let coefficient = joined([
            json!({ "key": key, "value": value * mean.exp() }),
            of_posterior(&fit.posterior, *value),
            over_all,
            new.map_or(json!({}), |new| json!({ "new_rail": new_rail(mean, new, *value) })),
        ]);
        joined([number, json!({ "coefficient": coefficient })])
    }
}

/// One object of the keys of `objects`, in their order.
fn joined<const N: usize>(objects: [Value; N]) -> Value {
    objects.into_iter().filter_map(|object| object.as_object().cloned()).flatten().collect()
}

fn of_site((site, fit): (&Site, &SiteFit)) -> Value {
    json!({
        "name": site.name,
        "measurements": site.measured.len(),
        "used": fit.observations.iter().flatten().count(),
        "log_mean": fit.readings.map(|readings| readings.0),
        "log_std": fit.readings.map(|readings| readings.1),
        "chi_squared": fit.consistency.map(|own| own.chi_squared),
        "largest_residual": fit.consistency.map(|own| own.largest.1),
        "posterior_log_mean": fit.posterior.mean,
        "posterior_log_std": fit.posterior.std,
    })
}

fn of_posterior(posterior: &Posterior, value: f64) -> Value {
    let (low, high) = posterior.interval;
    json!({
        "factor": posterior.mean.exp(),
        "log_mean": posterior.mean,
        "log_std": posterior.std,
        "interval": [value * low.exp(), value * high.exp()],
        "discrepancy_log_std": posterior.discrepancy,
        "log_evidence": posterior.log_evidence,
    })
}

fn new_rail(mean: f64, new: NewRail, value: f64) -> Value {
    json!({ "log_std": new.std, "interval": interval_95(value, mean, new.std) })
}
