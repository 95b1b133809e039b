//! Discretisation of the cracks at the beginning: face elements, finite elements, cells in space,
//! counted without any of them being made.

use super::case::Case;
use super::geometry::{Geometry, PlaneCase};
use crate::tables::{ELEMENT_SIZE, INTERFACE_ELEMENTS, INTERFACE_SPACING, PlaneEngine, SPACE_CELLS};
use railcrack::bulk::Boundary;
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::{FaceResolution, face_points};
use railcrack::math::RailBox;
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

/// The same in space: three unknowns at each make dense matrices of 300 MB.
const MOST_SPACE_POINTS: f64 = 2000.0;

impl PlaneCase {
    /// Resolution of the faces of `cracks` in the dislocation engine.
    #[must_use]
    pub fn face_resolution(&self, cracks: &CrackNetwork) -> FaceResolution {
        let by_default = || FaceResolution::for_cracks(cracks.cracks().len());
        self.mesh.interface_elements.map_or_else(by_default, |elements| FaceResolution { elements })
    }

    /// Size (mm) of the finite elements at each of `cracks`.
    #[must_use]
    pub fn element_sizes(&self, cracks: &CrackNetwork) -> Vec<f64> {
        match self.mesh.element_size {
            Some(size) => vec![size; cracks.cracks().len()],
            None => default_element_sizes(cracks),
        }
    }

    /// The regions in which the meshes of a run are fine, one for each stage of growth of `cracks`.
    #[must_use]
    pub fn refined_regions(&self, cracks: &CrackNetwork) -> [RefinedRegion; 3] {
        let sizes = self.element_sizes(cracks);
        WINDOWS.map(|growth| RefinedRegion::with_sizes(cracks, &sizes, growth))
    }

    /// Boundary of a rail of this `extent` in finite elements.
    #[must_use]
    pub fn rail_end(&self, extent: RailBox) -> RailEnd {
        match self.boundary {
            Boundary::HalfPlane => RailEnd::HalfPlane { centre: extent.centre },
            Boundary::Block { bottom, sides } => RailEnd::Block { extent, bottom, sides },
        }
    }

    /// The layers that finite elements resolve where a plastic stress reaches down to `depth` (mm).
    #[must_use]
    pub fn layers_of_plastic_stress(depth: f64) -> ResolvedLayers {
        ResolvedLayers { depth, height: depth / LAYERS_PER_PLASTIC_DEPTH }
    }

    /// Displacement unknowns of the mesh of the finite-element engine for `cracks` in a rail of
    /// this `extent`, computed without generating it, or a larger number that is acceptable; those
    /// of layers of a given plastic stress included. None without finite elements.
    pub(super) fn wanted_mesh_unknowns(&self, cracks: &CrackNetwork, extent: RailBox) -> f64 {
        // The rail of the finite elements also carries the residual stress of the other engine.
        if self.engine == PlaneEngine::Dislocation && self.plastic_stress.is_none() {
            return 0.0;
        }
        let [.., largest] = self.refined_regions(cracks);
        let plastic = self.plastic_stress.as_ref().and_then(|source| source.given_field().ok().flatten());
        let largest = match plastic.and_then(|field| field.plastic_depth()) {
            Some(depth) => largest.resolving(Self::layers_of_plastic_stress(depth)),
            None => largest,
        };
        let extent = self.rail_end(extent).extent(&largest);
        let most = largest.most_mesh_unknowns(extent);
        if most <= MOST_MESH_UNKNOWNS { most } else { largest.mesh_unknowns(extent) }
    }

    /// The face points that `cracks` require: those of the first step, or with finite elements an
    /// upper estimate, because these points depend on the elements that a crack crosses.
    pub(super) fn wanted_face_points(&self, cracks: &CrackNetwork) -> f64 {
        match self.engine {
            PlaneEngine::Xfem => {
                let spacing = self.mesh.interface_spacing.unwrap_or(f64::INFINITY);
                let points = |(crack, size): (&Crack, f64)| crack.length() / size.min(spacing);
                cracks.cracks().iter().zip(self.element_sizes(cracks)).map(points).sum()
            }
            PlaneEngine::Dislocation => face_points(cracks, self.face_resolution(cracks)) as f64,
        }
    }
}

impl Geometry {
    /// Maximum number of face points.
    pub(super) fn most_face_points(&self) -> f64 {
        match self {
            Self::Plane(_) => MOST_FACE_POINTS,
            Self::Space(_) => MOST_SPACE_POINTS,
        }
    }

    /// The key of `[mesh]` responsible for too many face points, and a remedy.
    pub(super) fn finest_key(&self) -> (&'static str, &'static str) {
        match self {
            Self::Plane(plane) if plane.engine == PlaneEngine::Dislocation => (
                INTERFACE_ELEMENTS.key.name,
                "a smaller [mesh] interface_elements or cracks further apart ([[crack]] spacing_mm) reduce their number",
            ),
            Self::Plane(plane) if plane.mesh.interface_spacing.is_some() => {
                (INTERFACE_SPACING.key.name, "a larger [mesh] interface_spacing_mm reduces their number")
            }
            Self::Plane(_) => (ELEMENT_SIZE.key.name, "a larger [mesh] element_size_mm reduces their number"),
            Self::Space(_) => {
                (SPACE_CELLS.key.name, "reduce space_cells, space_rings or the number of cracks")
            }
        }
    }
}

impl Case {
    /// Whether the steps are expected to make the cracks outgrow the first mesh.
    #[must_use]
    pub fn outgrows_first_mesh(&self) -> bool {
        (1.0 + self.growth.increment).powf(self.growth.expected_steps() as f64) > WINDOWS[0]
    }
}
