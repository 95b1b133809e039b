//! Checksums of what was written: FNV-1a, 64 bits. Each byte maps the sum one-to-one, so that a
//! single changed byte is always found.

use crate::error::OutputError;
use railcrack_case::open_regular;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read};
use std::path::Path;

/// Key of a JSON document for the checksum of the others.
const KEY: &str = "checksum";

/// A checksum of bytes in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Checksum(u64);

impl Checksum {
    /// The checksum of no bytes.
    pub(crate) const NOTHING: Self = Self(0xcbf2_9ce4_8422_2325);

    /// The checksum of `bytes`.
    pub(crate) fn of(bytes: &[u8]) -> Self {
        Self::NOTHING.with(bytes)
    }

    /// The checksum of the bytes so far followed by `bytes`.
    #[must_use]
    pub(crate) fn with(self, bytes: &[u8]) -> Self {
        let add = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        Self(bytes.iter().fold(self.0, add))
    }

    /// The checksum that this number is.
    pub(crate) fn of_number(number: u64) -> Self {
        Self(number)
    }

    /// The checksum that `text` shows; none where it is not one.
    pub(crate) fn of_text(text: &str) -> Option<Self> {
        u64::from_str_radix(text, 16).ok().map(Self)
    }

    /// As bytes of a file, the lowest first.
    pub(crate) fn to_bytes(self) -> [u8; 8] {
        self.0.to_le_bytes()
    }
}

/// Sixteen hexadecimal digits.
impl fmt::Display for Checksum {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{:016x}", self.0)
    }
}

/// Length and checksum of what was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Seal {
    /// Bytes.
    pub length: u64,
    /// Their checksum.
    pub checksum: Checksum,
}

impl Seal {
    /// The seal of an empty file.
    pub(crate) const NOTHING: Self = Self { length: 0, checksum: Checksum::NOTHING };

    /// The checksum of `bytes`.
    pub(crate) fn of(bytes: &[u8]) -> Self {
        Self::NOTHING.with(bytes)
    }

    /// The seal of what was written so far followed by `bytes`.
    #[must_use]
    pub(crate) fn with(self, bytes: &[u8]) -> Self {
        Self { length: self.length + bytes.len() as u64, checksum: self.checksum.with(bytes) }
    }

    /// The seal of the file at `path`.
    ///
    /// Errors: the system refuses.
    pub(crate) fn of_file(path: &Path) -> Result<Self, OutputError> {
        let refused = || OutputError::io("read", path);
        Self::read(open_regular(path).map_err(refused())?, u64::MAX).map_err(refused())
    }

    /// The seal of all of `content`, or of its first `most` bytes.
    pub(crate) fn read(content: impl Read, most: u64) -> io::Result<Self> {
        let (mut content, mut seal, mut piece) = (content.take(most), Self::NOTHING, vec![0; 1 << 16]);
        loop {
            match content.read(&mut piece)? {
                0 => return Ok(seal),
                count => seal = seal.with(&piece[..count]),
            }
        }
    }
}

/// Checksums of `files` in `folder`, for a document stored with them.
///
/// Errors: the system refuses.
pub(crate) fn checksums(folder: &Path, files: &[&str]) -> Result<BTreeMap<String, String>, OutputError> {
    let of = |file: &&str| Ok(((*file).to_owned(), Seal::of_file(&folder.join(file))?.checksum.to_string()));
    files.iter().map(of).collect()
}

/// Adds the checksum of its content to a JSON document.
pub(crate) fn sign(document: &mut Value) {
    let sum = of_document(document);
    if let Value::Object(keys) = document {
        keys.insert(KEY.into(), sum.to_string().into());
    }
}

/// Whether a JSON document has what was written; none where it has no checksum.
pub(crate) fn is_signed(document: &Value) -> Option<bool> {
    let stored = document.get(KEY)?.as_str();
    Some(stored == Some(&of_document(document).to_string()))
}

/// The checksum of a document without its own checksum and without what differs between two runs of
/// the same: wall times and memory.
fn of_document(document: &Value) -> Checksum {
    let mut lasting = lasting(document);
    if let Value::Object(keys) = &mut lasting {
        keys.remove(KEY);
    }
    Checksum::of(lasting.to_string().as_bytes())
}

fn lasting(value: &Value) -> Value {
    let is_cost = |key: &str| matches!(key, "wall_s" | "phases_s" | "peak_memory_mb");
    match value {
        Value::Object(keys) => {
            let kept = keys.iter().filter(|(key, _)| !is_cost(key));
            Value::Object(kept.map(|(key, value)| (key.clone(), lasting(value))).collect::<Map<_, _>>())
        }
        Value::Array(values) => Value::Array(values.iter().map(lasting).collect()),
        other => other.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_turned_bit_is_found() {
        let bytes: Vec<u8> = (0..200u8).collect();
        let sum = Checksum::of(&bytes);
        for at in 0..bytes.len() {
            for bit in 0..8 {
                let mut turned = bytes.clone();
                turned[at] ^= 1 << bit;
                assert_ne!(Checksum::of(&turned), sum, "byte {at}, bit {bit}");
            }
        }
    }

    #[test]
    fn a_document_is_signed_without_its_times() {
        let of = |wall: f64, k: f64| {
            let mut document = json!({ "k": k, "runs": [{ "wall_s": wall, "n": 1 }], "wall_s": wall });
            sign(&mut document);
            document
        };
        let text = of(1.5, 0.1).to_string();
        let mut read: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(is_signed(&read), Some(true));
        assert_eq!(of(1.5, 0.1)[KEY], of(2.5, 0.1)[KEY]);
        read["k"] = json!(0.2);
        assert_eq!(is_signed(&read), Some(false));
        assert_eq!(is_signed(&json!({ "k": 1 })), None);
    }
}
