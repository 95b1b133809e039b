//! Measurements of cracks over traffic.

use railcrack_case::{CampaignSize, Campaigns, CaseErrors, Column, Columns};
use std::path::Path;

/// The measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Depth of the tip.
    Depth,
    /// Length of the crack.
    Length,
}

impl Measure {
    /// Its column.
    #[must_use]
    pub fn column(self) -> &'static str {
        match self {
            Self::Depth => "depth_mm",
            Self::Length => "length_mm",
        }
    }
}

/// The result of an inspection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding {
    /// A size, mm.
    Size(f64),
    /// A size above the first and at or below the second number, mm: a class of depths, or with −∞
    /// no indication, with +∞ an open class.
    Within(f64, f64),
}

/// A measured crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Million gross tonnes since the crack had the size with which the case begins.
    pub mgt: f64,
    /// The result.
    pub finding: Finding,
    /// Standard deviation of the reading, mm, where it is given.
    pub std: Option<f64>,
}

/// The measurements at one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Its name: that of its file.
    pub name: String,
    /// The measured quantity.
    pub measure: Measure,
    /// The measurements.
    pub measured: Vec<Measured>,
    /// Columns of its file that are not read.
    pub unused: Vec<String>,
    /// Rows of its file that are left out, and why.
    pub remarks: Vec<String>,
}

impl Site {
    /// A site without measurements.
    #[must_use]
    pub fn named(name: &str, measure: Measure) -> Self {
        Self { name: name.to_owned(), measure, measured: Vec::new(), unused: Vec::new(), remarks: Vec::new() }
    }
}

/// A file of measurements.
const COLUMNS: Columns = Columns {
    columns: &[
        Column::Needed("mgt"),
        Column::Alternative("depth_mm"),
        Column::Alternative("length_mm"),
        Column::Blank("at_least_mm"),
        Column::Blank("at_most_mm"),
        Column::Blank("std_mm"),
    ],
    largest: 1e6,
    help: "a file of measurements begins with the header mgt,depth_mm or mgt,length_mm, with at_least_mm,at_most_mm for classes (the size is then left blank or out) and std_mm for errors of reading, and has a row for each measurement",
};

/// The measurements in the CSV file `path`, each site of it: of a [list of campaigns](Campaigns)
/// each crack, otherwise one.
///
/// Errors: those of [`Campaigns::read`]; a list without a reading; otherwise those of one site: it
/// cannot be read; another header; no row; a field that is not a number; a row without a size and a
/// bound, or with both; bounds in descending order; a negative mgt; a std_mm that is not positive.
pub fn read_measured(path: &Path) -> Result<Vec<Site>, CaseErrors> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let Some(campaigns) = Campaigns::read(path)? else { return Ok(vec![read_site(path, &name)?]) };
    let measure = if campaigns.has_lengths { Measure::Length } else { Measure::Depth };
    let measured = |&(mgt, size): &(f64, CampaignSize)| {
        let finding = match size {
            CampaignSize::Size(size) => Finding::Size(size),
            CampaignSize::Class(above, up_to) => {
                Finding::Within(above.unwrap_or(f64::NEG_INFINITY), up_to.unwrap_or(f64::INFINITY))
            }
        };
        Measured { mgt, finding, std: None }
    };
    let found = campaigns.cracks.iter().filter(|crack| !crack.readings.is_empty());
    let sites: Vec<Site> = found
        .map(|crack| Site {
            measured: crack.readings.iter().map(measured).collect(),
            ..Site::named(format!("{name} {}", crack.name).trim(), measure)
        })
        .collect();
    if sites.is_empty() {
        return Err(COLUMNS.error_of_row(path, 0, "no crack has a reading in a campaign".to_owned()));
    }
    Ok(sites)
}

/// The measurements at one site, with the columns mgt and depth_mm or length_mm, and optionally
/// at_least_mm, at_most_mm and std_mm; with classes alone neither of the former. A row that copies
/// another one in all of its fields counts once.
///
/// Errors: it cannot be read; another header; no row; a field that is not a number; a row without a
/// size and a bound, or with both; bounds in descending order; a negative mgt; a std_mm that is not
/// positive.
fn read_site(path: &Path, name: &str) -> Result<Site, CaseErrors> {
    let read = COLUMNS.read_file(path)?;
    // Classes alone are classes of depth.
    let (measure, column) = if read.is_given[2] { (Measure::Length, 2) } else { (Measure::Depth, 1) };
    if read.rows.is_empty() {
        return Err(COLUMNS.error_of_row(path, 0, "no measurement follows the header".to_owned()));
    }
    let mut measured = Vec::with_capacity(read.rows.len());
    for (i, row) in read.rows.iter().enumerate() {
        let refuse = |says: String| Err(COLUMNS.error_of_row(path, i + 1, says));
        let given = |column: usize| Some(row[column]).filter(|value| !value.is_nan());
        let (at_least, at_most) = (given(3), given(4));
        let finding = match (given(column), at_least.is_some() || at_most.is_some()) {
            (Some(size), false) => Finding::Size(size),
            (None, true) => {
                let bounds = (at_least.unwrap_or(f64::NEG_INFINITY), at_most.unwrap_or(f64::INFINITY));
                if bounds.0 >= bounds.1 {
                    return refuse(format!(
                        "`at_least_mm = {}` must be less than `at_most_mm = {}`",
                        bounds.0, bounds.1
                    ));
                }
                Finding::Within(bounds.0, bounds.1)
            }
            (Some(size), true) => {
                return refuse(format!(
                    "`{} = {size}` is given beside a class: leave it blank, or both bounds",
                    measure.column()
                ));
            }
            (None, false) => {
                return refuse(format!(
                    "neither {} nor at_least_mm or at_most_mm is given",
                    measure.column()
                ));
            }
        };
        if row[0] < 0.0 {
            return refuse(format!("`mgt = {}`: must be at least 0", row[0]));
        }
        let std = given(5);
        if let Some(std) = std.filter(|std| *std <= 0.0) {
            return refuse(format!("`std_mm = {std}`: must be positive, or blank"));
        }
        if !read.copies.iter().any(|(copy, _)| *copy == i + 1) {
            measured.push(Measured { mgt: row[0], finding, std });
        }
    }
    let copied = |(copy, first): &(usize, usize)| {
        format!("{name}: row {copy} is a copy of row {first} in all of its fields and counts once")
    };
    let remarks = read.copies.iter().map(copied).collect();
    Ok(Site { measured, unused: read.unused, remarks, ..Site::named(name, measure) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_measurements() {
        let folder = std::env::temp_dir().join(format!("railcrack-measured-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let read = |text: &str| {
            let path = folder.join("m.csv");
            std::fs::write(&path, text).unwrap();
            read_measured(&path).map(|mut sites| sites.remove(0))
        };
        let of = |mgt: f64, size: f64| Measured { mgt, finding: Finding::Size(size), std: None };
        let site = read("# a rail\nmgt,length_mm\n10, 5.5\n").unwrap();
        assert_eq!((site.measure, site.measured), (Measure::Length, vec![of(10.0, 5.5)]));
        let site = read("depth_mm,mgt\n2,1\n").unwrap();
        assert_eq!((site.measure, site.measured), (Measure::Depth, vec![of(1.0, 2.0)]));
        let classes =
            "mgt,depth_mm,at_least_mm,at_most_mm,std_mm\n1,,,2.7,\n2,,0.5,1.0,0.3\n3,,2.1,,\n4,3.5,,,0.5\n";
        let site = read(classes).unwrap();
        assert_eq!(site.measured[0].finding, Finding::Within(f64::NEG_INFINITY, 2.7));
        assert_eq!(
            site.measured[1],
            Measured { mgt: 2.0, finding: Finding::Within(0.5, 1.0), std: Some(0.3) }
        );
        assert_eq!(site.measured[2].finding, Finding::Within(2.1, f64::INFINITY));
        assert_eq!(site.measured[3].std, Some(0.5));
        // Classes alone, quotes, and columns of whoever exported the table.
        let of_class = Finding::Within(1.0, 1.5);
        let site = read("mgt,at_least_mm,at_most_mm,std_mm\n6,1.0,1.5,0.3\n").unwrap();
        assert_eq!((site.measure, site.measured[0].finding), (Measure::Depth, of_class));
        let site = read("\u{feff}\"mgt\",\"depth_mm\"\r\n\"6.0\",\"1.2\"\r\n").unwrap();
        assert_eq!(site.measured, [of(6.0, 1.2)]);
        let site = read("\"\",date,mgt,operator,depth_mm\n1,2024-05-02,6,\"Doe, J.\",1.2\n").unwrap();
        assert_eq!(
            (site.measured, site.unused),
            (vec![of(6.0, 1.2)], ["date", "operator"].map(String::from).into())
        );
        // As exported from a spreadsheet with decimal commas and classes, and one column per
        // campaign.
        let site = read("mgt;depth_mm;std_mm\nMGT;mm;mm\n6,0;0,5-1,0;0,3\n11,0;1,7;\n11,0;1,7;\n").unwrap();
        assert_eq!(site.measured[0].finding, Finding::Within(0.5, 1.0));
        assert_eq!((site.measured[1], site.measured.len()), (of(11.0, 1.7), 2));
        assert_eq!(site.remarks, ["m.csv: row 3 is a copy of row 2 in all of its fields and counts once"]);
        let site = read("crack;6 MGT;11 MGT\nA;1,2;1,7\nB;;0,5\n").unwrap();
        assert_eq!((site.name.as_str(), site.measured), ("m.csv A", vec![of(6.0, 1.2), of(11.0, 1.7)]));
        for (text, line, says) in [
            ("mgt,depth_mm,std\n1,2,1\n", 1, "unknown column `std`; nearest known column: `std_mm`"),
            ("mgt,place\n1,2\n", 1, "column `depth_mm` or `length_mm` is missing; unknown column `place`"),
            ("mgt,std_mm\n1,2\n", 2, "neither depth_mm nor at_least_mm"),
            ("mgt,depth_mm\n1,\"2,5\"\n", 2, "row 1: `depth_mm = 2,5`: must be a number"),
            ("depth,mgt\n", 1, "unknown column `depth`; nearest known column: `depth_mm`"),
            ("mgt\n1\n", 1, "column `depth_mm` or `length_mm` is missing"),
            (
                "mgt,depth_mm,length_mm\n1,2,3\n",
                1,
                "column `depth_mm` or `length_mm` must be given, and only one of them",
            ),
            ("mgt,depth_mm\n1,2\n3,x\n", 3, "row 2: `depth_mm = x`: must be a number in [-1e6, 1e6]"),
            ("mgt,depth_mm\n1,2,3\n", 2, "row 1: 3 values in a row of 2 columns"),
            ("mgt,depth_mm,at_least_mm\n1,2,1\n", 2, "`depth_mm = 2` is given beside a class"),
            ("mgt,depth_mm,at_least_mm\n1,,\n", 2, "neither depth_mm nor at_least_mm"),
            ("mgt,depth_mm,at_least_mm,at_most_mm\n1,,2,1\n", 2, "`at_least_mm = 2` must be less than"),
            ("mgt,depth_mm,std_mm\n1,2,0\n", 2, "`std_mm = 0`: must be positive"),
            ("mgt,depth_mm\n1,2\n-3,2\n", 3, "`mgt = -3`: must be at least 0"),
            ("mgt,depth_mm\n", 1, "no measurement follows the header"),
        ] {
            let errors = read(text).unwrap_err();
            let error = &errors.errors()[0];
            assert!(error.message().starts_with(says) && error.file().ends_with("m.csv"), "{says}: {error}");
            assert!(
                error.help().is_some_and(|help| help.contains("mgt,depth_mm or mgt,length_mm")),
                "{text}"
            );
            assert_eq!(error.position().map(|place| place.0), Some(line), "{text}");
        }
        assert!(
            read_measured(&folder.join("none.csv"))
                .unwrap_err()
                .to_string()
                .contains("there is no such file")
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
