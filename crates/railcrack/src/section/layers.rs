//! Head, web and foot as layers.

use crate::linear::general_inverse;
use crate::load::NamedSection;
use crate::math::{Matrix, OutOfRange};

/// A part of the section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Height, mm.
    pub height: f64,
    /// Width across the rail, mm.
    pub width: f64,
}

/// A rail as layers from the running surface down to the foot.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionLayers {
    /// The head, which contains the cracks.
    pub head: Layer,
    /// The parts below the head, from its bottom downwards; none for a strip.
    pub below: Vec<Layer>,
}

/// Changes of the heights and widths (mm) at which the search for a section ends.
const FOUND: f64 = 1e-10;
/// Newton steps of that search; named sections need six.
const MOST_STEPS: usize = 40;

impl SectionLayers {
    /// A strip: a plate of one width.
    pub fn strip(height: f64) -> Self {
        Self { head: Layer { height, width: 1.0 }, below: Vec::new() }
    }

    /// Three rectangles with the height, the widths of head and foot, the area, the neutral axis
    /// and the second moment of `section`; free are the heights of head and foot and the width of
    /// the web. None where there are no such rectangles.
    pub fn of(section: &NamedSection) -> Option<Self> {
        let NamedSection { height, head_width, foot_width, .. } = *section;
        let wanted = [1e2 * section.area_cm2, section.neutral_axis_depth, 1e4 * section.second_moment_cm4];
        let rectangles = |[head, web, foot]: [f64; 3]| {
            let below = vec![
                Layer { height: height - head - foot, width: web },
                Layer { height: foot, width: foot_width },
            ];
            Self { head: Layer { height: head, width: head_width }, below }
        };
        let misses = |of: [f64; 3]| {
            let found = rectangles(of).constants();
            [0, 1, 2].map(|i| found[i] / wanted[i] - 1.0)
        };
        let mut of = [0.25 * height, 0.12 * foot_width, 0.12 * height];
        for _ in 0..MOST_STEPS {
            let miss = misses(of);
            let slope = |i: usize, j: usize| {
                let at = |by: f64| {
                    let mut moved = of;
                    moved[j] += by;
                    misses(moved)[i]
                };
                (at(SLOPE_STEP) - at(-SLOPE_STEP)) / (2.0 * SLOPE_STEP)
            };
            let step = general_inverse(&Matrix::from_fn(3, 3, slope)).ok()?.times(&miss);
            of.iter_mut().zip(&step).for_each(|(value, step)| *value -= step);
            if step.iter().all(|step| step.abs() < FOUND) {
                let layers = rectangles(of);
                return layers.check().is_ok().then_some(layers);
            }
        }
        None
    }

    /// Rejects layers without height or width.
    pub fn check(&self) -> Result<(), OutOfRange> {
        for layer in std::iter::once(&self.head).chain(&self.below) {
            OutOfRange::unless_positive("height of a layer (mm)", layer.height)?;
            OutOfRange::unless_positive("width of a layer (mm)", layer.width)?;
        }
        Ok(())
    }

    /// Area (mm²), depth of the neutral axis (mm) and second moment of area (mm⁴).
    #[must_use]
    pub fn constants(&self) -> [f64; 3] {
        let (mut top, mut area, mut first, mut second) = (0.0f64, 0.0, 0.0, 0.0);
        for Layer { height, width } in std::iter::once(&self.head).chain(&self.below) {
            let bottom = top + height;
            area += width * height;
            first += 0.5 * width * (bottom.powi(2) - top.powi(2));
            second += width * (bottom.powi(3) - top.powi(3)) / 3.0;
            top = bottom;
        }
        [area, first / area, second - first * first / area]
    }

    /// H, mm.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.head.height + self.below.iter().map(|layer| layer.height).sum::<f64>()
    }
}

/// Step (mm) of the slopes in the search.
const SLOPE_STEP: f64 = 1e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::SECTIONS;

    #[test]
    fn rectangles_have_the_constants_of_their_rails() {
        for section in SECTIONS {
            let layers = SectionLayers::of(section).unwrap();
            let [area, neutral, second] = layers.constants();
            assert!((area - 100.0 * section.area_cm2).abs() < 1e-6, "{}: {area}", section.name);
            assert!((neutral - section.neutral_axis_depth).abs() < 1e-9, "{}: {neutral}", section.name);
            assert!((second / section.second_moment_cm4 - 1e4).abs() < 1e-6, "{}: {second}", section.name);
            assert!((layers.height() - section.height).abs() < 1e-9);
            // Heads of these rails are 37 to 52 mm high at their side and middle; webs are 14 to
            // 16.5 mm thick, and fillets add to them.
            assert!((30.0..45.0).contains(&layers.head.height), "{}: {layers:?}", section.name);
            assert!((14.0..26.0).contains(&layers.below[0].width), "{}: {layers:?}", section.name);
        }
    }

    #[test]
    fn a_strip_has_the_constants_of_a_rectangle() {
        let [area, neutral, second] = SectionLayers::strip(12.0).constants();
        assert!((area - 12.0).abs() < 1e-12 && (neutral - 6.0).abs() < 1e-12);
        assert!((second - 144.0).abs() < 1e-10);
    }

    #[test]
    fn layers_without_extent_are_refused() {
        let flat = SectionLayers::strip(0.0).check().unwrap_err().to_string();
        assert!(flat.contains("height of a layer (mm) = 0"), "{flat}");
    }
}
