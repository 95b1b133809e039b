//! Reading the tables of a run back, step by step.

use super::fields::Layout;
use super::table::Table;
use crate::error::OutputError;
use railcrack_case::open_regular;
use std::fmt;
use std::io::{BufRead, BufReader, Cursor};
use std::marker::PhantomData;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// The whole lines of a table behind its header. A last line without its end, left by a kill, is
/// not a row.
struct Lines {
    layout: Arc<Layout>,
    reader: Box<dyn BufRead + Send>,
    line: usize,
    text: String,
}

impl fmt::Debug for Lines {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.debug_struct("Lines").field("layout", &self.layout).field("line", &self.line).finish()
    }
}

impl Lines {
    fn open<T: Table>(path: &Path) -> Result<Self, OutputError> {
        let file = open_regular(path).map_err(OutputError::io("read", path))?;
        Self::of::<T>(path, Box::new(BufReader::with_capacity(1 << 18, file)))
    }

    /// The lines of `reader`, which errors call `path`.
    fn of<T: Table>(path: &Path, reader: Box<dyn BufRead + Send>) -> Result<Self, OutputError> {
        let layout = Arc::new(Layout::of(path, &[], "")?);
        let mut lines = Self { layout, reader, line: 0, text: String::new() };
        let header = lines.advance()?.then(|| lines.text.trim_end().to_owned());
        // A run that was killed before the header stood there has no row.
        if let Some(header) = header {
            lines.layout = Arc::new(Layout::of(path, T::COLUMNS, &header)?);
        }
        Ok(lines)
    }

    /// Reads the next line that is not a comment into `text`; false at the end.
    fn advance(&mut self) -> Result<bool, OutputError> {
        loop {
            self.text.clear();
            self.line += 1;
            let read = self.reader.read_line(&mut self.text);
            let read = read.map_err(OutputError::io("read", &self.layout.path))?;
            if read == 0 || !self.text.ends_with('\n') {
                return Ok(false);
            }
            if !self.text.starts_with('#') {
                return Ok(true);
            }
        }
    }
}

/// All rows of the table in `folder`.
///
/// Errors: the table is damaged; the system refuses.
pub fn read_table<T: Table>(folder: &Path) -> Result<Vec<T>, OutputError> {
    let mut lines = Lines::open::<T>(&folder.join(T::FILE))?;
    let mut rows = Vec::new();
    while lines.advance()? {
        rows.push(T::take(&mut lines.layout.fields(lines.line, lines.text.trim_end(), &mut Vec::new())?)?);
    }
    Ok(rows)
}

/// The rows of one growth step as they stand in a table: several threads can read blocks at once.
#[derive(Debug)]
pub struct StepBlock<T> {
    layout: Arc<Layout>,
    /// Number of its first line in the table.
    line: usize,
    /// The growth step.
    pub step: usize,
    text: String,
    row: PhantomData<fn() -> T>,
}

impl<T: Table> StepBlock<T> {
    /// Its rows, each an error where it is damaged.
    pub fn rows(&self) -> impl Iterator<Item = Result<T, OutputError>> {
        let row =
            |(i, text)| T::take(&mut self.layout.fields(self.line + i, text, &mut Vec::with_capacity(16))?);
        self.text.lines().enumerate().map(row)
    }
}

/// A table whose first column is the growth step, read step by step: the rows of a step stand
/// together.
#[derive(Debug)]
pub struct StepBlocks<T> {
    lines: Lines,
    steps: Range<usize>,
    next: Option<StepBlock<T>>,
}

impl<T: Table> StepBlocks<T> {
    /// The table in the run folder `folder`, of the growth steps `steps`.
    ///
    /// Errors: a column is missing; the system refuses.
    pub fn open(folder: &Path, steps: Range<usize>) -> Result<Self, OutputError> {
        Ok(Self { lines: Lines::open::<T>(&folder.join(T::FILE))?, steps, next: None })
    }

    /// The same of a table with this `text`; errors call it a file of `folder`.
    ///
    /// Errors: a column is missing.
    pub(crate) fn of_text(folder: &Path, text: String, steps: Range<usize>) -> Result<Self, OutputError> {
        let lines = Lines::of::<T>(&folder.join(T::FILE), Box::new(Cursor::new(text)))?;
        Ok(Self { lines, steps, next: None })
    }

    /// All rows of these steps.
    ///
    /// Errors: a row is damaged; the system refuses.
    pub fn read(self) -> Result<Vec<T>, OutputError> {
        let mut rows = Vec::new();
        for block in self {
            for row in block?.rows() {
                rows.push(row?);
            }
        }
        Ok(rows)
    }

    fn next_block(&mut self) -> Result<Option<StepBlock<T>>, OutputError> {
        while self.lines.advance()? {
            let Lines { layout, line, text, .. } = &self.lines;
            let step = text.split(',').next().and_then(|step| step.parse().ok());
            let step = step.ok_or_else(|| layout.damaged(format!("line {line}: no step number")))?;
            let finished = self.next.take_if(|block| block.step != step);
            if self.steps.contains(&step) {
                let (layout, line) = (layout.clone(), *line);
                let new = || StepBlock { layout, line, step, text: String::new(), row: PhantomData };
                self.next.get_or_insert_with(new).text.push_str(text);
            }
            if finished.is_some() {
                return Ok(finished);
            }
        }
        Ok(self.next.take())
    }
}

impl<T: Table> Iterator for StepBlocks<T> {
    type Item = Result<StepBlock<T>, OutputError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_block().transpose()
    }
}
