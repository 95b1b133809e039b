//! Base64 (RFC 4648, section 4) of VTK files.

use data_encoding::{BASE64, Encoding};
use std::sync::LazyLock;

/// Letters with white space among them. Padding may occur between groups: VTK encodes header and
/// data one by one.
static SPACED: LazyLock<Encoding> = LazyLock::new(|| {
    let mut letters = BASE64.specification();
    letters.ignore.push_str(" \t\r\n");
    letters.encoding().unwrap_or(BASE64)
});

/// The bytes that `text` begins with, at most `most` of them; the error is the position of the
/// first invalid letter before them, or of a group that is not whole.
pub(super) fn decode(text: &[u8], most: usize) -> Result<Vec<u8>, usize> {
    // A group of four letters for three bytes, and one for the end of either part.
    let letters = most.div_ceil(3).saturating_add(2).saturating_mul(4);
    let mut places = text.iter().enumerate().filter(|(_, letter)| !letter.is_ascii_whitespace());
    let text = &text[..places.nth(letters).map_or(text.len(), |(place, _)| place)];
    let mut bytes = vec![0; SPACED.decode_len(text.len()).map_err(|error| error.position)?];
    let (length, fault) = match SPACED.decode_mut(text, &mut bytes) {
        Ok(length) => (length, None),
        Err(partial) => (partial.written, Some(partial.error.position)),
    };
    match fault {
        Some(position) if length < most => Err(position),
        _ => {
            bytes.truncate(length.min(most));
            Ok(bytes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_the_round_trip() {
        let bytes: Vec<u8> = (0..=255).rev().cycle().take(1000).collect();
        assert_eq!(decode(BASE64.encode(&bytes).as_bytes(), usize::MAX).unwrap(), bytes);
    }

    #[test]
    fn separately_encoded_parts_are_read_as_one() {
        let text = format!(" {}\n  {} ", BASE64.encode(b"head"), BASE64.encode(b"body"));
        assert_eq!(decode(text.as_bytes(), usize::MAX).unwrap(), b"headbody");
        assert_eq!(decode(text.as_bytes(), 5).unwrap(), b"headb");
        // What follows the bytes is not read.
        let text = format!("{}</AppendedData>", BASE64.encode(b"headbo"));
        assert_eq!(decode(text.as_bytes(), 6).unwrap(), b"headbo");
        assert_eq!(decode(text.as_bytes(), 7), Err(8));
    }

    #[test]
    fn invalid_base64_is_located() {
        for (text, at) in [("Zm9-", 3), ("Zg=v", 2), ("=Zg=", 0), ("Zm9vY", 4), ("Zg=", 0)] {
            assert_eq!(decode(text.as_bytes(), usize::MAX), Err(at), "{text}");
        }
    }
}
