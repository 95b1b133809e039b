//! `shakedown.json`.

use super::results::ShakedownResults;
use crate::disk::VERSION;
use railcrack::fatigue::DepthValue;
use railcrack::load::ContactKind;
use railcrack::math::Stress;
use railcrack::shakedown::{DepthBounds, LayerState, MapPoint, Method, RailState};
use railcrack::words::Choice;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The stabilised state in numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShakedownSummary {
    /// Version of the program.
    pub version: String,
    /// Heading of the case.
    pub title: String,
    /// The stabilised state.
    #[serde(with = "crate::disk::words")]
    pub state: RailState,
    /// The method of computing it.
    #[serde(with = "crate::disk::words")]
    pub method: Method,
    /// Passages until the residual stress repeated; 1 for the direct method.
    pub passes: usize,
    /// Elastic redistributions of all passages: the cost.
    pub redistributions: usize,
    /// Peak pressure of the wheel, MPa.
    pub peak_pressure_mpa: f64,
    /// Half-width a of the wheel contact, mm.
    pub half_width_mm: f64,
    /// Under a patch: half-width b across the rail, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral_half_width_mm: Option<f64>,
    /// Under a patch: the lateral place of the profile, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral_mm: Option<f64>,
    /// Under a patch: columns along the rail, rows across it and layers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<[usize; 3]>,
    /// Q/P, signed: the friction of the wheel in full sliding.
    pub friction: f64,
    /// `contact.kind`.
    #[serde(default = "hertz")]
    pub contact: String,
    /// p0 over the yield stress in shear.
    pub p0_over_k: f64,
    /// First yield without residual stress.
    pub first_yield: Bound,
    /// Limit of elastic shakedown.
    pub shakedown_limit: Bound,
    /// The same by depth.
    pub bounds_by_depth: Vec<BoundsRow>,
    /// The shakedown map: the same over the friction of the wheel.
    pub map: Vec<MapRow>,
    /// Where plastic strain alternates, in plastic shakedown.
    pub alternating_zone: Option<AlternatingZone>,
    /// The largest magnitude of σ_xx or σ_zz of the residual stress.
    pub peak_residual_stress: PeakStress,
    /// σ_xx of manufacturing by depth, where the case gives it.
    pub initial_residual: Option<Vec<ResidualPoint>>,
    /// The Dang Van criterion.
    pub dang_van: DangVanSummary,
    /// How well the state meets its conditions.
    pub admissibility: AdmissibilitySummary,
    /// With the direct method: its distance from the state reached passage by passage.
    pub direct_against_pass_by_pass: Option<MethodComparison>,
    /// Wall time, s.
    pub wall_s: f64,
    /// Remarks for the reader.
    pub warnings: Vec<String>,
    /// Checksum of each table and field file (SHA-256).
    #[serde(default)]
    pub checksums: BTreeMap<String, String>,
}

/// A bound and the depth that decides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bound {
    /// p0 / k.
    pub p0_over_k: f64,
    /// mm.
    pub depth_mm: f64,
}

/// Shakedown limits at a depth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BoundsRow {
    /// mm.
    pub depth_mm: f64,
    /// p0 / k.
    pub first_yield_p0_over_k: f64,
    /// p0 / k.
    pub shakedown_p0_over_k: f64,
    /// Under the load of the case.
    pub verdict: BoundsVerdict,
}

/// A depth under the load of the case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BoundsVerdict {
    /// Below first yield.
    #[serde(rename = "elastic")]
    Elastic,
    /// Beyond first yield, below the shakedown limit.
    #[serde(rename = "shakedown possible")]
    Possible,
    /// Beyond the shakedown limit.
    #[serde(rename = "no shakedown")]
    Impossible,
}

/// A point of the shakedown map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MapRow {
    /// |μ| of the wheel.
    pub friction: f64,
    /// p0 / k.
    pub first_yield_p0_over_k: f64,
    /// p0 / k.
    pub shakedown_p0_over_k: f64,
}

/// Residual stress at a depth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ResidualPoint {
    /// mm.
    pub depth_mm: f64,
    /// Along the rail, MPa.
    pub sxx_mpa: f64,
    /// Out of plane, MPa.
    pub szz_mpa: f64,
}

/// Where plastic strain alternates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AlternatingZone {
    /// Upper end, mm.
    pub from_depth_mm: f64,
    /// Lower end, mm.
    pub to_depth_mm: f64,
    /// The largest plastic path per passage, √(2/3) ∫ |dε_p|.
    pub plastic_strain_per_pass: f64,
}

/// A component of the residual stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StressComponent {
    /// σ_xx, along the rail.
    Sxx,
    /// σ_zz, out of plane.
    Szz,
}

impl StressComponent {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sxx => "sxx",
            Self::Szz => "szz",
        }
    }
}

/// A largest residual stress.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PeakStress {
    /// Component of the stress.
    pub component: StressComponent,
    /// MPa.
    pub stress_mpa: f64,
    /// mm.
    pub depth_mm: f64,
    /// Under a patch: lateral place, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral_mm: Option<f64>,
}

/// The Dang Van criterion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DangVanSummary {
    /// a.
    pub a: f64,
    /// b, MPa.
    pub b_mpa: f64,
    /// Where a crack starts first.
    pub critical_depth_mm: f64,
    /// Under a patch: lateral place where a crack starts first, mm; surface and subsurface are
    /// those of the profile.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub critical_lateral_mm: Option<f64>,
    /// τ + a p_h there, MPa.
    pub critical_value_mpa: f64,
    /// b less that; negative where a crack starts.
    pub margin_mpa: f64,
    /// At the running surface.
    pub surface: DangVanPoint,
    /// The largest maximum below it.
    pub subsurface: Option<DangVanPoint>,
}

/// The criterion at one depth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DangVanPoint {
    /// mm.
    pub depth_mm: f64,
    /// τ + a p_h, MPa.
    pub value_mpa: f64,
    /// τ, MPa.
    pub shear_mpa: f64,
    /// p_h, MPa.
    pub hydrostatic_mpa: f64,
    /// b less the value, MPa.
    pub margin_mpa: f64,
}

/// Admissibility of the state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AdmissibilitySummary {
    /// Largest (|s − X| − R)/R over the whole cycle.
    pub overshoot: f64,
    /// Largest change of the plastic strain from upstream to downstream, √(2/3) |Δε_p|.
    pub drift: f64,
    /// Largest imbalance of forces, over R.
    pub imbalance: f64,
}

/// Distance of the result of the direct method from the state reached passage by passage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MethodComparison {
    /// The state by passages.
    #[serde(with = "crate::disk::words")]
    pub state: RailState,
    /// Passages that it took.
    pub passes: usize,
    /// Their redistributions.
    pub redistributions: usize,
    /// Largest difference of σ_xx or σ_zz of the residual stress, MPa.
    pub stress_difference_mpa: f64,
    /// Its residual stress, layer by layer.
    pub profile: Vec<ResidualPoint>,
}

impl ShakedownSummary {
    pub(super) fn of(results: &ShakedownResults) -> Self {
        let (rail, state) = (&results.rail, &results.stabilised);
        let a = rail.contact.half_width();
        let (first, limit) = (results.first_yield, results.limit);
        let longest = state.profile.iter().map(|layer| layer.plastic_per_pass).fold(0.0, f64::max);
        let ratio = rail.pressure_ratio();
        Self {
            version: VERSION.into(),
            title: results.title.clone(),
            state: state.state,
            method: state.method,
            passes: state.passes.len(),
            redistributions: state.iterations(),
            peak_pressure_mpa: rail.contact.peak_pressure(),
            half_width_mm: a,
            lateral_half_width_mm: results.section.as_ref().map(|section| section.lateral_half_width),
            lateral_mm: results.section.as_ref().map(|section| section.lateral),
            grid: results.section.as_ref().map(|section| section.state.grid()),
            friction: rail.contact.adhesion(),
            contact: rail.contact.kind().word().to_owned(),
            p0_over_k: ratio,
            first_yield: Bound { p0_over_k: first.ratio, depth_mm: first.depth_over_a * a },
            shakedown_limit: Bound { p0_over_k: limit.ratio, depth_mm: limit.depth_over_a * a },
            bounds_by_depth: results.bounds.iter().map(|bounds| bounds_row(bounds, a, ratio)).collect(),
            map: results.map.iter().map(map_row).collect(),
            alternating_zone: state.alternating.map(|zone| AlternatingZone {
                from_depth_mm: zone.from,
                to_depth_mm: zone.to,
                plastic_strain_per_pass: longest,
            }),
            peak_residual_stress: peak(results),
            initial_residual: rail.initial.as_ref().map(|_| {
                let point =
                    |layer: &LayerState| residual_point(layer.depth, rail.initial_stress(layer.depth));
                state.profile.iter().map(point).collect()
            }),
            dang_van: dang_van(results),
            admissibility: AdmissibilitySummary {
                overshoot: state.admissibility.overshoot,
                drift: state.admissibility.drift,
                imbalance: state.admissibility.imbalance,
            },
            direct_against_pass_by_pass: results.pass_by_pass.as_ref().map(|other| MethodComparison {
                state: other.state,
                passes: other.passes.len(),
                redistributions: other.iterations(),
                stress_difference_mpa: state.stress_difference(other),
                profile: other
                    .profile
                    .iter()
                    .map(|layer| residual_point(layer.depth, layer.stress))
                    .collect(),
            }),
            wall_s: results.wall_s,
            warnings: results.warnings.clone(),
            checksums: BTreeMap::new(),
        }
    }
}

/// The contact of folders that do not record it.
fn hertz() -> String {
    ContactKind::Hertz.word().to_owned()
}

fn map_row(point: &MapPoint) -> MapRow {
    MapRow {
        friction: point.friction,
        first_yield_p0_over_k: point.first_yield,
        shakedown_p0_over_k: point.shakedown,
    }
}

fn residual_point(depth: f64, stress: Stress) -> ResidualPoint {
    ResidualPoint { depth_mm: depth, sxx_mpa: stress.xx, szz_mpa: stress.zz }
}

fn bounds_row(bounds: &DepthBounds, half_width: f64, ratio: f64) -> BoundsRow {
    let verdict = if ratio <= bounds.first_yield {
        BoundsVerdict::Elastic
    } else if ratio <= bounds.shakedown {
        BoundsVerdict::Possible
    } else {
        BoundsVerdict::Impossible
    };
    BoundsRow {
        depth_mm: bounds.depth_over_a * half_width,
        first_yield_p0_over_k: bounds.first_yield,
        shakedown_p0_over_k: bounds.shakedown,
        verdict,
    }
}

fn peak(results: &ShakedownResults) -> PeakStress {
    if let Some(layer) = results.section.as_ref().and_then(|section| section.state.peak()) {
        let (along, across) = (layer.stress.xx, layer.stress.yy);
        let (component, stress_mpa) = if along.abs() >= across.abs() {
            (StressComponent::Sxx, along)
        } else {
            (StressComponent::Szz, across)
        };
        return PeakStress { component, stress_mpa, depth_mm: layer.depth, lateral_mm: Some(layer.lateral) };
    }
    let components = results.stabilised.profile.iter().flat_map(|layer| {
        [
            (StressComponent::Sxx, layer.stress.xx, layer.depth),
            (StressComponent::Szz, layer.stress.zz, layer.depth),
        ]
    });
    let largest = components.reduce(|best, here| if here.1.abs() > best.1.abs() { here } else { best });
    let (component, stress_mpa, depth_mm) = largest.unwrap_or((StressComponent::Sxx, 0.0, 0.0));
    PeakStress { component, stress_mpa, depth_mm, lateral_mm: None }
}

fn dang_van(results: &ShakedownResults) -> DangVanSummary {
    let criterion = &results.dang_van;
    let point = |at: DepthValue| DangVanPoint {
        depth_mm: at.depth,
        value_mpa: at.worst.value,
        shear_mpa: at.worst.shear,
        hydrostatic_mpa: at.worst.hydrostatic,
        margin_mpa: criterion.margin(at.worst.value),
    };
    let in_section = results.section.as_ref().and_then(|section| section.critical());
    let critical = point(in_section.map_or_else(|| results.initiation.critical(), |own| own.1));
    DangVanSummary {
        a: criterion.slope,
        b_mpa: criterion.limit,
        critical_depth_mm: critical.depth_mm,
        critical_lateral_mm: in_section.map(|own| own.0),
        critical_value_mpa: critical.value_mpa,
        margin_mpa: critical.margin_mpa,
        surface: point(results.initiation.surface),
        subsurface: results.initiation.subsurface.map(point),
    }
}
