//! Checksums of what was written: SHA-256.

use super::files::SUMS_FILE;
use super::replace::{Durability, read_if_there, replace_file};
use super::stored_name::is_plain;
use crate::error::OutputError;
use data_encoding::HEXLOWER;
use railcrack_case::open_regular;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read};
use std::path::Path;

/// Key of a JSON document for the checksum of the others.
const KEY: &str = "checksum";

/// Number of bytes of a checksum.
pub(crate) const CHECKSUM_BYTES: usize = 32;

/// A checksum of bytes in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Checksum([u8; CHECKSUM_BYTES]);

impl Checksum {
    /// That of nothing in particular.
    pub(crate) const NONE: Self = Self([0; CHECKSUM_BYTES]);

    /// The checksum of `bytes`.
    pub(crate) fn of(bytes: &[u8]) -> Self {
        Self::of_parts([bytes])
    }

    /// The checksum of `parts` one after another.
    pub(crate) fn of_parts<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut sealing = Sealing::default();
        parts.into_iter().for_each(|part| sealing.add(part));
        sealing.seal().checksum
    }

    /// The checksum that `text` shows; none where it is not one.
    pub(crate) fn of_text(text: &str) -> Option<Self> {
        Self::of_bytes(&HEXLOWER.decode(text.as_bytes()).ok()?)
    }

    /// The checksum that these bytes of a file are; none where their number is another one.
    pub(crate) fn of_bytes(bytes: &[u8]) -> Option<Self> {
        bytes.try_into().ok().map(Self)
    }

    /// As bytes of a file.
    pub(crate) fn to_bytes(self) -> [u8; CHECKSUM_BYTES] {
        self.0
    }
}

/// Sixty-four hexadecimal digits.
impl fmt::Display for Checksum {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(&HEXLOWER.encode(&self.0))
    }
}

/// SHA-256 of `bytes`, sixty-four hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    Checksum::of(bytes).to_string()
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
    /// The checksum of `bytes`.
    pub(crate) fn of(bytes: &[u8]) -> Self {
        Self { length: bytes.len() as u64, checksum: Checksum::of(bytes) }
    }

    /// The seal of the file at `path`.
    ///
    /// Errors: the system refuses.
    pub(crate) fn of_file(path: &Path) -> Result<Self, OutputError> {
        let refused = || OutputError::io("read", path);
        let sealing = Sealing::read(open_regular(path).map_err(refused())?, u64::MAX).map_err(refused())?;
        Ok(sealing.seal())
    }
}

/// Length and checksum of what is being written.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sealing {
    length: u64,
    hash: Sha256,
}

impl Sealing {
    /// Of all of `content`, or of its first `most` bytes.
    pub(crate) fn read(content: impl Read, most: u64) -> io::Result<Self> {
        let (mut content, mut sealing, mut piece) = (content.take(most), Self::default(), vec![0; 1 << 16]);
        loop {
            match content.read(&mut piece)? {
                0 => return Ok(sealing),
                count => sealing.add(&piece[..count]),
            }
        }
    }

    /// `bytes` follow.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.length += bytes.len() as u64;
        self.hash.update(bytes);
    }

    /// The seal of what was written so far.
    pub(crate) fn seal(&self) -> Seal {
        Seal { length: self.length, checksum: Checksum(self.hash.clone().finalize().into()) }
    }
}

/// The file of the checksums `sums` of a folder by file, which `sha256sum -c` reads.
pub(crate) fn sums_text(sums: &BTreeMap<String, String>) -> String {
    sums.iter().map(|(file, sum)| format!("{sum}  {file}\n")).collect()
}

/// Writes `sums` to [`SUMS_FILE`] in `folder`.
///
/// Errors: the system refuses.
pub(crate) fn write_sums(folder: &Path, sums: &BTreeMap<String, String>) -> Result<(), OutputError> {
    replace_file(&folder.join(SUMS_FILE), sums_text(sums).as_bytes(), Durability::Cached)
}

/// The checksums in the file `path`, by the names of files; lines of another form, and names that
/// lead out of its folder, are left out. None where there is no such file.
///
/// Errors: the system refuses.
pub(crate) fn read_sums(path: &Path) -> Result<BTreeMap<String, String>, OutputError> {
    let text = read_if_there(path)?.unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let entry = |line: &str| {
        let (sum, name) = line.split_once("  ")?;
        let is_within = name.split('/').all(is_plain);
        (is_within && Checksum::of_text(sum).is_some()).then(|| (name.to_owned(), sum.to_owned()))
    };
    Ok(text.lines().filter_map(entry).collect())
}

/// Checksums of `files` in `folder`, for a document stored with them.
///
/// Errors: the system refuses.
pub(crate) fn checksums<'a>(
    folder: &Path,
    files: impl IntoIterator<Item = &'a str>,
) -> Result<BTreeMap<String, String>, OutputError> {
    let of = |file: &str| Ok((file.to_owned(), Seal::of_file(&folder.join(file))?.checksum.to_string()));
    files.into_iter().map(of).collect()
}

/// Adds the checksum of its content to a JSON document.
pub(crate) fn sign(document: &mut Value) {
    let sum = of_document(document);
    if let Value::Object(keys) = document {
        keys.insert(KEY.into(), sum.to_string().into());
    }
}

/// Whether a JSON document has what was written; none where it has no checksum, or one of versions
/// before SHA-256: sixteen digits.
pub(crate) fn is_signed(document: &Value) -> Option<bool> {
    let stored = document.get(KEY)?.as_str();
    let is_digits = |text: &&str| text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    let is_of_before = stored.as_ref().is_some_and(is_digits);
    (!is_of_before).then(|| stored == Some(&of_document(document).to_string()))
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

    /// FIPS 180-2, appendix B.1, whole and in parts.
    #[test]
    fn the_checksum_is_sha_256() {
        let sum = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(Checksum::of(b"abc").to_string(), sum);
        assert_eq!(Checksum::of_parts([&b"a"[..], b"", b"bc"]), Checksum::of(b"abc"));
        assert_eq!(Sealing::read(&b"abcd"[..], 3).unwrap().seal(), Seal::of(b"abc"));
        assert_eq!(Checksum::of_text(sum), Some(Checksum::of(b"abc")));
        assert_eq!((Checksum::of_text("ba78"), Checksum::of_text("cbf29ce484222325")), (None, None));
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
        assert_eq!(is_signed(&json!({ "k": 1, "checksum": "cbf29ce484222325" })), None);
    }
}
