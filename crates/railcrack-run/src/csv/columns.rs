//! Tables as columns of numbers and words, for programs that compute with them.

/// The values of a column, row by row.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Numbers that count.
    Counts(Vec<i64>),
    /// Real numbers; NaN where there is none.
    Reals(Vec<f64>),
    /// Choices.
    Words {
        /// Index into `words`; −1 where there is none.
        codes: Vec<i32>,
        /// The words of all choices.
        words: Vec<&'static str>,
    },
    /// Texts; empty where there is none.
    Texts(Vec<String>),
}

/// A table under construction, column by column.
#[derive(Debug, Default)]
pub struct Columns {
    values: Vec<ColumnValues>,
    /// The column for the next value.
    next: usize,
}

impl Columns {
    /// Begins a row.
    pub(super) fn begin_row(&mut self) {
        self.next = 0;
    }

    /// The columns as far as there are rows.
    pub(super) fn into_values(self) -> Vec<ColumnValues> {
        self.values.into_iter().map(ColumnValues::with_distinct_words).collect()
    }

    /// The column of the next value, made by `new` for the first row.
    fn next(&mut self, new: impl FnOnce() -> ColumnValues) -> &mut ColumnValues {
        let at = self.next;
        self.next += 1;
        if at == self.values.len() {
            self.values.push(new());
        }
        &mut self.values[at]
    }

    /// A number that counts, or none.
    pub(super) fn count(&mut self, value: Option<usize>) {
        let column = self.next(|| ColumnValues::Counts(Vec::new()));
        match (column, value.and_then(|value| i64::try_from(value).ok())) {
            (ColumnValues::Counts(values), Some(value)) => values.push(value),
            (ColumnValues::Reals(values), value) => values.push(value.map_or(f64::NAN, |value| value as f64)),
            // An integer cannot represent a missing value.
            (column @ ColumnValues::Counts(_), None) => {
                if let ColumnValues::Counts(values) = column {
                    let reals = values.iter().map(|&value| value as f64).chain([f64::NAN]).collect();
                    *column = ColumnValues::Reals(reals);
                }
            }
            _ => {}
        }
    }

    /// A real number, or none.
    pub(super) fn real(&mut self, value: Option<f64>) {
        if let ColumnValues::Reals(values) = self.next(|| ColumnValues::Reals(Vec::new())) {
            values.push(value.unwrap_or(f64::NAN));
        }
    }

    /// One of `choices`, by its index, or none.
    pub(super) fn word(&mut self, code: Option<usize>, choices: impl FnOnce() -> Vec<&'static str>) {
        let new = || ColumnValues::Words { codes: Vec::new(), words: choices() };
        if let ColumnValues::Words { codes, .. } = self.next(new) {
            codes.push(code.and_then(|code| i32::try_from(code).ok()).unwrap_or(-1));
        }
    }

    /// A text, or none.
    pub(super) fn text(&mut self, value: Option<&str>) {
        if let ColumnValues::Texts(values) = self.next(|| ColumnValues::Texts(Vec::new())) {
            values.push(value.unwrap_or_default().to_owned());
        }
    }
}

impl ColumnValues {
    /// The same with every word once: several choices may share one, and codes are those of the
    /// first.
    fn with_distinct_words(self) -> Self {
        let Self::Words { codes, words } = self else { return self };
        let mut distinct: Vec<&'static str> = Vec::new();
        let mut new_codes: Vec<i32> = Vec::new();
        for word in words {
            let at = distinct.iter().position(|known| *known == word).unwrap_or_else(|| {
                distinct.push(word);
                distinct.len() - 1
            });
            new_codes.push(at as i32);
        }
        let code = |code: i32| usize::try_from(code).map_or(-1, |code| new_codes[code]);
        Self::Words { codes: codes.into_iter().map(code).collect(), words: distinct }
    }

    /// Whether a row has a value.
    pub(super) fn has_any(&self) -> bool {
        match self {
            Self::Counts(values) => !values.is_empty(),
            Self::Reals(values) => values.iter().any(|value| !value.is_nan()),
            Self::Words { codes, .. } => codes.iter().any(|&code| code >= 0),
            Self::Texts(values) => values.iter().any(|value| !value.is_empty()),
        }
    }
}
