//! A of all cracks: each by itself, and the forces between them.

use super::cross::{Placed, cross_stiffness};
use super::face_matrix::FaceMatrix;
use super::galerkin::{Galerkin, ImagePart};
use super::image_table::ImageTable;
use super::plane::Surroundings;
use super::shape::{SpaceCrack, SpaceError};
use super::turned::turned_stiffness;
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use crate::math::Matrix;
use std::sync::Arc;

/// The images in the surface for the planes of some dips, shared by all cracks that grow in such
/// planes.
#[derive(Debug, Clone)]
pub struct SpaceKernel {
    poisson: f64,
    tables: Vec<(f64, Arc<ImageTable>)>,
}

impl SpaceKernel {
    /// The kernel for planes that descend at `dips` (radians) in steel of Poisson's ratio
    /// `poisson`.
    pub fn new(dips: &[f64], poisson: f64) -> Self {
        let mut kernel = Self { poisson, tables: Vec::new() };
        kernel.prepare(dips);
        kernel
    }

    /// Adds planes that descend at `dips` (radians), where they are not among those prepared.
    pub fn prepare(&mut self, dips: &[f64]) {
        for &dip in dips {
            if self.tables.iter().all(|(known, _)| *known != dip) {
                self.tables.push((dip, Arc::new(ImageTable::new(dip, self.poisson))));
            }
        }
    }

    /// The image for planes of a given dip, computed anew unless the dip is one of those prepared.
    pub(super) fn image(&self, dip: f64) -> ImagePart {
        let known = self.tables.iter().find(|(known, _)| *known == dip).map(|(_, table)| Arc::clone(table));
        ImagePart { table: known.unwrap_or_else(|| Arc::new(ImageTable::new(dip, self.poisson))), dip }
    }
}

/// A of all cracks, N/mm.
pub(super) fn stiffness_of(
    cracks: &[SpaceCrack],
    placed: &[Placed],
    steel: &IsotropicElastic,
    kernel: Option<&SpaceKernel>,
    interruption: Interruption<'_>,
) -> Result<FaceMatrix, SpaceError> {
    let (poisson, mu) = (steel.poisson(), steel.shear_modulus());
    debug_assert!(kernel.is_none_or(|kernel| kernel.poisson == poisson));
    let own = |k: usize| {
        let image = kernel.map(|kernel| kernel.image(cracks[k].dip));
        let own = match &image {
            Some(image) if placed[k].sheet.plane().is_none() => {
                turned_stiffness(placed[k], poisson, image, 0, interruption)?
            }
            _ => Galerkin::new(placed[k].grid, poisson, image.as_ref()).stiffness_unless(interruption)?,
        };
        Ok::<_, SpaceError>(own.scaled(mu))
    };
    if placed.len() == 1 {
        return own(0);
    }
    let surroundings = kernel.map_or(Surroundings::FullSpace, |_| Surroundings::HalfSpace);
    let mut starts = Vec::with_capacity(placed.len());
    let mut order = 0;
    for crack in placed {
        starts.push(order);
        order += 3 * crack.grid.free;
    }
    let mut stiffness = Matrix::zeros(order, order);
    let first_copies = first_copies(cracks);
    let mut integrated: Vec<[usize; 2]> = Vec::new();
    for (k, (crack, &start)) in placed.iter().zip(&starts).enumerate() {
        let size = 3 * crack.grid.free;
        // Copies of a crack have the same self-stiffness, wherever they lie.
        if first_copies[k] < k {
            let from = starts[first_copies[k]];
            for i in 0..size {
                let row = stiffness.row(from + i)[from..from + size].to_vec();
                stiffness.row_mut(start + i)[start..start + size].copy_from_slice(&row);
            }
        } else {
            let own = own(k)?;
            for i in 0..size {
                stiffness.row_mut(start + i)[start..start + size].copy_from_slice(&own.row(i));
            }
        }
        for (j, (other, &first)) in placed[..k].iter().zip(&starts).enumerate() {
            let between = match integrated_as([j, k], cracks, &first_copies, &integrated) {
                // Pairs of copies at equal offsets differ by a translation of the half-space.
                Some([row, column]) => Matrix::from_fn(3 * other.grid.free, size, |i, c| {
                    stiffness[(starts[row] + i, starts[column] + c)]
                }),
                None => {
                    integrated.push([j, k]);
                    let between = cross_stiffness([*other, *crack], surroundings, poisson, interruption)?;
                    Matrix::from_fn(between.rows(), between.columns(), |i, c| mu * between[(i, c)])
                }
            };
            set_both(&mut stiffness, [first, start], &between);
        }
    }
    Ok(stiffness.into())
}

/// Sets the `block` of a symmetric `matrix` that begins in this row and column, and its transpose.
fn set_both(matrix: &mut Matrix, [row, column]: [usize; 2], block: &Matrix) {
    for i in 0..block.rows() {
        for (j, &value) in block.row(i).iter().enumerate() {
            matrix[(row + i, column + j)] = value;
            matrix[(column + j, row + i)] = value;
        }
    }
}

/// Offsets of cracks that differ by no more than this fraction of a semi-axis count as equal: far
/// above the rounding of positions, far below the errors of the integrals.
const SAME_OFFSET: f64 = 1e-9;

/// For each crack the first one of which it is a copy: itself, where no earlier one is the same.
pub(super) fn first_copies(cracks: &[SpaceCrack]) -> Vec<usize> {
    let first = |k: usize| (0..k).find(|&other| cracks[k].is_copy_of(&cracks[other])).unwrap_or(k);
    (0..cracks.len()).map(first).collect()
}

/// The pair among those `integrated` whose cracks are copies of those of `pair` at the same offset.
pub(super) fn integrated_as(
    pair: [usize; 2],
    cracks: &[SpaceCrack],
    first_copies: &[usize],
    integrated: &[[usize; 2]],
) -> Option<[usize; 2]> {
    let offset = |[a, b]: [usize; 2]| [0, 1].map(|e| cracks[b].middle[e] - cracks[a].middle[e]);
    let copied = pair.map(|crack| first_copies[crack]);
    let wanted = offset(pair);
    let near = SAME_OFFSET * cracks[pair[0]].length.min(cracks[pair[1]].length);
    integrated.iter().copied().find(|known| {
        let found = offset(*known);
        known.map(|crack| first_copies[crack]) == copied
            && (0..2).all(|e| (found[e] - wanted[e]).abs() <= near)
    })
}
