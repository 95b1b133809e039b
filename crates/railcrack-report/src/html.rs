//! Text and data in HTML.

use crate::markup::{Piece, pieces};
use crate::svg::{AREA, GREY, INK, LIGHT, RAIL, ZERO};
pub(crate) use railcrack_vtu::escaped;
use serde_json::Value;

/// [`escaped`], with the index of `K_{I}` lowered and the power of `10^{6}` raised.
pub(crate) fn typeset(text: &str) -> String {
    let set = |piece| match piece {
        Piece::Plain(text) => escaped(text),
        Piece::Index(text) => format!("<sub>{}</sub>", escaped(text)),
        Piece::Power(text) => format!("<sup>{}</sup>", escaped(text)),
    };
    pieces(text).into_iter().map(set).collect()
}

/// [`typeset`], with places at which long names may be broken into lines: after the dots and the
/// underscores of `contact.peak_pressure_mpa`.
pub(crate) fn typeset_in_parts(text: &str) -> String {
    let mut parts = vec![String::new()];
    let letters: Vec<char> = text.chars().collect();
    for (place, &letter) in letters.iter().enumerate() {
        let before = place.checked_sub(1).map(|before| letters[before]);
        let after = letters.get(place + 1);
        let joins = |letter: &char| letter.is_ascii_alphabetic() || "])".contains(*letter);
        let is_end = matches!(letter, '.' | '_')
            && before.as_ref().is_some_and(joins)
            && after.is_some_and(char::is_ascii_alphabetic);
        if let Some(part) = parts.last_mut() {
            part.push(letter);
        }
        if is_end {
            parts.push(String::new());
        }
    }
    parts.iter().map(|part| typeset(part)).collect::<Vec<_>>().join("<wbr>")
}

/// An SVG as a part of the page, in the colours of the page's light or dark. There is one on a page
/// at most: names in it are not made unique.
pub(crate) fn inlined(svg: &str, description: &str) -> String {
    let label = format!("<svg role=\"img\" aria-label=\"{}\" ", escaped(description));
    in_page_colours(&svg.replacen("<svg ", &label, 1))
}

/// `svg` with the colours of the page, which are others in the dark.
pub(crate) fn in_page_colours(svg: &str) -> String {
    PAGE_COLOURS.iter().fold(svg.to_owned(), |svg, (fixed, name)| {
        svg.replace(&format!("\"{fixed}\""), &format!("\"var(--{name})\""))
    })
}

/// Colours of the files that are others in the dark, and their names on a page.
const PAGE_COLOURS: [(&str, &str); 7] = [
    ("#ffffff", "ground"),
    (INK, "ink"),
    (GREY, "quiet"),
    (LIGHT, "line"),
    (ZERO, "zero"),
    (AREA, "area"),
    (RAIL, "rail"),
];

/// `value` for a `<script type="application/json">`, which nothing in it can end.
pub(crate) fn json_for_script(value: &Value) -> String {
    // Only strings can hold these letters, and in strings they may be written as escapes.
    value
        .to_string()
        .replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn text_cannot_break_out() {
        assert_eq!(escaped("a<b> & \"c\" 'd'\u{7}\u{fffe}"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;  ");
        assert_eq!(typeset("<K_{II}> (MPa√m)"), "&lt;K<sub>II</sub>&gt; (MPa√m)");
        assert_eq!(typeset("K_{I"), "K_{I");
        assert_eq!(typeset("10^{6} K_{I} <"), "10<sup>6</sup> K<sub>I</sub> &lt;");
    }

    #[test]
    fn names_break_between_their_parts() {
        assert_eq!(typeset_in_parts("crack[1].friction 0.025"), "crack[1].<wbr>friction 0.025");
        assert_eq!(typeset_in_parts("[mesh] element_size_mm"), "[mesh] element_<wbr>size_<wbr>mm");
        assert_eq!(typeset_in_parts("ΔK_{eq} of 1.5e-6, a.<b>"), "ΔK<sub>eq</sub> of 1.5e-6, a.&lt;b&gt;");
    }

    #[test]
    fn data_cannot_end_its_script() {
        let value = json!({ "title": "</script><script>alert(1)</script><!--" });
        let text = json_for_script(&value);
        assert!(!text.contains('<') && !text.contains('>'), "{text}");
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }
}
