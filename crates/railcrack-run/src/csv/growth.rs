//! `growth.csv`: every tip at every step.

use super::table;
use railcrack::growth::{Axles, Jump, RunStop, StepRecord, TipRecord, WheelShares};
use railcrack::math::MPA_SQRT_MM;
use railcrack::words::Choice;
use serde::{Deserialize, Serialize};

table! {
    /// A tip at the start of a growth step, and its increment, in the units of `growth.csv`.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct TipRow in "growth.csv", [
        "One row per step and tip: the state at the start of the step, and the increment that follows it",
        "step: 0 is the initial geometry; crack: from 1; tip: from 1 within its crack",
        "lengths and coordinates: mm, y upwards, the rail is y <= 0; length_mm: of the whole crack, including deferred growth at its tips",
        "K: MPa sqrt(m), ranges over the stabilised passage, K_I clipped at zero; in a mix the largest K_I of all wheels and the ranges of the wheel that contributes most to the growth",
        "angles: degrees from straight ahead, counter-clockwise positive; empty: an unloaded tip, or no rival direction",
        "rival_ratio: growth rate in the rival direction over the chosen one",
        "load_cycles: axles up to the start of the step, by the trapezoidal rule in 1/rate of the fastest tip; stop: why the tip, or in the last step the run, stopped",
        "increments of a slow tip are deferred and then applied together; until then the tip does not move",
    ] {
        /// Step, crack and tip.
        step: usize = "step";
        /// Step, crack and tip.
        crack: usize = "crack";
        /// Step, crack and tip.
        tip: usize = "tip";
        /// Position of the tip, mm.
        place: [f64; 2] = "tip_x_mm" "tip_y_mm";
        /// Length of the whole crack along its path, mm, with the deferred growth at its tips.
        length: f64 = "length_mm";
        /// Largest K_I of the stabilised passage, MPa√m.
        ki_max: f64 = "ki_max_mpa_sqrt_m";
        /// Range of K_I, clipped at zero, MPa√m.
        delta_ki: f64 = "delta_ki_mpa_sqrt_m";
        /// Range of K_II, MPa√m.
        delta_kii: f64 = "delta_kii_mpa_sqrt_m";
        /// ΔK_eq of the actual tip, MPa√m: ΔK_I alone where its shear adds nothing to the rate.
        delta_keq: f64 = "delta_keq_mpa_sqrt_m";
        /// Chosen kink angle, degrees; empty for a tip that is not loaded.
        kink_deg: Option<f64> = "kink_angle_deg";
        /// Secondary maximum of the direction criterion: the best other local maximum at least 15°
        /// away, degrees; empty if there is none.
        rival_deg: Option<f64> = "rival_angle_deg";
        /// Growth rate at the secondary maximum over that at the chosen angle; empty with it.
        rival_ratio: Option<f64> = "rival_ratio";
        /// Growth to the next step, mm; 0 in the last step and for a stopped tip. At coalescence
        /// the increment ends on the other crack, and is negative if that crack lies across the
        /// deferred growth.
        increment: f64 = "increment_mm";
        /// Rate da/dN, mm per load cycle.
        rate: f64 = "rate_mm_per_cycle";
        /// Load cycles up to the start of the step: each increment of the fastest tip takes Δa/2
        /// (1/r_start + 1/r_end).
        load_cycles: f64 = "load_cycles";
        /// Why the tip stopped; in the last step, for tips without a reason of their own, why the
        /// run ended; else empty.
        stop: Option<RunStop> = "stop";
        /// Depth of the tip below the running surface, mm, with its deferred growth. With
        /// `[traffic]`, or a mix of wheels with axle loads.
        depth: Option<f64> = "depth_mm", with "traffic";
        /// Million gross tonnes up to the start of the step. With `[traffic]`, or a mix of wheels
        /// with axle loads.
        mgt: Option<f64> = "mgt", with "traffic";
        /// Share of each wheel of a mix in the growth rate of the tip.
        shares: WheelShares = "share_wheel_1" "share_wheel_2" "share_wheel_3" "share_wheel_4" "share_wheel_5"
            "share_wheel_6" "share_wheel_7" "share_wheel_8" "share_wheel_9" "share_wheel_10" "share_wheel_11"
            "share_wheel_12" "share_wheel_13" "share_wheel_14" "share_wheel_15" "share_wheel_16" "share_wheel_17"
            "share_wheel_18" "share_wheel_19" "share_wheel_20"
            "share_wheel_21" "share_wheel_22" "share_wheel_23" "share_wheel_24" "share_wheel_25"
            "share_wheel_26" "share_wheel_27" "share_wheel_28" "share_wheel_29" "share_wheel_30"
            "share_wheel_31" "share_wheel_32", with "wheel";
        /// Depth removed from the running surface by wear and grinding up to the start of the step,
        /// mm: coordinates and depths are measured from the remaining surface. With
        /// `[maintenance]`.
        removed: Option<f64> = "removed_mm", with "maintenance";
        /// Parametric angle of a front point in space, degrees: 0 and 180 at the surface, 90
        /// deepest; on the sides of the strip of a folded crack −90 at the mouth to 0 at the fold,
        /// and 180 to 270.
        phi_deg: Option<f64> = "phi_deg", with "space";
        /// Lateral position of a front point in space, mm.
        lateral: Option<f64> = "tip_z_mm", with "space";
        /// Semi-axis of the crack in space along the surface, mm; `length_mm` is the one down the
        /// dip, of a crack that turns or has a fold the length down its middle.
        half_length: Option<f64> = "surface_half_length_mm", with "space";
        /// Range of K_III of a front point in space, MPa√m.
        delta_kiii: Option<f64> = "delta_kiii_mpa_sqrt_m", with "space";
        /// Distance of a front point in space from the mouth down the crack, mm.
        down: Option<f64> = "down_mm", with "space";
        /// Kink that the direction criterion would choose by K_I and K_II at a front point in
        /// space, degrees.
        wanted_kink_deg: Option<f64> = "wanted_kink_deg", with "space";
        /// Growth rate of that kink over that straight ahead, both without mode III.
        wanted_ratio: Option<f64> = "wanted_ratio", with "space";
        /// Ratio of the increment of a front point to the one that its own rate would give, 1 where
        /// the front follows the local rates; empty without growth and in the surface layer,
        /// which is not considered.
        followed: Option<f64> = "followed", with "space";
        /// Turn of the path from this tip to the next, degrees; in space that of the crack down its
        /// middle, empty with `surface = "plane"`.
        turn_deg: Option<f64> = "turn_deg";
        /// Why the path kinks here instead of turning smoothly; else empty.
        jump: Option<Jump> = "jump";
        /// Estimated error of `load_cycles` by the increments.
        cycles_error: f64 = "load_cycles_error";
    }
}

impl TipRow {
    /// The rows of a step, tip by tip; `axle_load` (t) gives million gross tonnes.
    pub fn of_step(record: &StepRecord, axle_load: Option<f64>) -> impl Iterator<Item = Self> {
        record.tips.iter().map(move |tip| Self {
            stop: tip.stop.map(RunStop::NoTipGrows).or(record.stop),
            mgt: axle_load.map(|tonnes| Axles(record.load_cycles).mgt(tonnes).0),
            removed: Some(record.removed),
            cycles_error: record.cycles_error,
            ..Self::of_tip(record.step, record.load_cycles, tip)
        })
    }

    /// The row of `tip` in a growth step that begins after `load_cycles`.
    pub fn of_tip(step: usize, load_cycles: f64, tip: &TipRecord) -> Self {
        Self {
            step,
            crack: tip.tip.crack + 1,
            tip: tip.tip.tip + 1,
            place: [tip.x, tip.y],
            length: tip.length,
            ki_max: tip.ki_max / MPA_SQRT_MM,
            delta_ki: tip.delta_ki / MPA_SQRT_MM,
            delta_kii: tip.delta_kii / MPA_SQRT_MM,
            delta_keq: tip.delta_keq / MPA_SQRT_MM,
            kink_deg: tip.kink.map(f64::to_degrees),
            rival_deg: tip.plane().and_then(|plane| plane.secondary).map(f64::to_degrees),
            rival_ratio: tip.plane().and_then(|plane| plane.secondary_ratio),
            increment: tip.increment,
            rate: tip.rate,
            load_cycles,
            stop: tip.stop.map(RunStop::NoTipGrows),
            depth: Some(tip.depth()),
            mgt: None,
            shares: tip.shares,
            removed: None,
            phi_deg: tip.front().map(|front| front.phi.to_degrees()),
            lateral: tip.front().map(|front| front.lateral),
            half_length: tip.front().map(|front| front.half_length),
            delta_kiii: tip.front().map(|front| front.delta_kiii / MPA_SQRT_MM),
            down: tip.front().map(|front| front.down),
            wanted_kink_deg: tip.front().and_then(|front| front.wanted_kink).map(f64::to_degrees),
            wanted_ratio: tip.front().and_then(|front| front.wanted_ratio),
            followed: tip.front().and_then(|front| front.followed),
            turn_deg: tip.turn().map(f64::to_degrees),
            jump: tip.plane().and_then(|plane| plane.jump),
            cycles_error: 0.0,
        }
    }

    /// Why the tip stopped, or in the last step the run, as the table has it; empty where neither
    /// did.
    pub fn stop_word(&self) -> &'static str {
        self.stop.map_or("", RunStop::word)
    }
}

/// Deferred growth (mm) of the tip of `row`: its increments since it came to where it is. `growth`
/// holds all rows of the run.
pub fn deferred_growth(growth: &[TipRow], row: &TipRow) -> f64 {
    let before = growth
        .iter()
        .rev()
        .filter(|other| other.step < row.step && (other.crack, other.tip) == (row.crack, row.tip));
    before.take_while(|other| other.place == row.place).map(|other| other.increment).sum()
}

impl TipRow {
    /// A tip of crack 1 at the origin that does nothing at the start of `step`: what a row says
    /// beyond its own fields.
    #[must_use]
    pub fn idle(step: usize) -> Self {
        Self {
            step,
            crack: 1,
            tip: 1,
            place: [0.0, 0.0],
            length: 0.0,
            ki_max: 0.0,
            delta_ki: 0.0,
            delta_kii: 0.0,
            delta_keq: 0.0,
            kink_deg: None,
            rival_deg: None,
            rival_ratio: None,
            increment: 0.0,
            rate: 0.0,
            load_cycles: 0.0,
            stop: None,
            depth: None,
            mgt: None,
            shares: WheelShares::default(),
            removed: None,
            phi_deg: None,
            lateral: None,
            half_length: None,
            delta_kiii: None,
            down: None,
            wanted_kink_deg: None,
            wanted_ratio: None,
            followed: None,
            turn_deg: None,
            jump: None,
            cycles_error: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step: usize, tip: usize, x: f64, increment: f64) -> TipRow {
        TipRow { tip, place: [x, -1.0], length: 2.0, increment, ..TipRow::idle(step) }
    }

    #[test]
    fn deferred_growth_is_the_increments_since_the_tip_moved() {
        let growth: Vec<TipRow> = (0..6)
            .flat_map(|step| {
                let slow = if step < 2 { 0.0 } else { 1.0 };
                [row(step, 1, step as f64, 1.0), row(step, 2, slow, 0.1 * (1 + step) as f64)]
            })
            .collect();
        let expected = [0.0, 0.1, 0.0, 0.3, 0.3 + 0.4, 0.3 + 0.4 + 0.5];
        for (pair, expected) in growth.chunks(2).zip(expected) {
            assert_eq!(deferred_growth(&growth, &pair[0]), 0.0);
            assert!((deferred_growth(&growth, &pair[1]) - expected).abs() < 1e-12, "step {}", pair[1].step);
        }
    }
}
