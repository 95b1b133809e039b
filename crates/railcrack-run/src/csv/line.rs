//! A line of a CSV file taken apart and put together: quotes as in RFC 4180.

use std::borrow::Cow;

/// The fields of `line`, their quotes taken off.
pub fn line_fields(line: &str) -> Vec<String> {
    if !line.contains('"') {
        return line.split(',').map(str::to_owned).collect();
    }
    let mut fields = Vec::new();
    let mut field = String::new();
    let (mut is_quoted, mut letters) = (false, line.chars().peekable());
    while let Some(letter) = letters.next() {
        match letter {
            '"' if is_quoted && letters.next_if_eq(&'"').is_some() => field.push('"'),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(std::mem::take(&mut field)),
            other => field.push(other),
        }
    }
    fields.push(field);
    fields
}

/// `field` as it stands in a line: in quotes where it has commas, quotes, line ends (which become
/// spaces) or the sign of a comment.
pub fn line_field(field: &str) -> Cow<'_, str> {
    if !field.contains([',', '"', '\n', '\r', '#']) {
        return Cow::Borrowed(field);
    }
    Cow::Owned(format!("\"{}\"", field.replace('"', "\"\"").replace(['\n', '\r'], " ")))
}

/// A text of the user as it stands in a line: [`line_field`], with an apostrophe before what a
/// spreadsheet would take for a formula. Numbers are none.
pub fn text_field(text: &str) -> Cow<'_, str> {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']) && text.parse::<f64>().is_err();
    match is_formula {
        true => Cow::Owned(line_field(&format!("'{text}")).into_owned()),
        false => line_field(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_is_a_formula() {
        for (text, field) in [
            ("=1+1", "'=1+1"),
            ("@SUM(A1,B1)", "\"'@SUM(A1,B1)\""),
            ("-2+3", "'-2+3"),
            ("-2.5e-3", "-2.5e-3"),
            ("+7", "+7"),
            ("a = b", "a = b"),
        ] {
            assert_eq!(text_field(text), field);
        }
    }

    #[test]
    fn fields_are_those_of_the_file() {
        let cases: [(&str, &[&str]); 4] = [
            ("a,\"b, \"\"c\"\"\",,1", &["a", "b, \"c\"", "", "1"]),
            ("\"half-plane, along\",reference,-6.0", &["half-plane, along", "reference", "-6.0"]),
            ("a,,b", &["a", "", "b"]),
            ("", &[""]),
        ];
        for (line, fields) in cases {
            assert_eq!(line_fields(line), fields);
            assert_eq!(fields.iter().map(|field| line_field(field)).collect::<Vec<_>>().join(","), line);
        }
    }
}
