//! `passes.csv`, `profile.csv` and `section.csv`.

use super::results::SectionResults;
use crate::csv::table;
use railcrack::fatigue::Initiation;
use railcrack::math::{Stress, Tensor};
use railcrack::shakedown::{PassRecord, PlasticStrain, StabilisedRail};

table! {
    /// A passage; with the direct method, the only one.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct PassRow in "passes.csv", [
        "Changes by each passage, maximum over depth; strains are equivalent strains, sqrt(2/3) of the Frobenius norm",
        "stress_change_mpa: of sxx or szz of the residual stress, MPa; plastic_strain_max: after the passage; plastic_path_max: strain accumulated in the passage; left_stress_max_mpa: left by the passages so far",
    ] {
        /// Passage, from 1.
        pass: usize = "pass";
        /// Largest change of σ_xx or σ_zz of the residual stress by the passage, MPa.
        stress_change: f64 = "stress_change_mpa";
        /// Largest change of the plastic strain by the passage, √(2/3) \|Δε_p\|.
        strain_change: f64 = "plastic_strain_change";
        /// Largest plastic strain after the passage, √(2/3) \|ε_p\|.
        largest_strain: f64 = "plastic_strain_max";
        /// Largest plastic strain accumulated in the passage, √(2/3) ∫ \|dε_p\|.
        plastic_path: f64 = "plastic_path_max";
        /// Largest \|σ_xx\| or \|σ_zz\| due to the passages so far, without that of manufacturing,
        /// MPa.
        left_stress: f64 = "left_stress_max_mpa";
        /// Elastic redistributions in the passage.
        redistributions: usize = "redistributions";
    }
}

impl From<&PassRecord> for PassRow {
    fn from(pass: &PassRecord) -> Self {
        Self {
            pass: pass.pass,
            stress_change: pass.stress_change,
            strain_change: pass.strain_change,
            largest_strain: pass.largest_strain,
            plastic_path: pass.plastic_path,
            left_stress: pass.left_stress,
            redistributions: pass.iterations,
        }
    }
}

table! {
    /// The unloaded rail in a layer.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct LayerRow in "profile.csv", [
        "State of the unloaded rail by depth: residual stress (including that of manufacturing), plastic strain (tensor components)",
        "depth_mm: middle of the layer, mm; stress: MPa, tension positive; x along the rail, y upwards, z out of plane",
        "plastic_per_pass: equivalent plastic strain accumulated in one passage; dang_van_mpa: largest tau + a p_h of the cycle, MPa",
    ] {
        /// Depth of the middle of the layer, mm.
        depth: f64 = "depth_mm";
        /// Residual stress, including that of manufacturing, MPa.
        stress: Stress = "sxx_mpa" "syy_mpa" "szz_mpa" "sxy_mpa";
        /// Plastic strain; `ep_xy` is the tensor component.
        strain: PlasticStrain = "ep_xx" "ep_yy" "ep_zz" "ep_xy";
        /// Plastic strain accumulated per passage in the stabilised state, √(2/3) ∫ \|dε_p\|.
        plastic_per_pass: f64 = "plastic_per_pass";
        /// Largest τ + a p_h of the stabilised cycle, MPa.
        dang_van: f64 = "dang_van_mpa";
    }
}

impl LayerRow {
    /// The layers of `rail`; `initiation` has the surface before them.
    pub(super) fn of(rail: &StabilisedRail, initiation: &Initiation) -> impl Iterator<Item = Self> {
        rail.profile.iter().zip(initiation.by_depth.iter().skip(1)).map(|(layer, value)| Self {
            depth: layer.depth,
            stress: layer.stress,
            strain: layer.strain,
            plastic_per_pass: layer.plastic_per_pass,
            dang_van: value.worst.value,
        })
    }
}

table! {
    /// The unloaded rail in a layer at a lateral place.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct SectionRow in "section.csv", [
        "State of the unloaded rail across it: residual stress (including that of manufacturing), plastic strain (tensor components)",
        "Axes of this table: x along the rail, y across it, z down; y_mm: lateral place, mm; depth_mm: middle of the layer, mm; stress: MPa, tension positive",
        "yield_utilisation, shakedown_utilisation: more than 1 where the elastic passage yields, and where no elastic shakedown is possible (Melan)",
    ] {
        /// Lateral place from the cracks, mm.
        lateral: f64 = "y_mm";
        /// Depth of the middle of the layer, mm.
        depth: f64 = "depth_mm";
        /// Residual stress, including that of manufacturing, MPa: y across the rail, z down.
        stress: Tensor = "sxx_mpa" "syy_mpa" "szz_mpa" "syz_mpa" "sxz_mpa" "sxy_mpa";
        /// Plastic strain; shears are tensor components.
        strain: Tensor = "ep_xx" "ep_yy" "ep_zz" "ep_yz" "ep_xz" "ep_xy";
        /// Plastic strain accumulated per passage in the stabilised state, √(2/3) ∫ \|dε_p\|.
        plastic_per_pass: f64 = "plastic_per_pass";
        /// Largest \|s\| of the elastic passage over the radius of the yield surface.
        yield_utilisation: f64 = "yield_utilisation";
        /// Radius of the smallest ball around the path of s over that of the yield surface.
        shakedown_utilisation: f64 = "shakedown_utilisation";
        /// Largest τ + a p_h of the stabilised cycle, MPa.
        dang_van: f64 = "dang_van_mpa";
    }
}

impl SectionRow {
    /// The computed rows of `section` and, of a state that is its own mirror image, their images:
    /// by lateral place, then by depth.
    pub(super) fn of(section: &SectionResults) -> Vec<Self> {
        let state = &section.state;
        let (count, computed) = (state.layers.count(), state.computed_rows());
        let all = state.laterals.len();
        let first = if computed.start == all / 2 { all - computed.end + 1 } else { computed.start };
        let row = |m: usize| {
            let by_depth = &section.by_row[state.computed_row(state.laterals[m])].by_depth;
            let layer = move |l: usize| {
                let own = &state.section[m * count + l];
                Self {
                    lateral: own.lateral,
                    depth: own.depth,
                    stress: own.stress,
                    strain: own.strain,
                    plastic_per_pass: own.plastic_per_pass,
                    yield_utilisation: own.yield_utilisation,
                    shakedown_utilisation: own.shakedown_utilisation,
                    dang_van: by_depth[l + 1].worst.value,
                }
            };
            (0..count).map(layer)
        };
        (first..computed.end).flat_map(row).collect()
    }
}
