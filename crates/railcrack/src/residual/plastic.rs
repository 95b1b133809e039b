//! Plastic stress given on a mesh, evaluated at any point of the rail.

use super::cells::{CellMesh, PlaneCell, PlasticFieldError};
use super::recover::nodes_from_cells;
use super::shape::PlaneShape;
use crate::field::DepthProfile;
use crate::math::{Stress, Vec2};
use crate::mesh::{CellShape, UnstructuredGrid};

/// Name of the array that holds the plastic stress 𝕂ε_p, MPa.
pub const PLASTIC_STRESS_ARRAY: &str = "plastic_stress_mpa";

/// Largest plausible plastic stress of steel, MPa: a larger one indicates a wrong unit.
const LARGEST: f64 = 1e5;
/// Fraction of its height by which a mesh may exceed y = 0, for coordinates rounded in a file.
const ABOVE: f64 = 1e-3;

/// Fraction of the largest plastic stress below which a plastic stress is ignored in the plastic
/// depth.
const NOTHING: f64 = 1e-3;

/// The plastic stress 𝕂ε_p = 2 G ε_p (MPa) at the nodes of its own mesh, not yet balanced.
///
/// Beyond the left and the right end of the mesh it continues as at the end: the rail is rolled
/// over along its whole length. Below and in holes of the mesh it is zero.
#[derive(Debug, Clone, PartialEq)]
pub struct PlasticField {
    mesh: CellMesh,
    nodal: Vec<Stress>,
    cells: Option<Vec<Stress>>,
}

/// L2 norms over the field's own mesh: √∫ p:p dA, MPa mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecoveryLoss {
    /// Norm of the given field, constant in each cell.
    pub norm: f64,
    /// Norm of the field recovered from nodal values, over that of the given field.
    pub norm_ratio: f64,
    /// Norm of the difference, over that of the given field.
    pub difference: f64,
}

impl PlasticField {
    /// Reads the array [`PLASTIC_STRESS_ARRAY`] of a grid: point data as they are, cell data as
    /// means, from which nodal values follow by least squares. Points and lines among the cells are
    /// ignored.
    ///
    /// Errors: no such array, or one that does not hold a stress; no plane cells, or folded cells;
    /// a mesh above the running surface.
    pub fn from_grid(grid: &UnstructuredGrid) -> Result<Self, PlasticFieldError> {
        let (on_points, on_cells) =
            (grid.point_array(PLASTIC_STRESS_ARRAY), grid.cell_array(PLASTIC_STRESS_ARRAY));
        let Some(array) = on_points.or(on_cells) else {
            let names: Vec<String> = grid
                .point_data
                .iter()
                .chain(&grid.cell_data)
                .map(|array| format!("`{}`", array.name))
                .collect();
            let there = if names.is_empty() { "none".into() } else { names.join(", ") };
            return Err(PlasticFieldError::NoArray { wanted: PLASTIC_STRESS_ARRAY, there });
        };
        let values =
            array.to_stresses().map_err(|reason| PlasticFieldError::Array { reason: reason.to_string() })?;
        let largest =
            values.iter().flat_map(|s| [s.xx, s.yy, s.zz, s.xy]).fold(0.0, |m: f64, v| m.max(v.abs()));
        if largest > LARGEST {
            return Err(PlasticFieldError::TooLarge { largest, limit: LARGEST });
        }
        let (cells, kept) = plane_cells(grid)?;
        let mesh = CellMesh::new(grid.points.clone(), cells)?;
        let (lower, upper) = mesh.extent();
        if lower.y >= 0.0 || upper.y > ABOVE * (upper.y - lower.y) {
            return Err(PlasticFieldError::NotInRail { from: lower.y, to: upper.y });
        }
        if on_points.is_some() {
            return Ok(Self { mesh, nodal: values, cells: None });
        }
        let values: Vec<Stress> = kept.into_iter().map(|cell| values[cell]).collect();
        Ok(Self { nodal: nodes_from_cells(&mesh, &values), mesh, cells: Some(values) })
    }

    /// A plastic stress that depends on depth alone, `profile` read as σ_p,xx and σ_p,zz.
    ///
    /// Errors: a stress that is implausible for steel.
    pub fn layers(profile: &DepthProfile) -> Result<Self, PlasticFieldError> {
        let rows = profile.rows();
        let mut depths: Vec<f64> = rows.iter().map(|row| row.0).collect();
        if depths.first().is_some_and(|&first| first > 0.0) {
            depths.insert(0, 0.0);
        }
        if depths.len() == 1 {
            // A single row is a value at the surface, with zero below.
            depths.push(f64::EPSILON);
        }
        let points =
            depths.iter().flat_map(|&depth| [Vec2::new(-1.0, -depth), Vec2::new(1.0, -depth)]).collect();
        let nodal = depths
            .iter()
            .flat_map(|&depth| {
                let next = rows.partition_point(|row| row.0 < depth).min(rows.len() - 1);
                let stress = Stress { xx: rows[next].1, zz: rows[next].2, ..Stress::ZERO };
                [stress, stress]
            })
            .collect();
        let cells = (0..depths.len() - 1)
            .map(|i| PlaneCell {
                shape: PlaneShape::Quad,
                nodes: vec![2 * i + 2, 2 * i + 3, 2 * i + 1, 2 * i],
            })
            .collect();
        Ok(Self { mesh: CellMesh::new(points, cells)?, nodal, cells: None })
    }

    /// The plastic stress (MPa) at `point` (mm).
    pub fn plastic_stress(&self, point: Vec2) -> Stress {
        let (lower, upper) = self.mesh.extent();
        let inside = Vec2::new(point.x.clamp(lower.x, upper.x), point.y.min(upper.y));
        let Some((cell, shapes)) = self.mesh.locate(inside) else { return Stress::ZERO };
        let nodes = &self.mesh.cells[cell].nodes;
        nodes.iter().zip(shapes).fold(Stress::ZERO, |sum, (&node, n)| sum + self.nodal[node] * n[0])
    }

    /// Left end, right end and depth of its mesh, mm.
    pub fn extent(&self) -> (f64, f64, f64) {
        let (lower, upper) = self.mesh.extent();
        (lower.x, upper.x, -lower.y)
    }

    /// Depth of the lowest node with significant plastic stress, mm; none without any plastic
    /// stress.
    pub fn plastic_depth(&self) -> Option<f64> {
        let largest = self.nodal.iter().map(|stress| stress.squared()).fold(0.0, f64::max);
        let counts = |stress: &Stress| stress.squared() > NOTHING * NOTHING * largest;
        let stressed = self.mesh.points.iter().zip(&self.nodal).filter(|(_, stress)| counts(stress));
        stressed.map(|(point, _)| -point.y).reduce(f64::max)
    }

    /// Loss of the recovery from cells to nodes; none where values were given at nodes.
    pub fn recovery_loss(&self) -> Option<RecoveryLoss> {
        let cells = self.cells.as_ref()?;
        let (mut given, mut recovered, mut difference) = (0.0, 0.0, 0.0);
        for (cell, &value) in cells.iter().enumerate() {
            let nodes = &self.mesh.cells[cell].nodes;
            for (shapes, weight) in self.mesh.quadrature(cell) {
                let at = nodes
                    .iter()
                    .zip(shapes)
                    .fold(Stress::ZERO, |sum, (&node, n)| sum + self.nodal[node] * n[0]);
                given += weight * value.squared();
                recovered += weight * at.squared();
                difference += weight * (at - value).squared();
            }
        }
        let norm = given.sqrt();
        let over = |square: f64| if norm > 0.0 { square.sqrt() / norm } else { 0.0 };
        Some(RecoveryLoss { norm, norm_ratio: over(recovered), difference: over(difference) })
    }
}

/// Triangles and quadrilaterals, and their indices in the grid.
fn plane_cells(grid: &UnstructuredGrid) -> Result<(Vec<PlaneCell>, Vec<usize>), PlasticFieldError> {
    let (mut cells, mut kept) = (Vec::new(), Vec::new());
    let mut index = 0;
    for block in &grid.cells {
        let shape = match block.shape {
            CellShape::Triangle | CellShape::Polygon { corners: 3 } => Some(PlaneShape::Triangle),
            CellShape::Quad | CellShape::Polygon { corners: 4 } => Some(PlaneShape::Quad),
            CellShape::QuadraticTriangle => Some(PlaneShape::QuadraticTriangle),
            CellShape::QuadraticQuad => Some(PlaneShape::QuadraticQuad),
            CellShape::BiquadraticQuad => Some(PlaneShape::BiquadraticQuad),
            CellShape::Vertex | CellShape::Line | CellShape::QuadraticLine => None,
            CellShape::Polygon { corners } => {
                let found = format!("a polygon with {corners} corners");
                return Err(PlasticFieldError::Cell { cell: index, found });
            }
        };
        for nodes in block.cells() {
            if let Some(shape) = shape {
                cells.push(PlaneCell { shape, nodes: nodes.to_vec() });
                kept.push(index);
            }
            index += 1;
        }
    }
    Ok((cells, kept))
}
