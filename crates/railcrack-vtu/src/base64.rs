//! Base64 (RFC 4648, section 4) of VTK files.

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The value of each letter; [`NONE`] for other characters.
const VALUES: [u8; 256] = {
    let mut values = [NONE; 256];
    let mut value = 0;
    while value < LETTERS.len() {
        values[LETTERS[value] as usize] = value as u8;
        value += 1;
    }
    values
};
const NONE: u8 = 64;

/// Appends `bytes` to `text`.
pub fn encode(bytes: &[u8], text: &mut Vec<u8>) {
    text.reserve(bytes.len().div_ceil(3) * 4);
    let letters = |group: [u8; 3]| {
        let bits = u32::from_be_bytes([0, group[0], group[1], group[2]]);
        [18, 12, 6, 0].map(|shift| LETTERS[(bits >> shift) as usize & 63])
    };
    let (groups, rest) = bytes.as_chunks::<3>();
    groups.iter().for_each(|&group| text.extend_from_slice(&letters(group)));
    if !rest.is_empty() {
        let padded = letters([rest[0], rest.get(1).copied().unwrap_or(0), 0]);
        text.extend_from_slice(&padded[..=rest.len()]);
        text.resize(text.len() + 3 - rest.len(), b'=');
    }
}

/// The bytes that `text` encodes, without white space, at most `most` of them; the error is the
/// position of the first invalid letter. Padding may occur between groups: VTK encodes header and
/// data one by one.
pub fn decode(text: &[u8], most: usize) -> Result<Vec<u8>, usize> {
    let mut bytes = Vec::with_capacity((text.len() / 4 * 3).min(most));
    let (mut bits, mut letters, mut padding) = (0u32, 0, 0);
    let mut at = 0;
    while at < text.len() && bytes.len() < most {
        if letters == 0
            && let Some(group) = whole_group(&text[at..])
        {
            bytes.extend_from_slice(&group.to_be_bytes()[1..]);
            at += 4;
            continue;
        }
        let letter = text[at];
        at += 1;
        if letter.is_ascii_whitespace() {
            continue;
        }
        let value = match (VALUES[usize::from(letter)], letter) {
            (NONE, b'=') if letters >= 2 => {
                padding += 1;
                0
            }
            (value, _) if value != NONE && padding == 0 => u32::from(value),
            _ => return Err(at - 1),
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

/// The 24 bits of the next four letters, unless there are other characters among them.
fn whole_group(text: &[u8]) -> Option<u32> {
    let [a, b, c, d] = text.first_chunk::<4>()?.map(|letter| u32::from(VALUES[usize::from(letter)]));
    (a | b | c | d < u32::from(NONE)).then_some(a << 18 | b << 12 | c << 6 | d)
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
    fn every_byte_survives_the_round_trip() {
        let bytes: Vec<u8> = (0..=255).rev().cycle().take(1000).collect();
        assert_eq!(decode(encoded(&bytes).as_bytes(), usize::MAX).unwrap(), bytes);
    }

    #[test]
    fn separately_encoded_parts_are_read_as_one() {
        let text = format!(" {}\n  {} ", encoded(b"head"), encoded(b"body"));
        assert_eq!(decode(text.as_bytes(), usize::MAX).unwrap(), b"headbody");
        assert_eq!(decode(text.as_bytes(), 5).unwrap(), b"headb");
    }

    #[test]
    fn invalid_base64_is_located() {
        for (text, at) in [("Zm9-", 3), ("Zg=v", 3), ("=Zg=", 0), ("Zm9vY", 5), ("Zg=", 3)] {
            assert_eq!(decode(text.as_bytes(), usize::MAX), Err(at), "{text}");
        }
    }
}
