//! Phrases of results as sentences.

/// `text` as a complete sentence.
pub(in crate::pages) fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map_or_else(String::new, |letter| letter.to_uppercase().collect());
    let end = if text.ends_with('.') { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

/// How well absolute rates are known; none of a folder that does not say it.
pub(in crate::pages) fn calibration(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| sentence(text))
}
