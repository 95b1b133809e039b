//! Cracks in the plane or in space: the parts of a case that only the engines of either know.

use super::space_case::SpaceCase;
use crate::tables::{ContactSolver, MeshSettings, PlaneEngine, PlasticSource};
use railcrack::bulk::Boundary;
use railcrack::load::NamedSection;

/// The geometry of the cracks of a case, with the parts that only its engines know.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Cracks in the plane.
    Plane(PlaneCase),
    /// Cracks with fronts in space.
    Space(SpaceCase),
}

/// The parts of a case that only the engines in the plane know.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneCase {
    /// Engine that computes the cracked rail.
    pub engine: PlaneEngine,
    /// Solver of the contact conditions on the crack faces.
    pub contact_solver: ContactSolver,
    /// Half-plane, or a block with its supports.
    pub boundary: Boundary,
    /// The section that makes the cracked rail more compliant than the half-plane.
    pub section: Option<&'static NamedSection>,
    /// Half the extent along the surface over the length of each crack; long ones where none is
    /// given.
    pub widths: Vec<f64>,
    /// Plastic stress, still to be balanced.
    pub plastic_stress: Option<PlasticSource>,
    /// Discretisation.
    pub mesh: MeshSettings,
}
