//! The cracks of a case, in the plane and in space.

use super::row::Row;
use crate::numbers::short;
use crate::setup::wheel_patches;
use railcrack::crack::Crack;
use railcrack::growth::FrontShape;
use railcrack::space::CellDivision;
use railcrack_case::Case;

/// The cracks, a line of a table for each.
pub(super) fn cracks(case: &Case) -> Vec<Row> {
    let mut different = case.crack_friction.clone();
    different.dedup();
    let different: Vec<String> = different.into_iter().map(short).collect();
    let columns = "   #   x mm        y mm        length mm   angle deg   friction   tips mm";
    let mut rows = vec![Row::number("number", case.cracks.cracks().len() as f64, ""), Row::line(columns)];
    for (i, (crack, friction)) in case.cracks.cracks().iter().zip(&case.crack_friction).enumerate() {
        rows.push(Row::line(crack_line(i + 1, crack, *friction)));
    }
    rows.extend([
        Row::text(
            "faces",
            "no initial gap, unilateral contact, Coulomb friction; stick and slip are reset at the start of each growth step",
        ),
        Row::text("friction", different.join(", ")),
    ]);
    rows
}

fn crack_line(count: usize, crack: &Crack, friction: f64) -> String {
    let (first, next) = crack.segment(0);
    let angle = -(next - first).angle().to_degrees();
    let tips: Vec<String> = crack
        .tips()
        .into_iter()
        .map(|end| crack.tip(end))
        .map(|tip| format!("({}, {})", short(tip.x), short(tip.y)))
        .collect();
    format!(
        "{count:>4}   {:<11} {:<11} {:<11} {:<11} {:<10} {}",
        short(first.x),
        short(first.y),
        short(crack.length()),
        short(angle),
        short(friction),
        tips.join(" ")
    )
}

/// The cracks of a case in space.
pub(super) fn in_space(case: &Case) -> Vec<Row> {
    let Some(space) = case.space() else { return Vec::new() };
    let mut rows: Vec<Row> = space.shapes.iter().flat_map(shape).collect();
    let mut divisions: Vec<CellDivision> = Vec::new();
    for division in space.divisions() {
        if !divisions.contains(&division) {
            divisions.push(division);
        }
    }
    for CellDivision { columns, rows: own, ring, .. } in divisions {
        let rows_of_block = if own == columns { String::new() } else { format!(" in {own} rows") };
        let text = format!("{columns} on each side of the middle{rows_of_block}, {ring} to the front");
        rows.push(Row::text("cells", text));
    }
    let patches = wheel_patches(case);
    let lateral: Vec<f64> = patches.iter().map(|wheel| wheel.outline().lateral_friction).collect();
    if lateral.iter().any(|friction| *friction != 0.0) {
        let texts: Vec<String> = lateral.iter().map(|friction| short(*friction)).collect();
        rows.push(Row::text("lateral friction", texts.join(", ")));
    }
    rows
}

/// A crack with a front.
fn shape(shape: &FrontShape) -> Vec<Row> {
    let mut rows = Vec::new();
    if let Some(strip) = shape.strip {
        rows.push(Row::with(
            "to the fold",
            "{length} from the mouth, at {dip}; below it the branch:",
            [("length", strip, "mm"), ("dip", shape.dip.to_degrees(), "degrees")],
        ));
    }
    let [x, z] = shape.middle;
    rows.extend([
        Row::with(
            "semi-axes",
            "{down} down the dip, {along} along the surface",
            [("down", shape.length, "mm"), ("along", shape.half_length, "mm")],
        ),
        Row::number("dip", shape.front_dip().to_degrees(), "degrees"),
        Row::number("strike", shape.strike.to_degrees(), "degrees"),
        Row::with("middle", "x = {x}, z = {z}", [("x", x, "mm"), ("z", z, "mm")]),
    ]);
    let buried =
        shape.buried.map(|centre| Row::with("buried", "{depth} down the dip", [("depth", centre, "mm")]));
    rows.extend(buried);
    rows
}
