//! How the cells of a crack are divided between its rows, its columns and the ring at its front.
//!
//! The flap above a shallow crack bends over distances of its own thickness, which falls to zero at
//! the mouth, and slip is locked in row by row as the faces close. A shallow crack therefore has
//! more and narrower rows than a steep one, at the expense of its columns.

use super::shape::{Extent, SpaceCrack};
use std::f64::consts::{FRAC_PI_2, PI};

/// Numbers of cells of a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct SpaceResolution {
    /// Cells from the middle of the block to its sides. There are 4 times as many along the front,
    /// or 8 times as many where the front is closed. Of 5 or more, a crack that meets the surface
    /// at less than 30° has as many cells, divided otherwise: see [`CellDivision::of`].
    pub block: usize,
    /// Cells from the block to the front.
    pub ring: usize,
    /// Further rows next to the surface, each half as wide as the next one below: they resolve K
    /// where a front meets the surface. Only planar cracks that break it have them.
    #[serde(default)]
    pub surface: usize,
}

impl SpaceResolution {
    /// These cells, without further rows next to the surface.
    #[must_use]
    pub const fn new(block: usize, ring: usize) -> Self {
        Self { block, ring, surface: 0 }
    }
}

impl Default for SpaceResolution {
    fn default() -> Self {
        Self::new(4, 4)
    }
}

/// The cells of a crack by their direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellDivision {
    /// Columns of the block from its middle to its side.
    pub columns: usize,
    /// Rows of the block, from the mouth down or, of a closed front, from its middle to either
    /// side. Those next to the surface count, those of a strip do not.
    pub rows: usize,
    /// Cells from the block to the front.
    pub ring: usize,
    /// Whether the front is closed.
    is_closed: bool,
    /// Half the sides of the block in the unit disc, along the trace and down the dip.
    pub(super) sides: [f64; 2],
    /// The rows end at the powers with this exponent of their number over that of all rows.
    grading: f64,
    /// Rows into which the uppermost one is divided further, each half as wide as the next one.
    surface: usize,
    /// Rows of the strip above the block, of a crack that has one.
    pub(super) strip: usize,
    /// Rows of a block without a strip above the first turn of the crack, and the place of the last
    /// one over the block.
    flat: Option<(usize, f64)>,
    /// The rows of the ring end at the powers with this exponent of their number over that of all.
    ring_grading: f64,
}

/// Half-width (radians of φ) of the layer in which the front meets the surface, or turns at the end
/// of a fold, which the cells do not resolve without further rows.
pub const VERTEX_LAYER: f64 = 15.0 * PI / 180.0;

/// Whether φ lies outside the layer of this half-width (radians) next to the surface.
pub(super) fn is_outside(layer: f64, phi: f64) -> bool {
    let least = least_outside(layer);
    phi >= least && phi <= PI - least
}

/// The least φ (radians) that counts below a layer of this half-width: points exactly at the limit
/// do, irrespective of round-off.
pub(super) fn least_outside(layer: f64) -> f64 {
    layer - 1e-9
}

/// Whether a point at φ on the side of a strip counts in growth. The layer is as wide, relative to
/// the length of the strip, as in the branch relative to its semi-axis.
pub(super) fn counts_on_strip(phi: f64) -> bool {
    let from_fold = strip_side(phi).1;
    let layer = least_outside(VERTEX_LAYER).sin();
    from_fold >= layer && from_fold <= 1.0 - layer
}

/// The side of the strip on which the point at φ lies (1 where ζ > 0, −1 where ζ < 0), and its
/// distance from the fold relative to the length of the strip.
pub(super) fn strip_side(phi: f64) -> (f64, f64) {
    if phi < 0.0 { (1.0, -phi / FRAC_PI_2) } else { (-1.0, (phi - PI) / FRAC_PI_2) }
}

/// φ of the side points of a strip at the distance `from_fold` from the fold, relative to the
/// length of the strip: where ζ > 0 and where ζ < 0.
pub(super) fn phi_on_strip(from_fold: f64) -> [f64; 2] {
    [-from_fold * FRAC_PI_2, PI + from_fold * FRAC_PI_2]
}

/// A value at `row` of rows at whose ends it is `end`; within a row it is linear.
fn within_rows(row: f64, end: impl Fn(f64) -> f64) -> f64 {
    let before = row.floor();
    end(before) + (row - before) * (end(before + 1.0) - end(before))
}

/// Dips (degrees) from which the cells of a crack are those of a steep one, and down to which they
/// go over into those of a shallow one.
const STEEP: f64 = 30.0;
const SHALLOW: f64 = 20.0;
/// Half the side of the block in the unit disc.
const SIDE: f64 = 0.6;
/// The block of a shallow crack: half its sides, and the exponent of its rows. By trial at 15° and
/// 20°.
const SHALLOW_SIDES: [f64; 2] = [0.7, 0.75];
const SHALLOW_GRADING: f64 = 1.25;
/// Columns of a shallow crack over those of a steep one, and cells of the ring.
const SHALLOW_COLUMNS: f64 = 2.0 / 3.0;
const SHALLOW_RING: f64 = 5.0 / 6.0;
/// The most that each further row next to the surface adds to the exponent of the ring's rows.
const RING_GRADING: f64 = 0.25;
/// Rows between the mouth and the first turn of a crack, at least: hats on the mouth and hats over
/// a turn do not touch.
const LEAST_FLAT_ROWS: usize = 3;
/// Rows of the block behind the first turn, at least.
const LEAST_TURNED_ROWS: usize = 2;
/// The least number of columns of a steep crack of which a shallow one gives up some: with fewer,
/// K along the front suffers more than rows gain.
const LEAST_COLUMNS: usize = 5;

impl CellDivision {
    /// The same cells in all directions: those of a steep crack, of a buried one and of a branch.
    #[must_use]
    pub fn even(resolution: SpaceResolution, is_closed: bool) -> Self {
        let block = resolution.block.max(1);
        Self {
            columns: block,
            rows: block,
            ring: resolution.ring.max(2),
            is_closed,
            sides: [SIDE; 2],
            grading: 1.0,
            surface: 0,
            strip: 0,
            flat: None,
            ring_grading: 1.0,
        }
    }

    /// The cells of `crack`. A strip has half as many rows again as the block below it. In a crack
    /// that turns without a strip at least three rows lie above the first turn. Where a planar
    /// crack meets the surface at less than 30°, columns become fewer, down to two thirds at 20°,
    /// and cells from the block to the front, down to five sixths; there are as many rows as make
    /// up for them, and they become narrower towards the mouth. With fewer than 5 columns the cells
    /// are those of a steep crack.
    #[must_use]
    pub fn of(crack: &SpaceCrack, resolution: SpaceResolution) -> Self {
        let even = Self::even(resolution, false);
        match (crack.strip, crack.turns) {
            (None, None) => Self::planar(crack.dip, crack.extent != Extent::SurfaceBreaking, resolution),
            (Some(_), _) => Self { strip: (3 * even.rows).div_ceil(2).max(LEAST_FLAT_ROWS), ..even },
            (None, Some(turns)) => even.flat_above(turns.straight / crack.length),
        }
    }

    /// The same with rows above and below the first turn, at this share of the length of the crack.
    fn flat_above(self, share: f64) -> Self {
        // Towards the front, rows end deeper than in the block.
        let place = (share.min(1.0).asin() / (0.25 * PI)).min(1.0);
        let rows = self.rows as f64;
        if place == 1.0 {
            return Self { rows: self.rows.max(LEAST_FLAT_ROWS), ..self };
        }
        let above = ((rows * place).round() as usize).max(LEAST_FLAT_ROWS);
        let below = ((rows * (1.0 - place)).ceil() as usize).max(LEAST_TURNED_ROWS);
        Self { rows: above + below, flat: Some((above, place)), ..self }
    }

    /// The cells of a planar crack of the dip `dip` (radians), either buried or not.
    fn planar(dip: f64, is_closed: bool, resolution: SpaceResolution) -> Self {
        let division = Self::without_surface(dip, is_closed, resolution);
        let surface = if is_closed { 0 } else { resolution.surface };
        let with_rows = Self { rows: division.rows + surface, surface, ..division };
        Self { ring_grading: with_rows.ring_grading(), ..with_rows }
    }

    fn without_surface(dip: f64, is_closed: bool, resolution: SpaceResolution) -> Self {
        let even = Self::even(resolution, is_closed);
        let angle = dip.sin().abs().asin().to_degrees();
        // Round-off at 30° must not count.
        if is_closed || angle >= STEEP - 1e-9 || even.columns < LEAST_COLUMNS {
            return even;
        }
        let share = ((STEEP - angle) / (STEEP - SHALLOW)).min(1.0);
        let towards = |steep: f64, shallow: f64| steep + share * (shallow - steep);
        let part = |count: usize, shallow: f64| (count as f64 * towards(1.0, shallow)).round() as usize;
        let columns = part(even.columns, SHALLOW_COLUMNS);
        let ring = part(even.ring, SHALLOW_RING).max(2);
        let rest = even.cells() as f64 - (2 * columns * ring) as f64;
        let rows = (rest / (2 * (columns + ring)) as f64).round() as usize;
        Self {
            columns,
            rows: rows.max(even.rows),
            ring,
            sides: SHALLOW_SIDES.map(|side| towards(SIDE, side)),
            grading: towards(1.0, SHALLOW_GRADING),
            ..even
        }
    }

    /// Whether rows become narrower towards the mouth.
    pub(super) fn is_graded(&self) -> bool {
        self.grading > 1.0 || self.surface > 0 || self.flat.is_some()
    }

    /// Half-width (radians of φ) of the layer next to the surface in which K does not count: each
    /// further row halves it.
    #[must_use]
    pub fn layer(&self) -> f64 {
        VERTEX_LAYER * 0.5f64.powi(self.surface as i32)
    }

    /// Whether K counts in the growth of a point of the front at φ (radians).
    #[must_use]
    pub fn counts(&self, phi: f64) -> bool {
        self.is_closed || is_outside(self.layer(), phi)
    }

    /// The number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        let sides = 1 + usize::from(self.is_closed);
        let strip = 2 * self.strip * (self.columns + self.ring);
        sides * (2 * self.columns * self.rows + 2 * (self.columns + self.rows) * self.ring) + strip
    }

    /// The number of points of the faces.
    #[must_use]
    pub fn face_points(&self) -> usize {
        self.points_of_ellipse() + self.strip * (2 * (self.columns + self.ring) - 1)
    }

    /// The number of points of the faces below a strip.
    pub(super) fn points_of_ellipse(&self) -> usize {
        self.block_points() + self.ends_of_columns() * (self.ring - 1)
    }

    /// The number of points of the front.
    #[must_use]
    pub fn front_points(&self) -> usize {
        self.ends_of_columns() + 2 * self.strip
    }

    /// The number of points of the front at the ends of columns of the ring.
    pub(super) fn ends_of_columns(&self) -> usize {
        let half = 2 * (self.columns + self.rows);
        if self.is_closed { 2 * half } else { half + 1 }
    }

    /// φ of the points of the front below a strip, radians.
    pub fn front_angles(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.ends_of_columns()).map(|column| 0.25 * PI * self.turn(column as f64))
    }

    /// The first row of vertices of the block: at the mouth, or above the middle.
    pub(super) fn first_row(&self) -> i64 {
        if self.is_closed { -(self.rows as i64) } else { 0 }
    }

    /// The number of vertices of the block.
    pub(super) fn block_points(&self) -> usize {
        (2 * self.columns + 1) * ((self.rows as i64 - self.first_row()) as usize + 1)
    }

    /// Columns and rows from the middle of the block to the point of its outline on column `t` of
    /// the ring, counted from the mouth or the middle where ζ = c.
    pub(super) fn outline(&self, t: f64) -> [f64; 2] {
        self.leg(t).1
    }

    /// The leg of the outline, from 0, on which column `t` of the ring ends, and the place there.
    fn leg(&self, t: f64) -> (usize, [f64; 2]) {
        let (k, m) = (self.columns as f64, self.rows as f64);
        match t {
            t if t <= m => (0, [k, t]),
            t if t <= m + 2.0 * k => (1, [m + k - t, m]),
            t if t <= 3.0 * m + 2.0 * k => (2, [-k, 2.0 * (m + k) - t]),
            t if t <= 3.0 * m + 4.0 * k => (3, [t - 3.0 * (m + k), -m]),
            t => (4, [k, t - 4.0 * (m + k)]),
        }
    }

    /// The place of a column and a row in the block, from −1 to 1.
    pub(super) fn place(&self, [column, row]: [f64; 2]) -> [f64; 2] {
        [column / self.columns as f64, self.graded(row)]
    }

    /// The place of a row over the block, from −1 to 1; within a row it is linear.
    fn graded(&self, row: f64) -> f64 {
        if !self.is_graded() {
            return row / self.rows as f64;
        }
        if let Some((above, place)) = self.flat {
            let below = (row - above as f64) / (self.rows - above) as f64;
            return if below < 0.0 { row / above as f64 * place } else { place + below * (1.0 - place) };
        }
        let surface = self.surface as f64;
        let end = |row: f64| {
            let [whole, halved] = [(row - surface).max(1.0), (surface + 1.0 - row).max(0.0)];
            let end = (whole / (self.rows as f64 - surface)).powf(self.grading);
            if row == 0.0 { 0.0 } else { end * (-halved).exp2() }
        };
        row.signum() * within_rows(row.abs(), end)
    }

    /// The parameter η at the end of a row of the ring, counted from the front: 0 there and 1 at
    /// the block; within a row it is linear. The closer a point is to the surface, the smaller is
    /// the region around the front that decides K.
    pub(super) fn parameter(&self, row: f64) -> f64 {
        within_rows(row, |row| (row / self.ring as f64).powf(self.ring_grading))
    }

    /// The length over which a crack of this `length` (mm) may turn at its front: that of the two
    /// rows of cells of which K is taken.
    pub(super) fn resolved_turn(&self, length: f64) -> f64 {
        self.parameter(2.0).powi(2) * (1.0 - self.sides[1]) * length
    }

    /// The exponent of the rows of the ring: K is taken from the first two, which should reach no
    /// farther than half the uppermost row of cells, but too narrow ones are integrated badly.
    fn ring_grading(&self) -> f64 {
        let most = 1.0 + RING_GRADING * self.surface as f64;
        if self.surface == 0 || self.ring < 3 {
            return 1.0;
        }
        let [_, down] = self.sides;
        let reach = 0.5 * down * self.graded(1.0) / (1.0 - down);
        (reach.ln() / (2.0 * (2.0 / self.ring as f64).ln())).clamp(1.0, most)
    }

    /// φ over π/4 on column `t` of the ring: it goes with the place on the outline of the block.
    pub(super) fn turn(&self, t: f64) -> f64 {
        let (leg, steps) = self.leg(t);
        let [x, y] = self.place(steps);
        match leg {
            0 => y,
            1 => 2.0 - x,
            2 => 4.0 - y,
            3 => 6.0 + x,
            _ => 8.0 + y,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(degrees: f64, block: usize, ring: usize) -> CellDivision {
        CellDivision::planar(degrees.to_radians(), false, SpaceResolution::new(block, ring))
    }

    #[test]
    fn shallow_cracks_have_as_many_cells_in_more_rows() {
        for degrees in [30.0, 60.0, 90.0, 150.0] {
            assert_eq!(at(degrees, 6, 5), CellDivision::even(SpaceResolution::new(6, 5), false));
        }
        for degrees in [5.0, 15.0, 20.0, 160.0] {
            let own = at(degrees, 6, 6);
            assert_eq!([own.columns, own.rows, own.ring], [4, 10, 5], "{degrees}");
        }
        assert_eq!(at(15.0, 4, 4), at(90.0, 4, 4));
        for (block, ring) in (5..17).flat_map(|block| (2..17).map(move |ring| (block, ring))) {
            let even = at(90.0, block, ring);
            for degrees in [15.0, 22.0, 27.0, 29.9] {
                let own = at(degrees, block, ring);
                // Half a row more or less, and never fewer rows than columns had.
                let row = (own.columns + own.ring) as f64;
                let off = own.cells() as f64 - even.cells() as f64;
                assert!(own.rows == even.rows || off.abs() <= row, "{block} {ring} {degrees}: {own:?}");
                assert!(own.rows >= even.rows && own.columns <= even.columns && own.ring <= even.ring);
            }
        }
    }

    #[test]
    fn rows_next_to_the_surface_halve_the_uppermost_one() {
        let resolution = SpaceResolution { block: 6, ring: 6, surface: 3 };
        for degrees in [90.0f64, 15.0] {
            let plain = at(degrees, 6, 6);
            let own = CellDivision::planar(degrees.to_radians(), false, resolution);
            assert_eq!([own.columns, own.rows, own.ring], [plain.columns, plain.rows + 3, plain.ring]);
            let ends: Vec<f64> = (0..=own.rows).map(|row| own.graded(row as f64)).collect();
            let first = plain.graded(1.0);
            assert_eq!(ends[..5], [0.0, 0.125 * first, 0.25 * first, 0.5 * first, first], "{degrees}");
            for row in 1..=plain.rows {
                assert!((ends[row + 3] - plain.graded(row as f64)).abs() < 1e-15, "{degrees} {row}");
            }
            assert!((own.graded(0.5) - 0.5 * ends[1]).abs() < 1e-15);
            // The first two rows of the ring end at half the uppermost row of cells at most, or as
            // near to it as the ring may be graded.
            let reach = own.parameter(2.0).powi(2) * (1.0 - own.sides[1]);
            assert!(reach < own.sides[1] * first && own.parameter(6.0) >= 1.0 - 1e-15, "{degrees}: {reach}");
            assert!((own.layer() - VERTEX_LAYER / 8.0).abs() < 1e-15);
            assert!(own.counts(own.layer()) && own.counts(PI - own.layer()) && !own.counts(0.03));
        }
        let closed = CellDivision::planar(0.3, true, resolution);
        assert!(closed == CellDivision::even(SpaceResolution { surface: 0, ..resolution }, true));
        assert!(closed.counts(0.0));
    }

    #[test]
    fn columns_go_round_the_block_and_the_front() {
        for (degrees, is_closed) in [(15.0f64, false), (40.0, false), (15.0, true)] {
            let resolution = SpaceResolution::new(6, 4);
            let own = CellDivision::planar(degrees.to_radians(), is_closed, resolution);
            let angles: Vec<f64> = own.front_angles().collect();
            assert_eq!(angles.len(), own.front_points());
            assert!(angles.windows(2).all(|pair| pair[1] > pair[0]), "{angles:?}");
            let columns = 2 * (own.columns + own.rows);
            assert!((angles[columns / 2] - 0.5 * PI).abs() < 1e-12);
            for (from, to) in angles[..=columns / 2]
                .iter()
                .zip(angles[columns / 2..=columns.min(angles.len() - 1)].iter().rev())
            {
                assert!((from + to - PI).abs() < 1e-12 || is_closed, "{from} {to}");
            }
            for t in 0..own.front_points() {
                let [x, y] = own.place(own.outline(t as f64));
                assert!((x.abs().max(y.abs()) - 1.0).abs() < 1e-12, "{t}: {x} {y}");
            }
        }
    }
}
