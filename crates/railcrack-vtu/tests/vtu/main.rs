//! Fields in the XML format of VTK: written, read back, and exchanged with other programs.

mod bad_files;
mod damage;
mod meshio;
mod other_programs;
mod round_trip;

#[path = "../../../railcrack/tests/common/random.rs"]
mod random;

use railcrack::math::{Stress, Vec2};
use railcrack::mesh::{Array, CellBlock, CellShape, UnstructuredGrid};
use std::path::{Path, PathBuf};

/// Every shape once, twice where a block of several cells could go wrong, with data that
/// distinguish entries and components.
fn grid_of_every_shape() -> UnstructuredGrid {
    let points: Vec<Vec2> =
        (0..9).map(|i| Vec2::new(f64::from(i % 3) / 3.0, -f64::from(i / 3) - 0.1)).collect();
    let block = |shape, connectivity: &[usize]| CellBlock { shape, connectivity: connectivity.to_vec() };
    let cells = vec![
        block(CellShape::Quad, &[3, 4, 1, 0, 4, 5, 2, 1]),
        block(CellShape::Triangle, &[6, 7, 3, 7, 4, 3]),
        block(CellShape::Line, &[0, 1, 1, 2]),
        block(CellShape::Vertex, &[8]),
        block(CellShape::QuadraticLine, &[0, 2, 1]),
        block(CellShape::QuadraticTriangle, &[6, 8, 0, 7, 4, 3]),
        block(CellShape::QuadraticQuad, &[6, 8, 2, 0, 7, 5, 1, 3]),
        block(CellShape::BiquadraticQuad, &[6, 8, 2, 0, 7, 5, 1, 3, 4]),
        block(CellShape::Polygon { corners: 5 }, &[6, 7, 4, 1, 0]),
    ];
    let stress = |p: &Vec2| Stress { xx: p.x, yy: p.y, zz: 1e-300, xy: -p.x * p.y };
    let stresses: Vec<Stress> = points.iter().map(stress).collect();
    let displacements: Vec<Vec2> = points.iter().map(|p| Vec2::new(p.y * 1e-3, 0.1 + p.x)).collect();
    UnstructuredGrid {
        point_data: vec![
            Array::vectors("displacement_mm", &displacements),
            Array::stresses("stress_mpa", &stresses),
            Array::scalars("a < \"b\" & c", (0..9).map(|i| f64::from(i).sqrt()).collect()),
        ],
        cell_data: vec![
            Array::scalars("material", (0..12).map(f64::from).collect()),
            Array { name: "pair".to_owned(), components: 2, values: (0..24).map(f64::from).collect() },
        ],
        points,
        z: Vec::new(),
        cells,
    }
}

/// A folder of this test.
fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("vtu").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}
