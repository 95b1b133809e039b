//! The tables of the figures, read: CSV whose names are in quotes where they have commas.

/// The set-up of digitised curves in tables and charts.
pub(crate) const DIGITISED: &str = "digitised";

/// A table of strings and numbers.
pub(crate) struct FigureTable {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl FigureTable {
    /// Errors: the line of a row that has not as many fields as the header.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
        let columns = lines.next().map_or_else(Vec::new, |(_, header)| fields(header));
        let mut rows = Vec::new();
        for (i, line) in lines {
            let row = fields(line);
            if row.len() != columns.len() {
                return Err(format!("line {}: {} fields", i + 1, row.len()));
            }
            rows.push(row);
        }
        Ok(Self { columns, rows })
    }

    /// The place of the column `name`; none where there is none.
    pub(crate) fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// The rows, field by field.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[String]> {
        self.rows.iter().map(Vec::as_slice)
    }
}

fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    for letter in line.chars() {
        match letter {
            // A doubled quote within quotes leaves them and comes back: none is in these names.
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            other => {
                if let Some(field) = fields.last_mut() {
                    field.push(other);
                }
            }
        }
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::fields;

    #[test]
    fn commas_in_quotes_do_not_part() {
        assert_eq!(
            fields("\"half-plane, along\",reference,1,-6.0"),
            ["half-plane, along", "reference", "1", "-6.0"]
        );
        assert_eq!(fields("a,,b"), ["a", "", "b"]);
    }
}
