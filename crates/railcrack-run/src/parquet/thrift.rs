//! The compact protocol of Thrift, in which Parquet writes its headers.

/// Kinds of fields.
const I32: u8 = 5;
const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// A struct being written: fields in the order of their numbers.
#[derive(Debug, Default)]
pub(super) struct Struct {
    bytes: Vec<u8>,
    last: i16,
}

impl Struct {
    fn field(&mut self, number: i16, kind: u8) {
        // Numbers are at most 15 apart in the headers of Parquet.
        self.bytes.push(((number - self.last) as u8) << 4 | kind);
        self.last = number;
    }

    /// A field with a whole number of 32 bits.
    pub(super) fn i32(mut self, number: i16, value: i32) -> Self {
        self.field(number, I32);
        varint(&mut self.bytes, zigzag(i64::from(value)));
        self
    }

    /// A field with a whole number of 64 bits.
    pub(super) fn i64(mut self, number: i16, value: i64) -> Self {
        self.field(number, I64);
        varint(&mut self.bytes, zigzag(value));
        self
    }

    /// A field with text.
    pub(super) fn text(mut self, number: i16, text: &str) -> Self {
        self.field(number, BINARY);
        put_text(&mut self.bytes, text);
        self
    }

    /// A field with a struct.
    pub(super) fn nested(mut self, number: i16, inner: Self) -> Self {
        self.field(number, STRUCT);
        self.bytes.append(&mut inner.end());
        self
    }

    /// A field with a list of structs.
    pub(super) fn structs(mut self, number: i16, items: Vec<Self>) -> Self {
        self.list(number, STRUCT, items.len());
        items.into_iter().for_each(|item| self.bytes.append(&mut item.end()));
        self
    }

    /// A field with a list of whole numbers of 32 bits.
    pub(super) fn numbers(mut self, number: i16, items: &[i32]) -> Self {
        self.list(number, I32, items.len());
        items.iter().for_each(|&item| varint(&mut self.bytes, zigzag(i64::from(item))));
        self
    }

    /// A field with a list of texts.
    pub(super) fn texts(mut self, number: i16, items: &[&str]) -> Self {
        self.list(number, BINARY, items.len());
        items.iter().for_each(|item| put_text(&mut self.bytes, item));
        self
    }

    fn list(&mut self, number: i16, kind: u8, length: usize) {
        self.field(number, LIST);
        if length < 15 {
            self.bytes.push((length as u8) << 4 | kind);
        } else {
            self.bytes.push(0xf0 | kind);
            varint(&mut self.bytes, length as u64);
        }
    }

    /// The bytes, with the mark of its end.
    pub(super) fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}

fn put_text(bytes: &mut Vec<u8>, text: &str) {
    varint(bytes, text.len() as u64);
    bytes.extend_from_slice(text.as_bytes());
}

/// Small numbers of either sign as small numbers.
fn zigzag(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)) as u64
}

/// Seven bits to a byte, the lowest first.
pub(super) fn varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_those_of_the_specification() {
        // thrift-compact-protocol.md: zigzag and varint of 50 399.
        let mut bytes = Vec::new();
        varint(&mut bytes, 50_399);
        assert_eq!(bytes, [0xdf, 0x89, 0x03]);
        assert_eq!([0, -1, 1, -2].map(zigzag), [0, 1, 2, 3]);
        let inner = Struct::default().i32(1, 1);
        let outer = Struct::default().i64(2, -1).text(4, "ab").nested(5, inner).numbers(6, &[3]);
        assert_eq!(outer.end(), [0x26, 1, 0x28, 2, b'a', b'b', 0x1c, 0x15, 2, 0, 0x19, 0x15, 6, 0]);
    }
}
