//! Words of enums: the names of variants in case files, tables and JSON files.

/// An enum whose variants have names in files.
pub trait Choice: Copy + PartialEq + Sized + 'static {
    /// Every variant with its word, the default first.
    const WORDS: &'static [(Self, Word)];

    /// The word in files and results.
    fn word(self) -> &'static str {
        Self::WORDS.iter().find(|(value, _)| *value == self).map_or("", |(_, word)| word.name)
    }

    /// Its meaning, without a capital and a full stop.
    fn meaning(self) -> &'static str {
        Self::WORDS.iter().find(|(value, _)| *value == self).map_or("", |(_, word)| word.doc)
    }

    /// The variant with this word, if there is one.
    fn of_word(name: &str) -> Option<Self> {
        Self::WORDS.iter().find(|(_, word)| word.name == name).map(|(value, _)| *value)
    }

    /// All words, for messages: `open, stick or slip`.
    fn accepted() -> String {
        let words: Vec<&str> = Self::WORDS.iter().map(|(_, word)| word.name).collect();
        match words.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => words.concat(),
        }
    }
}

/// One word of a [`Choice`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word {
    /// The word.
    pub name: &'static str,
    /// Its meaning, without a capital and a full stop.
    pub doc: &'static str,
    /// The equivalent boolean, if there is one.
    pub switch: Option<bool>,
}

impl Word {
    /// A word without an equivalent boolean.
    pub const fn now(name: &'static str, doc: &'static str) -> Self {
        Self { name, doc, switch: None }
    }

    /// This word with an equivalent boolean.
    #[must_use]
    pub const fn or(self, switch: bool) -> Self {
        Self { switch: Some(switch), ..self }
    }
}
