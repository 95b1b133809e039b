//! Student's distribution.

/// Student's t of 97.5 % for some `degrees` of freedom: a table, between its entries from above.
#[must_use]
pub fn student(degrees: usize) -> f64 {
    const TABLE: [(usize, f64); 14] = [
        (1, 12.706),
        (2, 4.303),
        (3, 3.182),
        (4, 2.776),
        (5, 2.571),
        (6, 2.447),
        (7, 2.365),
        (8, 2.306),
        (9, 2.262),
        (10, 2.228),
        (15, 2.131),
        (20, 2.086),
        (30, 2.042),
        (60, 2.000),
    ];
    let below = TABLE.iter().rev().find(|(n, _)| *n <= degrees);
    if degrees > 120 { 1.98 } else { below.map_or(TABLE[0].1, |(_, t)| *t) }
}
