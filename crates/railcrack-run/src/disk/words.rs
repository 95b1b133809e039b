//! Words of enums in JSON files.

use railcrack::words::Choice;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

/// Serializes the word of a choice.
pub(crate) fn serialize<W: Choice, S: Serializer>(choice: &W, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(choice.word())
}

/// Reads a choice from its word.
pub(crate) fn deserialize<'de, W: Choice, D: Deserializer<'de>>(deserializer: D) -> Result<W, D::Error> {
    let word = String::deserialize(deserializer)?;
    W::of_word(&word).ok_or_else(|| D::Error::custom(format!("\"{word}\" is not {}", W::accepted())))
}

/// The same for a choice that may be null.
pub(crate) mod optional {
    use super::*;

    pub(crate) fn serialize<W: Choice, S: Serializer>(
        choice: &Option<W>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match choice {
            Some(choice) => serializer.serialize_some(choice.word()),
            None => serializer.serialize_none(),
        }
    }

    pub(crate) fn deserialize<'de, W: Choice, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<W>, D::Error> {
        let Some(word) = Option::<String>::deserialize(deserializer)? else { return Ok(None) };
        W::of_word(&word)
            .map(Some)
            .ok_or_else(|| D::Error::custom(format!("\"{word}\" is not {}", W::accepted())))
    }
}
