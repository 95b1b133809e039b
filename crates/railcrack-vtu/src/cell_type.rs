//! Numbers of cell shapes in VTK files.

use railcrack::mesh::CellShape;

const VTK_VERTEX: u8 = 1;
const VTK_LINE: u8 = 3;
const VTK_TRIANGLE: u8 = 5;
const VTK_POLYGON: u8 = 7;
const VTK_QUAD: u8 = 9;
const VTK_QUADRATIC_LINE: u8 = 21;
const VTK_QUADRATIC_TRIANGLE: u8 = 22;
const VTK_QUADRATIC_QUAD: u8 = 23;
const VTK_BIQUADRATIC_QUAD: u8 = 28;

/// The number of the shape in files (`vtkCellType.h`).
pub fn vtk_type(shape: CellShape) -> u8 {
    match shape {
        CellShape::Vertex => VTK_VERTEX,
        CellShape::Line => VTK_LINE,
        CellShape::QuadraticLine => VTK_QUADRATIC_LINE,
        CellShape::Triangle => VTK_TRIANGLE,
        CellShape::Quad => VTK_QUAD,
        CellShape::QuadraticTriangle => VTK_QUADRATIC_TRIANGLE,
        CellShape::QuadraticQuad => VTK_QUADRATIC_QUAD,
        CellShape::BiquadraticQuad => VTK_BIQUADRATIC_QUAD,
        CellShape::Polygon { .. } => VTK_POLYGON,
    }
}

/// The shape of a cell of this number in files with `nodes` nodes; none if the shape is not
/// supported.
pub(crate) fn shape_of(vtk_type: u8, nodes: usize) -> Option<CellShape> {
    let shape = match vtk_type {
        VTK_VERTEX => CellShape::Vertex,
        VTK_LINE => CellShape::Line,
        VTK_QUADRATIC_LINE => CellShape::QuadraticLine,
        VTK_TRIANGLE => CellShape::Triangle,
        VTK_QUAD => CellShape::Quad,
        VTK_QUADRATIC_TRIANGLE => CellShape::QuadraticTriangle,
        VTK_QUADRATIC_QUAD => CellShape::QuadraticQuad,
        VTK_BIQUADRATIC_QUAD => CellShape::BiquadraticQuad,
        VTK_POLYGON if nodes >= 3 => CellShape::Polygon { corners: nodes },
        _ => return None,
    };
    (shape.nodes() == nodes).then_some(shape)
}
