//! Files of VTK and meshio read by railcrack, and files of railcrack read by meshio.

use super::meshio::read_back;
use super::{grid_of_every_shape, scratch};
use railcrack::mesh::{Array, CellShape, UnstructuredGrid};
use railcrack_vtu::{read_vtu, write_vtu};
use serde_json::{Value, json};
use std::ops::Range;
use std::path::{Path, PathBuf};

fn verification() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/vtu")
}

/// Decimals of meshio have 11 digits behind the first (`%.11e`), those of VTK 17; binary numbers
/// are exact.
const DECIMALS: f64 = 1e-10;

#[test]
fn files_of_other_programs_hold_what_they_wrote() {
    let mut count = 0;
    for entry in std::fs::read_dir(verification().join("samples")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let grid = read_vtu(&path).unwrap_or_else(|error| panic!("{error}"));
        check_sample(&grid, if name.contains("ascii") { DECIMALS } else { 0.0 }, &name);
        count += 1;
    }
    assert_eq!(count, 9);
}

fn check_sample(grid: &UnstructuredGrid, tolerance: f64, name: &str) {
    let close = |found: f64, want: f64, what: &str| {
        assert!((found - want).abs() <= tolerance, "{name}: {what} is {found}, not {want}");
    };
    assert_eq!(grid.points.len(), 45, "{name}");
    close(grid.points[44].x, 5.5, "x of the last point");
    close(grid.points[44].y, -0.5, "y of the last point");
    let shapes: Vec<CellShape> = grid.cells.iter().map(|block| block.shape).collect();
    use CellShape::{BiquadraticQuad, Quad, QuadraticQuad, QuadraticTriangle, Triangle};
    assert_eq!(shapes, [Triangle, Quad, QuadraticTriangle, QuadraticQuad, BiquadraticQuad], "{name}");
    assert_eq!(grid.cells[2].connectivity, [18, 19, 20, 22, 23, 26], "{name}");
    assert_eq!(grid.cells[4].connectivity, (36..45).collect::<Vec<_>>(), "{name}");
    let displacements = grid.point_array("displacement_mm").unwrap().to_vectors().unwrap();
    let stresses = grid.point_array("stress_mpa").unwrap().to_stresses().unwrap();
    for ((p, u), s) in grid.points.iter().zip(displacements).zip(stresses) {
        close(u.x, 0.5 * p.x, "u_x");
        close(u.y, -0.25 * p.y, "u_y");
        close(s.xx, p.x, "s_xx");
        close(s.yy, p.y, "s_yy");
        close(s.zz, 2.0, "s_zz");
        close(s.xy, p.x * p.y, "s_xy");
    }
    assert_eq!(grid.cell_array("material").unwrap().values, [0.0, 10.0, 20.0, 30.0, 40.0], "{name}");
}

#[test]
#[ignore = "extra: needs RAILCRACK_PYTHON, a Python with meshio; .ci/run provides it"]
fn meshio_reads_what_we_write() {
    let path = scratch("meshio").join("grid.vtu");
    let grid = grid_of_every_shape();
    write_vtu(&path, &grid).unwrap();
    let read = read_back(&path);

    let points: Vec<Value> = grid.points.iter().map(|p| bits(&[p.x, p.y, 0.0])).collect();
    assert_eq!(read["points"], json!(points));
    let cells: Vec<Value> = (grid.cells.iter())
        .map(|block| json!({ "type": meshio_name(block.shape), "nodes": block.cells().collect::<Vec<_>>() }))
        .collect();
    assert_eq!(read["cells"], json!(cells));
    for array in &grid.point_data {
        assert_eq!(read["point_data"][&array.name], as_meshio(array, 0..9), "{}", array.name);
    }
    // meshio splits cell data into one array per block.
    let mut begin = 0;
    for (i, block) in grid.cells.iter().enumerate() {
        let cells = begin..begin + block.cell_count();
        for array in &grid.cell_data {
            assert_eq!(read["cell_data"][&array.name][i], as_meshio(array, cells.clone()), "{}", array.name);
        }
        begin = cells.end;
    }
}

/// Real numbers as the script prints them.
fn bits(values: &[f64]) -> Value {
    json!(values.iter().map(|value| value.to_bits()).collect::<Vec<_>>())
}

/// Some entries of an array; meshio gives entries of one component as plain numbers.
fn as_meshio(array: &Array, entries: Range<usize>) -> Value {
    let wanted = &array.values[entries.start * array.components..entries.end * array.components];
    match array.components {
        1 => bits(wanted),
        components => json!(wanted.chunks_exact(components).map(bits).collect::<Vec<_>>()),
    }
}

fn meshio_name(shape: CellShape) -> &'static str {
    match shape {
        CellShape::Vertex => "vertex",
        CellShape::Line => "line",
        CellShape::QuadraticLine => "line3",
        CellShape::Triangle => "triangle",
        CellShape::Quad => "quad",
        CellShape::QuadraticTriangle => "triangle6",
        CellShape::QuadraticQuad => "quad8",
        CellShape::BiquadraticQuad => "quad9",
        CellShape::Polygon { .. } => "polygon",
    }
}
