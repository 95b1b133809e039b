//! Titles as spans: indices, powers, symbols of quantities in italics.

use super::element::Span;
use crate::markup::{Piece, pieces};

/// The spans of a text in which single letters are no symbols.
pub(crate) fn text(text: &str) -> Vec<Span> {
    set(text, |_, _| false)
}

/// The spans of the title of an axis: a letter that stands alone is a symbol.
pub(crate) fn quantity(text: &str) -> Vec<Span> {
    let stands = |neighbour: Option<char>| neighbour.is_none_or(|c| !c.is_alphanumeric() && c != '√');
    set(text, |before, after| stands(before) && stands(after))
}

fn set(text: &str, is_symbol: impl Fn(Option<char>, Option<char>) -> bool) -> Vec<Span> {
    let mut spans = Vec::new();
    for piece in pieces(text) {
        match piece {
            Piece::Index(index) => spans.push(Span::Sub(index.to_owned())),
            Piece::Power(power) => spans.push(Span::Super(power.to_owned())),
            Piece::Plain(words) => {
                let letters: Vec<char> = words.chars().collect();
                let mut run = String::new();
                for (i, &letter) in letters.iter().enumerate() {
                    let before = i.checked_sub(1).map(|i| letters[i]);
                    if letter.is_alphabetic() && is_symbol(before, letters.get(i + 1).copied()) {
                        if !run.is_empty() {
                            spans.push(Span::Plain(std::mem::take(&mut run)));
                        }
                        spans.push(Span::Italic(letter.to_string()));
                    } else {
                        run.push(letter);
                    }
                }
                if !run.is_empty() {
                    spans.push(Span::Plain(run));
                }
            }
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_stand_alone() {
        let plain = |text: &str| Span::Plain(text.to_owned());
        let italic = |text: &str| Span::Italic(text.to_owned());
        let sub = |text: &str| Span::Sub(text.to_owned());
        assert_eq!(quantity("K_{I} (MPa√m)"), [italic("K"), sub("I"), plain(" (MPa√m)")]);
        assert_eq!(quantity("da/dN of a"), [plain("da/dN of "), italic("a")]);
        assert_eq!(text("a K_{I"), [plain("a K_{I")]);
    }
}
