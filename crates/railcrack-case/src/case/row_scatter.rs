//! Scatter of the copies of a row of cracks.

use crate::normal;
use crate::schema::{KeyRow, Report, SectionValues};
use crate::tables::{
    ANGLE, ANGLE_SD, ANGLES, COUNT, LENGTH, LENGTH_SD, POINTS, ROW_SEED, SPACING, SPACING_SD,
};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// Number of standard deviations at which the distribution is truncated.
const CUT: f64 = 3.0;
/// The share of a normal distribution below minus [`CUT`].
const BELOW: f64 = 1.349_898_031_630_094_6e-3;
/// Shortest crack of a row, mm.
const SHORTEST: f64 = 1e-3;
/// Stream of the generator (O'Neill 2014): any odd constant.
const STREAM: u128 = 0x5851_f42d_4c95_7f2d_1405_7b7e_f767_814f;

/// Normal deviations of length, angle and spacing from copy to copy, cut at three standard
/// deviations.
pub(super) struct RowScatter {
    random: Pcg64,
    length: f64,
    angle: f64,
    spacing: f64,
}

/// Deviations of one copy from the values of its section.
pub(super) struct CopyDeviation {
    /// Deviation of its length, mm.
    pub length: f64,
    /// Deviation of its angle, degrees.
    pub angle: f64,
    /// Deviation of the distance to the next copy, mm.
    pub spacing: f64,
}

impl RowScatter {
    /// The scatter of the row of `section`, none where none is given; `None` after a fault in
    /// `report`.
    pub fn of(section: &SectionValues, report: &mut Report) -> Option<Option<Self>> {
        let deviations = [LENGTH_SD, ANGLE_SD, SPACING_SD];
        if deviations.iter().any(|row| section.is_refused(*row)) || section.is_refused(ROW_SEED) {
            return None;
        }
        let given = deviations.into_iter().find(|row| section.get(*row).is_some());
        let seed = section.get(ROW_SEED);
        let Some(key) = given.map(|row| row.key.name).or(seed.map(|_| ROW_SEED.key.name)) else {
            return Some(None);
        };
        let mut refuse = |name: &str, says: String, help: &str| {
            report.add(section.fault_of_name(name, says).help(help));
        };
        if section.get(COUNT)? == 1 {
            refuse(
                key,
                "applies to the copies of a row, but count is 1".into(),
                "a row is defined by count and spacing_mm",
            );
            return None;
        }
        if given.is_none() {
            let help = "length_sd_mm, angle_sd_deg and spacing_sd_mm define the scatter of the copies";
            refuse(key, "applies to a row with scatter, but no standard deviation is given".into(), help);
            return None;
        }
        for row in [LENGTH_SD, ANGLE_SD] {
            if section.get(row).is_some() && section.get(POINTS).is_some() {
                let help = "the copies of a polyline can have a spacing_sd_mm only";
                refuse(row.key.name, "applies to straight cracks".into(), help);
                return None;
            }
        }
        let mut sound = true;
        let mut scatter = |row: KeyRow<f64>, of: KeyRow<f64>, fits: &dyn Fn(f64) -> bool, within: &str| {
            let deviation = section.get(row).unwrap_or_default();
            let most = CUT * deviation;
            if let Some(mean) = section.get(of)
                && !(fits(mean - most) && fits(mean + most))
            {
                let says = format!("three standard deviations, {most}, lead from {mean} out of {within}");
                refuse(row.key.name, says, "copies are drawn up to three standard deviations from the mean");
                sound = false;
            }
            deviation
        };
        let length = scatter(LENGTH_SD, LENGTH, &|x| x >= SHORTEST, "the possible lengths of a crack");
        let angle = scatter(ANGLE_SD, ANGLE, &|x| ANGLES.contains(x), "the angles that the engines resolve");
        let spacing = scatter(SPACING_SD, SPACING, &|x| x > 0.0, "the possible distances between copies");
        let random = Pcg64::new(seed.unwrap_or(1) as u128, STREAM);
        // Without any deviation the copies are those of a row without scatter.
        let scatters = [length, angle, spacing] != [0.0; 3];
        sound.then_some(scatters.then_some(Self { random, length, angle, spacing }))
    }

    /// The deviations of the next copy. Each takes its own numbers, so that one deviation has no
    /// effect on what is drawn for another.
    pub fn draw(&mut self) -> CopyDeviation {
        let [length, angle, spacing] = [(); 3].map(|()| self.cut_normal());
        CopyDeviation {
            length: self.length * length,
            angle: self.angle * angle,
            spacing: self.spacing * spacing,
        }
    }

    /// A standard normal number between -[`CUT`] and [`CUT`].
    fn cut_normal(&mut self) -> f64 {
        let share = ((self.random.next_u64() >> 12) as f64 + 0.5) / (1u64 << 52) as f64;
        normal::quantile(BELOW + (1.0 - 2.0 * BELOW) * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_normal_and_cut() {
        let mut scatter = RowScatter { random: Pcg64::new(1, STREAM), length: 0.5, angle: 2.0, spacing: 0.0 };
        let drawn: Vec<CopyDeviation> = (0..20_000).map(|_| scatter.draw()).collect();
        let (mut lengths, mut mixed) = ((0.0, 0.0), 0.0);
        for one in &drawn {
            assert!(one.length.abs() <= 1.5 && one.angle.abs() <= 6.0 && one.spacing == 0.0);
            lengths = (lengths.0 + one.length, lengths.1 + one.length * one.length);
            mixed += one.length * one.angle;
        }
        let count = drawn.len() as f64;
        // For a normal distribution truncated at three deviations, variance 0.9733.
        let deviation = (lengths.1 / count).sqrt();
        assert!((lengths.0 / count).abs() < 0.015 && (deviation - 0.4933).abs() < 0.01, "{deviation}");
        assert!((mixed / count).abs() < 0.03, "lengths and angles are drawn on their own");
    }
}
