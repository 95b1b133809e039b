//! Quantities of the runs that statements are decided by.

use crate::case_run::{CaseRun, CrackGrowth, SifCurve};

impl CrackGrowth {
    /// ΔK_I of the initial crack, MPa√m.
    pub fn delta_ki(&self) -> f64 {
        self.steps[0].delta_ki
    }

    /// ΔK_II of the initial crack, MPa√m.
    pub fn delta_kii(&self) -> f64 {
        self.steps[0].delta_kii
    }

    /// ΔK_eq of the initial crack, MPa√m.
    pub fn delta_keq(&self) -> f64 {
        self.steps[0].delta_keq
    }

    /// Load cycles until the crack is `length` mm long, linear between steps; none where it is
    /// never that long.
    pub fn cycles_to(&self, length: f64) -> Option<f64> {
        let pair = self.steps.windows(2).find(|pair| pair[1].length >= length)?;
        let share = (length - pair[0].length) / (pair[1].length - pair[0].length);
        Some(pair[0].load_cycles + share * (pair[1].load_cycles - pair[0].load_cycles))
    }
}

impl SifCurve {
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

    /// This K less `other`'s at the positions of this one that both have: (position, ΔK_I, ΔK_II).
    pub fn minus(&self, other: &Self) -> Vec<[f64; 3]> {
        let here = self.position.iter().zip(self.ki.iter().zip(&self.kii));
        here.filter_map(|(&x, (ki, kii))| other.at(x).map(|[i, ii]| [x, ki - i, kii - ii])).collect()
    }

    /// The largest difference of K_I or K_II to `other`, over the largest |K| of it.
    pub fn difference(&self, other: &Self) -> f64 {
        let largest = self.minus(other).iter().fold(0.0, |d: f64, [_, i, ii]| d.max(i.abs()).max(ii.abs()));
        largest / other.peak()
    }

    /// The largest change of K_II while the whole crack sticks, over the peak; none where it never
    /// does for two positions in a row.
    pub fn change_while_stuck(&self) -> Option<f64> {
        let stuck = (1..self.kii.len()).filter(|&i| self.sticks[i] && self.sticks[i - 1]);
        stuck.map(|i| (self.kii[i] - self.kii[i - 1]).abs() / self.peak()).reduce(f64::max)
    }
}

impl CaseRun {
    /// The only crack, or the first.
    pub fn crack(&self) -> &CrackGrowth {
        &self.cracks[0]
    }
}
