//! Conversion between the internal units, mm and MPa √mm, and those of input and output.

/// √1000: MPa √mm in one MPa √m.
pub const MPA_SQRT_MM: f64 = 31.622_776_601_683_793;
