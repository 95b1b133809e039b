//! Parts of a description: rows with a name, a text and the numbers in it.

use crate::numbers::short;
use serde_json::{Map, Value, json};

/// A heading with its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// In lower case.
    pub heading: String,
    /// In the order in which they are read.
    pub rows: Vec<Row>,
}

/// A row of a [`Part`].
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Empty for a line of a table and for a remark.
    pub name: &'static str,
    /// In ASCII but for formulas, with units.
    pub text: String,
    /// The numbers in the text.
    pub numbers: Vec<Number>,
}

/// A number in a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// Empty for the only number of a row.
    pub key: &'static str,
    /// In `unit`.
    pub value: f64,
    /// Empty for a number without a unit.
    pub unit: &'static str,
}

impl Part {
    /// A part with the heading `heading`.
    pub(super) fn new(heading: impl Into<String>, rows: Vec<Row>) -> Self {
        Self { heading: heading.into(), rows }
    }

    /// The numbers of named rows, and the texts of those without numbers, by the names of the rows.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let mut rows = Map::new();
        for row in self.rows.iter().filter(|row| !row.name.is_empty()) {
            // Several wheels, cracks or patches have rows of one name.
            match rows.get_mut(row.name) {
                Some(Value::Array(all)) => all.push(row.to_json()),
                Some(first) => *first = json!([first.take(), row.to_json()]),
                None => drop(rows.insert(row.name.to_owned(), row.to_json())),
            }
        }
        Value::Object(rows)
    }
}

impl Row {
    /// A row without numbers.
    pub(super) fn text(name: &'static str, text: impl Into<String>) -> Self {
        Self { name, text: text.into(), numbers: Vec::new() }
    }

    /// A line of a table, or a remark.
    pub(super) fn line(text: impl Into<String>) -> Self {
        Self::text("", text)
    }

    /// A row of one number.
    pub(super) fn number(name: &'static str, value: f64, unit: &'static str) -> Self {
        let number = Number { key: "", value, unit };
        Self { name, text: number.written(), numbers: vec![number] }
    }

    /// A row whose `text` has a place `{key}` for each of `numbers` (key, value and unit); a place
    /// `{key:}` is without the unit.
    pub(super) fn with<const N: usize>(
        name: &'static str,
        text: &str,
        numbers: [(&'static str, f64, &'static str); N],
    ) -> Self {
        let mut text = text.to_owned();
        let number = |(key, value, unit): (&'static str, f64, &'static str)| {
            let number = Number { key, value, unit };
            text = text.replace(&format!("{{{key}:}}"), &short(value));
            text = text.replace(&format!("{{{key}}}"), &number.written());
            number
        };
        let numbers = numbers.map(number).to_vec();
        Self { name, text, numbers }
    }

    /// The row with the name of its `subject`, as a user wrote it, before its text.
    pub(super) fn about(mut self, subject: &str) -> Self {
        self.text = format!("{subject}: {}", self.text);
        self
    }

    fn to_json(&self) -> Value {
        match self.numbers.as_slice() {
            [] => self.text.as_str().into(),
            [only] => only.to_json(),
            several => several.iter().map(|number| (number.key.to_owned(), number.to_json())).collect(),
        }
    }
}

impl Number {
    fn written(&self) -> String {
        let space = if self.unit.is_empty() { "" } else { " " };
        format!("{}{space}{}", short(self.value), self.unit)
    }

    fn to_json(self) -> Value {
        if self.unit.is_empty() {
            json!(self.value)
        } else {
            json!({ "value": self.value, "unit": self.unit })
        }
    }
}

/// `parts` as one object: numbers with their units, by heading and name.
#[must_use]
pub fn parts_json(parts: &[Part]) -> Value {
    let filled = parts.iter().map(|part| (part.heading.clone(), part.to_json()));
    filled.filter(|(_, rows)| rows.as_object().is_some_and(|rows| !rows.is_empty())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_in_the_text_and_in_the_object() {
        let row = Row::with("ellipse", "a = {a:} to {a}, ratio {b/a}", [("a", 6.75, "mm"), ("b/a", 1.5, "")]);
        assert_eq!(row.text, "a = 6.75 to 6.75 mm, ratio 1.5");
        let named = Row::with("wheel", "{share} of the axles", [("share", 70.0, "%")]).about("{share}");
        assert_eq!(named.text, "{share}: 70 % of the axles", "a name is no place of a number");
        let part = Part::new("contact", vec![row, Row::number("p0", 845.0, "MPa"), Row::line("a remark")]);
        let want = json!({ "contact": {
            "ellipse": { "a": { "value": 6.75, "unit": "mm" }, "b/a": 1.5 },
            "p0": { "value": 845.0, "unit": "MPa" },
        } });
        assert_eq!(parts_json(&[part]), want);
    }

    #[test]
    fn rows_of_one_name_are_a_list() {
        let rows = [1.0, 2.0, 3.0].map(|value| Row::number("wheel", value, "kN"));
        assert_eq!(Part::new("mix", rows.to_vec()).to_json()["wheel"][2]["value"], 3.0);
    }
}
