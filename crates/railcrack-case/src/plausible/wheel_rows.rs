//! Unusual numbers in the rows of a table of wheels.

use super::loads::counted;
use super::ranges::of_column;
use super::spin::too_much_spin;
use super::topic::{Implausible, Topic};
use crate::case::TabledWheel;

/// Numbers of the rows of a table that are unusual, one remark for each column.
pub(super) fn of_table_rows(wheels: &[TabledWheel]) -> Vec<Implausible> {
    let mut found: Vec<(&'static str, String, usize)> = Vec::new();
    for wheel in wheels {
        for own in &wheel.wheel.patches {
            let creepage = own.patch.creepage;
            let remarks = [
                ("normal_kn", 1e-3 * own.patch.normal_force()),
                ("creepage_x", creepage.longitudinal),
                ("creepage_y", creepage.lateral),
                ("mu", own.patch.friction),
                ("a_mm", own.patch.ellipse.along),
                ("b_mm", own.patch.ellipse.across),
            ]
            .map(|(column, value)| (column, of_column(column).and_then(|usual| usual.remark(column, value))));
            let of_axle = wheel
                .wheel
                .axle_load
                .and_then(|tonnes| of_column("axle_load_t")?.remark("axle_load_t", tonnes));
            let of_radius = own
                .wheel_radius
                .and_then(|radius| of_column("wheel_radius_mm")?.remark("wheel_radius_mm", radius));
            let others = [
                ("axle_load_t", of_axle),
                ("wheel_radius_mm", of_radius),
                ("spin_per_mm", too_much_spin(creepage.spin, own.wheel_radius)),
            ];
            for (column, remark) in remarks.into_iter().chain(others) {
                let Some(remark) = remark else { continue };
                match found.iter_mut().find(|(known, ..)| *known == column) {
                    Some((.., count)) => *count += 1,
                    None => found.push((column, format!("wheel {}: {remark}", wheel.wheel.number), 1)),
                }
            }
        }
    }
    let told = |(_, text, count): (&str, String, usize)| Implausible {
        topic: Topic::Quantity,
        text: counted(count, wheels.len(), &text),
    };
    found.into_iter().map(told).collect()
}
