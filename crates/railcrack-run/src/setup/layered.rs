//! Balanced stress that rolling has left: by depth in the plane of the cracks, and across the rail.

use railcrack::field::StressField;
use railcrack::math::{Stress, Tensor, Vec2};
use railcrack::space::{StandingStress, Symmetric};

/// A stress that does not vary along the rail: linear between depths, constant above the first one,
/// and down to zero at twice the last one.
#[derive(Debug, Clone, PartialEq)]
pub struct LayeredStress {
    /// Depth (mm), increasing, and stress (MPa).
    rows: Vec<(f64, Stress)>,
}

impl LayeredStress {
    /// The stress with these depths (mm), increasing and positive, and values (MPa).
    #[must_use]
    pub fn new(mut rows: Vec<(f64, Stress)>) -> Self {
        if let Some(&(deepest, _)) = rows.last() {
            rows.push((2.0 * deepest, Stress::ZERO));
        }
        Self { rows }
    }

    /// Its depths, increasing, mm.
    pub fn depths(&self) -> impl Iterator<Item = f64> + '_ {
        self.rows.iter().map(|row| row.0)
    }
}

impl StressField for LayeredStress {
    fn stress(&self, point: Vec2) -> Stress {
        let depth = -point.y;
        let next = self.rows.partition_point(|row| row.0 < depth);
        match (next.checked_sub(1).map(|above| self.rows[above]), self.rows.get(next)) {
            (Some((from, above)), Some(&(to, below))) => {
                let t = (depth - from) / (to - from);
                above * (1.0 - t) + below * t
            }
            (None, Some(&(_, first))) => first,
            _ => Stress::ZERO,
        }
    }
}

/// A stress that does not vary along the rail, on rows and layers: linear between them, constant
/// above the first layer, down to zero at twice the last depth and at a period beside the rows.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionStress {
    /// Lateral places of the rows, increasing, mm.
    laterals: Vec<f64>,
    /// Depths of the layers, increasing, mm.
    depths: Vec<f64>,
    /// Layer l of row m at m · layers + l, MPa: x along the rail, y across it, z down.
    stress: Vec<Tensor>,
}

impl SectionStress {
    /// The stress (MPa) of places, lateral and depth (mm), ordered by lateral place, then by depth;
    /// none where they are not rows of the same layers.
    #[must_use]
    pub fn new(places: &[(f64, f64, Tensor)]) -> Option<Self> {
        let first = places.first()?.0;
        let count = places.iter().take_while(|place| place.0 == first).count();
        let rows = places.chunks(count);
        let depths: Vec<f64> = places[..count].iter().map(|place| place.1).collect();
        let is_even = rows.clone().all(|row| row.iter().map(|place| place.1).eq(depths.iter().copied()));
        is_even.then(|| Self {
            laterals: rows.map(|row| row[0].0).collect(),
            depths,
            stress: places.iter().map(|place| place.2).collect(),
        })
    }

    /// Its depths, increasing, mm.
    pub fn depths(&self) -> impl Iterator<Item = f64> + '_ {
        self.depths.iter().copied()
    }

    /// The stress (MPa) at a lateral place and depth (mm).
    #[must_use]
    pub fn at(&self, lateral: f64, depth: f64) -> Tensor {
        let (Some(&first), Some(&last)) = (self.laterals.first(), self.laterals.last()) else {
            return Tensor::ZERO;
        };
        let beside = (first - lateral).max(lateral - last).max(0.0);
        let kept = if last > first { (1.0 - beside / (last - first)).max(0.0) } else { 1.0 };
        let deepest = self.depths.last().copied().unwrap_or(0.0);
        let below = if deepest > 0.0 { (2.0 - depth / deepest).clamp(0.0, 1.0) } else { 1.0 };
        let (m, across) = place(&self.laterals, lateral);
        let (l, down) = place(&self.depths, depth);
        let count = self.depths.len();
        let last = [self.laterals.len() - 1, count - 1];
        let of = |m: usize, l: usize| self.stress[m.min(last[0]) * count + l.min(last[1])];
        let layer = |l: usize| of(m, l) * (1.0 - across) + of(m + 1, l) * across;
        (layer(l) * (1.0 - down) + layer(l + 1) * down) * (kept * below)
    }
}

impl StandingStress for SectionStress {
    fn stress(&self, [_, lateral, depth]: [f64; 3]) -> Symmetric {
        self.at(lateral, depth).entries()
    }
}

/// The interval of `ends` in which `value` lies, and its share of it; the nearest end outside.
fn place(ends: &[f64], value: f64) -> (usize, f64) {
    let next = ends.partition_point(|end| *end < value).clamp(1, ends.len().max(2) - 1);
    match (ends.get(next - 1), ends.get(next)) {
        (Some(from), Some(to)) => (next - 1, ((value - from) / (to - from)).clamp(0.0, 1.0)),
        _ => (0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_above_and_below_its_depths() {
        let at = |xx: f64| Stress { xx, ..Stress::ZERO };
        let field = LayeredStress::new(vec![(1.0, at(-10.0)), (3.0, at(30.0))]);
        for (depth, want) in [(0.0, -10.0), (1.0, -10.0), (2.0, 10.0), (3.0, 30.0), (4.5, 15.0), (7.0, 0.0)] {
            let got = field.stress(Vec2::new(5.0, -depth));
            assert!((got.xx - want).abs() < 1e-12, "{depth}: {got:?}"); // round-off
        }
        assert_eq!(LayeredStress::new(Vec::new()).stress(Vec2::new(0.0, -1.0)), Stress::ZERO);
    }

    #[test]
    fn between_and_beside_rows() {
        let at = |lateral: f64, depth: f64, xx: f64| (lateral, depth, Tensor { xx, ..Tensor::ZERO });
        let places = [at(-1.0, 1.0, 0.0), at(-1.0, 2.0, 10.0), at(1.0, 1.0, 20.0), at(1.0, 2.0, 30.0)];
        let section = SectionStress::new(&places).unwrap();
        for (lateral, depth, want) in [
            (-1.0, 1.0, 0.0),
            (0.0, 1.5, 15.0),
            (1.0, 0.0, 20.0),
            (2.0, 2.0, 15.0),
            (1.0, 3.0, 15.0),
            (9.0, 1.0, 0.0),
        ] {
            let got = section.at(lateral, depth).xx;
            assert!((got - want).abs() < 1e-12, "{lateral} {depth}: {got}"); // round-off
        }
        assert_eq!(SectionStress::new(&places[..3]), None);
        assert_eq!(SectionStress::new(&[]), None);
    }
}
