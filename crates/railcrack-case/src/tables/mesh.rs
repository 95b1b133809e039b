//! `[mesh]`: discretisation of rail and crack faces.

use crate::schema::{SectionValues, integer, number, positive, section};
use railcrack::space::SpaceResolution;

section! {
    MESH "mesh", Defaulted, "Discretisation.";
    ELEMENT_SIZE: f64 = number("element_size_mm", "mm", positive(100.0), 0.1,
        "Element size at the cracks in the finite-element engine. By default, at each crack a sixtieth of the longest one (a 75th at a kinked crack, a thirtieth at a straight one if there are more than three), but no more than a thirtieth of the crack or a tenth of the segment at its tip. It has no effect on the dislocation engine.").optional();
    TIP_ENRICHMENT_RADIUS: f64 = number("tip_enrichment_radius_mm", "mm", positive(100.0), 0.5,
        "Radius around a tip within which nodes carry the square-root functions of the crack tip; by default two and a half elements.").optional();
    INTERFACE_SPACING: f64 = number("interface_spacing_mm", "mm", positive(100.0), 0.2,
        "Largest distance between face points in the finite-element engine, at least 0.3 of the element size; by default the length of the crack within an element.").optional();
    INTERFACE_ELEMENTS: usize = integer("interface_elements", (8, 400), 28,
        "Number of elements along each crack in the dislocation engine, before grading towards mouth, tips and kinks. By default 28; with more than four cracks, 132 shared by all of them, but at least 22 each.").optional();
    SPACE_CELLS: usize = integer("space_cells", (2, 16), 4,
        "Number of cells from the centre of a crack to each side of its inner block in the space engine; there are four times as many along the front. From 5 on, a crack that dips at less than 30 degrees has as many cells in total, but more rows down the dip and fewer columns.").optional();
    SPACE_RINGS: usize = integer("space_rings", (2, 16), 4,
        "Number of cells from the inner block to the front in the space engine.").optional();
    SPACE_SURFACE_ROWS: usize = integer("space_surface_rows", (0, 6), 0,
        "Further rows of cells next to the surface in the space engine, each half as wide as the next one below. They resolve K where the fronts meet the surface: K counts in growth outside 15 degrees of the front from the surface, and each row halves this layer. Only planar cracks that break the surface have them.").optional();
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
