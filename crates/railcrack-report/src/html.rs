//! Text and data in HTML.

use railcrack_vtu::base64;
use serde_json::Value;

/// `text` as the content of an element or the value of a quoted attribute.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // HTML has no place for them.
            control if control.is_control() && control != '\n' => out.push(' '),
            other => out.push(other),
        }
    }
    out
}

/// [`escaped`], with `K_{I}` set as K with the index I and `10^{6}` as a power.
pub(crate) fn typeset(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, tag, after)) = marked(rest) {
        let Some((inside, behind)) = after.split_once('}') else { break };
        out.push_str(&escaped(before));
        out.push_str(&format!("<{tag}>{}</{tag}>", escaped(inside)));
        rest = behind;
    }
    out.push_str(&escaped(rest));
    out
}

/// What stands before the first mark, the element that the mark means, and what stands after.
fn marked(text: &str) -> Option<(&str, &'static str, &str)> {
    let at = |mark: &str| text.find(mark);
    let (place, tag) = match (at("_{"), at("^{")) {
        (Some(low), Some(high)) if high < low => (high, "sup"),
        (Some(low), _) => (low, "sub"),
        (None, Some(high)) => (high, "sup"),
        (None, None) => return None,
    };
    Some((&text[..place], tag, &text[place + 2..]))
}

/// An SVG as an image of its own: its names cannot meet those of another picture, nor its content the page.
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
