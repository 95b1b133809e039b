//! A case under the representatives of its table of wheels.

use super::grouping::grouped;
use railcrack_case::{Case, GivenWheel, TrafficWheel, WheelGroups, WheelLoading, WheelTable};
use std::borrow::Cow;

/// `case` as a run computes it: with representatives of the wheels of its table, which are grouped
/// unless they are already.
#[must_use]
pub fn represented(case: &Case) -> Cow<'_, Case> {
    match &case.wheel_table {
        Some(table) if table.groups.is_none() => {
            let groups = grouped(case, table);
            represented_in(case, groups).map_or(Cow::Borrowed(case), Cow::Owned)
        }
        _ => Cow::Borrowed(case),
    }
}

/// `case` with the representatives of `groups` instead of the wheels of its table. None where the
/// groups are not those of its table.
#[must_use]
pub fn represented_in(case: &Case, groups: WheelGroups) -> Option<Case> {
    let table = case.wheel_table.as_ref().filter(|table| table.groups.is_none())?;
    let count = table.wheels.len();
    let known = groups.representatives.iter().all(|wheel| *wheel < count)
        && groups.group_of.iter().flatten().all(|group| *group < groups.representatives.len());
    if !known || groups.group_of.len() != count || groups.representatives.is_empty() {
        return None;
    }
    let own = |wheel: usize| &case.wheels[table.first + wheel];
    let mut wheels: Vec<TrafficWheel> = case.wheels[..table.first].to_vec();
    for (group, chosen) in groups.representatives.iter().enumerate() {
        let members = members(&groups, Some(group));
        let name = match members.len() {
            1 => own(*chosen).name.clone(),
            alike => format!("{} and {} like it", own(*chosen).name, alike - 1),
        };
        wheels.push(TrafficWheel {
            name,
            share: share(table, &members),
            axle_load: mean_axle_load(case, table, &members),
            ..own(*chosen).clone()
        });
    }
    let missing = members(&groups, None);
    if !missing.is_empty() {
        let like = own(groups.representatives[0]);
        let loading = WheelLoading::Misses { half_width: like.wheel.half_width() };
        wheels.push(TrafficWheel {
            name: "wheels that miss the crack".to_owned(),
            share: share(table, &missing),
            axle_load: mean_axle_load(case, table, &missing),
            wheel: GivenWheel { loading, ..like.wheel.clone() },
            ..like.clone()
        });
    }
    Some(case.clone().represented_by(wheels, groups))
}

/// The wheels of the table that are in `group`, those that miss the cracks in none.
fn members(groups: &WheelGroups, group: Option<usize>) -> Vec<usize> {
    (0..groups.group_of.len()).filter(|wheel| groups.group_of[*wheel] == group).collect()
}

fn share(table: &WheelTable, members: &[usize]) -> f64 {
    members.iter().fold(0.0, |sum, wheel| sum + table.wheels[*wheel].share)
}

/// The mean load (t) of the axles of `members`; where the table does not give it for all of them,
/// that of the case, if any.
fn mean_axle_load(case: &Case, table: &WheelTable, members: &[usize]) -> Option<f64> {
    let of_table = |wheel: &usize| table.wheels[*wheel].wheel.axle_load;
    let not_given = members.iter().find(|wheel| of_table(wheel).is_none());
    if let Some(wheel) = not_given {
        return case.wheels[table.first + wheel].axle_load;
    }
    let all = members.iter().map(|wheel| table.wheels[*wheel].share * of_table(wheel).unwrap_or_default());
    let share = share(table, members);
    (share > 0.0).then(|| all.sum::<f64>() / share)
}
