//! Standard output and standard error.

use crate::display::stderr_columns;
use crate::exit::{Exit, Failure};
use crate::interruption::Remains;
use crate::terminal::{plain, plain_json, stderr};
use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{Annotation, AnnotationKind, Element, Level, Origin, Renderer, Snippet};
use railcrack_case::CaseError;
use std::io::{ErrorKind, IsTerminal, Write};

/// Writes `text` to standard output, without what would command a terminal. A reader that closes
/// the pipe (`| head`) is not a failure.
pub fn stdout(text: &str) -> Result<(), Failure> {
    write_stdout(&plain(text))
}

/// Writes the JSON `text` to standard output: what would command a terminal is written as `\u001b`.
pub fn json(text: &str) -> Result<(), Failure> {
    write_stdout(&plain_json(text))
}

fn write_stdout(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Stdout(error)),
        _ => Ok(()),
    }
}

/// Writes a warning to standard error.
pub fn warning(says: &str) {
    stderr(&format!("warning: {says}\n"));
}

/// Reports on standard error that a command was interrupted and leaves no results.
pub fn interrupted() -> Exit {
    stderr(&format!("{}\n", Remains::Nothing.sentence()));
    Exit::Interrupted
}

/// Reports a failure on standard error: graphically with an excerpt of the file on a terminal,
/// otherwise with one line per error followed by the line of the file.
pub fn failure(failure: &Failure) {
    let mut err = std::io::stderr().lock();
    let text = match failure {
        Failure::Case(errors) if err.is_terminal() => {
            let is_plain = std::env::var_os("NO_COLOR").is_some();
            let renderer = if is_plain { Renderer::plain() } else { Renderer::styled() };
            let renderer = renderer.decor_style(DecorStyle::Unicode);
            let renderer = renderer.term_width(stderr_columns().unwrap_or(100).max(40));
            errors.errors().iter().map(|error| graphic(error, &renderer)).collect()
        }
        Failure::Case(errors) => {
            let lines = errors.errors().iter();
            lines.map(|error| format!("error: {}\n{}", error.one_line(), error.excerpt())).collect()
        }
        other => plain(&format!("error: {other}\n")).into_owned(),
    };
    // A failure to write to standard error cannot be reported.
    let _ = err.write_all(text.as_bytes());
}

/// An error with the lines of its file that it is about.
fn graphic(error: &CaseError, renderer: &Renderer) -> String {
    let kinds = std::iter::once(AnnotationKind::Primary).chain(std::iter::repeat(AnnotationKind::Context));
    let marks: Vec<Annotation> = error
        .labels()
        .iter()
        .zip(kinds)
        // An error about an option of the command line has a place outside of the file.
        .filter(|((span, _), _)| error.text().get(span.clone()).is_some())
        .map(|((span, label), kind)| kind.span(span.clone()).label(*label))
        .collect();
    let title = Level::ERROR.primary_title(error.message());
    let place = match marks.is_empty() {
        true => Element::from(Origin::path(error.file())),
        false => Element::from(Snippet::source(error.text()).path(error.file()).annotations(marks)),
    };
    let help = error.help().map(|help| Element::from(Level::HELP.message(help)));
    renderer.render(&[title.element(place).elements(help)]) + "\n\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use railcrack_case::{Case, CaseErrors};
    use std::path::Path;

    const CASE: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\n[[crack]]\nmouth_mm = 0.0\nlength_mm = 1.0\nangle_deg = 15.0\n";

    fn errors(rest: &str, name: &str) -> CaseErrors {
        Case::parse(&format!("{CASE}{rest}"), name, Path::new("")).unwrap_err()
    }

    fn all(errors: &CaseErrors, renderer: Renderer) -> String {
        let renderer = renderer.decor_style(DecorStyle::Unicode);
        errors.errors().iter().map(|error| graphic(error, &renderer)).collect()
    }

    #[test]
    fn every_error_has_its_place_and_its_help() {
        let errors = errors("fricton = 0.5\n[passage]\npositions = \"many\"\n", "case.toml");
        assert!(errors.errors().len() > 1, "{errors}");
        let shown = all(&errors, Renderer::plain());
        for error in errors.errors() {
            assert!(shown.contains(error.message()), "{shown}");
            assert!(error.help().is_none_or(|help| shown.contains(help)), "{shown}");
        }
        let marked = "8 │ fricton = 0.5\n  │ ━━━━━━━ here";
        for part in [" ╭▸ case.toml:8:1\n", marked, " ╭▸ case.toml:10:13\n", "━━━━━━ here"]
        {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
        // Colours only where they are asked for.
        assert!(!shown.contains('\u{1b}') && all(&errors, Renderer::styled()).contains("\u{1b}["));
    }

    #[test]
    fn a_second_place_has_its_own_label() {
        let crossing =
            "friction = 0.5\n[[crack]]\nmouth_mm = 0.0\nlength_mm = 1.0\nangle_deg = 15.0\nfriction = 0.5\n";
        let shown = all(&errors(crossing, "case.toml"), Renderer::plain());
        for part in ["4 │ [[crack]]", "9 │ [[crack]]", "here", "the other crack"] {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
    }

    #[test]
    fn control_characters_of_a_file_do_not_reach_the_terminal() {
        let rest = "friction = 0.5\n[mesh]\n\"a\\u001b[31m\" = \"\\u202e\"\n# \u{1b}[2J\n";
        let shown = all(&errors(rest, "case\u{1b}.toml"), Renderer::plain());
        assert!(!shown.contains(['\u{1b}', '\u{202e}']), "{shown}");
    }

    #[test]
    fn an_error_without_a_place_names_the_file() {
        let missing = Case::read(Path::new("no-such-case.toml")).unwrap_err();
        let shown = all(&missing, Renderer::plain());
        assert!(shown.contains("no-such-case.toml"), "{shown}");
    }
}
