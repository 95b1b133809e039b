//! Depth profile of the Dang Van criterion of crack initiation.

use super::{DangVan, DangVanValue};
use crate::math::Stress;

/// The criterion at one depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthValue {
    /// Depth, mm; 0 is the running surface.
    pub depth: f64,
    /// The critical time of the cycle at this depth.
    pub worst: DangVanValue,
}

/// The criterion over depth, and its maxima.
#[derive(Debug, Clone, PartialEq)]
pub struct Initiation {
    /// The values from the surface down.
    pub by_depth: Vec<DepthValue>,
    /// The value at the surface, the first depth.
    pub surface: DepthValue,
    /// The largest maximum below the surface; none where the value decreases all the way down.
    pub subsurface: Option<DepthValue>,
}

impl Initiation {
    /// `criterion` at depths (mm, increasing, the surface first), each with the stress path of its
    /// cycle (MPa). None without a path.
    pub fn by_depth(
        criterion: &DangVan,
        paths: impl IntoIterator<Item = (f64, Vec<Stress>)>,
    ) -> Option<Self> {
        let value = |(depth, path): (f64, Vec<Stress>)| {
            criterion.value(&path).map(|worst| DepthValue { depth, worst })
        };
        let by_depth: Vec<DepthValue> = paths.into_iter().filter_map(value).collect();
        let surface = *by_depth.first()?;
        let rises =
            |w: &&[DepthValue]| w[1].worst.value > w[0].worst.value && w[1].worst.value >= w[2].worst.value;
        let subsurface = by_depth
            .windows(3)
            .filter(rises)
            .map(|w| w[1])
            .reduce(|best, here| if here.worst.value > best.worst.value { here } else { best });
        Some(Self { surface, subsurface, by_depth })
    }

    /// The larger of the two maxima, where a crack initiates first.
    pub fn critical(&self) -> DepthValue {
        match self.subsurface {
            Some(below) if below.worst.value > self.surface.worst.value => below,
            _ => self.surface,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maxima_apart() {
        // Reversed shear ±T has the value T.
        let depths =
            [(0.0, 90.0), (1.0, 80.0), (2.0, 85.0), (3.0, 95.0), (4.0, 70.0), (5.0, 75.0), (6.0, 0.0)];
        let paths =
            depths.map(|(depth, t)| (depth, [t, -t].map(|xy| Stress { xy, ..Stress::ZERO }).to_vec()));
        let criterion = DangVan { slope: 0.3, limit: 100.0 };
        let found = Initiation::by_depth(&criterion, paths.clone()).unwrap();
        assert_eq!(
            (found.surface.depth, found.subsurface.unwrap().depth, found.critical().depth),
            (0.0, 3.0, 3.0)
        );
        let falling = Initiation::by_depth(&criterion, paths.into_iter().take(2)).unwrap();
        assert_eq!((falling.subsurface, falling.critical().depth), (None, 0.0));
        assert_eq!(Initiation::by_depth(&criterion, []), None);
    }
}
