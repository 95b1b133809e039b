//! Cracked body in space: compliance, stiffness and stress intensity factors along the front.

use super::Symmetric;
use super::cross::Placed;
use super::division::{CellDivision, SpaceResolution};
use super::face_matrix::FaceMatrix;
use super::grid::Grid;
use super::plane::{PlaneFrame, Surroundings};
use super::shape::{CloseCracks, SpaceCrack, SpaceError};
use super::sheet::Sheet;
use super::stiffness::{SpaceKernel, stiffness_of};
use super::strip_grid::grid_of;
use crate::interruption::Interruption;
use crate::linear::LinearError;
use crate::material::IsotropicElastic;
use crate::math::{Matrix, gauss_legendre};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::ops::Range;

/// Points per cell and direction at which the stress of the uncracked rail is evaluated.
pub(super) const LOAD_POINTS: usize = 4;

/// A point of the front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrontPoint {
    /// Its crack, from 0.
    pub crack: usize,
    /// Parametric angle: 0 and π at the surface, π/2 at the deepest point, radians. The sides of a
    /// strip continue it from 0 to −π/2 and from π to 3π/2 at the mouth.
    pub phi: f64,
    /// x, lateral and depth, mm.
    pub position: [f64; 3],
    /// Unit normal of the front within the crack, away from it: down the dip and along the trace.
    pub normal: [f64; 2],
    /// Whether its K counts in the growth of its crack. Next to the surface, or to the ends of a
    /// strip, the cells do not resolve it.
    pub counts: bool,
}

/// Stress intensity factors of a point of the front, MPa √mm. At the deepest point K_II slides
/// along the dip and K_III along the lateral axis; elsewhere both directions rotate with the front.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct FrontSif {
    /// Opening.
    pub ki: f64,
    /// Sliding.
    pub kii: f64,
    /// Tearing.
    pub kiii: f64,
}

impl FrontSif {
    /// The largest difference from another one, MPa √mm.
    #[must_use]
    pub fn difference(&self, other: &Self) -> f64 {
        let of = |a: f64, b: f64| (a - b).abs();
        of(self.ki, other.ki).max(of(self.kii, other.kii)).max(of(self.kiii, other.kiii))
    }
}

/// A point at which the stress of the uncracked rail is evaluated, with its contribution to the
/// nodal forces.
#[derive(Debug, Clone)]
pub(super) struct LoadPoint {
    /// Its crack, from 0.
    pub crack: usize,
    /// The directions of the crack there.
    pub frame: PlaneFrame,
    /// x, lateral and depth, mm.
    pub position: [f64; 3],
    /// Points of the crack and the integrals of their hat functions, mm².
    pub hats: [(usize, f64); 4],
}

/// A crack of a body.
#[derive(Debug, Clone)]
pub struct CrackPart {
    /// Its shape.
    pub shape: SpaceCrack,
    /// Its surface.
    pub(super) sheet: Sheet,
    /// Its points.
    pub points: Range<usize>,
    /// The points of its front.
    pub front: Range<usize>,
    /// Its points on a fold, where its faces transmit no friction.
    ///
    /// Contact acts there along the normal above the fold: where both sides are closed a continuous
    /// jump vanishes on the fold, and in the limit of small cells the points next to it see to
    /// that. Both conditions at one point, or friction there, would lock slip over the length of a
    /// cell; the normal of a plane between the two rounds off the fold over a cell on either side
    /// of it.
    pub fold: Vec<usize>,
}

impl CrackPart {
    /// (s, ζ) of a point (x, lateral, depth; mm) of the crack: the distance from the trace of its
    /// plane, or from its mouth down its way, and the distance along the trace.
    pub(super) fn coordinates(&self, [x, lateral, depth]: [f64; 3]) -> [f64; 2] {
        let from = [x - self.shape.middle[0], lateral - self.shape.middle[1], depth];
        let [_, s, zeta] = self.shape.frame().components(from);
        [if self.sheet.plane().is_some() { s } else { self.sheet.way().to_depth(depth) }, zeta]
    }

    /// x and lateral position (mm) of the mouth at ζ.
    pub(super) fn mouth(&self, zeta: f64) -> [f64; 2] {
        let [x, lateral, _] = self.sheet.place([0.0, zeta]);
        [x, lateral]
    }

    /// s of the front at ζ.
    pub(super) fn reach(&self, zeta: f64) -> f64 {
        let across = zeta / self.shape.half_length;
        let below = self.shape.length * (1.0 - across * across).max(0.0).sqrt();
        below + self.shape.strip.unwrap_or(0.0)
    }
}

/// Cracks in the half-space as matrices: with f the nodal forces on their faces, ⟦w⟧ = C f
/// and K = S f. Points of cracks and of fronts are numbered crack by crack.
#[derive(Debug, Clone)]
pub struct SpaceBody {
    cracks: Vec<CrackPart>,
    points: Vec<[f64; 3]>,
    front: Vec<FrontPoint>,
    stiffness: FaceMatrix,
    compliance: FaceMatrix,
    sif_influence: Matrix,
    sif_of_jumps: Matrix,
    loads: Vec<LoadPoint>,
    cells: Vec<[usize; 4]>,
    /// The directions of the components at each point.
    frames: Vec<PlaneFrame>,
}

impl SpaceBody {
    /// The body with `cracks` in `surroundings`.
    ///
    /// Errors: cracks that are too close to each other; a stiffness that is not positive definite.
    pub fn new(
        cracks: &[SpaceCrack],
        steel: &IsotropicElastic,
        surroundings: Surroundings,
        resolution: SpaceResolution,
    ) -> Result<Self, SpaceError> {
        let dips: Vec<f64> = cracks.iter().map(|crack| crack.dip).collect();
        let kernel =
            (surroundings == Surroundings::HalfSpace).then(|| SpaceKernel::new(&dips, steel.poisson()));
        Self::with_kernel(cracks, steel, kernel.as_ref(), resolution, Interruption::NEVER)
    }

    /// The body with `cracks` in the half-space of `kernel`, or in the full space without one. An
    /// `interruption` ends the computation.
    ///
    /// Errors: cracks that are too close to each other; a stiffness that is not positive definite;
    /// the interruption.
    pub fn with_kernel(
        cracks: &[SpaceCrack],
        steel: &IsotropicElastic,
        kernel: Option<&SpaceKernel>,
        resolution: SpaceResolution,
        interruption: Interruption<'_>,
    ) -> Result<Self, SpaceError> {
        let mut body = Self::in_parts(cracks, steel, kernel, resolution, interruption)?;
        body.invert(interruption)?;
        Ok(body)
    }

    /// [`Self::with_kernel`] without C and S: a body of which only parts are solved for.
    ///
    /// Errors: cracks that are too close to each other; the interruption.
    pub(super) fn in_parts(
        cracks: &[SpaceCrack],
        steel: &IsotropicElastic,
        kernel: Option<&SpaceKernel>,
        resolution: SpaceResolution,
        interruption: Interruption<'_>,
    ) -> Result<Self, SpaceError> {
        if let Some(close) = CloseCracks::among(cracks) {
            return Err(close.into());
        }
        let grids: Vec<Grid> =
            cracks.iter().map(|crack| grid_of(crack, &CellDivision::of(crack, resolution))).collect();
        let sheets: Vec<Sheet> = cracks.iter().map(Sheet::of).collect();
        let placed: Vec<Placed> =
            grids.iter().zip(&sheets).map(|(grid, sheet)| Placed { grid, sheet }).collect();
        let stiffness = stiffness_of(cracks, &placed, steel, kernel, interruption)?;
        let total = stiffness.order() / 3;
        let fronts = grids.iter().map(|grid| grid.front.len()).sum::<usize>();
        let mut body = Self {
            cracks: Vec::with_capacity(cracks.len()),
            points: Vec::with_capacity(total),
            front: Vec::with_capacity(fronts),
            sif_of_jumps: Matrix::zeros(3 * fronts, 3 * total),
            sif_influence: Matrix::zeros(0, 0),
            stiffness,
            compliance: Matrix::zeros(0, 0).into(),
            loads: Vec::new(),
            cells: Vec::new(),
            frames: Vec::with_capacity(total),
        };
        for (crack, placed) in cracks.iter().zip(&placed) {
            body.append(crack, placed, steel, total);
        }
        Ok(body)
    }

    /// Computes C and S.
    fn invert(&mut self, interruption: Interruption<'_>) -> Result<(), SpaceError> {
        self.compliance =
            self.stiffness.inverse_unless(interruption).map_err(|error| too_coarse(error, &self.cracks))?;
        self.sif_influence = influence(&self.sif_of_jumps, &self.compliance);
        Ok(())
    }

    /// The body with the cracks of these numbers (from 0) alone.
    ///
    /// Errors: a stiffness that is not positive definite; the interruption.
    pub(super) fn part(&self, cracks: &[usize], interruption: Interruption<'_>) -> Result<Self, SpaceError> {
        let chosen = || cracks.iter().map(|&crack| &self.cracks[crack]);
        let old: Vec<usize> = chosen().flat_map(|part| part.points.clone()).collect();
        let old_front: Vec<usize> = chosen().flat_map(|part| part.front.clone()).collect();
        let mut new = vec![0; self.points.len() + self.front.len()];
        old.iter().enumerate().for_each(|(k, &point)| new[point] = k);
        for (k, &point) in old_front.iter().enumerate() {
            new[self.points.len() + point] = old.len() + k;
        }
        let mut crack_of = vec![None; self.cracks.len()];
        cracks.iter().enumerate().for_each(|(k, &crack)| crack_of[crack] = Some(k));
        let columns = |i: usize| 3 * old[i / 3] + i % 3;
        let mut body = Self {
            cracks: Vec::with_capacity(cracks.len()),
            points: old.iter().map(|&point| self.points[point]).collect(),
            front: Vec::with_capacity(old_front.len()),
            stiffness: Matrix::from_fn(3 * old.len(), 3 * old.len(), |i, j| {
                self.stiffness.entry(columns(i), columns(j))
            })
            .into(),
            compliance: Matrix::zeros(0, 0).into(),
            sif_influence: Matrix::zeros(0, 0),
            sif_of_jumps: Matrix::from_fn(3 * old_front.len(), 3 * old.len(), |i, j| {
                self.sif_of_jumps[(3 * old_front[i / 3] + i % 3, columns(j))]
            }),
            loads: Vec::new(),
            cells: Vec::new(),
            frames: old.iter().map(|&point| self.frames[point]).collect(),
        };
        let (mut first, mut first_of_front) = (0, 0);
        for (k, part) in chosen().enumerate() {
            let points = first..first + part.points.len();
            let front = first_of_front..first_of_front + part.front.len();
            (first, first_of_front) = (points.end, front.end);
            body.front
                .extend(self.front[part.front.clone()].iter().map(|point| FrontPoint { crack: k, ..*point }));
            let fold = part.fold.iter().map(|&point| new[point]).collect();
            body.cracks.push(CrackPart { points, front, fold, ..part.clone() });
        }
        for load in &self.loads {
            if let Some(crack) = crack_of[load.crack] {
                let hats = load.hats.map(|(point, weight)| (new[point], weight));
                body.loads.push(LoadPoint { crack, hats, ..load.clone() });
            }
        }
        let is_chosen = |cell: &&[usize; 4]| {
            cell.iter().all(|&v| match v.checked_sub(self.points.len()) {
                None => crack_of[self.crack_of(v)].is_some(),
                Some(front) => crack_of[self.front[front].crack].is_some(),
            })
        };
        body.cells = self.cells.iter().filter(is_chosen).map(|cell| cell.map(|v| new[v])).collect();
        body.invert(interruption)?;
        Ok(body)
    }

    /// Appends the points of a crack; all cracks together have `total` points.
    fn append(&mut self, shape: &SpaceCrack, placed: &Placed, steel: &IsotropicElastic, total: usize) {
        let (crack, grid, sheet) = (self.cracks.len(), placed.grid, placed.sheet);
        let (first, first_of_front) = (self.points.len(), self.front.len());
        let vertex =
            |v: usize| if v < grid.free { first + v } else { total + first_of_front + v - grid.free };
        front_rows(grid, steel, [3 * first_of_front, 3 * first], &mut self.sif_of_jumps);
        for &vertex in &grid.vertices[..grid.free] {
            let (position, frame) = sheet.framed(vertex);
            self.points.push(position);
            self.frames.push(frame);
        }
        self.front.extend(grid.front.iter().enumerate().map(|(t, column)| FrontPoint {
            crack,
            phi: column.phi,
            position: sheet.place(grid.vertices[grid.free + t]),
            normal: column.normal,
            counts: column.counts,
        }));
        let rule = gauss_legendre(LOAD_POINTS);
        for cell in &grid.cells {
            for (u, wu) in &rule {
                for (v, wv) in &rule {
                    let point = cell.at(*u, *v);
                    let hats = std::array::from_fn(|a| {
                        let weight = wu * wv * point.area * point.hats[a];
                        let corner = cell.vertices[a];
                        if corner < grid.free { (vertex(corner), weight) } else { (first, 0.0) }
                    });
                    let (position, frame) = sheet.framed(point.position);
                    self.loads.push(LoadPoint { crack, frame, position, hats });
                }
            }
        }
        self.cells.extend(grid.cells.iter().map(|cell| cell.vertices.map(vertex)));
        let is_on_fold = |v: &usize| sheet.way().has_fold(grid.vertices[*v][0]);
        self.cracks.push(CrackPart {
            shape: shape.clone(),
            sheet: sheet.clone(),
            points: first..self.points.len(),
            front: first_of_front..self.front.len(),
            fold: (0..grid.free).filter(is_on_fold).map(vertex).collect(),
        });
    }

    /// The cracks.
    pub fn cracks(&self) -> &[CrackPart] {
        &self.cracks
    }

    /// The directions of the components at a point: normal, dip and trace; on a fold those above
    /// it.
    pub fn frame_of(&self, point: usize) -> &PlaneFrame {
        &self.frames[point]
    }

    /// The crack (from 0) of a point.
    pub fn crack_of(&self, point: usize) -> usize {
        self.cracks.partition_point(|crack| crack.points.end <= point)
    }

    /// Points of the cracks that carry a jump: x, lateral and depth, mm.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The area (mm²) that each point represents: the integral of its hat function.
    pub(super) fn areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.points.len()];
        for (point, weight) in self.loads.iter().flat_map(|load| load.hats) {
            areas[point] += weight;
        }
        areas
    }

    /// Positions of the cracks along the rail, mm: the middles of their mouths; if no crack breaks
    /// the surface, that of the first crack.
    pub(super) fn places(&self) -> Vec<f64> {
        let mean = |points: Vec<&[f64; 3]>| {
            let sum = points.iter().map(|point| point[0]).sum::<f64>();
            (!points.is_empty()).then(|| sum / points.len() as f64)
        };
        let of = |crack: &CrackPart| self.points[crack.points.clone()].iter();
        let mouths = self.cracks.iter().map(|crack| mean(of(crack).filter(|p| p[2] == 0.0).collect()));
        let places: Vec<f64> = mouths.flatten().collect();
        if !places.is_empty() {
            return places;
        }
        self.cracks.first().and_then(|crack| mean(of(crack).collect())).into_iter().collect()
    }

    /// Points of the fronts, crack by crack in the order of increasing φ.
    pub fn front(&self) -> &[FrontPoint] {
        &self.front
    }

    /// Vertices of the cells: points of the cracks, then points of the fronts.
    pub fn cells(&self) -> &[[usize; 4]] {
        &self.cells
    }

    /// C (mm/N), 3p × 3p: opening, slip along the dip and along the trace of each point.
    pub fn compliance(&self) -> &FaceMatrix {
        &self.compliance
    }

    /// A between two cracks (from 0).
    pub(super) fn stiffness_between(&self, [one, other]: [usize; 2]) -> Matrix {
        self.stiffness_towards(one, &[other])
    }

    /// A of the jumps of a crack (rows) and those of `others` (columns).
    pub(super) fn stiffness_towards(&self, crack: usize, others: &[usize]) -> Matrix {
        let points = &self.cracks[crack].points;
        let ranges = || others.iter().map(|&other| &self.cracks[other].points);
        let mut entries =
            Vec::with_capacity(9 * points.len() * ranges().map(|range| range.len()).sum::<usize>());
        for row in 3 * points.start..3 * points.end {
            let row = self.stiffness.row(row);
            ranges().for_each(|range| entries.extend_from_slice(&row[3 * range.start..3 * range.end]));
        }
        let columns = ranges().map(|range| 3 * range.len()).sum();
        Matrix::from_entries(3 * points.len(), columns, entries).unwrap_or_else(|| Matrix::zeros(0, 0))
    }

    /// A = C⁻¹ (N/mm).
    pub fn stiffness(&self) -> &FaceMatrix {
        &self.stiffness
    }

    /// S, 3q × 3p: K_I, K_II, K_III (MPa √mm) of each front point per nodal force (N).
    pub fn sif_influence(&self) -> &Matrix {
        &self.sif_influence
    }

    /// Nodal forces (N), 3p, due to a stress field of the uncracked rail, given as a function of x,
    /// lateral and depth.
    pub fn nodal_forces(&self, stress: impl Fn([f64; 3]) -> Symmetric + Sync) -> Vec<f64> {
        self.nodal_forces_by_crack(|_, point| stress(point))
    }

    /// [`Self::nodal_forces`] of a stress that depends on the crack, too.
    pub(super) fn nodal_forces_by_crack(
        &self,
        stress: impl Fn(usize, [f64; 3]) -> Symmetric + Sync,
    ) -> Vec<f64> {
        let traction = |_, load: &LoadPoint| self.traction_at(load, &stress(load.crack, load.position));
        self.forces_of_tractions(0..self.cracks.len(), traction)
    }

    /// Points at which the stress of the uncracked rail is evaluated, crack by crack.
    pub(super) fn load_points(&self) -> &[LoadPoint] {
        &self.loads
    }

    /// The traction (opening, slip along the dip and along the trace; MPa) of a stress at a load
    /// point.
    pub(super) fn traction_at(&self, load: &LoadPoint, stress: &Symmetric) -> [f64; 3] {
        load.frame.traction(stress)
    }

    /// Nodal forces (N) at the points of `cracks` (from 0) due to the traction (MPa) at each of
    /// their load points, given with its number.
    pub(super) fn forces_of_tractions(
        &self,
        cracks: Range<usize>,
        traction: impl Fn(usize, &LoadPoint) -> [f64; 3] + Sync,
    ) -> Vec<f64> {
        let from = |crack: usize| self.loads.partition_point(|load| load.crack < crack);
        let loads = from(cracks.start)..from(cracks.end);
        let points = self.cracks[cracks].iter().map(|part| part.points.clone());
        let points = points.reduce(|all, next| all.start..next.end).unwrap_or_default();
        let numbered = loads.clone().into_par_iter().map(|number| traction(number, &self.loads[number]));
        let tractions: Vec<_> = numbered.collect();
        let mut forces = vec![0.0; 3 * points.len()];
        for (point, traction) in self.loads[loads].iter().zip(tractions) {
            let is_plane = self.cracks[point.crack].sheet.plane().is_some();
            for (a, weight) in point.hats {
                let along =
                    if is_plane { traction } else { self.frames[a].components(point.frame.vector(traction)) };
                let own = 3 * (a - points.start);
                (0..3).for_each(|c| forces[own + c] += weight * along[c]);
            }
        }
        forces
    }

    /// K along the front due to jumps ⟦w⟧ (mm), 3p.
    pub fn sifs_of_jumps(&self, jumps: &[f64]) -> Vec<FrontSif> {
        sifs(&self.sif_of_jumps.times(jumps))
    }

    /// K along the front due to nodal forces (N), 3p, on free faces.
    pub fn sifs(&self, forces: &[f64]) -> Vec<FrontSif> {
        sifs(&self.sif_influence.times(forces))
    }
}

/// S, K per force, from K per jump, of which few count for each K.
fn influence(sif_of_jumps: &Matrix, compliance: &FaceMatrix) -> Matrix {
    let mut influence = Matrix::zeros(sif_of_jumps.rows(), sif_of_jumps.columns());
    for k in 0..sif_of_jumps.rows() {
        influence.row_mut(k).copy_from_slice(&compliance.times(sif_of_jumps.row(k)));
    }
    influence
}

/// `error` of the inverse of the stiffness of `cracks`, with the crack whose cells are too coarse.
fn too_coarse(error: LinearError, cracks: &[CrackPart]) -> SpaceError {
    let LinearError::NotPositiveDefinite { pivot, .. } = error else { return error.into() };
    match cracks.iter().position(|part| pivot < 3 * part.points.end) {
        Some(crack) => SpaceError::TooCoarse { crack, shape: Box::new(cracks[crack].shape.clone()) },
        None => error.into(),
    }
}

fn sifs(values: &[f64]) -> Vec<FrontSif> {
    values.chunks_exact(3).map(|k| FrontSif { ki: k[0], kii: k[1], kiii: k[2] }).collect()
}

/// K from the jumps of the first two rows: w = α η + β η³ along a column, or α √(distance) near the
/// front, and K_I = μ α √(2π) / (4 (1 − ν)); K_II is similar, and K_III lacks the factor (1 − ν).
/// On a curved crack the components of each point are those along its own directions, between which
/// slip that follows the surface opens nothing. The rows begin at `start` in `rows`.
fn front_rows(grid: &Grid, steel: &IsotropicElastic, start: [usize; 2], rows: &mut Matrix) {
    let [first, left] = start;
    for (q, column) in grid.front.iter().enumerate() {
        let [e, f] = column.parameters;
        let weights = [f * f / (e * (f * f - e * e)), -e * e / (f * (f * f - e * e))];
        let scale = steel.shear_modulus() * (2.0 * PI).sqrt() / (4.0 * column.distance.sqrt());
        let plane = scale / (1.0 - steel.poisson());
        let [ms, mz] = column.normal;
        for (vertex, weight) in column.vertices.into_iter().zip(weights) {
            let (row, at) = (first + 3 * q, left + 3 * vertex);
            rows[(row, at)] += plane * weight;
            rows[(row + 1, at + 1)] += plane * weight * ms;
            rows[(row + 1, at + 2)] += plane * weight * mz;
            // The front's direction, normal × x2: (−m_ζ, m_s).
            rows[(row + 2, at + 1)] -= scale * weight * mz;
            rows[(row + 2, at + 2)] += scale * weight * ms;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::galerkin::Galerkin;
    use crate::space::stiffness::{first_copies, integrated_as};

    #[test]
    fn a_crack_with_too_few_cells_is_named_with_the_remedy() {
        let flat = |dip: f64| SpaceCrack::surface_breaking(dip.to_radians(), 4.0, 4.0).unwrap();
        let cracks = [flat(30.0), flat(6.0)];
        let resolution = SpaceResolution::new(2, 2);
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let at = |crack: &SpaceCrack, x| SpaceCrack { middle: [x, 0.0], ..crack.clone() };
        let apart = [at(&cracks[0], 0.0), at(&cracks[1], 20.0)];
        let body = SpaceBody::in_parts(&apart, &steel, None, resolution, Interruption::NEVER).unwrap();
        let [first, second] = [&body.cracks()[0].points, &body.cracks()[1].points];
        let order = 3 * second.end;
        for (pivot, crack, dip) in [(3 * first.end - 1, 0, "30.0°"), (3 * first.end, 1, "6.0°")] {
            let error = too_coarse(LinearError::NotPositiveDefinite { order, pivot }, body.cracks());
            let text = error.to_string();
            assert!(matches!(error, SpaceError::TooCoarse { crack: found, .. } if found == crack), "{text}");
            assert!(text.contains("more cells (space_cells") && text.contains(dip), "{text}");
        }
    }

    #[test]
    fn pairs_at_equal_offsets_are_integrated_once() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let crack = SpaceCrack::surface_breaking(30f64.to_radians(), 2.0, 1.5).unwrap();
        let at = |x: f64, lateral: f64| SpaceCrack { middle: [x, lateral], ..crack.clone() };
        let cracks = [at(0.0, 0.0), at(3.1, 0.2), at(6.2, 0.4), at(9.4, 0.6), at(12.5, 0.8)];
        let pairs: Vec<_> = (0..5).flat_map(|k| (0..k).map(move |j| [j, k])).collect();
        let first_copies = first_copies(&cracks);
        assert_eq!(first_copies, [0; 5]);
        let shared = |pair: [usize; 2]| {
            let before: Vec<_> = pairs.iter().copied().take_while(|known| *known != pair).collect();
            integrated_as(pair, &cracks, &first_copies, &before)
        };
        let offsets = [shared([1, 2]), shared([3, 4]), shared([2, 3]), shared([2, 4])];
        assert_eq!(offsets, [Some([0, 1]), Some([0, 1]), None, Some([1, 3])]);
        let resolution = SpaceResolution::new(2, 2);
        let of = |cracks: &[SpaceCrack]| {
            SpaceBody::new(cracks, &steel, Surroundings::HalfSpace, resolution).unwrap().stiffness.to_matrix()
        };
        let all = of(&cracks);
        let size = all.rows() / 5;
        for [j, k] in pairs {
            let alone = of(&[cracks[j].clone(), cracks[k].clone()]);
            for (a, b) in (0..size).flat_map(|a| (0..size).map(move |b| (a, b))) {
                let (wanted, found) = (alone[(a, size + b)], all[(j * size + a, k * size + b)]);
                assert!((wanted - found).abs() < 1e-10 * all[(0, 0)], "{j} {k}: {wanted} {found}");
                assert_eq!(found, all[(k * size + b, j * size + a)]);
            }
        }
    }

    #[test]
    fn more_points_leave_ki_of_an_open_shallow_crack() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let crack = SpaceCrack::surface_breaking(15f64.to_radians(), 2.0, 1.0).unwrap();
        let resolution = SpaceResolution::new(5, 4);
        let kernel = SpaceKernel::new(&[crack.dip], steel.poisson());
        let cracks = std::slice::from_ref(&crack);
        let body =
            SpaceBody::with_kernel(cracks, &steel, Some(&kernel), resolution, Interruption::NEVER).unwrap();
        let [x, lateral, depth] = crack.frame().vector([1.0, 0.0, 0.0]);
        let tension = [x * x, lateral * lateral, depth * depth, lateral * depth, x * depth, x * lateral];
        let forces = body.nodal_forces(|_| tension);
        let (grid, image) =
            (Grid::new(&crack, &CellDivision::of(&crack, resolution)), kernel.image(crack.dip));
        let finer = Galerkin::with_more_points(&grid, steel.poisson(), Some(&image), 2);
        let stiffness = finer.stiffness_unless(Interruption::NEVER).unwrap();
        let mut jumps = stiffness.inverse_unless(Interruption::NEVER).unwrap().times(&forces);
        jumps.iter_mut().for_each(|jump| *jump /= steel.shear_modulus());
        let (sifs, finer) = (body.sifs(&forces), body.sifs_of_jumps(&jumps));
        // The front without the layer at the surface.
        for (k, fine) in sifs.iter().zip(&finer).skip(2).take(sifs.len() - 4) {
            assert!((k.ki / fine.ki - 1.0).abs() < 0.0015, "{} {}", k.ki, fine.ki);
        }
    }
}
