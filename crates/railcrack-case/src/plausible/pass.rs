//! The pass over a case.

use super::keys::of_keys;
use super::loads::of_loads;
use super::rates::of_law;
use super::stresses::of_tables;
use super::topic::Implausible;
use super::wheel_rows::of_table_rows;
use crate::case::Case;

/// The numbers of `case` that are probably not those that are meant.
#[must_use]
pub fn implausible(case: &Case) -> Vec<Implausible> {
    let rows = case.wheel_table.as_ref().map(|table| of_table_rows(&table.wheels)).unwrap_or_default();
    let law = of_law(case).into_iter();
    law.chain(of_loads(case)).chain(rows).chain(of_keys(case)).chain(of_tables(case)).collect()
}
