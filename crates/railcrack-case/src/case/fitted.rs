//! Numbers of a case that can be fitted: the coefficient of its growth law, and any other.

use super::case::Case;
use super::overrides::Overrides;
use super::setting::place_of;
use crate::schema::{Kind, NumberRange, Value};
use railcrack::fatigue::{Constant, LawInput};
use railcrack::words::Choice;
use thiserror::Error;

/// The coefficient of the growth law of a case, in proportion to which cracks grow.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficient {
    /// Its key in `[growth]`.
    pub key: &'static str,
    /// Its value in the case.
    pub value: f64,
    /// Settings that another coefficient requires as well.
    beside: Overrides,
}

/// A growth law without a coefficient.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "`growth.law = \"{law}\"`: the rates of `{file}` have no coefficient to fit; use a law with constants, such as law = \"paris\""
)]
pub struct NoCoefficient {
    /// The name of the law.
    pub law: &'static str,
    /// The file of its rates as the case names it.
    pub file: String,
}

/// A key whose value is not a number.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{key}`: {reason}; {help}")]
pub struct NoNumber {
    /// The key.
    pub key: String,
    /// The fault.
    pub reason: String,
    /// A remedy.
    pub help: String,
}

impl Coefficient {
    /// Overrides with which the case has `value` as its coefficient.
    #[must_use]
    pub fn overrides(&self, value: f64) -> Overrides {
        let mut overrides = self.beside.clone();
        overrides.settings.push(format!("growth.{}={value:?}", self.key));
        overrides
    }
}

impl Case {
    /// The coefficient of the growth law. With a steel it is that of its law, which replaces the
    /// steel if another coefficient is given.
    ///
    /// Errors: a table of rates has none.
    pub fn coefficient(&self) -> Result<Coefficient, NoCoefficient> {
        let rate = &self.growth.law.rate;
        let LawInput::Constants(of) = rate.declaration().input else {
            let file = self.growth_rates.as_ref().map_or(String::new(), |file| file.given_name().to_owned());
            return Err(NoCoefficient { law: rate.name(), file });
        };
        let constants: Vec<(&Constant, f64)> = of.all.iter().zip(rate.constants()).collect();
        let value = constants.iter().find(|(constant, _)| constant.key == of.coefficient.key);
        let value = value.map_or(f64::NAN, |(_, value)| *value);
        let beside =
            if self.growth_steel.is_some() { self.steel_spelt_out(&constants) } else { Overrides::default() };
        Ok(Coefficient { key: of.coefficient.key, value, beside })
    }

    /// Overrides that give law, constants, equivalent range and scatter of the steel without its
    /// name.
    fn steel_spelt_out(&self, constants: &[(&Constant, f64)]) -> Overrides {
        let law = &self.growth.law;
        let mut settings = vec![format!("growth.law={}", law.rate.name())];
        settings
            .extend(constants.iter().map(|(constant, value)| format!("growth.{}={value:?}", constant.key)));
        if let Some((form, weight)) = law.equivalent.form() {
            settings.push(format!("growth.equivalent={}", form.word()));
            settings.extend(weight.map(|weight| format!("growth.mode_2_weight={weight:?}")));
        }
        if law.threshold_2 > 0.0 {
            settings.push(format!("growth.threshold_2_mpa_sqrt_m={:?}", law.threshold_2));
        }
        if let Some(scatter) = &self.scatter {
            settings.push(format!("scatter.paris_c_log_std={:?}", scatter.rail_log_std));
        }
        Overrides { settings, left_out: vec!["growth.steel".to_owned()], ..Overrides::default() }
    }

    /// The numbers that `key` accepts; none where there is no such key, or it takes no number.
    #[must_use]
    pub fn accepted_numbers(&self, key: &str) -> Option<NumberRange> {
        match place_of(key).ok()?.2.kind {
            Kind::Number { range, .. } => Some(range),
            _ => None,
        }
    }

    /// The number that the case has at `key`, `section.key` or `section[2].key`; of a section that
    /// repeats that of the first one.
    ///
    /// Errors: there is no such key; it does not take a number; the case gives no value for it.
    pub fn number(&self, key: &str) -> Result<f64, NoNumber> {
        let refuse =
            |reason: String, help: &str| NoNumber { key: key.to_owned(), reason, help: help.to_owned() };
        let (section, number, found) = place_of(key).map_err(|(reason, help)| refuse(reason, &help))?;
        if !matches!(found.kind, Kind::Number { .. }) {
            let reason = format!("is not a number but {}", found.kind.accepted());
            return Err(refuse(reason, "contact.friction and crack[1].angle_deg are numbers"));
        }
        match self.written.value(&section.path(number.unwrap_or(1)), found.name) {
            Some(Value::Number(value)) => Ok(*value),
            _ => {
                Err(refuse("the case gives no value for it".to_owned(), "give a starting value in the case"))
            }
        }
    }

    /// The word that the case gives for `key`; none where it gives none.
    #[must_use]
    pub fn word(&self, key: &str) -> Option<&str> {
        let (section, number, found) = place_of(key).ok()?;
        match self.written.value(&section.path(number.unwrap_or(1)), found.name)? {
            Value::Text(word) => Some(word),
            _ => None,
        }
    }
}
