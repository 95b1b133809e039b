//! A column of a group of rows as a page of data.

use super::thrift::{Struct, varint};
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

/// Kind of the values of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ColumnKind {
    /// Whole numbers, 64 bits.
    Integer,
    /// Numbers in double precision.
    Number,
    /// Words in UTF-8.
    Text,
}

/// Encodings of Parquet: values one after the other; runs of equal levels; the first bytes of all
/// numbers, then the second ones, and so on, which lets exponents shrink.
const PLAIN: i32 = 0;
const RLE: i32 = 3;
const BYTE_STREAM_SPLIT: i32 = 9;
/// Its compression by zstd.
pub(super) const ZSTD: i32 = 6;

impl ColumnKind {
    /// The physical type of Parquet.
    pub(super) fn physical(self) -> i32 {
        match self {
            Self::Integer => 2,
            Self::Number => 5,
            Self::Text => 6,
        }
    }

    /// The encoding of its values.
    fn encoding(self) -> i32 {
        match self {
            Self::Number => BYTE_STREAM_SPLIT,
            Self::Integer | Self::Text => PLAIN,
        }
    }

    /// All encodings of its pages.
    pub(super) fn encodings(self) -> [i32; 2] {
        [RLE, self.encoding()]
    }
}

/// The values of a column, row by row; a row may have none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    /// Values of [`ColumnKind::Integer`].
    Integers(Vec<Option<i64>>),
    /// Values of [`ColumnKind::Number`].
    Numbers(Vec<Option<f64>>),
    /// Values of [`ColumnKind::Text`].
    Texts(Vec<Option<String>>),
}

impl Values {
    /// None yet, of `kind`.
    pub(crate) fn none(kind: ColumnKind) -> Self {
        match kind {
            ColumnKind::Integer => Self::Integers(Vec::new()),
            ColumnKind::Number => Self::Numbers(Vec::new()),
            ColumnKind::Text => Self::Texts(Vec::new()),
        }
    }

    /// Appends the field `text` of a table; an empty one is none.
    pub(crate) fn push(&mut self, text: &str) {
        match self {
            Self::Integers(values) => values.push(text.parse().ok()),
            Self::Numbers(values) => values.push(text.parse().ok()),
            Self::Texts(values) => values.push((!text.is_empty()).then(|| text.to_owned())),
        }
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Integers(values) => values.len(),
            Self::Numbers(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }

    fn kind(&self) -> ColumnKind {
        match self {
            Self::Integers(_) => ColumnKind::Integer,
            Self::Numbers(_) => ColumnKind::Number,
            Self::Texts(_) => ColumnKind::Text,
        }
    }

    /// Which rows have a value.
    fn there(&self) -> Vec<bool> {
        match self {
            Self::Integers(values) => values.iter().map(Option::is_some).collect(),
            Self::Numbers(values) => values.iter().map(Option::is_some).collect(),
            Self::Texts(values) => values.iter().map(Option::is_some).collect(),
        }
    }

    fn encoded(&self) -> Vec<u8> {
        match self {
            Self::Integers(values) => values.iter().flatten().flat_map(|value| value.to_le_bytes()).collect(),
            Self::Numbers(values) => {
                let numbers: Vec<[u8; 8]> =
                    values.iter().flatten().map(|value| value.to_le_bytes()).collect();
                (0..8).flat_map(|byte| numbers.iter().map(move |number| number[byte])).collect()
            }
            Self::Texts(values) => values
                .iter()
                .flatten()
                .flat_map(|text| (text.len() as u32).to_le_bytes().into_iter().chain(text.bytes()))
                .collect(),
        }
    }

    /// The page, header and data, and how many bytes it has without compression.
    pub(super) fn page(&self) -> (Vec<u8>, usize) {
        let levels = levels(&self.there());
        let mut plain = (levels.len() as u32).to_le_bytes().to_vec();
        plain.extend(levels);
        plain.extend(self.encoded());
        let packed = compress_to_vec(plain.as_slice(), CompressionLevel::Fastest);
        let data = Struct::default()
            .i32(1, self.len() as i32)
            .i32(2, self.kind().encoding())
            .i32(3, RLE)
            .i32(4, RLE);
        let header = Struct::default()
            .i32(1, 0)
            .i32(2, plain.len() as i32)
            .i32(3, packed.len() as i32)
            .i32(4, crc32fast::hash(&packed) as i32)
            .nested(5, data);
        let mut page = header.end();
        let whole = page.len() + plain.len();
        page.extend(packed);
        (page, whole)
    }
}

/// Definition levels, 1 where there is a value, as runs of equal ones.
fn levels(there: &[bool]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for run in there.chunk_by(|one, other| one == other) {
        varint(&mut bytes, (run.len() as u64) << 1);
        bytes.push(u8::from(run[0]));
    }
    bytes
}
