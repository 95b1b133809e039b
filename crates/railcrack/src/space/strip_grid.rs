//! Grid of cells on a crack with a strip above its half-ellipse.
//!
//! The half-ellipse has the grid of a crack that breaks the surface. Its columns at the lower end
//! of the strip continue through it, whose rows are parallel to the mouth.

use super::division::{CellDivision, counts_on_strip, phi_on_strip};
use super::grid::{Cell, FrontColumn, Grid};
use super::patch::Patch;
use super::shape::SpaceCrack;

/// The cells of `crack` in the plane into which it unrolls.
pub(super) fn grid_of(crack: &SpaceCrack, division: &CellDivision) -> Grid {
    let lower = Grid::new(&SpaceCrack { strip: None, ..crack.clone() }, division);
    match crack.strip {
        Some(strip) => below_strip(&lower, strip, division.strip),
        None => lower,
    }
}

/// The grid `lower` of a half-ellipse below a strip of the length `strip` (mm) in `rows`. Vertices
/// of the strip come first; the front runs from the mouth down one side of the strip, along the
/// half-ellipse and up the other side.
fn below_strip(lower: &Grid, strip: f64, rows: usize) -> Grid {
    let line = vertices_at_end(lower);
    let (columns, inside) = (line.len() - 1, line.len() - 2);
    let above = rows * inside;
    let free = above + lower.free;
    let count = free + lower.front.len() + 2 * rows;
    let below = |v: usize| if v < lower.free { above + v } else { free + rows + v - lower.free };
    let vertex = |r: usize, c: usize| match c {
        c if r == rows => below(line[c]),
        0 => free + r,
        c if c == columns => count - 1 - r,
        c => r * inside + c - 1,
    };
    let row = |r: usize| strip * r as f64 / rows as f64;

    let (mut cells, mouth) = cells_of_strip(lower, &line, rows, &row, &vertex);
    let lowered = |[s, zeta]: [f64; 2]| [strip + s, zeta];
    let moved = |cell: &Cell| Cell::new(cell.vertices.map(below), |u, v| lowered(cell.at(u, v).position));
    cells.extend(lower.cells.iter().map(moved));

    let mut vertices = vec![[0.0; 2]; count];
    for (v, &position) in lower.vertices.iter().enumerate() {
        vertices[below(v)] = lowered(position);
    }
    for (r, c) in (0..rows).flat_map(|r| (0..=columns).map(move |c| (r, c))) {
        vertices[vertex(r, c)] = [row(r), lower.vertices[line[c]][1]];
    }
    let on_side = |end: FrontColumn, r: usize, side: usize, columns: [usize; 2]| {
        let phi = phi_on_strip(1.0 - r as f64 / rows as f64)[side];
        let vertices = columns.map(|c| vertex(r, c));
        FrontColumn { vertices, phi, counts: counts_on_strip(phi), ..end }
    };
    let of_ellipse = |column: &FrontColumn| FrontColumn { vertices: column.vertices.map(below), ..*column };
    let mut front: Vec<FrontColumn> = lower.front.iter().map(of_ellipse).collect();
    if let &[first, .., last] = &lower.front[..] {
        front.splice(..0, (0..rows).map(|r| on_side(first, r, 0, [1, 2])));
        front.extend((0..rows).rev().map(|r| on_side(last, r, 1, [columns - 1, columns - 2])));
    }
    Grid { cells, mouth, vertices, free, front, is_graded: lower.is_graded }
}

/// The vertices of the mouth of `lower`, at the lower end of the strip, from ζ = c to −c; the first
/// and the last are on the front.
fn vertices_at_end(lower: &Grid) -> Vec<usize> {
    let mut line: Vec<usize> = Vec::new();
    for (cell, corners) in &lower.mouth {
        line.extend(corners.map(|corner| lower.cells[*cell].vertices[corner]));
    }
    line.sort_by(|&a, &b| lower.vertices[b][1].total_cmp(&lower.vertices[a][1]));
    line.dedup();
    line
}

/// The cells of a strip in `rows`, each of which begins at s = `row` (mm), above the half-ellipse
/// of `lower`, with those on the mouth and the corners of their edges there. `vertex` numbers the
/// vertices by row and column.
fn cells_of_strip(
    lower: &Grid,
    line: &[usize],
    rows: usize,
    row: &dyn Fn(usize) -> f64,
    vertex: &dyn Fn(usize, usize) -> usize,
) -> (Vec<Cell>, Vec<(usize, [usize; 2])>) {
    let (mut cells, mut mouth) = (Vec::new(), Vec::new());
    for (at, [from, to]) in &lower.mouth {
        let cell = &lower.cells[*at];
        let place = |corner: usize| line.iter().position(|&v| v == cell.vertices[corner]);
        let (Some(start), Some(end)) = (place(*from), place(*to)) else { continue };
        let edge = if start < end { Patch::along(*from, *to) } else { Patch::along(*to, *from) };
        let first = start.min(end);
        for r in 0..rows {
            let [near, far] = [row(r), row(r + 1)];
            let corners = [(r, first), (r, first + 1), (r + 1, first + 1), (r + 1, first)];
            if r == 0 {
                mouth.push((cells.len(), [0, 1]));
            }
            cells.push(Cell::new(corners.map(|(r, c)| vertex(r, c)), |p, q| {
                let [u, v] = edge.at([p, 0.0]);
                [near + q * (far - near), cell.at(u, v).position[1]]
            }));
        }
    }
    (cells, mouth)
}

#[cfg(test)]
mod tests {
    use super::super::division::SpaceResolution;
    use super::super::grid::CORNERS;
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn cells_cover_strip_and_half_ellipse() {
        let ellipse = SpaceCrack::surface_breaking(0.4, 6.0, 3.0).unwrap();
        let crack = SpaceCrack { strip: Some(4.0), ..ellipse };
        let division = CellDivision::of(&crack, SpaceResolution::new(2, 3));
        let grid = grid_of(&crack, &division);
        assert_eq!((grid.cells.len(), grid.free), (division.cells(), division.face_points()));
        assert_eq!((grid.front.len(), division.strip), (division.front_points(), 3));
        let rule = crate::math::gauss_legendre(6);
        let mut area = 0.0;
        for cell in &grid.cells {
            for (u, wu) in &rule {
                area += rule.iter().map(|(v, wv)| wu * wv * cell.at(*u, *v).area).sum::<f64>();
            }
        }
        assert!((area / (48.0 + 0.5 * PI * 18.0) - 1.0).abs() < 1e-5, "{area}");
        // Corners of cells are where the vertices are.
        for cell in &grid.cells {
            for (v, [p, q]) in cell.vertices.iter().zip(CORNERS) {
                let [s, zeta] = cell.at(p, q).position;
                let want = grid.vertices[*v];
                assert!((s - want[0]).hypot(zeta - want[1]) < 1e-9, "{v}: {s} {zeta} {want:?}");
            }
        }
        for (k, column) in grid.front.iter().enumerate() {
            let [s, zeta] = grid.vertices[grid.free + k];
            let x = (s - 4.0).max(0.0) / 3.0;
            assert!((x.hypot(zeta / 6.0) - 1.0).abs() < 1e-9, "{k}: {s} {zeta}");
            assert_eq!((0.0..=PI).contains(&column.phi), s > 4.0 - 1e-9);
            let inner = grid.vertices[column.vertices[0]];
            let away = (s - inner[0]) * column.normal[0] + (zeta - inner[1]) * column.normal[1];
            assert!(away > 0.0, "{k}");
        }
    }
}
