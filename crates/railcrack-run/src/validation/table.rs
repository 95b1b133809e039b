//! `validation.csv`.

use super::folder::Validated;
use crate::csv::text_field;

const HEADER: &str = "id,grade,scored,certainty,read,unit,measured,measured_low,measured_high,predicted,predicted_low,predicted_high,predicted_log_std,factor,pit,crps_ln,inside_95,within_factor_2,within_factor_5,without,quantity,space_predicted,space_predicted_low,space_predicted_high,space_predicted_log_std,space_factor,space_pit,space_crps_ln,space_inside_95,space_without";

/// `validation.csv`: a row for each entry that is compared.
pub fn validation_table(validated: &[Validated]) -> String {
    let mut text = String::from(
        "# predicted: median, 95 % and sd of ln of the samples; factor: predicted over measured; pit, crps_ln: of the logarithm, with the error of measurement; without: share of samples that do not reach the depth; space_: the same conditions with an elliptical contact and a curved front, empty where they are not given\n",
    );
    text.push_str(HEADER);
    text.push('\n');
    for one in validated {
        let (entry, Some(comparison)) = (&one.entry, &one.entry.comparison) else { continue };
        let (low, high) = comparison.measured;
        let mut row = vec![
            text_field(&entry.id).into_owned(),
            entry.grade.word().to_owned(),
            entry.is_scored().to_string(),
            entry.certainty.to_string(),
            entry.read.word().to_owned(),
            comparison.quantity.unit().to_owned(),
        ];
        match &one.score {
            Some(score) => {
                let [from, median, to] = score.predicted;
                let numbers = [
                    score.measured,
                    low,
                    high,
                    median,
                    from,
                    to,
                    score.log_std,
                    score.factor,
                    score.pit,
                    score.crps,
                ];
                row.extend(numbers.map(|number| number.to_string()));
                let is = [score.is_inside(), score.is_within(2.0), score.is_within(5.0)];
                row.extend(is.map(|is| is.to_string()));
                row.push(score.without.to_string());
            }
            None => {
                row.extend([(low * high).sqrt(), low, high].map(|number| number.to_string()));
                row.extend(std::iter::repeat_n(String::new(), 10));
                row.push("1".to_owned());
            }
        }
        row.push(text_field(&entry.quantity).into_owned());
        match &one.in_space {
            Some(score) => {
                let [from, median, to] = score.predicted;
                let numbers = [median, from, to, score.log_std, score.factor, score.pit, score.crps];
                row.extend(numbers.map(|number| number.to_string()));
                row.push(score.is_inside().to_string());
                row.push(score.without.to_string());
            }
            None => row.extend(std::iter::repeat_n(String::new(), 9)),
        }
        text.push_str(&row.join(","));
        text.push('\n');
    }
    text
}
