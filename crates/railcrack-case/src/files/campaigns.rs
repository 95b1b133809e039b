//! Lists of inspections with a row for each crack and a column for each campaign.

use super::csv_rows::{CsvRow, csv_rows};
use super::size_class::SizeClass;
use super::units_row::is_units_row;
use crate::schema::{CaseErrors, Fault, Report, Source, read_file};
use std::ops::Range;
use std::path::Path;

/// A list with a column for each campaign, whose header, or whose row `mgt`, has its traffic.
#[derive(Debug, Clone, PartialEq)]
pub struct Campaigns {
    /// The cracks, in their order.
    pub cracks: Vec<CampaignCrack>,
    /// Whether sizes are lengths: a header names them. Otherwise they are depths.
    pub has_lengths: bool,
}

/// A crack in the campaigns in which it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct CampaignCrack {
    /// The text of the other columns.
    pub name: String,
    /// Traffic, million gross tonnes, and size.
    pub readings: Vec<(f64, CampaignSize)>,
}

/// A size in a list of inspections, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CampaignSize {
    /// A size.
    Size(f64),
    /// A size above the one and up to the other bound, where they are given.
    Class(Option<f64>, Option<f64>),
}

/// Word of the traffic in headers and at the beginning of a row.
const TRAFFIC: &str = "mgt";
/// Signs of a crack that a campaign did not find.
const BLANK: [&str; 5] = ["", "-", "\u{2013}", "n/a", "nan"];
/// Largest traffic and size.
const LARGEST: f64 = 1e6;

impl Campaigns {
    /// The list in the file `path`; none where the file has a column `mgt` or names no campaign.
    ///
    /// Errors: the file cannot be read; a field of a campaign is neither blank nor a size or a
    /// class of sizes.
    pub fn read(path: &Path) -> Result<Option<Self>, CaseErrors> {
        let source = read_file(path)?;
        Self::parse(&source).map_err(|(says, span)| {
            let help = "a list of campaigns has a row per crack, and a column per campaign with its traffic in the header, such as 6.0 MGT, or in a row mgt";
            let mut report = Report::new(source.clone());
            report.add(Fault { span: Some(span), ..Fault::new(says).help(help) });
            report.into_errors()
        })
    }

    fn parse(source: &Source) -> Result<Option<Self>, (String, Range<usize>)> {
        let mut rows = csv_rows(source).peekable();
        let Some(header) = rows.next() else { return Ok(None) };
        if header.fields().any(|name| name == TRAFFIC) {
            return Ok(None);
        }
        while rows.next_if(|row| is_units_row(row.fields())).is_some() {}
        let is_traffic =
            |row: &CsvRow| row.fields().next().is_some_and(|name| name.eq_ignore_ascii_case(TRAFFIC));
        let traffic: Vec<Option<f64>> = match rows.next_if(is_traffic) {
            Some(row) => row.fields().map(|given| row.number(given)).collect(),
            None => header.fields().map(traffic_of).collect(),
        };
        if traffic.iter().all(Option::is_none) {
            return Ok(None);
        }
        let has_lengths = header.fields().any(|name| name.to_lowercase().contains("length"));
        let cracks = rows.map(|row| crack(&row, &traffic)).collect::<Result<_, _>>()?;
        Ok(Some(Self { cracks, has_lengths }))
    }
}

/// The traffic in the header of a campaign: `6.0 MGT`, `depth_mm at 6,0 MGT`, `mgt_6`.
fn traffic_of(name: &str) -> Option<f64> {
    if !name.to_lowercase().contains(TRAFFIC) {
        return None;
    }
    let is_of_number = |letter: char| letter.is_ascii_digit() || matches!(letter, '.' | ',');
    let part = name
        .split(|letter| !is_of_number(letter))
        .find(|part| part.contains(|l: char| l.is_ascii_digit()))?;
    part.replace(',', ".").parse().ok()
}

/// The crack of a row, whose campaigns had `traffic`.
fn crack(row: &CsvRow, traffic: &[Option<f64>]) -> Result<CampaignCrack, (String, Range<usize>)> {
    if row.len() != traffic.len() {
        return Err((row.wrong_length(traffic.len()), row.span.clone()));
    }
    let mut crack = CampaignCrack { name: String::new(), readings: Vec::new() };
    for (given, traffic) in row.fields().zip(traffic) {
        let Some(mgt) = *traffic else {
            crack.name = format!("{} {given}", crack.name).trim().to_owned();
            continue;
        };
        if BLANK.contains(&given.to_lowercase().as_str()) {
            continue;
        }
        let size = match (row.number(given), SizeClass::of(given, |part| row.number(part))) {
            (Some(size), _) if size.abs() <= LARGEST => CampaignSize::Size(size),
            (_, Some(class)) => CampaignSize::Class(class.above, class.up_to),
            _ => {
                return Err((
                    format!("`{given}` after {mgt} MGT: must be a size, a class of sizes or blank"),
                    row.span.clone(),
                ));
            }
        };
        crack.readings.push((mgt, size));
    }
    Ok(crack)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Option<Campaigns> {
        Campaigns::parse(&Source::new("c.csv", text)).unwrap()
    }

    #[test]
    fn campaigns_in_headers_and_in_a_row() {
        let crack = |name: &str, readings: &[(f64, CampaignSize)]| CampaignCrack {
            name: name.to_owned(),
            readings: readings.to_vec(),
        };
        let cracks = vec![
            crack(
                "12.4 A",
                &[(6.0, CampaignSize::Size(1.2)), (11.5, CampaignSize::Class(Some(1.5), Some(2.0)))],
            ),
            crack("12.4 B", &[(11.5, CampaignSize::Class(None, Some(0.5)))]),
        ];
        let want = Some(Campaigns { cracks, has_lengths: false });
        let header = "\u{feff}km;crack;6 MGT;depth_mm at 11,5 MGT\n-;-;[mm];[mm]\n12.4;A;1,2;1,5\u{2013}2,0\n12.4;B;-;<0,5\n";
        assert_eq!(parsed(header), want);
        let row = "km,crack,May 2021,June 2022\nmgt,,6.0,11.5\n12.4,A,1.2,1.5-2.0\n12.4,B,,<0.5\n";
        assert_eq!(parsed(row), want);
        assert!(parsed("crack,length_mm 6 MGT\nA,3\n").unwrap().has_lengths);
        assert_eq!((parsed("mgt,depth_mm\n6,1.2\n"), parsed("a,b\n6,1.2\n"), parsed("")), (None, None, None));
        let refused = Campaigns::parse(&Source::new("c.csv", "crack,6 MGT\nA,deep\n")).unwrap_err();
        assert_eq!(
            refused,
            ("`deep` after 6 MGT: must be a size, a class of sizes or blank".to_owned(), 12..18)
        );
    }
}
