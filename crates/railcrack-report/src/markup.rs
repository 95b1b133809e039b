//! Indices and powers in the texts of charts and pages: `K_{I}`, `10^{6}`.

/// A piece of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Piece<'a> {
    /// On the line.
    Plain(&'a str),
    /// Below the line: an index.
    Index(&'a str),
    /// Above the line: a power.
    Power(&'a str),
}

/// The pieces of `text`; a mark that is not closed stands as it is.
pub(crate) fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some((before, piece, after)) = next_mark(rest) {
        if !before.is_empty() {
            pieces.push(Piece::Plain(before));
        }
        pieces.push(piece);
        rest = after;
    }
    if !rest.is_empty() {
        pieces.push(Piece::Plain(rest));
    }
    pieces
}

/// The text before the first mark, the marked piece, the text after it.
fn next_mark(text: &str) -> Option<(&str, Piece<'_>, &str)> {
    let place = [text.find("_{"), text.find("^{")].into_iter().flatten().min()?;
    let (inside, after) = text[place + 2..].split_once('}')?;
    let piece = if text[place..].starts_with('_') { Piece::Index(inside) } else { Piece::Power(inside) };
    Some((&text[..place], piece, after))
}

/// `text` without its marks.
pub(crate) fn plain(text: &str) -> String {
    let words = |piece| match piece {
        Piece::Plain(text) | Piece::Index(text) | Piece::Power(text) => text,
    };
    pieces(text).into_iter().map(words).collect()
}
