//! `calibration.json`.

use super::found::{Fitted, Found, New};
use railcrack_case::normal::QUANTILE_97_5;
use railcrack_run::calibration::Posterior;
use serde_json::{Value, json};

impl Found<'_> {
    /// `calibration.json`.
    pub fn json(&self) -> String {
        let mut all = json!({ "key": self.key, "of_case": self.value, "prior_log_mean": self.prior.mean, "prior_log_std": self.prior.log_std });
        let Some(object) = all.as_object_mut() else { return String::new() };
        let mut add = |name: &str, value: Value| object.insert(name.to_owned(), value);
        match &self.fitted {
            Fitted::Coefficient { calibration, new } => {
                let posterior = &calibration.posterior;
                add("value", json!(self.value * posterior.mean.exp()));
                of_posterior(&mut add, posterior, self.value);
                add("new_rail", new_rail(posterior.mean, *new, self.value));
                let sites: Vec<Value> = self
                    .sites
                    .iter()
                    .zip(&calibration.sites)
                    .map(|(site, fit)| {
                        json!({
                            "name": site.name,
                            "measurements": site.measured.len(),
                            "used": fit.observations.iter().flatten().count(),
                            "log_mean": fit.readings.map(|readings| readings.0),
                            "log_std": fit.readings.map(|readings| readings.1),
                            "posterior_log_mean": fit.posterior.mean,
                            "posterior_log_std": fit.posterior.std,
                        })
                    })
                    .collect();
                add("sites", sites.into());
            }
            Fitted::Parameter { fit, runs, coefficient, new } => {
                add("value", json!(fit.value));
                add("interval", json!([fit.interval.0, fit.interval.1]));
                add("is_determined", json!(!fit.is_indistinct()));
                add("used", json!(fit.used));
                add("runs", json!(runs));
                let profile: Vec<[f64; 2]> =
                    fit.profile.iter().map(|(value, deviance)| [*value, *deviance]).collect();
                add("deviance", json!(profile));
                if let Some((key, value)) = coefficient {
                    let mut inner = serde_json::Map::new();
                    inner.insert("key".into(), json!(key));
                    inner.insert("value".into(), json!(value * fit.posterior.mean.exp()));
                    let mut insert = |name: &str, value: Value| inner.insert(name.to_owned(), value);
                    of_posterior(&mut insert, &fit.posterior, *value);
                    if let Some((mean, std)) = fit.weighted {
                        insert("over_all_values", json!({ "log_mean": mean, "log_std": std }));
                    }
                    if let Some(new) = new {
                        insert("new_rail", new_rail(fit.posterior.mean, *new, *value));
                    }
                    add("coefficient", inner.into());
                } else if let Some(new) = new {
                    add("new_rail", new_rail(0.0, *new, fit.value));
                }
            }
        }
        let mut text = serde_json::to_string_pretty(&all).unwrap_or_default();
        text.push('\n');
        text
    }
}

fn of_posterior(add: &mut impl FnMut(&str, Value) -> Option<Value>, posterior: &Posterior, value: f64) {
    add("factor", json!(posterior.mean.exp()));
    add("log_mean", json!(posterior.mean));
    add("log_std", json!(posterior.std));
    let (low, high) = posterior.interval;
    add("interval", json!([value * low.exp(), value * high.exp()]));
    add("discrepancy_log_std", json!(posterior.discrepancy));
    add("log_evidence", json!(posterior.log_evidence));
}

fn new_rail(mean: f64, new: New, value: f64) -> Value {
    let ends = [-QUANTILE_97_5, QUANTILE_97_5].map(|z| value * (mean + z * new.std).exp());
    json!({ "log_std": new.std, "interval": ends })
}
