//! Errors of a file: message, place, key, help; all of a file at once.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;
use thiserror::Error;

/// One error of a case file or of a file that it names.
#[derive(Debug, Clone, Error)]
#[error("{message}")]
pub struct CaseError {
    message: String,
    file: String,
    key: Option<String>,
    span: Option<Range<usize>>,
    help: Option<String>,
    text: Arc<str>,
    labels: Vec<(Range<usize>, &'static str)>,
    quoting: Quoting,
}

impl CaseError {
    /// Key, value given and what is accepted.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }

    /// A remedy.
    #[must_use]
    pub fn help(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// The file as the user named it.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The key with its section, `section.key` or `section[2].key` (repeated sections count from
    /// 1).
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// Bytes of the file that the error is about; none where the file cannot be read or the command
    /// line is wrong.
    #[must_use]
    pub fn span(&self) -> Option<Range<usize>> {
        self.span.clone()
    }

    /// The text of the file, in which control characters are question marks.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The places in [`CaseError::text`] that the error is about, each with its label: first its
    /// own place, if it has one.
    #[must_use]
    pub fn labels(&self) -> &[(Range<usize>, &'static str)] {
        &self.labels
    }

    /// Line and column in the file, from 1; columns count characters.
    #[must_use]
    pub fn position(&self) -> Option<(usize, usize)> {
        let start = self.span.as_ref()?.start;
        let before = self.text.get(..start)?;
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        Some((line, column))
    }

    /// The same error with `note` added to its help.
    pub(crate) fn noting(mut self, note: &str) -> Self {
        self.help = Some(match self.help {
            Some(help) => format!("{help}; {note}"),
            None => note.to_owned(),
        });
        self
    }

    /// The line of the file that the error is about, with carets under the place; empty where there
    /// is none, and where the file is of another kind than expected.
    #[must_use]
    pub fn excerpt(&self) -> String {
        if self.quoting == Quoting::Hidden {
            return String::new();
        }
        let (Some((line, column)), Some(span)) = (self.position(), &self.span) else { return String::new() };
        let text = &self.text;
        let Some(shown) = text.lines().nth(line - 1) else { return String::new() };
        let (number, before) = (line.to_string(), column - 1);
        let marked = text.get(span.clone()).and_then(|text| text.lines().next()).unwrap_or_default();
        let (shown, before, carets) = windowed(&shown.replace('\t', " "), before, marked.chars().count());
        let margin = " ".repeat(number.len());
        format!("  {number} | {shown}\n  {margin} | {}{}\n", " ".repeat(before), "^".repeat(carets.max(1)))
    }

    /// The whole error on one line: `file:line:column: message (help)`.
    #[must_use]
    pub fn one_line(&self) -> String {
        let place = match self.position() {
            Some((line, column)) => format!("{}:{line}:{column}", self.file),
            None => self.file.clone(),
        };
        match &self.help {
            Some(help) => format!("{place}: {} ({help})", self.message),
            None => format!("{place}: {}", self.message),
        }
    }
}

/// Maximum number of characters shown of a line, and how many of them precede the marked place.
const MOST_SHOWN: usize = 100;
const BEFORE: usize = 40;

/// `line` cut to what fits around the `count` characters behind the first `before`: the line, the
/// characters before the place in it, and how many are marked.
fn windowed(line: &str, before: usize, count: usize) -> (String, usize, usize) {
    let length = line.chars().count();
    let from = if length <= MOST_SHOWN { 0 } else { before.saturating_sub(BEFORE) };
    let shown: String = line.chars().skip(from).take(MOST_SHOWN).collect();
    let left = if from > 0 { "\u{2026}" } else { "" };
    let right = if from + MOST_SHOWN < length { "\u{2026}" } else { "" };
    let room = shown.chars().count().saturating_sub(before - from);
    (format!("{left}{shown}{right}"), before - from + left.chars().count(), count.min(room))
}

/// All errors of a case file, in the order of the file; never empty.
#[derive(Debug, Clone, Error)]
pub struct CaseErrors {
    errors: Vec<CaseError>,
}

impl CaseErrors {
    /// The errors.
    #[must_use]
    pub fn errors(&self) -> &[CaseError] {
        &self.errors
    }
}

impl fmt::Display for CaseErrors {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let lines: Vec<String> = self.errors.iter().map(CaseError::one_line).collect();
        write!(f, "{}", lines.join("\n"))
    }
}

/// A text and its name in error messages.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    pub name: String,
    pub text: Arc<str>,
    pub quoting: Quoting,
}

/// Whether errors show lines of a text. A file of another kind than expected, named by mistake or
/// by somebody else's case, may hold what nobody should see in a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quoting {
    Shown,
    Hidden,
}

impl Source {
    /// A text whose lines errors may show.
    pub fn new(name: &str, text: &str) -> Self {
        Self { name: name.into(), text: Arc::from(text), quoting: Quoting::Shown }
    }

    /// The same text, of which errors show no line.
    pub fn hidden(self) -> Self {
        Self { quoting: Quoting::Hidden, ..self }
    }
}

/// An error under construction.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fault {
    pub message: String,
    pub key: Option<String>,
    pub span: Option<Range<usize>>,
    pub help: Option<String>,
    /// A second place that the error is about, and what it is.
    pub also: Option<(Range<usize>, &'static str)>,
}

impl Fault {
    /// A fault of the whole file.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), ..Self::default() }
    }

    /// A fault of `key`, at `span`.
    pub fn of(key: impl Into<String>, span: Range<usize>, message: impl Into<String>) -> Self {
        Self { key: Some(key.into()), span: Some(span), ..Self::new(message) }
    }

    /// With a remedy.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// With a second place that the error is about, and what it is.
    pub fn also(self, span: Range<usize>, what: &'static str) -> Self {
        Self { also: Some((span, what)), ..self }
    }
}

/// The errors of a file as they are found.
#[derive(Debug)]
pub(crate) struct Report {
    pub source: Source,
    errors: Vec<CaseError>,
    /// Number of errors found, including those that are not kept.
    found: usize,
}

/// Name of the command line in messages.
const COMMAND_LINE: &str = "command line";

/// Maximum number of errors kept for a file: nobody corrects more at once.
const MOST_ERRORS: usize = 50;

/// Maximum number of characters of a message, which may name parts of the file.
const LONGEST_MESSAGE: usize = 1000;

fn shortened(message: &str) -> String {
    let message = with_powers(message);
    match message.char_indices().nth(LONGEST_MESSAGE) {
        Some((end, _)) => format!("{}\u{2026}", &message[..end]),
        None => message,
    }
}

/// Digits of a number that nobody counts.
const MANY_DIGITS: usize = 24;

/// `message` with the numbers of many digits, such as 1e-300 in full, as powers of ten.
fn with_powers(message: &str) -> String {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    let mut written = String::with_capacity(message.len());
    let mut rest = message;
    while let Some(start) = rest.find(is_of_number) {
        let (before, from) = rest.split_at(start);
        let (number, after) = from.split_at(from.find(|c| !is_of_number(c)).unwrap_or(from.len()));
        written.push_str(before);
        match number.parse::<f64>() {
            Ok(value) if number.len() > MANY_DIGITS && value.is_finite() => {
                written.push_str(&format!("{value:e}"));
            }
            _ => written.push_str(number),
        }
        rest = after;
    }
    written + rest
}

/// `text` with its control characters written out, so that a file cannot send commands to the
/// terminal.
pub(crate) fn escaped(text: &str) -> String {
    let written = |c: char| match c {
        c if commands_terminal(c) => c.escape_default().collect(),
        c => String::from(c),
    };
    text.chars().map(written).collect()
}

/// The text of `source` with its control characters replaced by question marks, or all characters
/// where none is shown; byte for byte, so that positions in it do not change. A carriage return is
/// left only at the end of a line: alone, it would let the rest of the line overwrite its
/// beginning.
fn blanked(source: &Source) -> Arc<str> {
    let is_control = |c: char| (c.is_control() && !matches!(c, '\n' | '\t')) || is_invisible(c);
    let text = &source.text;
    if source.quoting == Quoting::Shown && !text.contains(is_control) {
        return Arc::clone(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let ends_line = c == '\n' || (c == '\r' && rest.peek() == Some(&'\n'));
        if !ends_line && (source.quoting == Quoting::Hidden || is_control(c)) {
            shown.extend(std::iter::repeat_n('?', c.len_utf8()));
        } else {
            shown.push(c);
        }
    }
    shown.into()
}

/// Whether a terminal would obey `c`: control characters, and those that change the direction of
/// the surrounding text.
#[must_use]
pub fn commands_terminal(c: char) -> bool {
    c.is_control() || is_invisible(c)
}

/// Characters that change the direction of the surrounding text.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

impl Report {
    pub fn new(source: Source) -> Self {
        Self { source, errors: Vec::new(), found: 0 }
    }

    /// The text at `span` as written, shortened to a line.
    pub fn shown(&self, span: &Range<usize>) -> String {
        let text = self.source.text.get(span.clone()).unwrap_or_default();
        let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
        match line.char_indices().nth(60) {
            Some(_) => format!("{}…", line.chars().take(59).collect::<String>()),
            None => line,
        }
    }

    /// Adds an error about the file.
    pub fn add(&mut self, fault: Fault) {
        let source = self.source.clone();
        self.add_to(&source, fault);
    }

    /// Adds an error about the file; nothing is read.
    pub fn refuse<T>(&mut self, fault: Fault) -> Option<T> {
        self.add(fault);
        None
    }

    /// Adds an error about another file.
    pub fn add_to(&mut self, source: &Source, fault: Fault) {
        self.found += 1;
        if self.errors.len() >= MOST_ERRORS {
            return;
        }
        let Fault { message, key, span, help, also } = fault;
        let (message, help) = (shortened(&escaped(&message)), help.map(|help| escaped(&help)));
        // A section that several others share is read for each of them.
        let is_same = |error: &CaseError| {
            (&error.message, &error.span, &error.file) == (&message, &span, &escaped(&source.name))
        };
        if span.is_some() && self.errors.iter().any(is_same) {
            self.found -= 1;
            return;
        }
        let labels = span.clone().map(|span| (span, "here")).into_iter().chain(also).collect();
        self.errors.push(CaseError {
            message,
            file: escaped(&source.name),
            key,
            span,
            help,
            text: blanked(source),
            labels,
            quoting: source.quoting,
        });
    }

    /// Adds an error about an option of the command line, which its message quotes.
    pub fn add_to_command_line(&mut self, fault: Fault) {
        self.add_to(&Source::new(COMMAND_LINE, ""), fault);
    }

    /// Number of errors kept so far.
    pub fn count(&self) -> usize {
        self.errors.len()
    }

    /// Errors from the one at `first` on are about the option `shown` of the command line.
    pub fn move_to_command_line(&mut self, first: usize, shown: &str) {
        for error in self.errors.iter_mut().skip(first).filter(|error| error.file != COMMAND_LINE) {
            COMMAND_LINE.clone_into(&mut error.file);
            error.message = format!("`{}`: {}", escaped(shown), error.message);
            error.text = Arc::from("");
            error.span = None;
            error.labels = Vec::new();
        }
    }

    /// Adds an error that another report found in the same file or in one that it names.
    pub fn absorb(&mut self, error: CaseError) {
        self.found += 1;
        if self.errors.len() < MOST_ERRORS {
            self.errors.push(error);
        }
    }

    /// Whether there is no error so far.
    pub fn is_clean(&self) -> bool {
        self.errors.is_empty()
    }

    /// The errors in the order in which they were found.
    pub fn into_list(self) -> Vec<CaseError> {
        self.errors
    }

    /// The errors in the order of the file.
    pub fn into_errors(mut self) -> CaseErrors {
        self.errors.sort_by_key(|e| e.span.as_ref().map(|s| s.start));
        let more = self.found - self.errors.len();
        if let Some(last) = self.errors.last_mut().filter(|_| more > 0) {
            last.message.push_str(&format!("; and {more} more errors"));
        }
        CaseErrors { errors: self.errors }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_many_digits_are_powers_of_ten() {
        for (value, shown) in [(1e-300, "1e-300"), (2.5e300, "2.5e300"), (1e-7, "0.0000001"), (0.25, "0.25")]
        {
            assert_eq!(
                shortened(&format!("`a = {value}`: too small.")),
                format!("`a = {shown}`: too small.")
            );
        }
    }
}
