//! Crack initiation by the criterion of Dang Van.

use crate::math::{Stress, Tensor, smallest_ball};

/// The criterion of crack initiation: no crack initiates where τ(t) + a p_h(t) ≤ b at all times of
/// the stabilised cycle.
///
/// Source: Dang Van, Griveau & Message 1989, EGF Publication 3, 479–496.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DangVan {
    /// a, the weight of the hydrostatic stress.
    pub slope: f64,
    /// b, MPa: the fatigue limit in pure shear.
    pub limit: f64,
}

/// The critical time of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DangVanValue {
    /// τ + a p_h, MPa.
    pub value: f64,
    /// Mesoscopic shear τ, MPa: half the difference of the extreme principal values of s − s*.
    pub shear: f64,
    /// Hydrostatic stress p_h, MPa, tension positive.
    pub hydrostatic: f64,
    /// Index of the stress in the path.
    pub time: usize,
}

impl DangVan {
    /// max over time of τ + a p_h on a cycle of stresses `path` (MPa, in any order, residual stress
    /// included); s* is the centre of the smallest ball (Frobenius norm) around the deviators. None
    /// for an empty path.
    pub fn value(&self, path: &[Stress]) -> Option<DangVanValue> {
        let deviators: Vec<[f64; 3]> = path.iter().map(|stress| stress.deviator()).collect();
        let hydrostatic = |time: usize| (path[time].xx + path[time].yy + path[time].zz) / 3.0;
        self.worst(&deviators, largest_shear, hydrostatic)
    }

    /// [`DangVan::value`] of stresses with six components.
    pub fn value_in_space(&self, path: &[Tensor]) -> Option<DangVanValue> {
        let deviators: Vec<[f64; 5]> = path.iter().map(|stress| stress.deviator()).collect();
        let shear = |deviator| Tensor::from_deviator(deviator).largest_shear();
        self.worst(&deviators, shear, |time| path[time].mean())
    }

    /// The worst time of a path of deviators, with the largest shear of a deviator and the
    /// hydrostatic stress by time.
    fn worst<const N: usize>(
        &self,
        deviators: &[[f64; N]],
        shear: impl Fn([f64; N]) -> f64,
        hydrostatic: impl Fn(usize) -> f64,
    ) -> Option<DangVanValue> {
        let centre = smallest_ball(deviators).centre;
        let at = |(time, deviator): (usize, &[f64; N])| {
            let shear = shear(std::array::from_fn(|c| deviator[c] - centre[c]));
            let hydrostatic = hydrostatic(time);
            DangVanValue { value: shear + self.slope * hydrostatic, shear, hydrostatic, time }
        };
        deviators
            .iter()
            .enumerate()
            .map(at)
            .reduce(|worst, here| if here.value > worst.value { here } else { worst })
    }

    /// b less `value`, MPa: negative where a crack initiates.
    pub fn margin(&self, value: f64) -> f64 {
        self.limit - value
    }
}

/// Half the difference of the extreme principal values of a deviator in the coordinates of
/// [`Stress::deviator`].
fn largest_shear([difference, out, shear]: [f64; 3]) -> f64 {
    let zz = (2.0 / 3.0_f64).sqrt() * out;
    let in_plane = difference.hypot(shear) / std::f64::consts::SQRT_2;
    let (high, low) = (-0.5 * zz + in_plane, -0.5 * zz - in_plane);
    0.5 * (high.max(zz) - low.min(zz))
}

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
        Self::of(paths.into_iter().filter_map(value).collect())
    }

    /// The values at depths that increase from the surface. None without a value.
    pub fn of(by_depth: Vec<DepthValue>) -> Option<Self> {
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

    const CRITERION: DangVan = DangVan { slope: 0.3, limit: 250.0 };
    /// Round-off.
    const ROUNDING: f64 = 1e-10;

    /// Fully reversed tension ±S: s* = 0, τ = S/2, p_h = S/3 at the tensile end.
    #[test]
    fn reversed_tension() {
        let path = [300.0, 0.0, -300.0].map(|yy| Stress { yy, ..Stress::ZERO });
        let worst = CRITERION.value(&path).unwrap();
        assert!((worst.value - (150.0 + 0.3 * 100.0)).abs() < ROUNDING, "{worst:?}");
        assert_eq!(worst.time, 0);
    }

    /// Repeated tension 0 to S: the ball is centred at half of it, τ = S/4, p_h = S/3; the same for
    /// out-of-plane tension.
    #[test]
    fn repeated_tension() {
        for path in [
            [0.0, 400.0].map(|xx| Stress { xx, ..Stress::ZERO }),
            [0.0, 400.0].map(|zz| Stress { zz, ..Stress::ZERO }),
        ] {
            let worst = CRITERION.value(&path).unwrap();
            assert!((worst.value - (100.0 + 0.3 * 400.0 / 3.0)).abs() < ROUNDING, "{worst:?}");
            assert_eq!(worst.time, 1);
        }
    }

    /// Reversed shear ±T under a constant pressure P: τ = T for any constant shear, less a P.
    #[test]
    fn reversed_shear_under_pressure() {
        let path = [-150.0, 150.0].map(|xy| Stress { xx: -90.0, yy: -90.0, zz: -90.0, xy: xy + 35.0 });
        let worst = CRITERION.value(&path).unwrap();
        assert!((worst.value - (150.0 - 0.3 * 90.0)).abs() < ROUNDING, "{worst:?}");
        assert!((CRITERION.margin(worst.value) - 127.0).abs() < ROUNDING);
    }

    #[test]
    fn an_empty_path_has_no_value() {
        assert_eq!(CRITERION.value(&[]), None);
    }

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
