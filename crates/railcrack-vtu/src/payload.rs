//! Encodings of the numbers of an array in a file.

use crate::base64;
use crate::error::Fault;
use crate::numbers::{ByteOrder, NumberType};
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
use std::borrow::Cow;

/// The declarations in the header of a file that apply to all its binary arrays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Encoding {
    pub order: ByteOrder,
    /// Type of the counts that precede binary numbers.
    pub header: NumberType,
    pub compression: Compression,
}

/// Whether binary arrays are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    /// Blocks in zlib format (RFC 1950).
    Zlib,
}

/// Location of the numbers of one array.
#[derive(Debug, Clone, Copy)]
pub(super) enum Payload<'a> {
    /// Decimal numbers.
    Ascii(&'a str),
    /// Raw binary data from here on.
    Raw(&'a [u8]),
    /// Binary data in base64 from here on.
    Base64(&'a [u8]),
}

impl Payload<'_> {
    /// The `count` numbers of the array called `part` in errors.
    pub(super) fn numbers(
        self,
        part: &str,
        number: NumberType,
        count: usize,
        encoding: Encoding,
    ) -> Result<Vec<f64>, Fault> {
        let numbers = match self {
            Self::Ascii(text) => decimals(text, part)?,
            _ => number.decode(&self.bytes(part, number, count, encoding)?, encoding.order),
        };
        if numbers.len() != count {
            return Err(Fault::malformed(part, format!("holds {} numbers, not {count}", numbers.len())));
        }
        Ok(numbers)
    }

    fn bytes(
        self,
        part: &str,
        number: NumberType,
        count: usize,
        encoding: Encoding,
    ) -> Result<Vec<u8>, Fault> {
        match encoding.compression {
            Compression::None => {
                let head = encoding.header.size();
                let counts = self.counts(part, 1, encoding)?;
                let whole = head.checked_add(counts[0]).ok_or_else(|| too_large(part))?;
                Ok(self.exactly(part, whole)?[head..].to_vec())
            }
            Compression::Zlib => {
                let most = count.checked_mul(number.size()).ok_or_else(|| too_large(part))?;
                self.inflated(part, most, encoding)
            }
        }
    }

    /// Number of blocks, bytes of a full and of the last block, compressed bytes of each block;
    /// then the blocks.
    fn inflated(self, part: &str, most: usize, encoding: Encoding) -> Result<Vec<u8>, Fault> {
        const FIXED: usize = 3;
        let blocks = self.counts(part, 1, encoding)?[0];
        if blocks == 0 {
            return Ok(Vec::new());
        }
        let counts =
            self.counts(part, blocks.checked_add(FIXED).ok_or_else(|| too_large(part))?, encoding)?;
        let mut begin = counts.len() * encoding.header.size();
        let whole = counts[FIXED..].iter().try_fold(begin, |sum, &size| sum.checked_add(size));
        let bytes = self.exactly(part, whole.ok_or_else(|| too_large(part))?)?;
        let mut inflated = Vec::new();
        for (block, size) in counts[FIXED..].iter().enumerate() {
            let room = most.saturating_sub(inflated.len());
            let plain = decompress_to_vec_zlib_with_limit(&bytes[begin..begin + size], room);
            let plain = plain
                .map_err(|reason| Fault::malformed(part, format!("compressed block {block}: {reason}")))?;
            inflated.extend_from_slice(&plain);
            begin += size;
        }
        Ok(inflated)
    }

    /// The first `count` counts of the header.
    fn counts(self, part: &str, count: usize, encoding: Encoding) -> Result<Vec<usize>, Fault> {
        let size = count.checked_mul(encoding.header.size()).ok_or_else(|| too_large(part))?;
        let head = self.exactly(part, size)?;
        let index = |&value: &f64| index(value).ok_or_else(|| too_large(part));
        encoding.header.decode(&head, encoding.order).iter().map(index).collect()
    }

    /// The first `size` bytes.
    fn exactly(&self, part: &str, size: usize) -> Result<Cow<'_, [u8]>, Fault> {
        let bytes = match self {
            Self::Raw(bytes) => Cow::Borrowed(&bytes[..bytes.len().min(size)]),
            Self::Base64(text) => Cow::Owned(base64::decode(text, size).map_err(|at| {
                Fault::malformed(part, format!("invalid base64 at byte {at} of {}", text.len()))
            })?),
            Self::Ascii(text) => Cow::Borrowed(text.as_bytes()),
        };
        if bytes.len() < size {
            return Err(Fault::malformed(part, format!("ends after {} of {size} bytes", bytes.len())));
        }
        Ok(bytes)
    }
}

fn too_large(part: &str) -> Fault {
    Fault::malformed(part, "a count in its header exceeds the size of any file")
}

/// `value` as an index or a count; none unless it is an integer that a number of this precision can
/// represent.
pub(super) fn index(value: f64) -> Option<usize> {
    const LARGEST: f64 = (1u64 << f64::MANTISSA_DIGITS) as f64;
    (value.fract() == 0.0 && (0.0..LARGEST).contains(&value)).then_some(value as usize)
}

fn decimals(text: &str, part: &str) -> Result<Vec<f64>, Fault> {
    let number = |word: &str| {
        let refused = |_| Fault::malformed(part, format!("`{word}` is not a number"));
        word.parse::<f64>().map_err(refused)
    };
    text.split_ascii_whitespace().map(number).collect()
}
