//! One value of a case file replaced, the rest of its text kept.

use toml::de::{DeTable, DeValue};

/// `key` of `section` gets `value`, in the words of TOML.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Edit {
    pub section: &'static str,
    pub key: &'static str,
    pub value: String,
}

impl Edit {
    pub(super) fn number(section: &'static str, key: &'static str, value: f64) -> Self {
        Self { section, key, value: format!("{value:?}") }
    }

    pub(super) fn integer(section: &'static str, key: &'static str, value: usize) -> Self {
        Self { section, key, value: value.to_string() }
    }

    pub(super) fn text(section: &'static str, key: &'static str, value: &str) -> Self {
        Self { section, key, value: format!("\"{value}\"") }
    }

    /// `text` with this value in every section of that name. A missing key is added at the top of
    /// its section, a missing section at the end. Text that is not TOML is returned unchanged.
    pub(super) fn apply(&self, text: &str) -> String {
        let (document, _) = DeTable::parse_recoverable(text);
        let Some((name, value)) = document.get_ref().get_key_value(self.section) else {
            return format!("{}\n\n[{}]\n{} = {}\n", text.trim_end(), self.section, self.key, self.value);
        };
        let places: Vec<_> = match value.get_ref() {
            DeValue::Table(table) => vec![(name.span(), table)],
            DeValue::Array(items) => items
                .iter()
                .filter_map(|item| match item.get_ref() {
                    DeValue::Table(table) => Some((item.span(), table)),
                    _ => None,
                })
                .collect(),
            _ => Vec::new(),
        };
        let mut out = text.to_owned();
        // From the last to the first, because a replacement moves the text after it.
        for (header, table) in places.into_iter().rev() {
            match table.get(self.key) {
                Some(old) => out.replace_range(old.span(), &self.value),
                None => {
                    let line = out[header.start..].find('\n').map_or(out.len(), |end| header.start + end + 1);
                    out.insert_str(line, &format!("{} = {}\n", self.key, self.value));
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "title = \"x\"\n\n[contact]\nfriction = 0.1 # signed\n\n[[crack]]\nfriction = 0.5\n\n[[crack]]\nfriction = 0.5\n";

    #[test]
    fn a_value_is_replaced_and_its_comment_kept() {
        let text = Edit::number("contact", "friction", -0.4).apply(TEXT);
        assert!(text.contains("[contact]\nfriction = -0.4 # signed\n"), "{text}");
        assert_eq!(text.matches("friction = 0.5").count(), 2);
    }

    #[test]
    fn every_crack_gets_the_value() {
        let text = Edit::number("crack", "friction", 0.01).apply(TEXT);
        assert_eq!(text.matches("friction = 0.01").count(), 2, "{text}");
        let text = Edit::integer("crack", "count", 2).apply(TEXT);
        assert_eq!(text.matches("[[crack]]\ncount = 2\nfriction = 0.5").count(), 2, "{text}");
    }

    #[test]
    fn a_missing_key_or_section_is_added() {
        let text = Edit::number("contact", "half_width_mm", 6.75).apply(TEXT);
        assert!(text.contains("[contact]\nhalf_width_mm = 6.75\nfriction"), "{text}");
        let text = Edit::text("solver", "engine", "dislocation").apply(TEXT);
        assert!(text.ends_with("\n\n[solver]\nengine = \"dislocation\"\n"), "{text}");
    }
}
