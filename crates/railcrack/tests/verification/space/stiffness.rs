//! Symmetry, positive definiteness and determinism of the stiffness of a crack.

use super::body;
use crate::common::{Absolute, close, measured};
use railcrack::linear::spd_inverse;
use railcrack::math::Matrix;
use railcrack::space::{SpaceCrack, Surroundings};

/// The largest eigenvalue of a symmetric positive definite matrix, by the power method.
pub(super) fn largest_eigenvalue(matrix: &Matrix) -> f64 {
    let mut vector: Vec<f64> = (0..matrix.rows()).map(|i| ((i * 7919) % 101) as f64 - 50.0).collect();
    let mut value = 0.0;
    for _ in 0..300 {
        let next = matrix.times(&vector);
        value = next.iter().map(|v| v * v).sum::<f64>().sqrt();
        vector = next.iter().map(|v| v / value).collect();
    }
    value
}

/// Smallest over largest eigenvalue of the stiffness, scaled to a unit diagonal.
fn condition(degrees: f64, cells: usize) -> f64 {
    let crack = SpaceCrack::surface_breaking(degrees.to_radians(), 1.0, 1.0).unwrap();
    let body = body(&crack, Surroundings::HalfSpace, cells);
    let a = body.stiffness().to_matrix();
    let size = |i: usize| a[(i, i)].sqrt();
    let scaled = Matrix::from_fn(a.rows(), a.rows(), |i, j| a[(i, j)] / (size(i) * size(j)));
    1.0 / (largest_eigenvalue(&scaled) * largest_eigenvalue(&spd_inverse(&scaled).unwrap()))
}

#[test]
fn shallow_cracks_stay_definite_on_finer_grids() {
    // The condition falls with the size of the cells at any dip, and with the dip as the flap above
    // the crack bends; what it must not do is fall faster with the cells where the dip is small.
    let share = |cells: usize| condition(15.0, cells) / condition(90.0, cells);
    let (coarse, fine) = (share(2), share(3));
    println!("{coarse:.3e} {fine:.3e}");
    measured(coarse / fine, 1.7, "smallest over largest eigenvalue at 15° over that at 90°, on refinement");
    assert!(fine > coarse / 1.7, "{coarse} {fine}");
}

#[test]
fn mirror_images() {
    let stiffness = |degrees: f64| {
        let crack = SpaceCrack::surface_breaking(f64::to_radians(degrees), 1.5, 1.0).unwrap();
        body(&crack, Surroundings::HalfSpace, 2)
    };
    let (one, other) = (stiffness(30.0), stiffness(150.0));
    let (a, b) = (one.stiffness().to_matrix(), other.stiffness().to_matrix());
    // Mirrored along the rail, the normal of the plane turns round but its dip and trace do not.
    let sign = |i: usize| if i.is_multiple_of(3) { -1.0 } else { 1.0 };
    let scale = a[(0, 0)];
    for i in 0..a.rows() {
        for j in 0..a.rows() {
            let gap = (a[(i, j)] - sign(i) * sign(j) * b[(i, j)]) / scale;
            close(gap, 0.0, Absolute(1e-6), "the table of the image");
        }
    }
}

#[test]
fn same_bits_with_any_number_of_threads() {
    let crack = SpaceCrack::surface_breaking(0.5, 1.0, 1.0).unwrap();
    let with = |threads: usize| {
        let pool = rayon_pool(threads);
        pool.install(|| body(&crack, Surroundings::HalfSpace, 2))
    };
    assert_eq!(with(1).stiffness(), with(3).stiffness());
}

fn rayon_pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}
