//! Tables of results, each declared once: columns with their meaning, rows, writer and reader.

use super::column::Column;
use super::columns::Columns;
use super::fields::Fields;
use super::rows::Rows;
use crate::disk::VERSION;
use crate::error::OutputError;
use railcrack::contact::FaceStatus;
use railcrack::growth::{Jump, MOST_WHEELS, RunStop, WheelShares};
use railcrack::math::{Stress, Tensor};
use railcrack::shakedown::PlasticStrain;
use railcrack::words::Choice;

/// A row of a table; `table!` declares its struct, columns, writer and reader
/// together.
pub trait Table: Sized {
    /// File of the table.
    const FILE: &'static str;
    /// Lines before the column names, without `#`.
    const COMMENTS: &'static [&'static str];
    /// Columns, from left to right. New ones come after the old.
    const COLUMNS: &'static [Column];

    /// Writes the fields of this row.
    fn put(&self, rows: &mut Rows);

    /// Appends the fields of this row to `columns`.
    fn keep(&self, columns: &mut Columns);

    /// Reads a row.
    ///
    /// Errors: a field is missing or not what its column holds.
    fn take(fields: &mut Fields) -> Result<Self, OutputError>;
}

/// The columns of a table in a run whose case has `sections`.
pub fn column_names<T: Table>(sections: &[&str]) -> Vec<&'static str> {
    T::COLUMNS.iter().filter(|column| column.is_there(sections)).map(|column| column.name).collect()
}

/// Comment lines, then the column names.
pub(crate) fn header<T: Table>(sections: &[&str]) -> String {
    header_of(T::COMMENTS, &column_names::<T>(sections))
}

pub(crate) fn header_of(comments: &[&str], columns: &[&str]) -> String {
    let mut text = format!("# railcrack {VERSION}\n");
    for comment in comments {
        text += &format!("# {comment}\n");
    }
    text + &columns.join(",") + "\n"
}

/// A whole table of a run whose case has `sections`.
///
/// Errors: a number that is not finite.
pub(crate) fn table_text<T: Table>(
    sections: &[&'static str],
    content: impl IntoIterator<Item = T>,
) -> Result<String, OutputError> {
    let mut rows = Rows::with_sections(sections);
    content.into_iter().for_each(|row| row.put(&mut rows));
    Ok(header::<T>(sections) + &String::from_utf8_lossy(rows.text(T::FILE)?))
}

/// A whole table.
///
/// Errors: a number that is not finite.
pub(crate) fn whole<T: Table>(content: impl IntoIterator<Item = T>) -> Result<Vec<u8>, OutputError> {
    let mut rows = Rows::default();
    content.into_iter().for_each(|row| row.put(&mut rows));
    Ok([header::<T>(&[]).as_bytes(), rows.text(T::FILE)?].concat())
}

/// The columns of a table as a table of Markdown; columns with the same meaning share a line.
pub(crate) fn markdown<T: Table>() -> String {
    let mut lines: Vec<(Vec<String>, String)> = Vec::new();
    for column in T::COLUMNS {
        let (name, meaning) = (format!("`{}`", column.name), sentence(column.meaning));
        match lines.iter_mut().find(|(_, known)| *known == meaning) {
            Some((names, _)) => names.push(name),
            None => lines.push((vec![name], meaning)),
        }
    }
    let shown = |names: &[String]| match names {
        [first, second, .., _] if names.len() > 8 => format!("{first}, {second}, …"),
        _ => names.join(", "),
    };
    let line = |(names, meaning): &(Vec<String>, String)| format!("| {} | {meaning} |\n", shown(names));
    lines.iter().map(line).fold("| column | meaning |\n|---|---|\n".to_owned(), |page, line| page + &line)
}

/// A doc comment as a cell of a page: one line, without the full stop, small where it begins with a
/// common word.
fn sentence(lines: &[&str]) -> String {
    let text: Vec<&str> = lines.iter().map(|line| line.trim()).collect();
    let text = text.join(" ");
    let text = text.strip_suffix('.').unwrap_or(&text);
    let mut letters = text.chars();
    match (letters.next(), letters.clone().next()) {
        (Some(first), Some(' ' | 'a'..='z')) => first.to_lowercase().chain(letters).collect(),
        _ => text.to_owned(),
    }
}

/// A value that takes one or more fields of a row.
pub trait Cell: Sized {
    /// Writes it into `columns`.
    fn put(&self, rows: &mut Rows, columns: &[&'static str]);

    /// Appends it, or a missing value, to the next of `columns`.
    fn keep(value: Option<&Self>, columns: &mut Columns);

    /// Reads it from the next fields.
    ///
    /// Errors: they do not hold it.
    fn take(fields: &mut Fields) -> Result<Self, OutputError>;
}

impl Cell for usize {
    fn put(&self, rows: &mut Rows, _: &[&'static str]) {
        rows.count(*self);
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        columns.count(value.copied());
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        fields.parse("a whole number", |text| text.parse().ok())
    }
}

impl Cell for f64 {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        rows.real(columns[0], *self);
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        columns.real(value.copied());
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        fields.parse("a finite number", |text| text.parse().ok().filter(|value: &Self| value.is_finite()))
    }
}

impl Cell for String {
    fn put(&self, rows: &mut Rows, _: &[&'static str]) {
        rows.quoted(self);
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        columns.text(value.map(String::as_str));
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        fields.parse("text", |text| Some(text.to_owned()))
    }
}

/// Choices, written and read by their words.
macro_rules! words {
    ($($choice:ty),+) => {$(
        impl Cell for $choice {
            fn put(&self, rows: &mut Rows, _: &[&'static str]) {
                rows.name(self.word());
            }

            fn keep(value: Option<&Self>, columns: &mut Columns) {
                let code =
                    |value: &Self| Self::WORDS.iter().position(|(_, word)| word.name == value.word());
                columns.word(value.and_then(code), || Self::WORDS.iter().map(|(_, word)| word.name).collect());
            }

            fn take(fields: &mut Fields) -> Result<Self, OutputError> {
                fields.parse(&Self::accepted(), Self::of_word)
            }
        }
    )+};
}

words!(FaceStatus, RunStop, Jump);

/// Empty where there is none.
impl<T: Cell> Cell for Option<T> {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        match self {
            Some(value) => value.put(rows, columns),
            None => rows.name(""),
        }
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        T::keep(value.and_then(Option::as_ref), columns);
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        if fields.skip_empty() { Ok(None) } else { T::take(fields).map(Some) }
    }
}

/// Components xx, yy, zz, yz, xz, xy.
impl Cell for Tensor {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        self.entries().put(rows, columns);
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        Cell::keep(value.map(|own| own.entries()).as_ref(), columns);
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        Cell::take(fields).map(Self::of)
    }
}

/// Components xx, yy, zz, xy.
impl Cell for Stress {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        [self.xx, self.yy, self.zz, self.xy].put(rows, columns);
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        Cell::keep(value.map(|s| [s.xx, s.yy, s.zz, s.xy]).as_ref(), columns);
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        let [xx, yy, zz, xy] = Cell::take(fields)?;
        Ok(Self { xx, yy, zz, xy })
    }
}

/// Components xx, yy, zz, xy of the tensor.
impl Cell for PlasticStrain {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        [self.xx, self.yy, self.zz, self.xy].put(rows, columns);
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        Cell::keep(value.map(|s| [s.xx, s.yy, s.zz, s.xy]).as_ref(), columns);
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        let [xx, yy, zz, xy] = Cell::take(fields)?;
        Ok(Self { xx, yy, zz, xy })
    }
}

/// One field for each wheel; a single wheel has the whole growth.
impl Cell for WheelShares {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        let count = self.values().len().max(1);
        for (wheel, column) in columns.iter().take(count).enumerate() {
            rows.real(column, self.values().get(wheel).copied().unwrap_or(1.0));
        }
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        let values = value.map_or(&[][..], Self::values);
        for i in 0..MOST_WHEELS {
            columns.real(values.get(i).copied());
        }
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        let values: Result<Vec<Option<f64>>, OutputError> =
            (0..MOST_WHEELS).map(|_| Cell::take(fields)).collect();
        Ok(Self::from_values(&values?.into_iter().flatten().collect::<Vec<f64>>()))
    }
}

/// A field for each.
impl<T: Cell, const N: usize> Cell for [T; N] {
    fn put(&self, rows: &mut Rows, columns: &[&'static str]) {
        for (value, column) in self.iter().zip(columns) {
            value.put(rows, std::slice::from_ref(column));
        }
    }

    fn keep(value: Option<&Self>, columns: &mut Columns) {
        for i in 0..N {
            T::keep(value.map(|values| &values[i]), columns);
        }
    }

    fn take(fields: &mut Fields) -> Result<Self, OutputError> {
        let values: Result<Vec<T>, OutputError> = (0..N).map(|_| T::take(fields)).collect();
        values?.try_into().map_err(|_| fields.unreadable("a row"))
    }
}

/// Declares a table: the struct of its rows with the columns of each field, and all that follows
/// from it ([`Table`]). The doc comment of a field is what the columns mean in
/// `docs/file-formats.md`. A field of one section of the case is an `Option` and ends in `, with
/// "section"`.
macro_rules! table {
    (
        $(#[$attribute:meta])*
        pub struct $row:ident in $file:literal, [$($comment:literal),* $(,)?] {
            $(
                $(#[doc = $meaning:literal])+
                $field:ident: $kind:ty = $($column:literal)+ $(, with $section:literal)?;
            )+
        }
    ) => {
        $(#[$attribute])*
        pub struct $row {
            $($(#[doc = $meaning])+ pub $field: $kind,)+
        }

        impl $crate::csv::Table for $row {
            const FILE: &'static str = $file;
            const COMMENTS: &'static [&'static str] = &[$($comment),*];
            const COLUMNS: &'static [$crate::csv::Column] = $crate::csv::table!(@flat
                [] $([[$($meaning),+] [$($section)?] $($column)+])+);

            fn put(&self, rows: &mut $crate::csv::Rows) {
                $(if true $(&& rows.has($section))? {
                    $crate::csv::Cell::put(&self.$field, rows, &[$($column),+]);
                })+
                rows.end();
            }

            fn keep(&self, columns: &mut $crate::csv::Columns) {
                $($crate::csv::Cell::keep(Some(&self.$field), columns);)+
            }

            fn take(fields: &mut $crate::csv::Fields) -> Result<Self, $crate::error::OutputError> {
                Ok(Self { $($field: $crate::csv::Cell::take(fields)?,)+ })
            }
        }
    };
    (@flat [$($done:tt)*]) => { &[$($done)*] };
    (@flat [$($done:tt)*] [$meaning:tt $section:tt] $($rest:tt)*) => {
        $crate::csv::table!(@flat [$($done)*] $($rest)*)
    };
    (@flat [$($done:tt)*] [$meaning:tt $section:tt $column:literal $($more:literal)*] $($rest:tt)*) => {
        $crate::csv::table!(@flat [
            $($done)*
            $crate::csv::Column { name: $column, meaning: &$meaning, section: $crate::csv::table!(@section $section) },
        ] [$meaning $section $($more)*] $($rest)*)
    };
    (@section []) => { None };
    (@section [$section:literal]) => { Some($section) };
}

pub(crate) use table;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csv::read_table;

    table! {
        /// A row with a column of its own for one section.
        #[derive(Debug, Clone, PartialEq)]
        pub struct Fluid in "fluid.csv", ["a comment"] {
            /// Step, crack and tip.
            step: usize = "step";
            /// Step, crack and tip.
            tip: usize = "tip";
            /// K_I, MPa√m.
            ki: f64 = "ki_mpa_sqrt_m";
            /// Pressure of the fluid at the
            /// mouth, MPa.
            fluid: Option<f64> = "fluid_mpa", with "fluid";
        }
    }

    fn text(rows: &[Fluid], sections: &'static [&'static str]) -> String {
        let mut text = Rows::with_sections(sections);
        rows.iter().for_each(|row| row.put(&mut text));
        header::<Fluid>(sections) + std::str::from_utf8(text.text(Fluid::FILE).unwrap()).unwrap()
    }

    #[test]
    fn a_section_brings_its_column_behind_the_others() {
        let rows = [(1, Some(6.0)), (2, None)].map(|(tip, fluid)| Fluid { step: 0, tip, ki: 1e-7, fluid });
        let with = text(&rows, &["fluid"]);
        assert!(with.ends_with("step,tip,ki_mpa_sqrt_m,fluid_mpa\n0,1,1e-7,6.0\n0,2,1e-7,\n"), "{with}");
        let without = text(&rows, &[]);
        assert!(without.ends_with("# a comment\nstep,tip,ki_mpa_sqrt_m\n0,1,1e-7\n0,2,1e-7\n"), "{without}");
        let folder = std::env::temp_dir().join(format!("railcrack-table-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for (text, fluid) in [(with, Some(6.0)), (without, None)] {
            std::fs::write(folder.join(Fluid::FILE), text).unwrap();
            let read: Vec<Fluid> = read_table(&folder).unwrap();
            assert_eq!(read, [Fluid { fluid, ..rows[0].clone() }, rows[1].clone()]);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn the_page_has_a_line_for_each_meaning() {
        assert_eq!(
            markdown::<Fluid>(),
            "| column | meaning |\n|---|---|\n| `step`, `tip` | step, crack and tip |\n\
             | `ki_mpa_sqrt_m` | K_I, MPa√m |\n| `fluid_mpa` | pressure of the fluid at the mouth, MPa |\n"
        );
    }
}
