//! Resolution settings of the enrichment and of the crack faces.

/// Resolution around the tips and along the faces. Numbers without unit count elements at the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct XfemSettings {
    /// Nodes within it carry √r functions.
    pub enrichment: EnrichmentRadius,
    /// The weight of the domain of integration of the SIFs is 1 up to here.
    pub domain_inner: f64,
    /// It falls to 0 here.
    pub domain_outer: f64,
    /// Distance between face points away from mouth, tip and kinks, mm; the length of crack in an
    /// element if not given.
    pub interface_spacing: Option<f64>,
}

/// Radius of the √r functions around a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EnrichmentRadius {
    /// In elements at the tip.
    Elements(f64),
    /// In mm.
    Fixed(f64),
}

impl Default for XfemSettings {
    fn default() -> Self {
        Self {
            enrichment: EnrichmentRadius::Elements(2.5),
            domain_inner: 1.5,
            domain_outer: 4.5,
            interface_spacing: None,
        }
    }
}
