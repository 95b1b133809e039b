//! A whole table, column by column.

use super::column::Column;
use super::columns::{ColumnValues, Columns};
use super::table::Table;

/// The columns of `rows` of a run whose case has `sections`; where these are not known (none),
/// columns of a section that no row has a value of are left out.
///
/// Errors: the first row that is one.
pub fn columns_of<T: Table, E>(
    rows: impl Iterator<Item = Result<T, E>>,
    sections: Option<&[&str]>,
) -> Result<Vec<(&'static Column, ColumnValues)>, E> {
    let mut columns = Columns::default();
    for row in rows {
        columns.begin_row();
        row?.keep(&mut columns);
    }
    let mut values = columns.into_values();
    values.resize_with(T::COLUMNS.len(), || ColumnValues::Reals(Vec::new()));
    let is_there = |(column, values): &(&'static Column, ColumnValues)| match sections {
        Some(sections) => column.is_there(sections),
        None => column.section.is_none() || values.has_any(),
    };
    Ok(T::COLUMNS.iter().zip(values).filter(is_there).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csv::table;
    use railcrack::contact::FaceStatus;
    use railcrack::growth::RunStop;
    use railcrack::words::Choice;
    use std::convert::Infallible;

    table! {
        /// A row with every kind of column.
        #[derive(Debug, Clone, PartialEq)]
        pub struct Every in "every.csv", [] {
            /// A number that counts.
            step: usize = "step";
            /// A number that may be missing.
            passages: Option<usize> = "passages";
            /// Two numbers.
            place: [f64; 2] = "x_mm" "y_mm";
            /// A number that may be missing.
            angle: Option<f64> = "angle_deg";
            /// A choice.
            status: FaceStatus = "status";
            /// A text that may be missing.
            reason: Option<String> = "reason";
            /// A number of a section.
            fluid: Option<f64> = "fluid_mpa", with "fluid";
        }
    }

    #[test]
    fn every_field_goes_to_its_column() {
        let row = |step, fluid| Every {
            step,
            passages: (step == 1).then_some(3),
            place: [0.5, -2.0],
            angle: (step == 0).then_some(70.5),
            status: FaceStatus::Slip,
            reason: (step == 0).then(|| "none".into()),
            fluid,
        };
        let of = |fluid| columns_of([row(0, None), row(1, fluid)].map(Ok::<_, Infallible>).into_iter(), None);
        let Ok(columns) = of(Some(6.0));
        let names: Vec<&str> = columns.iter().map(|(column, _)| column.name).collect();
        assert_eq!(names, ["step", "passages", "x_mm", "y_mm", "angle_deg", "status", "reason", "fluid_mpa"]);
        // As text, in which two NaN are equal.
        let values: Vec<String> = columns.iter().map(|(_, values)| format!("{values:?}")).collect();
        assert_eq!(
            values,
            [
                "Counts([0, 1])",
                "Reals([NaN, 3.0])",
                "Reals([0.5, 0.5])",
                "Reals([-2.0, -2.0])",
                "Reals([70.5, NaN])",
                "Words { codes: [2, 2], words: [\"open\", \"stick\", \"slip\"] }",
                "Texts([\"none\", \"\"])",
                "Reals([NaN, 6.0])",
            ]
        );
        let Ok(without) = of(None);
        assert_eq!(without.len(), 7);
        let Ok(asked) = columns_of([Ok::<_, Infallible>(row(0, None))].into_iter(), Some(&["fluid"]));
        assert_eq!(asked.len(), 8);
    }
    table! {
        /// A stop alone.
        #[derive(Debug, Clone, PartialEq)]
        pub struct Stop in "stop.csv", [] {
            /// Why the run ended.
            stop: Option<RunStop> = "stop";
        }
    }

    #[test]
    fn every_stop_has_its_word_and_every_word_is_there_once() {
        let stops = RunStop::WORDS.iter().map(|(stop, _)| Some(*stop)).chain([None]);
        let Ok(columns) = columns_of(stops.map(|stop| Ok::<_, Infallible>(Stop { stop })), None);
        let [(_, ColumnValues::Words { codes, words })] = columns.as_slice() else {
            panic!("a column of words")
        };
        for ((_, word), &code) in RunStop::WORDS.iter().zip(codes) {
            assert_eq!(words[usize::try_from(code).unwrap()], word.name);
        }
        assert_eq!(codes.last(), Some(&-1));
        let mut sorted = words.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(sorted.len(), words.len());
    }
}
