//! Mirror images of the points of a crack about its line of dip.

use crate::math::Matrix;

/// Signs of the components of mirrored jumps and forces.
pub(super) const SIGNS: [f64; 3] = [1.0, 1.0, -1.0];
/// Distance of a point from the mirror image of another one, relative to the size of the cracks, up
/// to which it is round-off: the points of a grid are closer together by a factor of 10⁴ at most.
pub(super) const COINCIDENT: f64 = 1e-9;

/// The stiffness `own` (3p × 3p) of a crack by itself, averaged with its mirror image about the
/// line of dip through the middle: every crack with these `points` (s, ζ) is its own mirror image,
/// but the quadrature takes the cells in an order that is not.
pub(super) fn averaged_with_mirror_image(own: Matrix, points: &[[f64; 2]]) -> Matrix {
    let size = points.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    let image = |[s, zeta]: &[f64; 2]| {
        let is_image = |[u, v]: &[f64; 2]| (u - s).abs().max((v + zeta).abs()) <= COINCIDENT * size;
        points.iter().position(is_image)
    };
    let Some(images) = points.iter().map(image).collect::<Option<Vec<usize>>>() else { return own };
    Matrix::from_fn(own.rows(), own.rows(), |i, j| {
        let (c, d) = (i % 3, j % 3);
        let mirrored = own[(3 * images[i / 3] + c, 3 * images[j / 3] + d)];
        0.5 * (own[(i, j)] + SIGNS[c] * SIGNS[d] * mirrored)
    })
}
