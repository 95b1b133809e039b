//! Arrays of numbers in a page: bytes, deflated (zlib), in base64.

use crate::vtu::base64;
use miniz_oxide::deflate::compress_to_vec_zlib;
use serde_json::{Value, json};

/// Effort of the compression, 0 to 10: beyond it, size falls by per cents and time doubles.
const EFFORT: u8 = 6;
/// Levels of a quantised number.
const LEVELS: f64 = 65535.0;

/// `bytes` as text.
pub(super) fn packed_bytes(bytes: &[u8]) -> Value {
    let deflated = compress_to_vec_zlib(bytes, EFFORT);
    let mut text = Vec::with_capacity(deflated.len() / 3 * 4 + 4);
    base64::encode(&deflated, &mut text);
    // Base64 is ASCII.
    Value::String(String::from_utf8(text).unwrap_or_default())
}

/// `values` in single precision.
pub(super) fn packed_singles(values: &[f64]) -> Value {
    let bytes: Vec<u8> = values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect();
    packed_bytes(&bytes)
}

/// `values` in 65536 levels between their extremes, packed as [`packed_levels`]: `{ "low", "step", "data" }`, value = low +
/// step × level.
pub(super) fn quantised(values: &[f64], row: usize) -> Value {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
    let step = (high - low) / LEVELS;
    let level = |value: f64| if step > 0.0 { ((value - low) / step).round() as u16 } else { 0 };
    let levels: Vec<u16> = values.iter().map(|&value| level(value)).collect();
    json!({ "low": low, "step": step, "data": packed_levels(&levels, row) })
}

/// Whole numbers as differences from one to the next in rows of `row` (each begins anew). First the low bytes, then the
/// high ones: the latter are mostly zero.
pub(super) fn packed_levels(levels: &[u16], row: usize) -> Value {
    let mut lows = Vec::with_capacity(2 * levels.len());
    let mut highs = Vec::with_capacity(levels.len());
    for row in levels.chunks(row.max(1)) {
        let mut before = 0u16;
        for &now in row {
            // Small differences of either sign become small numbers: 0, −1, 1, −2, …
            let difference = now.wrapping_sub(before) as i16;
            let folded = ((difference << 1) ^ (difference >> 15)) as u16;
            lows.push(folded as u8);
            highs.push((folded >> 8) as u8);
            before = now;
        }
    }
    lows.append(&mut highs);
    packed_bytes(&lows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    fn unpacked(value: &Value) -> Vec<u8> {
        let text = value.as_str().unwrap();
        decompress_to_vec_zlib(&base64::decode(text.as_bytes(), usize::MAX).unwrap()).unwrap()
    }

    /// As the page's script reads it.
    fn levels(bytes: &[u8], row: usize) -> Vec<u16> {
        let count = bytes.len() / 2;
        let mut before = 0u16;
        (0..count)
            .map(|i| {
                let folded = u16::from(bytes[i]) | u16::from(bytes[count + i]) << 8;
                let difference = (folded >> 1) ^ (folded & 1).wrapping_neg();
                before = if i % row == 0 { difference } else { before.wrapping_add(difference) };
                before
            })
            .collect()
    }

    #[test]
    fn quantised_numbers_are_within_half_a_level() {
        let values: Vec<f64> = (0..600).map(|i| (0.05 * i as f64).sin() * 845.0 - 3.0).collect();
        let packed = quantised(&values, 50);
        let (low, step) = (packed["low"].as_f64().unwrap(), packed["step"].as_f64().unwrap());
        let levels = levels(&unpacked(&packed["data"]), 50);
        assert!((step - 2.0 * 845.0 / LEVELS).abs() < 1e-3);
        for (&value, level) in values.iter().zip(levels) {
            // Half a level and round-off.
            assert!((low + step * f64::from(level) - value).abs() < 0.5001 * step, "{value}");
        }
    }

    #[test]
    fn equal_and_no_numbers_are_fine() {
        let packed = quantised(&[7.0; 5], 5);
        assert_eq!((packed["low"].as_f64(), packed["step"].as_f64()), (Some(7.0), Some(0.0)));
        assert_eq!(quantised(&[], 5)["low"].as_f64(), Some(0.0));
        assert_eq!(unpacked(&packed_singles(&[1.5])), 1.5f32.to_le_bytes());
    }
}
