//! Samples against closed forms.

use super::*;
use crate::decision::PathPoint;
use crate::log::MixInfo;
use railcrack::growth::StressMoves;
use railcrack_case::{Inspection, MaintenancePlan};

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
            shares: Default::default(),
        });
    }
    GrowthPath { tip: (1, 1), points, breaks: false, is_worn_away: false }
}

fn scatter() -> Scatter {
    Scatter {
        samples: 100_000,
        seed: 1,
        c_log_std: 0.3,
        m_std: 0.0,
        toughness: None,
        toughness_std: 0.0,
        detectable_depth_std: 0.0,
        wear_std: 0.0,
        share_log_std: 0.0,
    }
}

/// Samples of an inspected path under one wheel.
fn idle<'a>(path: &'a GrowthPath, scatter: &'a Scatter) -> Sampling<'a> {
    let inspection = Some(&INSPECTION);
    Sampling { path, scatter, inspection, critical_length: None, tonnes: 20.0, maintenance: None, mix: &[] }
}

fn sample(path: &GrowthPath, scatter: &Scatter) -> ScatterSummary {
    sampled(idle(path, scatter))
}

const INSPECTION: Inspection = Inspection {
    detectable_depth: Some(3.0),
    detectable_length: None,
    critical_depth: Some(7.0),
    safety_factor: 3.0,
};

#[test]
fn cycles_are_log_normal_where_c_is() {
    let (path, tonnes) = (path(), 20.0);
    let begun = std::time::Instant::now();
    let sampled = sample(&path, &scatter());
    let nominal = InspectionSummary::of(&path, &INSPECTION, None, tonnes);
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
    assert_eq!(sampled.sensitivities[0].key, "c_log_std");
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
    let nominal = InspectionSummary::of(&path(), &INSPECTION, None, 20.0);
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

/// Wear that the crack of 4 mm outgrows: sin θ = 0.5, and the rate at 4 mm is 2.03e-7 mm per axle
/// of 20 t, 0.0101 mm per MGT.
#[test]
fn wear_makes_the_way_longer_and_may_take_the_crack_away() {
    let path = path();
    let at = |wear: f64, scatter: Scatter| {
        let plan =
            MaintenancePlan { wear, grinding: None, first_grinding: None, stress: StressMoves::WithMetal };
        sampled(Sampling { maintenance: Some(&plan), ..idle(&path, &scatter) })
    };
    let still = Scatter { c_log_std: 0.0, samples: 100, ..scatter() };
    let growth = 1e6 / 20.0 * path.points[0].rate;
    // With a constant share of the growth removed at the beginning, by quadrature over the path.
    let wear = 0.25 * growth;
    let way = |from: f64, to: f64| {
        let steps = 20_000;
        let d = (to - from) / f64::from(steps);
        let net = |l: f64| 1e6 / 20.0 * 2e-9 * (4.0 * l.sqrt()).powf(3.33) - wear / 0.5;
        (0..steps).map(|i| d / net(from + (f64::from(i) + 0.5) * d)).sum::<f64>()
    };
    let worn = at(wear, still);
    // The trapezoidal rule over steps of 3.5 %: rates that wear halves at first.
    let median = worn.mgt_detectable_to_critical.p50.unwrap();
    assert!((median / way(6.0, 14.0) - 1.0).abs() < 2e-3, "{median} {}", way(6.0, 14.0));
    assert_eq!(worn.probability_growing, Some(1.0));
    // More wear than growth: nothing becomes critical, and the depth goes to nothing.
    let gone = at(0.7 * growth, still);
    assert_eq!((gone.probability_growing, gone.mgt_to_critical.p50), (Some(0.0), None));
    assert!(gone.depth.last().unwrap().depth_mm.p50.unwrap() < 1.9);
    // In the balance C decides, half and half: ln C is symmetrical.
    let half = at(0.5 * growth, Scatter { samples: 20_000, ..scatter() });
    let probability = half.probability_growing.unwrap();
    assert!((probability - 0.5).abs() < 0.015, "4 standard deviations of 20 000: {probability}");
    // Scatter of the wear contributes in addition to that of C.
    let both = at(wear, Scatter { samples: 20_000, wear_std: 0.1 * growth, ..scatter() });
    let keys: Vec<&str> = both.sensitivities.iter().map(|s| s.key.as_str()).collect();
    assert_eq!(keys, ["c_log_std", "wear_std"]);
    // A correlation of nothing would be 1/20 000.
    assert!(both.sensitivities[1].share > 0.003, "{:?}", both.sensitivities);
}

#[test]
fn shares_of_a_mix_scatter() {
    let mut path = path();
    let shares = railcrack::growth::WheelShares::from_values(&[0.8, 0.2]);
    path.points.iter_mut().for_each(|point| point.shares = shares);
    let wheel = |share: f64, load: f64| MixInfo {
        name: String::new(),
        share,
        axle_load: Some(load),
        half_width: 6.0,
    };
    let mix = [wheel(0.5, 20.0), wheel(0.5, 20.0)];
    let of = |std: f64| {
        let scatter = Scatter { c_log_std: 0.0, share_log_std: std, samples: 20_000, ..scatter() };
        sampled(Sampling { mix: &mix, ..idle(&path, &scatter) })
    };
    let way = InspectionSummary::of(&path, &INSPECTION, None, 20.0).mgt_detectable_to_critical.unwrap();
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
