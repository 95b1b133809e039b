//! Uncracked rail: mesh, supports, stiffness and factor.

use super::boundary::{Boundary, Freedom};
use crate::interruption::Interruption;
use crate::linear::{ElementSum, LinearError, SparseCholesky, SparseFactor};
use crate::material::IsotropicElastic;
use crate::math::{Matrix, Vec2, gauss_legendre};
use crate::mesh::{NODES, QuadMesh, shape_functions};
use std::sync::OnceLock;
use thiserror::Error;

/// Errors of the uncracked rail.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum BulkError {
    /// The mesh does not end at the running surface.
    #[error("the top of the mesh lies at y = {top} mm: must be the running surface, y = 0")]
    Top {
        /// Ordinate of its last line, mm.
        top: f64,
    },
    /// A half-plane has no ends to correct for.
    #[error("the stress in a half-plane under a wheel needs no correction; a correction requires a block")]
    NoBlock,
    /// Bending of the rail on its track, which the supports of a block replace.
    #[error(
        "bending of the rail on the track is not a field of the half-plane, and a block bends on its own supports: bending \
         must be left out, or the boundary be a half-plane"
    )]
    Bending,
    /// Wheel positions that are not increasing.
    #[error("wheel positions from {from} to {to} mm: must be finite and increasing")]
    Positions {
        /// First, mm.
        from: f64,
        /// Last, mm.
        to: f64,
    },
    /// A contact that leaves the block.
    #[error(
        "the contact reaches from {from} to {to} mm, the block only from {left} to {right} mm: it must stay {gap} mm \
         inside"
    )]
    OffTheBlock {
        /// Left end of the contact in its leftmost position, mm.
        from: f64,
        /// Right end in its rightmost position, mm.
        to: f64,
        /// Left side of the block, mm.
        left: f64,
        /// Right side, mm.
        right: f64,
        /// Smallest gap between contact and side, mm.
        gap: f64,
    },
    /// A wheel position outside the range of the correction.
    #[error("wheel at {position} mm: the correction was made for {from} to {to} mm")]
    Position {
        /// The requested position, mm.
        position: f64,
        /// First position, mm.
        from: f64,
        /// Last position, mm.
        to: f64,
    },
    /// A point that is not in the mesh.
    #[error("point ({x}, {y}) mm is not in the mesh")]
    Point {
        /// Abscissa, mm.
        x: f64,
        /// Ordinate, mm.
        y: f64,
    },
    /// A stiffness matrix that cannot be factored.
    #[error("the stiffness matrix of the uncracked rail cannot be factored")]
    Stiffness(#[from] LinearError),
}

/// The uncracked rail: a mesh of 8-node rectangles, supports, and the factor of the stiffness of
/// the free unknowns, computed at the latest when it is first needed.
#[derive(Debug, Clone)]
pub struct BulkRail {
    mesh: QuadMesh,
    steel: IsotropicElastic,
    boundary: Boundary,
    /// Unknowns along x and y of each node; none where it is held.
    unknowns: Vec<[Option<usize>; 2]>,
    /// Number of free unknowns.
    order: usize,
    factor: OnceLock<SparseFactor>,
}

/// The stiffness of the free unknowns of a rail, element by element; N/mm per mm of thickness.
#[derive(Debug, Clone)]
pub struct RailStiffness<'a> {
    mesh: &'a QuadMesh,
    unknowns: &'a [[Option<usize>; 2]],
    order: usize,
    of_rectangles: RectangleStiffness,
}

impl ElementSum for RailStiffness<'_> {
    fn order(&self) -> usize {
        self.order
    }

    fn count(&self) -> usize {
        self.mesh.element_count()
    }

    fn unknowns(&self, element: usize) -> Vec<Option<usize>> {
        of_element(self.mesh, self.unknowns, element).to_vec()
    }

    fn matrix(&self, element: usize) -> Matrix {
        self.of_rectangles.matrix(self.mesh.element(element).size())
    }
}

impl BulkRail {
    /// Assembles and factors the rail on `mesh`, whose top is the running surface, with the
    /// supports of `boundary`.
    ///
    /// Errors: a top that is not at y = 0; a stiffness that cannot be factored.
    pub fn new(mesh: QuadMesh, steel: &IsotropicElastic, boundary: Boundary) -> Result<Self, BulkError> {
        Self::new_unless(Interruption::NEVER, mesh, steel, boundary)
    }

    /// [`BulkRail::new`] that stops on an `interruption`.
    pub(crate) fn new_unless(
        interruption: Interruption<'_>,
        mesh: QuadMesh,
        steel: &IsotropicElastic,
        boundary: Boundary,
    ) -> Result<Self, BulkError> {
        let rail = Self::unfactored(mesh, steel, boundary)?;
        rail.factored(interruption)?;
        Ok(rail)
    }

    /// [`BulkRail::new`] without factoring the stiffness.
    ///
    /// Errors: a top that is not at y = 0.
    fn unfactored(mesh: QuadMesh, steel: &IsotropicElastic, boundary: Boundary) -> Result<Self, BulkError> {
        let top = mesh.y_lines()[mesh.rows()];
        if top != 0.0 {
            return Err(BulkError::Top { top });
        }
        let mut count = 0;
        let mut number = |freedom| {
            (freedom == Freedom::Free).then(|| {
                count += 1;
                count - 1
            })
        };
        let unknowns: Vec<[Option<usize>; 2]> =
            boundary.nodes(&mesh).into_iter().map(|axes| axes.map(&mut number)).collect();
        Ok(Self { mesh, steel: *steel, boundary, unknowns, order: count, factor: OnceLock::new() })
    }

    /// Computes the factor if it does not exist yet.
    fn factored(&self, interruption: Interruption<'_>) -> Result<&SparseFactor, LinearError> {
        if let Some(factor) = self.factor.get() {
            return Ok(factor);
        }
        let nodes = self.mesh.nested_dissection().into_iter();
        let order = nodes.flat_map(|node| self.unknowns[node]).flatten().collect();
        let stiffness = self.stiffness();
        let analysed = SparseCholesky::analyse_unless(interruption, &stiffness, order)?;
        let factor = analysed.factor_unless(interruption, &stiffness)?;
        Ok(self.factor.get_or_init(|| factor))
    }

    /// The mesh.
    pub fn mesh(&self) -> &QuadMesh {
        &self.mesh
    }

    /// The elasticity.
    pub fn steel(&self) -> &IsotropicElastic {
        &self.steel
    }

    /// The boundary of the mesh.
    pub(crate) fn boundary(&self) -> Boundary {
        self.boundary
    }

    /// The unknowns u_x, u_y of a node; none where it is held.
    pub fn unknowns(&self, node: usize) -> [Option<usize>; 2] {
        self.unknowns[node]
    }

    /// The unknowns of element `e`: 2i is u_x, 2i + 1 u_y of its node i.
    pub fn element_unknowns(&self, e: usize) -> [Option<usize>; 2 * NODES] {
        of_element(&self.mesh, &self.unknowns, e)
    }

    /// The stiffness of the free unknowns.
    pub fn stiffness(&self) -> RailStiffness<'_> {
        RailStiffness {
            mesh: &self.mesh,
            unknowns: &self.unknowns,
            order: self.order,
            of_rectangles: RectangleStiffness::new(&self.steel),
        }
    }

    /// Number of free unknowns.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The factor of the stiffness.
    ///
    /// Errors: a stiffness that cannot be factored.
    pub fn factor(&self) -> Result<&SparseFactor, LinearError> {
        self.factored(Interruption::NEVER)
    }

    /// Merges the displacements (mm) of the free unknowns with those of the `held` ones, node by
    /// node.
    pub(crate) fn at_nodes(&self, free: &[f64], held: impl Fn(Vec2) -> Vec2) -> Vec<Vec2> {
        let node = |(node, [x, y]): (usize, &[Option<usize>; 2])| match (x, y) {
            (Some(x), Some(y)) => Vec2::new(free[*x], free[*y]),
            _ => {
                let held = held(self.mesh.node_position(node));
                Vec2::new(x.map_or(held.x, |i| free[i]), y.map_or(held.y, |i| free[i]))
            }
        };
        self.unknowns.iter().enumerate().map(node).collect()
    }
}

fn of_element(mesh: &QuadMesh, unknowns: &[[Option<usize>; 2]], e: usize) -> [Option<usize>; 2 * NODES] {
    let nodes = mesh.element(e).nodes;
    std::array::from_fn(|k| unknowns[nodes[k / 2]][k % 2])
}

/// Stiffness of 8-node rectangles of any size in plane strain, integrated exactly.
///
/// With the Lamé constants λ, μ, sides h_x, h_y and A = ∫N_ξ N_ξ, B = ∫N_η N_η, C = ∫N_ξ N_η over
/// the reference square: K_xx = (λ + 2μ) (h_y/h_x) A + μ (h_x/h_y) B, K_yy with A and B
/// interchanged, K_xy = λ C + μ Cᵀ.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RectangleStiffness {
    lambda: f64,
    mu: f64,
    along_x: [[f64; NODES]; NODES],
    along_y: [[f64; NODES]; NODES],
    mixed: [[f64; NODES]; NODES],
}

impl RectangleStiffness {
    /// The integrals for elements of `steel`.
    pub(crate) fn new(steel: &IsotropicElastic) -> Self {
        let (lambda, mu) = lame(steel);
        let zero = [[0.0; NODES]; NODES];
        let mut stiffness = Self { lambda, mu, along_x: zero, along_y: zero, mixed: zero };
        // Products of derivatives have degree 4 in each direction.
        let rule = gauss_legendre(3);
        for (&(s, v), &(t, w)) in rule.iter().flat_map(|s| rule.iter().map(move |t| (s, t))) {
            let shapes = shape_functions(2.0 * s - 1.0, 2.0 * t - 1.0);
            let weight = 4.0 * v * w;
            for (i, a) in shapes.iter().enumerate() {
                for (j, b) in shapes.iter().enumerate() {
                    stiffness.along_x[i][j] += weight * a[1] * b[1];
                    stiffness.along_y[i][j] += weight * a[2] * b[2];
                    stiffness.mixed[i][j] += weight * a[1] * b[2];
                }
            }
        }
        stiffness
    }

    /// The stiffness (N/mm per mm of thickness, 16 × 16) of a rectangle of width and height `size`
    /// (mm); unknown 2i is u_x, 2i + 1 u_y of node i.
    pub(crate) fn matrix(&self, size: Vec2) -> Matrix {
        let (wide, high) = (size.x / size.y, size.y / size.x);
        let (lambda, mu) = (self.lambda, self.mu);
        Matrix::from_fn(2 * NODES, 2 * NODES, |row, column| {
            let (i, j) = (row / 2, column / 2);
            let (along_x, along_y) = (high * self.along_x[i][j], wide * self.along_y[i][j]);
            match (row % 2, column % 2) {
                (0, 0) => (lambda + 2.0 * mu) * along_x + mu * along_y,
                (1, 1) => (lambda + 2.0 * mu) * along_y + mu * along_x,
                (0, _) => lambda * self.mixed[i][j] + mu * self.mixed[j][i],
                _ => lambda * self.mixed[j][i] + mu * self.mixed[i][j],
            }
        })
    }
}

/// The Lamé constants λ and μ, MPa.
fn lame(steel: &IsotropicElastic) -> (f64, f64) {
    let (mu, nu) = (steel.shear_modulus(), steel.poisson());
    (2.0 * mu * nu / (1.0 - 2.0 * nu), mu)
}
