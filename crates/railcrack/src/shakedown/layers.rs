//! Layers of the rail in depth.

/// Layers of the rail from the surface down, each with one plastic strain at every abscissa.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    /// Depths of the interfaces, mm: 0 first.
    interfaces: Vec<f64>,
}

/// Thickness of a layer over that of the layer above, below the even layers, where there is no
/// plastic flow.
const GROWTH: f64 = 1.2;
/// Thickness of a layer over that of the layer above at the surface, …
const SURFACE_GROWTH: f64 = 2.0;
/// … where the first layer has the even thickness over two to this power. Under friction the stress
/// at the edges of the contact varies with the square root of the depth.
const SURFACE_LAYERS: i32 = 5;

impl Layers {
    /// Layers of `thickness` (mm) down to `fine_depth` (mm), thinner ones at the surface, and
    /// increasingly thick ones from there to `depth` (mm).
    pub(super) fn graded(thickness: f64, fine_depth: f64, depth: f64) -> Self {
        let mut interfaces = vec![0.0];
        // 2⁻⁵, 2⁻⁵, 2⁻⁴, …, 2⁻¹ of the thickness make up one layer.
        let surface = (0..SURFACE_LAYERS).rev().map(|i| thickness * SURFACE_GROWTH.powi(-i - 1));
        interfaces.extend(surface);
        let (mut bottom, mut next, mut count) = (0.0, thickness, 0.0);
        while bottom < depth {
            count += 1.0;
            bottom = if bottom < fine_depth {
                count * thickness
            } else {
                next *= GROWTH;
                bottom + next
            };
            interfaces.push(bottom);
        }
        Self { interfaces }
    }

    /// Number of layers.
    pub(crate) fn count(&self) -> usize {
        self.interfaces.len() - 1
    }

    /// Depth of the upper face of layer `i`, mm.
    pub(crate) fn top(&self, i: usize) -> f64 {
        self.interfaces[i]
    }

    /// Thickness of layer `i`, mm.
    pub(crate) fn thickness(&self, i: usize) -> f64 {
        self.interfaces[i + 1] - self.interfaces[i]
    }

    /// Depths of the midplanes of the layers, mm.
    pub(crate) fn middles(&self) -> Vec<f64> {
        self.interfaces.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect()
    }

    /// Depths of the interfaces, mm, the surface first.
    pub fn interfaces(&self) -> &[f64] {
        &self.interfaces
    }
}
