//! `[mesh]`: discretisation of rail and crack faces.

use crate::schema::{SectionValues, integer, number, positive, section};
use railcrack::space::SpaceResolution;

section! {
    MESH "mesh", Defaulted, "Discretisation.";
    ELEMENT_SIZE: f64 = number("element_size_mm", "mm", positive(100.0), 0.1,
        "Element size at the cracks in the finite-element engine; without it, at each crack a sixtieth of the longest one \
         (a thirtieth at a straight crack of more than three), or a thirtieth of the crack or a seventh of the segment at \
         its tip if that is less. Without effect on the dislocation engine.").optional();
    TIP_ENRICHMENT_RADIUS: f64 = number("tip_enrichment_radius_mm", "mm", positive(100.0), 0.5,
        "Radius around a tip within which nodes carry the square-root functions of the crack tip; without it, two and a \
         half elements.").optional();
    INTERFACE_SPACING: f64 = number("interface_spacing_mm", "mm", positive(100.0), 0.2,
        "Largest distance between face points in the finite-element engine, at least 0.3 of the element size; without \
         it, the length of crack in an element.").optional();
    INTERFACE_ELEMENTS: usize = integer("interface_elements", (8, 400), 28,
        "Elements along each crack in the dislocation engine, before its grading towards mouth, tips and kinks; without \
         it 28, and 132 shared by all cracks, but at least 22 each, where there are more than four.").optional();
    SPACE_CELLS: usize = integer("space_cells", (2, 16), 4,
        "Cells from the middle of the crack to each side of its inner block, in the engine space; along the front are four \
         times as many.").optional();
    SPACE_RINGS: usize = integer("space_rings", (2, 16), 4,
        "Cells from the inner block to the front, in the engine space.").optional();
}

/// Discretisation; without a value, each engine chooses it from the cracks.
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
    /// Cells of a crack in space.
    pub space: SpaceResolution,
}

impl MeshSettings {
    pub(crate) fn read(section: &SectionValues) -> Self {
        Self {
            element_size: section.get(ELEMENT_SIZE),
            tip_enrichment_radius: section.get(TIP_ENRICHMENT_RADIUS),
            interface_spacing: section.get(INTERFACE_SPACING),
            interface_elements: section.get(INTERFACE_ELEMENTS),
            space: SpaceResolution {
                block: section.get(SPACE_CELLS).unwrap_or(SpaceResolution::default().block),
                ring: section.get(SPACE_RINGS).unwrap_or(SpaceResolution::default().ring),
            },
        }
    }
}
