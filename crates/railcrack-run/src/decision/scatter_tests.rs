//! Samples against closed forms.

use super::*;
use crate::decision::{Course, Family, GrowthPath, InspectionSummary, Nominal, PathPoint, Question};
use crate::log::WheelInfo;
use railcrack::growth::{Grinding, Mgt, SurfaceRemoval};
use railcrack_case::Inspection;

/// A crack under Paris' law with ΔK = 4 √length, from 4 to 16 mm.
fn path() -> GrowthPath {
    let rate = |length: f64| 2e-9 * (4.0 * length.sqrt()).powf(3.33);
    let mut axles = 0.0;
    let mut points: Vec<PathPoint> = Vec::new();
    for i in 0..=40 {
        let length = 4.0 * 4.0_f64.powf(f64::from(i) / 40.0);
        if let Some(before) = points.last() {
            axles += 0.5 * (length - before.length) * (before.rate.recip() + rate(length).recip());
        }
        let delta_keq = 4.0 * length.sqrt();
        let depth = 0.5 * length;
        points.push(PathPoint {
            axles,
            length,
            depth,
            rate: rate(length),
            delta_keq,
            largest_k1: delta_keq,
            mouth_sine: Some(0.5),
            ..PathPoint::default()
        });
    }
    GrowthPath { tip: (1, 1), points, breaks: false, is_worn_away: false }
}

fn scatter() -> Scatter {
    Scatter {
        samples: 100_000,
        seed: 1,
        c_log_std: 0.3,
        rail_log_std: 0.3,
        m_std: 0.0,
        toughness: None,
        toughness_std: 0.0,
        detectable_depth_std: 0.0,
        wear_std: 0.0,
        share_log_std: 0.0,
    }
}

/// Samples of a crack on `path`, of which `question` is asked.
struct Asked<'a> {
    question: Question,
    path: &'a GrowthPath,
    scatter: &'a Scatter,
    mix: &'a [WheelInfo],
}

/// The question asked of each path.
const QUESTION: Question =
    Question { inspection: INSPECTION, critical_length: None, tonnes: 20.0, removal: SurfaceRemoval::NONE };

impl Asked<'_> {
    fn sampled(&self) -> ScatterSummary {
        let course = Course::of_path(self.path);
        let family = Family::alone(&course);
        let of = Sampling {
            family: &family,
            question: self.question,
            scatter: self.scatter,
            mix: self.mix,
            arrest_rate: 0.0,
            has_own_toughness: self.scatter.toughness_std > 0.0,
        };
        let inspection = nominal(self.path);
        let tonnages = tonnages(inspection.mgt_to_critical.unwrap(), self.scatter);
        sampled(of, tonnages, inspection.interval_mgt, Lives::Dropped).0
    }
}

/// Samples of an inspected path under one wheel.
fn idle<'a>(path: &'a GrowthPath, scatter: &'a Scatter) -> Asked<'a> {
    Asked { question: QUESTION, path, scatter, mix: &[] }
}

/// The inspection of the run.
fn nominal(path: &GrowthPath) -> InspectionSummary {
    InspectionSummary::of(&Nominal::of(&Course::of_path(path), &QUESTION), &INSPECTION, &[])
}

fn sample(path: &GrowthPath, scatter: &Scatter) -> ScatterSummary {
    idle(path, scatter).sampled()
}

const INSPECTION: Inspection = Inspection {
    detectable_depth: Some(3.0),
    detectable_length: None,
    critical_depth: Some(7.0),
    ultrasonic_depth: 5.0,
    safety_factor: 3.0,
};

#[test]
fn cycles_are_log_normal_where_c_is() {
    let path = path();
    let begun = std::time::Instant::now();
    let sampled = sample(&path, &scatter());
    let nominal = nominal(&path);
    let way = nominal.mgt_detectable_to_critical.unwrap();
    // N ∝ 1/C: quantiles are tonnage · e^(±1.6449 · 0.3). The sampled ones scatter by about
    // √(q (1−q)/n)/density: 0.2 % in the median, 0.4 % at 5 and 95 %.
    let quantile = |z: f64| way * (0.3 * z).exp();
    let Quantiles { p05, p50, p95 } = sampled.mgt_detectable_to_critical;
    for (sampled, exact) in [(p05, quantile(-1.644_854)), (p50, way), (p95, quantile(1.644_854))] {
        let sampled = sampled.unwrap();
        assert!((sampled / exact - 1.0).abs() < 0.015, "{sampled}, not {exact}");
    }
    // Three times the mean rate: ln 3/0.3 = 3.66 standard deviations, 1.2e-4.
    let probability = sampled.probability_critical_before_inspection.unwrap();
    assert!((probability - 1.25e-4).abs() < 1.2e-4, "{probability}");
    assert_eq!(sampled.sensitivities[0].key, "paris_c_log_std");
    assert!((sampled.sensitivities[0].share - 1.0).abs() < 1e-9);
    assert!(sampled.depth[0].depth_mm.p50 == Some(2.0));
    assert!(begun.elapsed().as_secs_f64() < 20.0, "{:?}", begun.elapsed());
}

#[test]
fn the_same_seed_gives_the_same_bits_and_no_scatter_the_run_itself() {
    let few = Scatter { samples: 500, ..scatter() };
    let run = |scatter: &Scatter| sample(&path(), scatter);
    assert_eq!(run(&few), run(&few));
    assert_ne!(run(&few), run(&Scatter { seed: 2, ..few }));
    let still = run(&Scatter { c_log_std: 0.0, ..few });
    let nominal = nominal(&path());
    let Quantiles { p05, p95, .. } = still.mgt_to_critical;
    let want = nominal.mgt_to_critical.unwrap();
    assert!([p05, p95].iter().all(|p| (p.unwrap() / want - 1.0).abs() < 1e-12), "{still:?}");
}

#[test]
fn a_brittle_rail_breaks_before_the_critical_depth() {
    let brittle = Scatter { samples: 2000, toughness: Some(12.0), toughness_std: 0.5, ..scatter() };
    let early = sample(&path(), &brittle);
    let late = sample(&path(), &Scatter { toughness: None, ..brittle });
    assert!(early.mgt_to_critical.p50 < late.mgt_to_critical.p50);
    assert!(early.sensitivities.iter().any(|s| s.key == "toughness_std" && s.share > 0.01));
}

/// A grinding before any traffic leaves open whether the crack grows at first.
#[test]
fn a_crack_that_is_ground_at_once_grows_after_it() {
    let (path, few) = (path(), Scatter { samples: 20, ..scatter() });
    let growing = |first: f64| {
        let grinding = Grinding { depth: 1e-3, interval: Mgt(1e4), first: Some(Mgt(first)) };
        let removal = SurfaceRemoval { grinding: Some(grinding), ..SurfaceRemoval::NONE };
        let question = Question { removal, ..QUESTION };
        Asked { question, ..idle(&path, &few) }.sampled().probability_growing
    };
    assert_eq!((growing(0.0), growing(1.0)), (Some(1.0), Some(1.0)));
}

#[test]
fn shares_of_a_mix_scatter() {
    let mut path = path();
    let shares = railcrack::growth::WheelShares::from_values(&[0.8, 0.2]);
    path.points.iter_mut().for_each(|point| point.shares = shares);
    let wheel = |share: f64, load: f64| WheelInfo {
        name: String::new(),
        share,
        axle_load: Some(load),
        half_width: 6.0,
    };
    let mix = [wheel(0.5, 20.0), wheel(0.5, 20.0)];
    let of = |std: f64| {
        let scatter = Scatter { c_log_std: 0.0, share_log_std: std, samples: 20_000, ..scatter() };
        Asked { mix: &mix, ..idle(&path, &scatter) }.sampled()
    };
    let way = nominal(&path).mgt_detectable_to_critical.unwrap();
    let Quantiles { p05, p50, p95 } = of(0.2).mgt_detectable_to_critical;
    // The rate over that of the case is 1.6 s + 0.4 (1 − s) with the logit of s normal, of the
    // standard deviation 0.2 √2.
    let want = |z: f64| {
        let s = 1.0 / (1.0 + (-0.2 * 2f64.sqrt() * z).exp());
        way / (1.6 * s + 0.4 * (1.0 - s))
    };
    for (got, z) in [(p05, 1.644_854), (p50, 0.0), (p95, -1.644_854)] {
        assert!((got.unwrap() / want(z) - 1.0).abs() < 0.01, "{got:?} {}", want(z));
    }
    assert!(of(0.0).sensitivities.is_empty());
    assert!((of(0.2).sensitivities[0].share - 1.0).abs() < 0.02);
}

#[test]
fn depths_in_classes_have_the_quantiles_of_all_depths() {
    let mut depths: Vec<f64> = (0..40_000u32).map(|i| 0.5 + f64::from(i * 7919 % 40_000) / 1e4).collect();
    depths.extend([f64::INFINITY; 1000]);
    let mut counts = DepthCounts::default();
    depths.iter().for_each(|depth| counts.take(*depth));
    let (found, exact) = (counts.quantiles(), quantiles(depths));
    for (found, exact) in [(found.p05, exact.p05), (found.p50, exact.p50), (found.p95, exact.p95)] {
        assert!((found.unwrap() / exact.unwrap() - 1.0).abs() < 1e-5, "{found:?} {exact:?}");
    }
    let of = |depths: &[f64]| {
        let mut counts = DepthCounts::default();
        depths.iter().for_each(|depth| counts.take(*depth));
        counts.quantiles()
    };
    // Few depths are themselves; beyond the end of a run and without samples there is none.
    assert_eq!(of(&[3.0, 1.1, 2.0]).p50, Some(2.0));
    assert_eq!(of(&[1.0, f64::INFINITY, f64::INFINITY]).p50, None);
    assert_eq!(of(&[]).p50, None);
}
