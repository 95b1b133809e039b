//! Checksum of the pages of Parquet: CRC-32 with the polynomial of zlib.

/// Of each byte, the remainder that it leaves.
const TABLE: [u32; 256] = table();

const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut rest = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            rest = if rest & 1 == 1 { rest >> 1 ^ 0xedb8_8320 } else { rest >> 1 };
            bit += 1;
        }
        table[byte] = rest;
        byte += 1;
    }
    table
}

/// The checksum of `bytes`.
pub(super) fn crc(bytes: &[u8]) -> u32 {
    let add = |rest: u32, &byte: &u8| rest >> 8 ^ TABLE[usize::from(rest as u8 ^ byte)];
    !bytes.iter().fold(!0, add)
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_check_value_is_that_of_the_definition() {
        // Catalogue of parametrised CRC algorithms, CRC-32/ISO-HDLC.
        assert_eq!(super::crc(b"123456789"), 0xcbf4_3926);
    }
}
