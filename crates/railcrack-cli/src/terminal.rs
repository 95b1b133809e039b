//! Text that commands no terminal: what a file holds is shown, and nothing else.

use railcrack_case::commands_terminal;
use std::borrow::Cow;
use std::io::Write;

/// `text` without what would command a terminal: control characters and marks of direction are
/// written out, but for line ends and tabs.
fn harmless(text: &str, written_out: impl Fn(char) -> String) -> Cow<'_, str> {
    let is_harmful = |c: char| commands_terminal(c) && !matches!(c, '\n' | '\t');
    if !text.contains(is_harmful) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| if is_harmful(c) { written_out(c) } else { String::from(c) };
    Cow::Owned(text.chars().map(shown).collect())
}

/// The same in the notation of error messages: `\u{1b}`.
pub fn plain(text: &str) -> Cow<'_, str> {
    harmless(text, |c| c.escape_default().collect())
}

/// The same in the notation of JSON: `\u001b`.
pub fn plain_json(text: &str) -> Cow<'_, str> {
    let units = |c: char| c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect();
    harmless(text, units)
}

/// Writes `text` to standard error, without what would command a terminal.
pub fn stderr(text: &str) {
    // A failure to write to standard error cannot be reported.
    let _ = std::io::stderr().lock().write_all(plain(text).as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_commands_the_terminal() {
        let text = "a\u{1b}]0;x\u{7}\u{9b}2J\r\u{202e}b\u{7f}\tc\n";
        assert_eq!(plain(text), "a\\u{1b}]0;x\\u{7}\\u{9b}2J\\r\\u{202e}b\\u{7f}\tc\n");
        assert!(matches!(plain("K_I, μ, ΔK\n"), Cow::Borrowed(_)));
        assert_eq!(plain_json("\"\u{9b}\""), "\"\\u009b\"");
    }
}
