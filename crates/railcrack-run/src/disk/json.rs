//! JSON files: signed as they are written, and read back.

use super::checksum::sign;
use super::replace::{Durability, read_if_there, replace_file};
use crate::error::OutputError;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;

/// The JSON file `file` of `folder`; none where it is not there.
pub(crate) fn read_json_if_there<T: DeserializeOwned>(
    folder: &Path,
    file: &str,
) -> Result<Option<T>, OutputError> {
    let path = folder.join(file);
    let Some(text) = read_if_there(&path)? else { return Ok(None) };
    let value = serde_json::from_slice(&text);
    value.map(Some).map_err(|reason| OutputError::damaged(&path, reason.to_string()))
}

/// The JSON file `file`, which makes `folder` what it is.
pub(crate) fn read_json<T: DeserializeOwned>(folder: &Path, file: &'static str) -> Result<T, OutputError> {
    read_json_if_there(folder, file)?
        .ok_or_else(|| OutputError::NotARun { folder: folder.to_path_buf(), file })
}

/// `value` as the text of a JSON file, which ends with the checksum of the others.
pub(crate) fn json_text(path: &Path, value: &impl Serialize) -> Result<String, OutputError> {
    let text = serde_json::to_value(value).and_then(|mut document| {
        sign(&mut document);
        serde_json::to_string_pretty(&document)
    });
    text.map(|text| text + "\n").map_err(|reason| OutputError::damaged(path, reason.to_string()))
}

/// Writes `value` to the JSON file `file` of `folder`.
pub(crate) fn write_json(
    folder: &Path,
    file: &str,
    value: &impl Serialize,
    durability: Durability,
) -> Result<(), OutputError> {
    let path = folder.join(file);
    replace_file(&path, json_text(&path, value)?.as_bytes(), durability)
}
