//! Arrays of numbers in a page: bytes, deflated (zlib), in base64.

use crate::svg::ends;
use data_encoding::BASE64;
use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::decompress_to_vec_zlib;
use serde::{Serialize, Serializer};
use std::ops::Range;

/// Effort of the compression, 0 to 10: beyond it, size falls by per cents and time doubles.
const EFFORT: u8 = 9;
/// Levels of a quantised number.
const LEVELS: u16 = u16::MAX;

/// Bytes, deflated; base64 in a page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Deflated(Vec<u8>);

impl Deflated {
    pub(crate) fn of(bytes: &[u8]) -> Self {
        let mut deflated = compress_to_vec_zlib(bytes, EFFORT);
        deflated.shrink_to_fit();
        Self(deflated)
    }

    /// `values` in single precision.
    pub(crate) fn singles(values: &[f64]) -> Self {
        let bytes: Vec<u8> = values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect();
        Self::of(&bytes)
    }

    /// Whole numbers in rows of `row`, as differences from the number above; those of the first row
    /// from the number before. First the low bytes, then the high ones: the latter are mostly zero.
    pub(crate) fn levels(levels: &[u16], row: usize) -> Self {
        let mut lows = Vec::with_capacity(2 * levels.len());
        let mut highs = Vec::with_capacity(levels.len());
        for (i, &level) in levels.iter().enumerate() {
            // Small differences of either sign become small numbers: 0, −1, 1, −2, …
            let difference = level.wrapping_sub(near(levels, i, row)) as i16;
            let folded = ((difference << 1) ^ (difference >> 15)) as u16;
            lows.push(folded as u8);
            highs.push((folded >> 8) as u8);
        }
        lows.append(&mut highs);
        Self::of(&lows)
    }

    /// The bytes.
    pub(crate) fn inflated(&self) -> Vec<u8> {
        // Data deflated here can be inflated.
        decompress_to_vec_zlib(&self.0).unwrap_or_default()
    }

    /// The levels given to [`Deflated::levels`].
    fn inflated_levels(&self, row: usize) -> Vec<u16> {
        let bytes = self.inflated();
        let (lows, highs) = bytes.split_at(bytes.len() / 2);
        let mut levels = Vec::with_capacity(lows.len());
        for (i, (&low, &high)) in lows.iter().zip(highs).enumerate() {
            let folded = u16::from_le_bytes([low, high]);
            let difference = (folded >> 1) ^ (folded & 1).wrapping_neg();
            levels.push(near(&levels, i, row).wrapping_add(difference));
        }
        levels
    }
}

/// The level above the one with number `i` in rows of `row`; in the first row, the one before.
fn near(levels: &[u16], i: usize, row: usize) -> u16 {
    i.checked_sub(if i < row { 1 } else { row.max(1) }).map_or(0, |place| levels[place])
}

impl Serialize for Deflated {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&BASE64.encode(&self.0))
    }
}

/// Numbers in levels between their extremes, in rows: value = low + step × level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Quantised {
    low: f64,
    step: f64,
    data: Deflated,
    #[serde(skip)]
    row: usize,
}

impl Quantised {
    /// `values` in rows of `row`, in 65536 levels.
    pub(crate) fn of(values: &[f64], row: usize) -> Self {
        Self::rounded(LEVELS, 1, values, row)
    }

    /// Of `values` in rows of `row`, in each every `stride`-th and the last, in levels from 0 to
    /// `highest`. These are those of all values.
    pub(crate) fn rounded(highest: u16, stride: usize, values: &[f64], row: usize) -> Self {
        let [low, high] = ends(values.iter().copied());
        let step = (high - low) / f64::from(highest);
        let level = |value: f64| if step > 0.0 { ((value - low) / step).round() as u16 } else { 0 };
        let levels: Vec<u16> = every(stride, values, row).map(level).collect();
        let row = every_count(stride, row);
        Self { low, step, data: Deflated::levels(&levels, row), row }
    }

    /// Of each row every other number and the last.
    pub(crate) fn halved(&self) -> Self {
        let levels: Vec<u16> = every(2, &self.data.inflated_levels(self.row), self.row).collect();
        let row = every_count(2, self.row);
        Self { data: Deflated::levels(&levels, row), row, ..*self }
    }

    /// Of each row the numbers at these `places`.
    pub(crate) fn within(&self, places: &Range<usize>) -> Self {
        let levels = self.data.inflated_levels(self.row);
        let levels: Vec<u16> = within(&levels, self.row, places).collect();
        Self { data: Deflated::levels(&levels, places.len()), row: places.len(), ..*self }
    }
}

/// Of `values` in rows of `row`, in each those at these `places`.
pub(crate) fn within<T: Copy>(values: &[T], row: usize, places: &Range<usize>) -> impl Iterator<Item = T> {
    values.chunks(row.max(1)).flat_map(|row| row.get(places.clone()).unwrap_or_default().iter().copied())
}

/// Of `values` in rows of `row`, in each every `stride`-th and the last.
pub(crate) fn every<T: Copy>(stride: usize, values: &[T], row: usize) -> impl Iterator<Item = T> {
    let kept = move |i: usize| i.is_multiple_of(stride) || i + 1 == row;
    values
        .chunks(row.max(1))
        .flat_map(move |row| row.iter().enumerate().filter(move |&(i, _)| kept(i)).map(|(_, &value)| value))
}

/// How many of a row of `row` are kept by [`every`].
pub(crate) fn every_count(stride: usize, row: usize) -> usize {
    row.saturating_sub(1).div_ceil(stride) + usize::from(row > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waves(count: usize) -> Vec<f64> {
        (0..count).map(|i| (0.05 * i as f64).sin() * 845.0 - 3.0).collect()
    }

    #[test]
    fn quantised_numbers_are_within_half_a_level() {
        let values = waves(600);
        let packed = Quantised::of(&values, 50);
        let levels = packed.data.inflated_levels(50);
        assert!((packed.step - 2.0 * 845.0 / f64::from(LEVELS)).abs() < 1e-3);
        for (&value, level) in values.iter().zip(levels) {
            // Half a level and round-off.
            assert!(
                (packed.low + packed.step * f64::from(level) - value).abs() < 0.5001 * packed.step,
                "{value}"
            );
        }
    }

    #[test]
    fn equal_and_no_numbers_are_fine() {
        let packed = Quantised::of(&[7.0; 5], 5);
        assert_eq!((packed.low, packed.step), (7.0, 0.0));
        assert_eq!((Quantised::of(&[], 5).low, Quantised::of(&[], 0).halved().row), (0.0, 0));
        assert_eq!(Deflated::singles(&[1.5]).inflated(), 1.5f32.to_le_bytes());
    }

    #[test]
    fn to_halve_twice_is_to_keep_every_fourth() {
        for row in [1, 2, 4, 5, 6, 7, 8, 9, 241] {
            let values = waves(3 * row);
            let [twice, fourth] = [2, 4].map(|stride| Quantised::rounded(LEVELS, stride, &values, row));
            assert_eq!(Quantised::rounded(LEVELS, 1, &values, row).halved(), twice, "rows of {row}");
            assert_eq!(twice.halved(), fourth, "rows of {row}");
            assert_eq!(fourth.data.inflated().len(), 2 * 3 * fourth.row, "rows of {row}");
            let last = every(4, &values, row).skip(fourth.row - 1).step_by(fourth.row);
            assert!(last.eq(values.iter().copied().skip(row - 1).step_by(row)), "rows of {row}");
        }
    }
}
