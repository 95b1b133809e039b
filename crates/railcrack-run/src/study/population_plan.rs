//! Facts of the cases of a study that samples between its runs take.

use railcrack_case::{Case, Distribution, Inspection, Scatter, Study, Variation};
use serde::{Deserialize, Serialize};

/// `[scatter]`, `[inspection]` and traffic of the cases of a study whose values are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PopulationPlan {
    /// How many samples.
    pub samples: usize,
    /// Seed of their random numbers.
    pub seed: usize,
    /// Mean load of an axle, t.
    pub axle_load_t: f64,
    /// Standard deviation of ln C.
    pub c_log_std: f64,
    /// Standard deviation of the exponent.
    pub m_std: f64,
    /// Standard deviation of the detectable depth, mm.
    pub detectable_depth_std_mm: f64,
    /// Depth from which a crack is detected, mm.
    pub detectable_depth_mm: Option<f64>,
    /// Length from which a crack is detected, mm.
    pub detectable_length_mm: Option<f64>,
    /// Depth that is critical, mm.
    pub critical_depth_mm: Option<f64>,
    /// Length that is critical, mm.
    pub critical_length_mm: Option<f64>,
    /// Safety factor.
    pub safety_factor: f64,
    /// Quantities interpolated between the runs.
    #[serde(default)]
    pub between: Between,
    /// Standard deviation of the wear, mm per million gross tonnes.
    #[serde(default)]
    pub wear_std_mm_per_mgt: f64,
}

/// Quantities interpolated between the runs of a study.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Between {
    /// Paths of the crack, along which samples of the growth law are evaluated.
    #[default]
    Paths,
    /// Lives of the samples of the runs: where the surface is removed the path of the crack depends
    /// on the sample.
    Lives,
}

/// Sections whose keys the samples take from the first run.
const OF_ALL_RUNS: [&str; 4] = ["scatter.", "inspection.", "traffic.", "growth.critical"];

impl PopulationPlan {
    /// The plan of `study`; none where no value is drawn or its cases have no `[scatter]`.
    pub fn of(study: &Study) -> Option<Self> {
        let variations = || study.axes.iter().flat_map(|axis| &axis.variations);
        let is_one_for_all =
            |variation: &Variation| OF_ALL_RUNS.iter().any(|section| variation.key.starts_with(section));
        if !variations().any(|variation| variation.distribution.is_some()) || variations().any(is_one_for_all)
        {
            return None;
        }
        Self::of_case(&study.runs.first()?.case)
    }

    fn of_case(case: &Case) -> Option<Self> {
        let scatter = case.scatter?;
        let is_removed =
            case.maintenance.is_some_and(|removal| removal.mean_rate() > 0.0) || scatter.wear_std > 0.0;
        let inspection = case.inspection.unwrap_or_default();
        Some(Self {
            samples: scatter.samples,
            seed: scatter.seed,
            axle_load_t: case.axle_load?,
            c_log_std: scatter.c_log_std,
            m_std: scatter.m_std,
            detectable_depth_std_mm: scatter.detectable_depth_std,
            detectable_depth_mm: inspection.detectable_depth,
            detectable_length_mm: inspection.detectable_length,
            critical_depth_mm: inspection.critical_depth,
            critical_length_mm: case.growth.critical_length,
            safety_factor: inspection.safety_factor,
            between: if is_removed { Between::Lives } else { Between::Paths },
            wear_std_mm_per_mgt: scatter.wear_std,
        })
    }

    pub(crate) fn scatter(&self) -> Scatter {
        Scatter {
            samples: self.samples,
            seed: self.seed,
            c_log_std: self.c_log_std,
            rail_log_std: self.c_log_std,
            m_std: self.m_std,
            toughness: None,
            toughness_std: 0.0,
            detectable_depth_std: self.detectable_depth_std_mm,
            wear_std: self.wear_std_mm_per_mgt,
            share_log_std: 0.0,
        }
    }

    pub(crate) fn inspection(&self) -> Inspection {
        Inspection {
            detectable_depth: self.detectable_depth_mm,
            detectable_length: self.detectable_length_mm,
            critical_depth: self.critical_depth_mm,
            safety_factor: self.safety_factor,
            ..Inspection::default()
        }
    }
}

/// The distributions of the keys of a drawn axis, from their texts; none where a key has none, or
/// one of words.
pub(crate) fn distributions<'a>(texts: impl Iterator<Item = Option<&'a str>>) -> Option<Vec<Distribution>> {
    texts.map(|text| text.and_then(Distribution::parse)).collect()
}
