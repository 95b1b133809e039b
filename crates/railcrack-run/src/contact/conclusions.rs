//! Sentences about the wheels of a case.

use super::across::GrowthAcross;
use super::rows::WheelRow;
use railcrack_case::{Case, WheelGroups, WheelTable};

/// Conclusions from the rows: who grows the cracks, the error of the representatives, the worst
/// place.
pub fn sentences(case: &Case, rows: &[WheelRow], across: Option<&GrowthAcross>) -> Vec<String> {
    let mut all = Vec::new();
    let mut shares: Vec<f64> = rows.iter().map(|row| row.growth_share).collect();
    shares.sort_by(|a, b| b.total_cmp(a));
    let (mut sum, mut count) = (0.0, 0);
    while sum < 0.5 && count < shares.len() {
        sum += shares[count];
        count += 1;
    }
    if rows.len() > 1 && sum > 0.0 {
        all.push(format!("{count} of {} wheels cause half of the growth", rows.len()));
    }
    if let Some(table) = &case.wheel_table
        && let Some(groups) = &table.groups
    {
        let missed = table.missed(groups);
        if missed > 0.0 {
            all.push(format!(
                "the patches of {:.1} % of the axles miss the crack at {} mm",
                100.0 * missed,
                table.lateral
            ));
        }
        if table.is_whole {
            all.push(in_space(case, table, groups));
            return with_worst_place(all, across);
        }
        let error = representatives_error(rows);
        all.push(format!(
            "{} representatives: mean growth rate off by {:+.2} % of that of all wheels, computed one by one ({:+.2} % by the coarse crack){}",
            groups.representatives.len(),
            100.0 * error,
            100.0 * groups.error,
            if error.abs() > table.accepted { "; more than representatives_error" } else { "" }
        ));
    }
    with_worst_place(all, across)
}

/// `all` with the place where the crack would grow fastest.
fn with_worst_place(mut all: Vec<String>, across: Option<&GrowthAcross>) -> Vec<String> {
    if let Some(across) = across {
        let (place, rate) = across.worst();
        all.push(format!(
            "the crack would grow fastest at lateral_mm = {place:.1}, {rate:.2} times as fast as here, by {}",
            across.by
        ));
    }
    all
}

/// Where the patches of a table lie in space, and the error of its representatives.
fn in_space(case: &Case, table: &WheelTable, groups: &WheelGroups) -> String {
    let aside: f64 = table
        .wheels
        .iter()
        .filter(|wheel| !wheel.wheel.over(table.lateral).iter().any(|own| own.patch.half_length(own.y) > 0.0))
        .map(|wheel| wheel.share)
        .sum();
    let error = match table.wheels.len() > groups.representatives.len() {
        true => format!(
            "{} representatives, whose mean growth rate is off by {:+.2} % of that of all wheels by the coarse crack{}; the other wheels are \
             those of the coarse crack times what it misses of their representative",
            groups.representatives.len(),
            100.0 * groups.error,
            if groups.error.abs() > table.accepted { ", more than representatives_error" } else { "" }
        ),
        false => format!("all {} wheels are computed", table.wheels.len()),
    };
    let whose = if case.cracks.cracks().len() > 1 {
        "the middle of the first crack"
    } else {
        "the middle of the crack"
    };
    format!(
        "the patches of {:.1} % of the axles lie beside {whose} and load it all the same; {error}",
        100.0 * aside
    )
}

/// Mean rate of the representatives over that of all wheels, less 1.
fn representatives_error(rows: &[WheelRow]) -> f64 {
    let all: f64 = rows.iter().map(|row| row.share * row.rate).sum();
    let by: f64 =
        rows.iter().map(|row| row.share * row.represented_by.map_or(0.0, |other| rows[other].rate)).sum();
    if all > 0.0 { by / all - 1.0 } else { 0.0 }
}
