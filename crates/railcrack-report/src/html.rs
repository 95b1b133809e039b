//! Text and data in HTML.

use super::markup::{Piece, pieces};
use railcrack_vtu::base64;
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

/// An SVG as an image of its own: its names cannot meet those of another picture, nor its content
/// the page.
pub(crate) fn still(svg: &str, description: &str) -> String {
    let mut data = Vec::with_capacity(svg.len() / 3 * 4 + 4);
    base64::encode(svg.as_bytes(), &mut data);
    // Base64 is ASCII.
    let data = String::from_utf8(data).unwrap_or_default();
    format!("<img src=\"data:image/svg+xml;base64,{data}\" alt=\"{}\">", escaped(description))
}

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
        assert_eq!(escaped("a<b> & \"c\" 'd'\u{7}"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39; ");
        assert_eq!(typeset("<K_{II}> (MPa√m)"), "&lt;K<sub>II</sub>&gt; (MPa√m)");
        assert_eq!(typeset("K_{I"), "K_{I");
        assert_eq!(typeset("10^{6} K_{I} <"), "10<sup>6</sup> K<sub>I</sub> &lt;");
    }

    #[test]
    fn data_cannot_end_its_script() {
        let value = json!({ "title": "</script><script>alert(1)</script><!--" });
        let text = json_for_script(&value);
        assert!(!text.contains('<') && !text.contains('>'), "{text}");
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }
}
