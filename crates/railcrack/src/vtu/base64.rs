//! Base64 (RFC 4648, section 4), as VTK files hold it.

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Appends `bytes` to `text`.
pub(crate) fn encode(bytes: &[u8], text: &mut Vec<u8>) {
    for group in bytes.chunks(3) {
        let byte = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * place)) as usize & 63];
            text.push(if place <= group.len() { letter } else { b'=' });
        }
    }
}

/// The bytes that `text` encodes, white space left out, or the first `most` of them; the position of the first letter that
/// does not belong there. Padding may occur between groups: VTK encodes header and data one by one.
pub(crate) fn decode(text: &[u8], most: usize) -> Result<Vec<u8>, usize> {
    let mut bytes = Vec::with_capacity((text.len() / 4 * 3).min(most));
    let (mut bits, mut letters, mut padding) = (0u32, 0, 0);
    for (at, &letter) in text.iter().enumerate() {
        if bytes.len() >= most {
            break;
        }
        if letter.is_ascii_whitespace() {
            continue;
        }
        let value = match (value_of(letter), letter) {
            (Some(value), _) if padding == 0 => value,
            (None, b'=') if letters >= 2 => {
                padding += 1;
                0
            }
            _ => return Err(at),
        };
        (bits, letters) = (bits << 6 | value, letters + 1);
        if letters == 4 {
            bytes.extend_from_slice(&bits.to_be_bytes()[1..4 - padding]);
            (bits, letters, padding) = (0, 0, 0);
        }
    }
    if letters != 0 && bytes.len() < most {
        return Err(text.len());
    }
    bytes.truncate(most);
    Ok(bytes)
}

fn value_of(letter: u8) -> Option<u32> {
    let value = match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    };
    Some(u32::from(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(bytes: &[u8]) -> String {
        let mut text = Vec::new();
        encode(bytes, &mut text);
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn the_vectors_of_rfc_4648() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, text) in vectors {
            assert_eq!(encoded(plain.as_bytes()), text);
            assert_eq!(decode(text.as_bytes(), usize::MAX).unwrap(), plain.as_bytes());
        }
    }

    #[test]
    fn every_byte_survives() {
        let bytes: Vec<u8> = (0..=255).rev().cycle().take(1000).collect();
        assert_eq!(decode(encoded(&bytes).as_bytes(), usize::MAX).unwrap(), bytes);
    }

    #[test]
    fn parts_encoded_one_by_one_are_read_in_one_go() {
        let text = format!(" {}\n  {} ", encoded(b"head"), encoded(b"body"));
        assert_eq!(decode(text.as_bytes(), usize::MAX).unwrap(), b"headbody");
        assert_eq!(decode(text.as_bytes(), 5).unwrap(), b"headb");
    }

    #[test]
    fn what_is_no_base64_is_refused_where_it_stands() {
        for (text, at) in [("Zm9-", 3), ("Zg=v", 3), ("=Zg=", 0), ("Zm9vY", 5), ("Zg=", 3)] {
            assert_eq!(decode(text.as_bytes(), usize::MAX), Err(at), "{text}");
        }
    }
}
