//! Reading the tables of a run back.

use crate::OutputError;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// One row: the columns asked for, in the order asked for.
pub struct Row<'a> {
    path: &'a Path,
    line: usize,
    columns: &'a [&'static str],
    fields: &'a [&'a str],
}

impl Row<'_> {
    /// The text of the `i`-th column asked for.
    pub fn text(&self, i: usize) -> &str {
        self.fields[i]
    }

    /// A number that counts.
    pub fn count(&self, i: usize) -> Result<usize, OutputError> {
        self.fields[i].parse().map_err(|_| self.unreadable(i, "a whole number"))
    }

    /// A real number.
    pub fn real(&self, i: usize) -> Result<f64, OutputError> {
        let value = self.fields[i].parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.unreadable(i, "a finite number"))
    }

    /// A real number, or an empty field.
    pub fn optional(&self, i: usize) -> Result<Option<f64>, OutputError> {
        if self.fields[i].is_empty() { Ok(None) } else { self.real(i).map(Some) }
    }

    /// The error that the `i`-th column asked for should hold what is `accepted`.
    pub fn unreadable(&self, i: usize, accepted: &str) -> OutputError {
        let (line, column, found) = (self.line, self.columns[i], self.fields[i]);
        OutputError::damaged(self.path, format!("line {line}: {column} is \"{found}\", not {accepted}"))
    }
}

/// Gives the rows of the table at `path` whose step is `wanted` to `take`, with the named `columns` only. The first
/// column of the table must be the step. A last line without its end, left by a kill, is not a row.
pub fn read_steps(
    path: &Path,
    columns: &[&'static str],
    wanted: impl Fn(usize) -> bool,
    mut take: impl FnMut(&Row) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    let file = File::open(path).map_err(OutputError::io("read", path))?;
    let mut reader = BufReader::with_capacity(1 << 16, file);
    let mut text = String::new();
    let mut order: Option<Vec<usize>> = None;
    for line in 1.. {
        text.clear();
        let read = reader.read_line(&mut text).map_err(OutputError::io("read", path))?;
        if read == 0 || !text.ends_with('\n') {
            break;
        }
        let row = text.trim_end();
        if row.starts_with('#') {
            continue;
        }
        let Some(order) = &order else {
            order = Some(find_columns(path, row, columns)?);
            continue;
        };
        let step = row.split(',').next().and_then(|step| step.parse().ok());
        let step = step.ok_or_else(|| OutputError::damaged(path, format!("line {line}: no step number")))?;
        if !wanted(step) {
            continue;
        }
        let all: Vec<&str> = row.split(',').collect();
        let fields: Option<Vec<&str>> = order.iter().map(|&place| all.get(place).copied()).collect();
        let fields =
            fields.ok_or_else(|| OutputError::damaged(path, format!("line {line}: {} fields", all.len())))?;
        take(&Row { path, line, columns, fields: &fields })?;
    }
    Ok(())
}

/// The named `columns` of the table at `path`, all of them numbers, row by row. A last line without its end is not a row.
pub fn read_columns<const N: usize>(
    path: &Path,
    columns: &[&'static str; N],
) -> Result<Vec<[f64; N]>, OutputError> {
    let text = std::fs::read_to_string(path).map_err(OutputError::io("read", path))?;
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    let mut lines = whole.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
    let header = lines.next().map_or("", |(_, header)| header);
    let order = find_columns(path, header, columns)?;
    let mut rows = Vec::new();
    for (i, line) in lines {
        let all: Vec<&str> = line.split(',').collect();
        let fields: Option<Vec<&str>> = order.iter().map(|&place| all.get(place).copied()).collect();
        let missing = || OutputError::damaged(path, format!("line {}: {} fields", i + 1, all.len()));
        let row = Row { path, line: i + 1, columns, fields: &fields.ok_or_else(missing)? };
        let mut values = [0.0; N];
        for (c, value) in values.iter_mut().enumerate() {
            *value = row.real(c)?;
        }
        rows.push(values);
    }
    Ok(rows)
}

/// The rows of one step as they stand in a table.
pub struct StepBlock<'a> {
    path: &'a Path,
    columns: &'a [&'static str],
    order: Vec<usize>,
    /// Number of its first line in the table.
    line: usize,
    /// The step.
    pub step: usize,
    text: String,
}

impl StepBlock<'_> {
    /// Gives the rows to `take`, with the columns asked for only.
    pub fn rows(&self, mut take: impl FnMut(&Row) -> Result<(), OutputError>) -> Result<(), OutputError> {
        let mut all = Vec::with_capacity(16);
        let mut fields = Vec::with_capacity(self.order.len());
        for (i, row) in self.text.lines().enumerate() {
            let line = self.line + i;
            all.clear();
            all.extend(row.split(','));
            fields.clear();
            for &place in &self.order {
                let field = all.get(place).copied();
                let missing =
                    || OutputError::damaged(self.path, format!("line {line}: {} fields", all.len()));
                fields.push(field.ok_or_else(missing)?);
            }
            take(&Row { path: self.path, line, columns: self.columns, fields: &fields })?;
        }
        Ok(())
    }
}

/// Gives the rows of the table at `path` step by step, of the steps that are `wanted`, to `take`: blocks can be read by
/// several threads. Rules as for [`read_steps`]; the rows of a step must stand together.
pub fn read_step_blocks<'a>(
    path: &'a Path,
    columns: &'a [&'static str],
    wanted: impl Fn(usize) -> bool,
    mut take: impl FnMut(StepBlock<'a>) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    let file = File::open(path).map_err(OutputError::io("read", path))?;
    let mut reader = BufReader::with_capacity(1 << 18, file);
    let mut order: Option<Vec<usize>> = None;
    let mut block: Option<StepBlock> = None;
    let mut text = String::new();
    for line in 1.. {
        text.clear();
        let read = reader.read_line(&mut text).map_err(OutputError::io("read", path))?;
        if read == 0 || !text.ends_with('\n') {
            break;
        }
        if text.starts_with('#') {
            continue;
        }
        let Some(order) = &order else {
            order = Some(find_columns(path, text.trim_end(), columns)?);
            continue;
        };
        let step = text.split(',').next().and_then(|step| step.parse().ok());
        let step = step.ok_or_else(|| OutputError::damaged(path, format!("line {line}: no step number")))?;
        if let Some(finished) = block.take_if(|block| block.step != step) {
            take(finished)?;
        }
        if wanted(step) {
            let new = || StepBlock { path, columns, order: order.clone(), line, step, text: String::new() };
            block.get_or_insert_with(new).text.push_str(&text);
        }
    }
    block.map_or(Ok(()), take)
}

fn find_columns(path: &Path, header: &str, columns: &[&'static str]) -> Result<Vec<usize>, OutputError> {
    let present: Vec<&str> = header.split(',').collect();
    let place = |column: &&'static str| {
        let found = present.iter().position(|name| name == column);
        found.ok_or_else(|| OutputError::damaged(path, format!("no column {column}")))
    };
    columns.iter().map(place).collect()
}
