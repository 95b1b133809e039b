//! The uncracked rail: its mesh, supports and factored stiffness.

use super::basis::Elasticity;
use crate::linear::{LinearError, SparseCholesky, SparseFactor, SparseSymmetric, SymmetricPattern};
use crate::material::IsotropicElastic;
use crate::math::{Matrix, gauss_legendre};
use crate::mesh::{Element, NODES, QuadMesh, shape_functions};
use std::sync::Arc;

/// How the bottom of a block is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BottomSupport {
    /// No displacement.
    Clamped,
    /// No vertical displacement; its middle is held along x where the sides do not hold it.
    Rollers,
}

/// How the sides of a block are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SideSupport {
    /// No traction.
    Free,
    /// No horizontal displacement.
    Rollers,
    /// No displacement.
    Clamped,
}

/// What holds the outer boundary of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Supports {
    /// The bottom.
    pub bottom: BottomSupport,
    /// Both sides.
    pub sides: SideSupport,
}

impl Supports {
    /// All held: for a boundary so far away that it is not felt.
    pub const FAR: Self = Self { bottom: BottomSupport::Clamped, sides: SideSupport::Clamped };

    /// Whether unknown 2 n + direction of each node n of `mesh` is held.
    pub fn held(&self, mesh: &QuadMesh) -> Vec<bool> {
        let mut held = vec![false; 2 * mesh.node_count()];
        for node in 0..mesh.node_count() {
            let (c, r) = mesh.lattice_point(node);
            if c == 0 || c == 2 * mesh.columns() {
                held[2 * node] |= self.sides != SideSupport::Free;
                held[2 * node + 1] |= self.sides == SideSupport::Clamped;
            }
            if r == 0 {
                held[2 * node] |= self.bottom == BottomSupport::Clamped;
                held[2 * node + 1] = true;
            }
        }
        if self.bottom == BottomSupport::Rollers && self.sides == SideSupport::Free {
            held[2 * mesh.node_at(mesh.columns(), 0)] = true;
        }
        held
    }
}

/// The uncracked rail with its stiffness matrix factored once.
#[derive(Debug)]
pub struct Background {
    mesh: QuadMesh,
    elasticity: Elasticity,
    /// Per displacement component of the mesh, its place in the factored system; none where it is held.
    unknowns: Vec<Option<usize>>,
    factor: SparseFactor,
}

impl Background {
    /// The rail on `mesh`, of `steel`, held by `supports`. Errors: a mesh too large for the memory.
    pub fn new(mesh: QuadMesh, steel: IsotropicElastic, supports: Supports) -> Result<Self, LinearError> {
        let elasticity = Elasticity::new(steel);
        let held = supports.held(&mesh);
        let mut free = 0;
        let unknowns: Vec<Option<usize>> = held
            .into_iter()
            .map(|held| {
                (!held).then(|| {
                    free += 1;
                    free - 1
                })
            })
            .collect();
        let blocks: Vec<Vec<Option<usize>>> = (0..mesh.element_count())
            .map(|e| {
                let nodes = mesh.element(e).nodes;
                nodes.into_iter().flat_map(|n| [unknowns[2 * n], unknowns[2 * n + 1]]).collect()
            })
            .collect();
        let pattern = Arc::new(SymmetricPattern::from_blocks(free, &blocks)?);
        let mut stiffness = SparseSymmetric::zeros(pattern.clone());
        for (e, block) in blocks.iter().enumerate() {
            stiffness.add_block(block, &element_stiffness(&mesh.element(e), &elasticity))?;
        }
        let order = mesh
            .nested_dissection()
            .into_iter()
            .flat_map(|n| [unknowns[2 * n], unknowns[2 * n + 1]])
            .flatten()
            .collect();
        let factor = SparseCholesky::analyse(pattern, order)?.factor(&stiffness)?;
        Ok(Self { mesh, elasticity, unknowns, factor })
    }

    /// The mesh.
    pub fn mesh(&self) -> &QuadMesh {
        &self.mesh
    }

    pub(super) fn elasticity(&self) -> &Elasticity {
        &self.elasticity
    }

    /// Number of displacement unknowns that are not held.
    pub fn unknown_count(&self) -> usize {
        self.factor.order()
    }

    /// Place of displacement component 2 n + direction of node n in the factored system; none where it is held.
    pub fn unknowns(&self) -> &[Option<usize>] {
        &self.unknowns
    }

    /// The factor of the stiffness matrix.
    pub fn factor(&self) -> &SparseFactor {
        &self.factor
    }
}

/// Stiffness of a rectangle, 16 × 16, unknown 2 k + direction of its node k: exact with 3 × 3 Gauss points.
fn element_stiffness(element: &Element, elasticity: &Elasticity) -> Matrix {
    let mut stiffness = Matrix::zeros(2 * NODES, 2 * NODES);
    let size = element.size();
    let rule = gauss_legendre(3);
    for &(s, v) in &rule {
        for &(t, w) in &rule {
            let values = shape_functions(2.0 * s - 1.0, 2.0 * t - 1.0);
            let strains: Vec<[f64; 3]> = values
                .iter()
                .flat_map(|[_, d_xi, d_eta]| {
                    let (dx, dy) = (2.0 * d_xi / size.x, 2.0 * d_eta / size.y);
                    [[dx, 0.0, dy], [0.0, dy, dx]]
                })
                .collect();
            for (i, strain) in strains.iter().enumerate() {
                let stress = elasticity.stress(*strain).map(|c| c * v * w * size.x * size.y);
                for (j, other) in strains.iter().enumerate() {
                    stiffness[(i, j)] += (0..3).map(|c| stress[c] * other[c]).sum::<f64>();
                }
            }
        }
    }
    stiffness
}
