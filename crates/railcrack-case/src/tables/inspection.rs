//! `[inspection]` and `[scatter]`: from growth to an interval with its uncertainty.

use super::calibration::CalibrationPrior;
use crate::files::{DetectionFile, read_detection};
use crate::schema::{Report, SectionValues, closed, file, integer, number, section};
use railcrack::fatigue::RailSteel;
use std::path::Path;

section! {
    INSPECTION "inspection", Optional,
        "Inspection interval: the traffic from a detectable to a critical crack over safety_factor; requires axle loads.",
        forms [[DETECTABLE_DEPTH], [DETECTABLE_LENGTH]];
    DETECTABLE_DEPTH: f64 = number("detectable_depth_mm", "mm", closed(0.0, 1e3), 2.0,
        "Tip depth from which a crack is detectable.").required();
    DETECTABLE_LENGTH: f64 = number("detectable_length_mm", "mm", closed(0.0, 1e3), 5.0,
        "Length from which a crack is detectable.").required();
    CRITICAL_DEPTH: f64 = number("critical_depth_mm", "mm", closed(1e-3, 1e3), 10.0,
        "Critical tip depth; critical_length_mm of [growth] and fracture are critical too.").optional();
    ULTRASONIC_DEPTH: f64 = number("ultrasonic_depth_mm", "mm", closed(1e-3, 1e3), 5.0,
        "Tip depth from which ultrasonic testing finds a crack that has turned down.");
    SAFETY_FACTOR: f64 = number("safety_factor", "", closed(1.0, 100.0), 3.0,
        "Divisor of the traffic from detectable to critical.");
    TARGET_RISK: f64 = number("target_risk", "", closed(1e-9, 1.0), 1e-3,
        "Accepted probability of failure before detection; the largest interval that keeps it is computed.").optional();
    POD: String = file("pod", "inputs/pod.csv", "pod.csv",
        "CSV file with the columns depth_mm,probability (of detection); linear between rows, zero for smaller depths, constant for larger ones. Not with pod_median_mm; without either, every detectable crack is found.").optional();
    POD_MEDIAN: f64 = number("pod_median_mm", "mm", closed(1e-3, 1e3), 2.0,
        "Depth at which half of the cracks are found; the probability of detection is Phi(ln(depth/median)/pod_log_std).").optional();
    POD_LOG_STD: f64 = number("pod_log_std", "", closed(1e-3, 10.0), 0.5,
        "Logarithmic standard deviation of the depth of detection; requires pod_median_mm.").optional();
}

section! {
    SCATTER "scatter", Optional,
        "Scatter of quantities that do not change the path, sampled after the run; requires axle loads.";
    SAMPLES: usize = integer("samples", (10, 10_000_000), 100_000, "Number of samples.");
    SEED: usize = integer("seed", (0, 4_294_967_295), 1, "Seed of the random numbers.");
    C_LOG_STD: f64 = number("paris_c_log_std", "", closed(0.0, 5.0), 0.3,
        "Standard deviation of ln C of the growth law; by default prior_log_std of [calibration], in a calibrated case that of the steel of [growth], or 0.3.").optional();
    M_STD: f64 = number("paris_m_std", "", closed(0.0, 5.0), 0.0,
        "Standard deviation of the exponent, with the rate at dKeq = 10 MPa sqrt(m) kept.");
    TOUGHNESS_STD: f64 = number("toughness_std", "MPa sqrt(m)", closed(0.0, 100.0), 0.0,
        "Standard deviation of the toughness of [fracture].");
    DETECTABLE_DEPTH_STD: f64 = number("detectable_depth_std", "mm", closed(0.0, 100.0), 0.0,
        "Standard deviation of the detectable depth.");
    WEAR_STD: f64 = number("wear_std", "mm/MGT", closed(0.0, 100.0), 0.0,
        "Standard deviation of wear_mm_per_mgt; negative samples count as zero.");
    SHARE_LOG_STD: f64 = number("share_log_std", "", closed(0.0, 5.0), 0.0,
        "Standard deviation of ln of the share of each [[wheel]], before normalisation.");
}

/// Inspection of the rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inspection {
    /// Depth (mm) from which a crack is found.
    pub detectable_depth: Option<f64>,
    /// Length (mm) from which a crack is found, where the depth is not given.
    pub detectable_length: Option<f64>,
    /// Depth (mm) that must not be reached.
    pub critical_depth: Option<f64>,
    /// Depth (mm) from which ultrasonic testing finds a crack that has turned down.
    pub ultrasonic_depth: f64,
    /// Safety factor.
    pub safety_factor: f64,
}

/// Detected from the beginning, without a safety factor.
impl Default for Inspection {
    fn default() -> Self {
        Self {
            detectable_depth: None,
            detectable_length: None,
            critical_depth: None,
            ultrasonic_depth: 0.0,
            safety_factor: 1.0,
        }
    }
}

/// Scatter of what does not change the path of the crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Number of samples.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: usize,
    /// Standard deviation of ln C.
    pub c_log_std: f64,
    /// The same from rail to rail, once the rates of a site are known: that of the steel, unless
    /// `c_log_std` is given.
    pub rail_log_std: f64,
    /// Standard deviation of the exponent.
    pub m_std: f64,
    /// K_Ic, MPa√m, where the case gives it.
    pub toughness: Option<f64>,
    /// Its standard deviation, MPa√m.
    pub toughness_std: f64,
    /// Standard deviation of the detectable depth, mm.
    pub detectable_depth_std: f64,
    /// Standard deviation of the wear, mm per million gross tonnes.
    pub wear_std: f64,
    /// Standard deviation of the logarithm of the share of each wheel.
    pub share_log_std: f64,
}

/// Scatter of ln C where nothing else is known.
const USUAL_LOG_STD: f64 = 0.3;

/// The inspection; `has_tonnes` says whether axle loads are given.
pub(crate) fn read_inspection(
    section: &SectionValues,
    has_tonnes: bool,
    report: &mut Report,
) -> Option<Inspection> {
    needs_tonnes(section, has_tonnes, report)?;
    let read = Inspection {
        detectable_depth: section.get(DETECTABLE_DEPTH),
        detectable_length: section.get(DETECTABLE_LENGTH),
        critical_depth: section.get(CRITICAL_DEPTH),
        ultrasonic_depth: section.get(ULTRASONIC_DEPTH)?,
        safety_factor: section.get(SAFETY_FACTOR)?,
    };
    if let (Some(detectable), Some(critical)) = (read.detectable_depth, read.critical_depth)
        && critical <= detectable
    {
        let says = format!("must be more than detectable_depth_mm = {detectable}");
        return report.refuse(section.fault(CRITICAL_DEPTH, says));
    }
    Some(read)
}

/// Probability that an inspection finds a crack, by its depth.
#[derive(Debug, Clone, PartialEq)]
pub enum Detection {
    /// Φ(ln(depth / median) / σ).
    LogNormal {
        /// The median, mm.
        median: f64,
        /// σ.
        log_std: f64,
    },
    /// A table.
    Table(DetectionFile),
}

/// The detection and the accepted risk of the inspections.
#[derive(Debug, Clone, PartialEq)]
pub struct InspectionRisk {
    /// The probability of failure before detection that is accepted.
    pub target: Option<f64>,
    /// The probability of detection; `None` where every detectable crack is found.
    pub detection: Option<Detection>,
}

/// The risk between inspections; files are relative to `folder`.
pub(crate) fn read_risk(
    section: &SectionValues,
    folder: &Path,
    report: &mut Report,
) -> Option<InspectionRisk> {
    let (median, log_std) = (section.get(POD_MEDIAN), section.get(POD_LOG_STD));
    let detection = match (section.get(POD), median, log_std) {
        (None, None, None) => None,
        (None, Some(median), Some(log_std)) => Some(Detection::LogNormal { median, log_std }),
        (Some(_), None, None) => Some(Detection::Table(read_detection(section, POD, folder, report)?)),
        (Some(_), median, _) => {
            let given = if median.is_some() { POD_MEDIAN } else { POD_LOG_STD };
            let help = "give either pod or pod_median_mm and pod_log_std";
            return report
                .refuse(section.fault(given, "is given beside pod, which is a curve of its own").help(help));
        }
        (None, median, _) => {
            let (given, other) =
                if median.is_some() { (POD_MEDIAN, POD_LOG_STD) } else { (POD_LOG_STD, POD_MEDIAN) };
            let help = "give both pod_median_mm and pod_log_std";
            return report
                .refuse(section.fault(given, format!("needs {} as well", other.key.name)).help(help));
        }
    };
    Some(InspectionRisk { target: section.get(TARGET_RISK), detection })
}

/// The numbers of a case that may scatter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scattering<'a> {
    /// K_Ic, MPa√m.
    pub toughness: Option<f64>,
    pub steel: Option<&'a RailSteel>,
    /// Knowledge of the coefficient of the growth law.
    pub prior: CalibrationPrior,
    /// Whether axle loads are given.
    pub has_tonnes: bool,
    /// Whether the surface is removed.
    pub is_maintained: bool,
    /// Whether there is a mix of wheels.
    pub is_mix: bool,
}

/// The scatter of a case.
pub(crate) fn read_scatter(section: &SectionValues, of: Scattering, report: &mut Report) -> Option<Scatter> {
    let Scattering { toughness, steel, prior, has_tonnes, is_maintained, is_mix } = of;
    needs_tonnes(section, has_tonnes, report)?;
    let (wear_std, share_log_std) = (section.get(WEAR_STD)?, section.get(SHARE_LOG_STD)?);
    if wear_std > 0.0 && !is_maintained {
        let help = "add a [maintenance] section with the mean wear";
        return report
            .refuse(section.fault(WEAR_STD, "there is no [maintenance] with a mean wear").help(help));
    }
    if share_log_std > 0.0 && !is_mix {
        let says = "the case has a single wheel, whose share is 1";
        return report.refuse(
            section.fault(SHARE_LOG_STD, says).help("it applies to a mix of [[wheel]] sections with shares"),
        );
    }
    let toughness_std = section.get(TOUGHNESS_STD)?;
    if toughness_std > 0.0 && toughness.is_none() {
        let help = "add a [fracture] section with the mean toughness";
        return report
            .refuse(section.fault(TOUGHNESS_STD, "there is no [fracture] with a mean toughness").help(help));
    }
    // Scatter of tests in a laboratory is that of a rail only where the rates of its site are
    // known.
    let of_steel = steel.map_or(USUAL_LOG_STD, |steel| steel.c_log_std);
    let usual = if prior.sites.is_some() { of_steel } else { prior.log_std };
    Some(Scatter {
        samples: section.get(SAMPLES)?,
        seed: section.get(SEED)?,
        c_log_std: section.get(C_LOG_STD).unwrap_or(usual),
        rail_log_std: section.get(C_LOG_STD).unwrap_or(of_steel),
        m_std: section.get(M_STD)?,
        toughness,
        toughness_std,
        detectable_depth_std: section.get(DETECTABLE_DEPTH_STD)?,
        wear_std,
        share_log_std,
    })
}

/// Intervals are in million gross tonnes.
pub(super) fn needs_tonnes(section: &SectionValues, has_tonnes: bool, report: &mut Report) -> Option<()> {
    if has_tonnes {
        return Some(());
    }
    let help = "add a [traffic] section with axle_load_t, or axle_load_t to every [[wheel]]";
    report
        .refuse(section.fault_of_all("counts in million gross tonnes, and no axle load is given").help(help))
}
