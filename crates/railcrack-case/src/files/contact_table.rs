//! Measured or computed contact of wheel and rail: CSV files, and the output of CONTACT.

use super::columns::{Column, Columns, LARGEST};
use super::companion::{ContactFile, read_named};
use super::contact_mat::{is_contact_output, strip};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use railcrack::load::{ContactRow, ContactTableError, TableContact, Travel};
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("u_mm"), Column::Needed("p_mpa"), Column::Needed("q_mpa")],
    largest: LARGEST,
    help: "a contact table begins with the header u_mm,p_mpa,q_mpa and has a row per position from -x to +x; u is measured from the wheel centre, and pressure and shear are zero in the first and last rows",
};

/// Options for reading a contact from its file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactReading {
    /// |q| ≤ μ p is required where μ is given.
    pub friction: Option<f64>,
    /// The strip to read from a file with several, in mm from the middle of the contact; none if
    /// not given.
    pub lateral: Option<f64>,
    /// Direction of travel of the wheel: x in such a file is the direction of rolling.
    pub travel: Travel,
}

/// The contact in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_contact_table(
    section: &SectionValues,
    row: KeyRow<String>,
    reading: ContactReading,
    folder: &Path,
    report: &mut Report,
) -> Option<ContactFile> {
    read_named(section, row, folder, report, &COLUMNS, |source| parse(source, reading))
}

fn parse(source: &Source, reading: ContactReading) -> Result<TableContact, Box<Fault>> {
    let ContactReading { friction, lateral, travel } = reading;
    if is_contact_output(&source.text) {
        let rows = strip(source, lateral.unwrap_or(0.0), travel)?;
        return TableContact::new(rows, friction).map_err(|error| {
            Box::new(Fault {
                span: Some(0..0),
                ..Fault::new(format!("the strip is not a valid contact: {error}"))
            })
        });
    }
    if let Some(lateral) = lateral {
        let message = format!(
            "a CSV file holds a single strip, but strip_mm = {lateral} chooses among those of a .mat file of CONTACT"
        );
        return Err(COLUMNS.fault(message, &(0..0)));
    }
    let read = COLUMNS.read(source)?;
    let rows =
        read.rows.iter().map(|row| ContactRow { u: row[0], pressure: row[1], shear: row[2] }).collect();
    TableContact::new(rows, friction).map_err(|error| {
        let (row, message) = match error {
            ContactTableError::Row { row, reason } => (row, reason.to_string()),
            other => (0, other.to_string()),
        };
        COLUMNS.fault_of_row(&read, row, message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str, friction: Option<f64>) -> Result<TableContact, String> {
        let reading = ContactReading { friction, lateral: None, travel: Travel::Forward };
        parse(&Source::new("c.csv", text), reading).map_err(|fault| fault.message)
    }

    #[test]
    fn columns_are_found_by_name() {
        let table = parsed("# measured\nq_mpa,u_mm,p_mpa\n0,-5,0\n-20, 0.5, 800\r\n\n0,5,0\n", None).unwrap();
        assert_eq!(table.rows()[1], ContactRow { u: 0.5, pressure: 800.0, shear: -20.0 });
        assert_eq!(table.half_width(), 5.0);
    }

    #[test]
    fn refused_with_row_and_value() {
        let refused = |text: &str| parsed(text, Some(0.3)).unwrap_err();
        assert!(
            refused("u_mm,p_mpa,q_mpa\n0,0,0\n1,-5,0\n2,0,0\n").starts_with("p_mpa = -5: must be zero or")
        );
        assert!(refused("u_mm,p_mpa,q_mpa\n0,0,0\n0,5,0\n2,0,0\n").starts_with("u_mm = 0: must be greater"));
        assert!(refused("u_mm,p_mpa,q_mpa\n0,0,0\n1,5,2\n2,0,0\n").contains("at most the given friction"));
        assert!(refused("u_mm,p_mpa,q_mpa\n0,0,0\n").starts_with("rows = 1"));
        assert!(refused("u_mm,p_mpa\n0,0\n").contains("`q_mpa` is missing"));
        assert!(refused("u_mm,p_mpa,q\n0,0,0\n").contains("nearest known column: `q_mpa`"));
        assert!(refused("u_mm,p_mpa,q_mpa\n0,0\n").contains("2 values in a row of 3"));
        assert!(refused("u_mm,p_mpa,q_mpa\n0,nan,0\n").contains("`p_mpa = nan`: must be a number"));
        assert!(refused("").contains("empty"));
    }
}
