//! `[mesh]`: discretisation of rail and crack faces.

use crate::schema::{SectionValues, integer, number, positive, section};
use railcrack::space::SpaceResolution;

section! {
    MESH "mesh", Defaulted, "Discretisation.";
    ELEMENT_SIZE: f64 = number("element_size_mm", "mm", positive(100.0), 0.1,
        "Element size at the cracks with finite elements; by default a thirtieth to a 75th of the longest crack, less at short cracks and segments.").optional();
    TIP_ENRICHMENT_RADIUS: f64 = number("tip_enrichment_radius_mm", "mm", positive(100.0), 0.5,
        "Radius of the square-root enrichment around a tip; by default two and a half elements.").optional();
    INTERFACE_SPACING: f64 = number("interface_spacing_mm", "mm", positive(100.0), 0.2,
        "Largest distance between face points with finite elements, at least 0.3 of the element size; by default the crack length within an element.").optional();
    INTERFACE_ELEMENTS: usize = integer("interface_elements", (8, 400), 28,
        "Elements along each crack with dislocations; by default 28, with more than four cracks 132 shared by all, at least 22 each.").optional();
    SPACE_CELLS: usize = integer("space_cells", (2, 16), 4,
        "Cells from the centre of a crack to each side of its inner block in space; by default 4. Shallow cracks need 6.").optional();
    SPACE_RINGS: usize = integer("space_rings", (2, 16), 4,
        "Cells from the inner block to the front in space; by default 4.").optional();
    SPACE_SURFACE_ROWS: usize = integer("space_surface_rows", (0, 6), 0,
        "Rows of cells added at the surface in space, by default 0. Each halves the 15 degrees of front at the surface where K does not count in growth. Planar surface-breaking cracks only.").optional();
}

/// Discretisation in the plane; without a value, each engine chooses it from the cracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshSettings {
    /// Element size at the cracks in the finite-element engine, mm.
    pub element_size: Option<f64>,
    /// Radius of the √r functions around a tip, mm.
    pub tip_enrichment_radius: Option<f64>,
    /// Largest distance between face points of the finite-element engine, mm.
    pub interface_spacing: Option<f64>,
    /// Elements along each crack in the dislocation engine.
    pub interface_elements: Option<usize>,
}

impl MeshSettings {
    pub(crate) fn read(section: &SectionValues) -> Self {
        Self {
            element_size: section.get(ELEMENT_SIZE),
            tip_enrichment_radius: section.get(TIP_ENRICHMENT_RADIUS),
            interface_spacing: section.get(INTERFACE_SPACING),
            interface_elements: section.get(INTERFACE_ELEMENTS),
        }
    }
}

/// Cells of a crack in space.
pub(crate) fn read_resolution(section: &SectionValues) -> SpaceResolution {
    let SpaceResolution { block, ring, surface } = SpaceResolution::default();
    SpaceResolution {
        block: section.get(SPACE_CELLS).unwrap_or(block),
        ring: section.get(SPACE_RINGS).unwrap_or(ring),
        surface: section.get(SPACE_SURFACE_ROWS).unwrap_or(surface),
    }
}
