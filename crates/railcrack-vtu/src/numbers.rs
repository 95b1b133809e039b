//! Binary numbers in VTK files.

/// Order of the bytes of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ByteOrder {
    Little,
    Big,
}

/// The type of the numbers of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberType {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float32,
    Float64,
}

impl NumberType {
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "Int8" => Self::Int8,
            "UInt8" => Self::UInt8,
            "Int16" => Self::Int16,
            "UInt16" => Self::UInt16,
            "Int32" => Self::Int32,
            "UInt32" => Self::UInt32,
            "Int64" => Self::Int64,
            "UInt64" => Self::UInt64,
            "Float32" => Self::Float32,
            "Float64" => Self::Float64,
            _ => return None,
        })
    }

    /// Size of one number in bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Int8 | Self::UInt8 => 1,
            Self::Int16 | Self::UInt16 => 2,
            Self::Int32 | Self::UInt32 | Self::Float32 => 4,
            Self::Int64 | Self::UInt64 | Self::Float64 => 8,
        }
    }

    /// The numbers in `bytes`; bytes beyond the last whole number are ignored. Integers beyond 2⁵³
    /// lose digits; indices and counts of a grid are smaller.
    pub(super) fn decode(self, bytes: &[u8], order: ByteOrder) -> Vec<f64> {
        macro_rules! numbers {
            ($number:ty) => {{
                let (whole, _) = bytes.as_chunks::<{ size_of::<$number>() }>();
                let number = |&chunk| match order {
                    ByteOrder::Little => <$number>::from_le_bytes(chunk) as f64,
                    ByteOrder::Big => <$number>::from_be_bytes(chunk) as f64,
                };
                whole.iter().map(number).collect()
            }};
        }
        match self {
            Self::Int8 => numbers!(i8),
            Self::UInt8 => numbers!(u8),
            Self::Int16 => numbers!(i16),
            Self::UInt16 => numbers!(u16),
            Self::Int32 => numbers!(i32),
            Self::UInt32 => numbers!(u32),
            Self::Int64 => numbers!(i64),
            Self::UInt64 => numbers!(u64),
            Self::Float32 => numbers!(f32),
            Self::Float64 => numbers!(f64),
        }
    }
}
