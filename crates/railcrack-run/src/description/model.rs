//! The rail of a case, and the limits of its model.

use super::row::Row;
use crate::numbers::short;
use railcrack::bulk::Boundary;
use railcrack::words::Choice;
use railcrack_case::Case;

pub(super) fn rail(case: &Case) -> Vec<Row> {
    let (left, right) = case.rail.ends();
    let boundary = case.boundary();
    let body = match (case.plane(), boundary) {
        (None, _) => "half-space, without curvature of the head and gauge corner".to_owned(),
        (Some(plane), Boundary::HalfPlane) => plane.section.map_or_else(
            || boundary.word().to_owned(),
            |section| format!("{}, cracked with the section {}", boundary.word(), section.name),
        ),
        (Some(_), Boundary::Block { bottom, sides }) => {
            let [width, depth] = [case.rail.width, case.rail.depth].map(short);
            format!("block of {width} by {depth} mm, bottom {}, sides {}", bottom.word(), sides.word())
        }
    };
    vec![
        Row::with(
            "elasticity",
            "E = {E}, nu = {nu}",
            [("E", case.steel.young(), "MPa"), ("nu", case.steel.poisson(), "")],
        ),
        Row::text("boundary", body),
        Row::with(
            "cracks stay within",
            "x = {left:} to {right}, depth {depth}",
            [("left", left, "mm"), ("right", right, "mm"), ("depth", case.rail.depth, "mm")],
        ),
    ]
}

/// Limits of the model: the effects that it leaves out.
pub(super) fn limits(case: &Case) -> Vec<Row> {
    let cracks = match case.space() {
        None => "plane strain: cracks that are wide across the rail",
        Some(_) if case.growth.turns_in_space => {
            "cracks that turn about the direction of their mouths, without twist, and stop before they meet"
        }
        Some(space) if space.shapes.iter().any(|shape| shape.strip.is_some()) => {
            "a straight fold as long as the mouth, without twist, and one branch; strip and branch grow in their planes"
        }
        Some(_) => "plane cracks that grow in their planes and stop before they meet",
    };
    let mut rows = vec![
        Row::text("cracks", cracks),
        Row::text("tips", "small-scale yielding; the residual stress does not relax as the cracks grow"),
    ];
    if !case.has_fluid() {
        rows.push(Row::text("fluid", "none"));
    }
    if case.maintenance.is_none() {
        rows.push(Row::text("wear", "none"));
    }
    rows
}
