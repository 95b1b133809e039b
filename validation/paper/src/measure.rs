//! Quantities of a crack that statements are decided by.

use crate::case_run::{CrackGrowth, SifCurve};
use crate::path_shape::PathShape;
use serde::Deserialize;

/// Crack length, mm, up to which cycles are compared.
const GROWN_TO: f64 = 7.0;

/// A number of one crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// ΔK_I of the initial crack, MPa√m.
    DeltaKi,
    /// ΔK_II of the initial crack, MPa√m.
    DeltaKii,
    /// ΔK_eq of the initial crack, MPa√m.
    DeltaKeq,
    /// The largest K_I, at least 0, MPa√m.
    LargestKi,
    /// The wheel position of the largest K_I, over a.
    PositionOfLargestKi,
    /// The largest change of K_II while the whole crack sticks, in per cent of the peak of K.
    ChangeWhileStuck,
    /// The first kink, degrees.
    FirstKink,
    /// The secondary maximum of the direction criterion in the first increment, degrees.
    SecondKink,
    /// Its ratio to the main maximum.
    SecondRatio,
    /// Load cycles to a length of 7 mm.
    #[serde(rename = "cycles-to-7-mm")]
    CyclesTo7mm,
    /// ΔK_eq in the last step over that in the first.
    KeqAtLast,
    /// The increment in which the path branches; one more than there are where it does not.
    Branch,
    /// Depth of the end of the path, mm.
    Depth,
    /// Inclination of the path below the surface from its branch to its end, degrees; of the whole
    /// growth where it does not branch.
    Inclination,
}

impl Measure {
    /// Whether it needs a crack that grows.
    pub fn needs_growth(self) -> bool {
        use Measure::{
            Branch, CyclesTo7mm, Depth, FirstKink, Inclination, KeqAtLast, SecondKink, SecondRatio,
        };
        matches!(
            self,
            FirstKink | SecondKink | SecondRatio | CyclesTo7mm | KeqAtLast | Branch | Depth | Inclination
        )
    }

    /// Its value for `crack`; none where the crack has none.
    pub fn value(self, crack: &CrackGrowth) -> Option<f64> {
        let first = crack.steps.first()?;
        let sif = &crack.sif;
        let path = || PathShape::new(crack);
        match self {
            Self::DeltaKi => Some(first.delta_ki),
            Self::DeltaKii => Some(first.delta_kii),
            Self::DeltaKeq => Some(first.delta_keq),
            Self::LargestKi => Some(sif.largest_ki()),
            Self::PositionOfLargestKi => {
                let top = (0..sif.ki.len()).max_by(|&i, &j| sif.ki[i].total_cmp(&sif.ki[j]))?;
                Some(sif.position[top])
            }
            Self::ChangeWhileStuck => Some(100.0 * sif.change_while_stuck()?),
            Self::FirstKink => first.kink_deg,
            Self::SecondKink => first.rival_deg,
            Self::SecondRatio => first.rival_ratio,
            Self::CyclesTo7mm => crack.cycles_to(GROWN_TO),
            Self::KeqAtLast => Some(crack.steps.last()?.delta_keq / first.delta_keq),
            Self::Branch => Some(path().branch_increment() as f64),
            Self::Depth => Some(path().depth),
            Self::Inclination => path().inclination_after.or(path().inclination),
        }
    }
}

impl CrackGrowth {
    /// Load cycles until the crack is `length` mm long, linear between steps; none where it is
    /// never that long.
    fn cycles_to(&self, length: f64) -> Option<f64> {
        let pair = self.steps.windows(2).find(|pair| pair[1].length >= length)?;
        let share = (length - pair[0].length) / (pair[1].length - pair[0].length);
        Some(pair[0].load_cycles + share * (pair[1].load_cycles - pair[0].load_cycles))
    }
}

impl SifCurve {
    /// The largest K_I, at least 0, MPa√m.
    pub fn largest_ki(&self) -> f64 {
        self.ki.iter().copied().fold(0.0, f64::max)
    }

    /// The largest |K_I| or |K_II|, MPa√m.
    pub fn peak(&self) -> f64 {
        self.ki.iter().chain(&self.kii).fold(0.0, |peak: f64, k| peak.max(k.abs()))
    }

    /// K_I and K_II at `position`, linear in between; none beyond the ends.
    pub fn at(&self, position: f64) -> Option<[f64; 2]> {
        let i = self.position.windows(2).position(|pair| pair[0] <= position && position <= pair[1])?;
        let share = (position - self.position[i]) / (self.position[i + 1] - self.position[i]);
        Some([&self.ki, &self.kii].map(|k| k[i] + share * (k[i + 1] - k[i])))
    }

    /// This K less that of `other` at the positions of this one that both have: (position, ΔK_I,
    /// ΔK_II).
    pub fn minus(&self, other: &Self) -> Vec<[f64; 3]> {
        let here = self.position.iter().zip(self.ki.iter().zip(&self.kii));
        here.filter_map(|(&x, (ki, kii))| other.at(x).map(|[i, ii]| [x, ki - i, kii - ii])).collect()
    }

    /// The largest difference of K_I or K_II from `other`, over the largest |K| of it.
    pub fn difference(&self, other: &Self) -> f64 {
        let largest = self.minus(other).iter().fold(0.0, |d: f64, [_, i, ii]| d.max(i.abs()).max(ii.abs()));
        largest / other.peak()
    }

    /// The largest change of K_II while the whole crack sticks, over the peak; none where it never
    /// does at two successive positions.
    fn change_while_stuck(&self) -> Option<f64> {
        let stuck = (1..self.kii.len()).filter(|&i| self.sticks[i] && self.sticks[i - 1]);
        stuck.map(|i| (self.kii[i] - self.kii[i - 1]).abs() / self.peak()).reduce(f64::max)
    }
}
