//! `calibration.csv`.

use super::fit::Calibration;
use super::measured::{Finding, Measure, Site};
use super::observed::Observed;
use super::parameter::Trial;
use crate::csv::text_field;

/// The measured quantities of `sites`.
pub fn quantities(sites: &[Site]) -> Vec<Measure> {
    [Measure::Depth, Measure::Length]
        .into_iter()
        .filter(|measure| sites.iter().any(|site| site.measure == *measure))
        .collect()
}

/// The measurements, each with the `cells` of its columns `header`.
fn table_of(
    sites: &[Site],
    header: &str,
    cells: impl Fn(usize, usize) -> Option<Vec<(String, Option<f64>)>>,
) -> String {
    let measures = quantities(sites);
    let names: Vec<&str> = measures.iter().map(|measure| measure.column()).collect();
    let mut text = format!("mgt,{},{header},site,at_least_mm,at_most_mm,std_mm\n", names.join(","));
    for (j, site) in sites.iter().enumerate() {
        for (i, measured) in site.measured.iter().enumerate() {
            let Some(rows) = cells(j, i) else { continue };
            let (size, bounds) = match measured.finding {
                Finding::Size(size) => (Some(size), (None, None)),
                Finding::Within(from, to) => {
                    (None, (Some(from).filter(|x| x.is_finite()), Some(to).filter(|x| x.is_finite())))
                }
            };
            for (middle, computed) in rows {
                let sizes: Vec<String> =
                    measures.iter().map(|measure| cell(size.filter(|_| *measure == site.measure))).collect();
                text.push_str(&format!(
                    "{},{},{}{middle},{},{},{},{}\n",
                    measured.mgt,
                    sizes.join(","),
                    cell(computed),
                    text_field(&site.name),
                    cell(bounds.0),
                    cell(bounds.1),
                    cell(measured.std)
                ));
            }
        }
    }
    text
}

fn cell(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

/// `calibration.csv` of a coefficient `value`.
pub fn coefficient_table(sites: &[Site], calibration: &Calibration, value: f64) -> String {
    table_of(sites, "computed_mgt,coefficient,ln_n_std", |j, i| {
        let observed = calibration.sites[j].observations[i].as_ref()?;
        let reading = observed.reading(calibration.usual);
        let computed = reading.map(|(y, _)| sites[j].measured[i].mgt * y.exp());
        let of = |cells: (f64, f64)| format!(",{},{}", value * cells.0.exp(), cells.1);
        Some(vec![(reading.map_or(",,".to_owned(), of), computed)])
    })
}

/// `calibration.csv` of the runs with several values of another number.
pub fn trials_table(sites: &[Site], trials: &[Trial]) -> String {
    table_of(sites, "computed_mgt,value", |j, i| {
        let of = |trial: &Trial| {
            let computed = match trial.sites[j][i].as_ref()? {
                Observed::Reading { y, .. } => Some(sites[j].measured[i].mgt * y.exp()),
                Observed::Class(_) => None,
            };
            Some((format!(",{}", trial.value), computed))
        };
        Some(trials.iter().filter_map(of).collect())
    })
}
