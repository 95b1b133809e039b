//! The depth of the rail, cut into layers.

/// Layers of the rail from the surface down, each with one plastic strain at every abscissa.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    /// Depths of the interfaces, mm: 0 first.
    interfaces: Vec<f64>,
}

/// Thickness of a layer over the one above, where they grow.
const GROWTH: f64 = 1.1;

impl Layers {
    /// Layers of `thickness` (mm) down to `fine_depth` (mm), growing below to `depth` (mm).
    pub(super) fn graded(thickness: f64, fine_depth: f64, depth: f64) -> Self {
        let mut interfaces = vec![0.0];
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
    pub fn count(&self) -> usize {
        self.interfaces.len() - 1
    }

    /// Depth of the upper face of layer `i`, mm.
    pub fn top(&self, i: usize) -> f64 {
        self.interfaces[i]
    }

    /// Thickness of layer `i`, mm.
    pub fn thickness(&self, i: usize) -> f64 {
        self.interfaces[i + 1] - self.interfaces[i]
    }

    /// Depths of the middles of the layers, mm.
    pub fn middles(&self) -> Vec<f64> {
        self.interfaces.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect()
    }

    /// Depth of the lower face of the last layer, mm.
    pub fn depth(&self) -> f64 {
        self.interfaces[self.interfaces.len() - 1]
    }
}
