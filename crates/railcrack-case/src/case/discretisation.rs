//! Discretisation of the cracks at the beginning: face elements, finite elements, cells in space,
//! counted without any of them being made.

use super::case::Case;
use super::space_case::{MOST_SPACE_POINTS, SpaceCase};
use crate::tables::{ELEMENT_SIZE, Engine, EngineDomain, INTERFACE_ELEMENTS, INTERFACE_SPACING, SPACE_CELLS};
use railcrack::bulk::Boundary;
use railcrack::crack::Crack;
use railcrack::dislocation::{FaceResolution, face_points};
use railcrack::space::SpaceResolution;
use railcrack::xfem::{MOST_MESH_UNKNOWNS, RailEnd, RefinedRegion, ResolvedLayers, default_element_sizes};

/// Growth of the length for which the refined regions of a run make room, one after the other: the
/// last one is enlarged for a crack that grows further. They do not depend on the number of steps,
/// so that a step is the same in a short run and in a long one.
const WINDOWS: [f64; 3] = [1.25, 1.75, 3.0];

/// Elements over the depth of the plastic stress, at least.
const LAYERS_PER_PLASTIC_DEPTH: f64 = 40.0;

/// Maximum number of points of the crack faces in the plane: four dense matrices with two unknowns
/// at each have 51 GB.
const MOST_FACE_POINTS: f64 = 2e4;

/// Maximum number of face points, the key of `[mesh]` that controls them, and a remedy.
pub(super) struct FinestGrid {
    pub most_points: f64,
    pub key: &'static str,
    /// The number of points and its limit, as worded in an error.
    pub says: fn(f64, f64) -> String,
    pub help: &'static str,
}

impl Case {
    /// Resolution of the crack faces in the dislocation engine.
    #[must_use]
    pub fn face_resolution(&self) -> FaceResolution {
        let cracks = self.cracks.cracks().len();
        self.mesh
            .interface_elements
            .map_or(FaceResolution::for_cracks(cracks), |elements| FaceResolution { elements })
    }

    /// Size (mm) of the finite elements at each crack.
    #[must_use]
    pub fn element_sizes(&self) -> Vec<f64> {
        match self.mesh.element_size {
            Some(size) => vec![size; self.cracks.cracks().len()],
            None => default_element_sizes(&self.cracks),
        }
    }

    /// The regions in which the meshes of a run are fine, one for each stage of growth.
    #[must_use]
    pub fn refined_regions(&self) -> [RefinedRegion; 3] {
        let sizes = self.element_sizes();
        WINDOWS.map(|growth| RefinedRegion::with_sizes(&self.cracks, &sizes, growth))
    }

    /// Boundary of the rail in finite elements.
    #[must_use]
    pub fn rail_end(&self) -> RailEnd {
        match self.rail.boundary {
            Boundary::HalfPlane => RailEnd::HalfPlane { centre: self.rail.extent.centre },
            Boundary::Block { bottom, sides } => RailEnd::Block { extent: self.rail.extent, bottom, sides },
        }
    }

    /// Whether the steps are expected to make the cracks outgrow the first mesh.
    #[must_use]
    pub fn outgrows_first_mesh(&self) -> bool {
        (1.0 + self.growth.increment).powf(self.growth.steps as f64) > WINDOWS[0]
    }

    /// The layers that finite elements resolve where a plastic stress reaches down to `depth` (mm).
    #[must_use]
    pub fn layers_of_plastic_stress(depth: f64) -> ResolvedLayers {
        ResolvedLayers { depth, height: depth / LAYERS_PER_PLASTIC_DEPTH }
    }

    /// Displacement unknowns of the mesh of the finite-element engine, computed without generating
    /// it, or a larger number that is acceptable; those of layers of a given plastic stress
    /// included. None without finite elements.
    pub(super) fn wanted_mesh_unknowns(&self) -> f64 {
        // The rail of the finite elements also carries the residual stress of the other engine.
        if self.engine.domain() != EngineDomain::Rail && self.plastic_stress.is_none() {
            return 0.0;
        }
        let [.., largest] = self.refined_regions();
        let plastic = self.plastic_stress.as_ref().and_then(|source| source.given_field().ok().flatten());
        let largest = match plastic.and_then(|field| field.plastic_depth()) {
            Some(depth) => largest.resolving(Self::layers_of_plastic_stress(depth)),
            None => largest,
        };
        let extent = self.rail_end().extent(&largest);
        let most = largest.most_mesh_unknowns(extent);
        if most <= MOST_MESH_UNKNOWNS { most } else { largest.mesh_unknowns(extent) }
    }

    /// The face points that the case requires: those of the first step, or with finite elements an
    /// upper estimate, because these points depend on the elements that a crack crosses.
    pub(super) fn wanted_face_points(&self) -> f64 {
        match self.engine {
            Engine::Xfem => {
                let spacing = self.mesh.interface_spacing.unwrap_or(f64::INFINITY);
                let points = |(crack, size): (&Crack, f64)| crack.length() / size.min(spacing);
                self.cracks.cracks().iter().zip(self.element_sizes()).map(points).sum()
            }
            Engine::Dislocation => face_points(&self.cracks, self.face_resolution()) as f64,
            Engine::Space => self.points_in_space(SpaceCase::face_points) as f64,
        }
    }

    /// Points of the faces or fronts of the cracks in space; none in the plane.
    fn points_in_space(&self, points: fn(&SpaceCase, SpaceResolution) -> usize) -> usize {
        self.space.as_ref().map_or(0, |space| points(space, self.mesh.space))
    }

    /// The keys responsible for too many face points in this case.
    pub(super) fn finest_grid(&self) -> FinestGrid {
        let in_the_plane = |key: &'static str, help: &'static str| FinestGrid {
            most_points: MOST_FACE_POINTS,
            key,
            says: |points, most| format!("{points:.2e} face points; the limit is {most:e}"),
            help,
        };
        match self.engine {
            Engine::Xfem if self.mesh.interface_spacing.is_some() => in_the_plane(
                INTERFACE_SPACING.key.name,
                "a larger [mesh] interface_spacing_mm reduces their number",
            ),
            Engine::Xfem => {
                in_the_plane(ELEMENT_SIZE.key.name, "a larger [mesh] element_size_mm reduces their number")
            }
            Engine::Dislocation => in_the_plane(
                INTERFACE_ELEMENTS.key.name,
                "a smaller [mesh] interface_elements or cracks further apart ([[crack]] spacing_mm) reduce their number",
            ),
            Engine::Space => FinestGrid {
                most_points: MOST_SPACE_POINTS as f64,
                key: SPACE_CELLS.key.name,
                says: |points, most| {
                    format!("with space_rings, {points} face points; the limit in space is {most}")
                },
                help: "reduce space_cells, space_rings or the number of cracks",
            },
        }
    }
}
