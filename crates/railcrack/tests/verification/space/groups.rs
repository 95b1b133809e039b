//! Cracks in space in groups, against the solution of all cracks together.

use crate::common::steel;
use railcrack::contact::{CrackFluid, FluidModel, PressureProfile};
use railcrack::growth::{
    FrontShape, Growth, GrowthSettings, GrowthState, NetworkContact, PassageRecord, PassageSettings,
    StepRecord, Unobserved,
};
use railcrack::load::Passage;
use railcrack::math::RailBox;
use railcrack::space::{EllipticWheel, SpaceRail, SpaceResolution, SpaceWheel};
use rayon::ThreadPoolBuilder;

/// Largest difference of K from that of all cracks together, relative to the peak of its crack. The
/// load steps of both leave 1e-3 of the largest peak each, more where faces let go.
const OF_PEAK: f64 = 5e-3;
/// The same with pressure from the mouth: jumps change at once where the edge of the contact passes
/// a mouth, and those of neighbours are interpolated; the run estimates up to 1.5 %.
const OF_WET_PEAK: f64 = 1.5e-2;

/// Cracks of 30° with their semi-axes, place along the rail and lateral place, mm.
fn shapes(cracks: &[[f64; 4]]) -> Vec<FrontShape> {
    let of = |&[length, half_length, x, lateral]: &[f64; 4]| FrontShape {
        dip: 30f64.to_radians(),
        strike: 0.0,
        length,
        half_length,
        middle: [x, lateral],
        buried: None,
        strip: None,
        turns: None,
        deviation: None,
    };
    cracks.iter().map(of).collect()
}

/// The initial passages over `cracks`.
fn first_step(cracks: &[[f64; 4]], fluid: Option<CrackFluid>, network: NetworkContact) -> StepRecord {
    let last = cracks.last().map_or(0.0, |crack| crack[2]);
    let wheel = SpaceWheel {
        wheel: EllipticWheel {
            peak_pressure: 900.0,
            half_width: 6.0,
            lateral_half_width: 5.0,
            lateral: 0.0,
            friction: 0.1,
            lateral_friction: 0.0,
        }
        .into(),
        share: 1.0,
        bending: None,
        residual: None,
        fluid,
        passages: PassageSettings {
            passage: Passage { from: -18.0, to: last + 18.0, positions: 41 },
            step_tolerance: 1e-3,
            ..PassageSettings::default()
        },
        toughness: None,
    };
    let rail = SpaceRail {
        network,
        standing: None,
        steel: steel(),
        wheels: vec![wheel],
        friction: (0..cracks.len()).map(|k| 0.2 + 0.05 * k as f64).collect(),
        resolution: SpaceResolution::new(2, 2),
        growth: GrowthSettings { steps: 0, ..GrowthSettings::default() },
        mode_3_weight: None,
        fields: None,
        rail: RailBox::default(),
        kernel: None,
    };
    let state = GrowthState::initial_in_space(shapes(cracks)).unwrap();
    Growth::new(rail, state).next_step(&Unobserved).unwrap().unwrap()
}

/// The largest difference of K in the stabilised passage, relative to the peak of its crack, at
/// points that count in growth: where a front meets the surface contact may have two solutions.
fn difference(one: &StepRecord, other: &StepRecord) -> f64 {
    let sizes = |record: &PassageRecord, tip: usize| {
        let both = record.sifs[tip].iter().flat_map(|k| [k.ki, k.kii]);
        both.chain(record.kiii[tip].iter().copied()).collect::<Vec<f64>>()
    };
    let [a, b] = [one, other].map(|step| step.passages.last().unwrap());
    let cracks = 1 + one.tips.iter().map(|tip| tip.tip.crack).max().unwrap();
    let (mut peaks, mut off) = (vec![0.0f64; cracks], vec![0.0f64; cracks]);
    for (tip, record) in one.tips.iter().enumerate() {
        if !record.front().is_some_and(|front| front.counts) {
            continue;
        }
        let crack = record.tip.crack;
        for (k, l) in sizes(a, tip).into_iter().zip(sizes(b, tip)) {
            peaks[crack] = peaks[crack].max(k.abs());
            off[crack] = off[crack].max((k - l).abs());
        }
    }
    off.iter().zip(&peaks).map(|(off, peak)| off / peak).fold(0.0, f64::max)
}

#[test]
fn two_close_cracks_are_one_group() {
    // Each group holds both cracks, and no force comes from outside.
    let cracks = [[3.0, 4.0, 0.0, 0.0], [3.0, 4.0, 2.5, 0.0]];
    let [whole, groups] =
        [NetworkContact::Whole, NetworkContact::Groups].map(|network| first_step(&cracks, None, network));
    assert_eq!(whole.passages, groups.passages);
    assert_eq!(whole.faces.states, groups.faces.states);
}

/// Compares groups with all cracks together: K differs by less than `allowed` of the peak.
fn agree(cracks: &[[f64; 4]], fluid: Option<&CrackFluid>, allowed: f64) {
    let [whole, groups] = [NetworkContact::Whole, NetworkContact::Groups]
        .map(|network| first_step(cracks, fluid.cloned(), network));
    let off = difference(&whole, &groups);
    println!("{off:.1e} of the peak");
    assert!(off < allowed, "{off}");
    let wet = |step: &StepRecord| step.passages.last().unwrap().fluid.len();
    assert_eq!(wet(&whole), wet(&groups));
    // The estimate is reported, of groups alone.
    let estimates = |step: &StepRecord| {
        step.warnings.iter().filter(|warning| warning.text.contains("contact in groups")).count()
    };
    assert_eq!((estimates(&whole), estimates(&groups)), (0, 1));
}

/// Four cracks in a row.
const ROW: [[f64; 4]; 4] =
    [[3.0, 4.0, 0.0, 0.0], [3.0, 4.0, 3.8, 0.0], [2.5, 3.0, 7.6, 0.0], [3.0, 4.0, 11.4, 0.0]];

/// The same, each farther from the middle of the wheel than the last.
fn aside() -> [[f64; 4]; 4] {
    ROW.map(|[length, half_length, x, _]| [length, half_length, x, 0.1 * x])
}

#[test]
fn groups_agree_with_all_cracks_together() {
    agree(&ROW, None, OF_PEAK);
    agree(&aside(), None, OF_PEAK);
}

#[test]
fn groups_agree_under_pressure_from_the_mouth() {
    let wet = CrackFluid {
        model: FluidModel::Mouth { cap: 100.0 },
        profile: PressureProfile::Linear,
        cracks: Some(vec![1, 3]),
    };
    agree(&aside(), Some(&wet), OF_WET_PEAK);
}

#[test]
fn groups_do_not_depend_on_the_number_of_threads() {
    let cracks = [[3.0, 4.0, 0.0, 0.0], [3.0, 4.0, 3.8, 0.5], [2.5, 3.0, 7.6, 0.0], [3.0, 4.0, 11.4, 0.0]];
    let [one, three] = [1, 3].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| first_step(&cracks, None, NetworkContact::Groups))
    });
    assert_eq!(one.passages, three.passages);
    assert_eq!(one.counts, three.counts);
}
