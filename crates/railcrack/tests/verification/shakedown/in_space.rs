//! The rolled rail in space: limits of ellipses, symmetry, the effect of the grid, and a state on
//! each side of the limit.

use super::YIELD;
use railcrack::interruption::Interruption;
use railcrack::load::Travel;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::math::Tensor;
use railcrack::shakedown::RailState;
use railcrack::shakedown::space::{
    RailInSpace, RolledPatch, SpaceResolution, SpaceStabilisation, StabilisedSpace, Symmetry,
    stabilise_in_space,
};
use railcrack::space::EllipticWheel;
use std::sync::Arc;

const POISSON: f64 = 0.3;

/// A Hertz ellipse in full sliding.
fn patch(peak_pressure: f64, [a, b]: [f64; 2], friction: f64) -> RolledPatch {
    let wheel = EllipticWheel {
        peak_pressure,
        half_width: a,
        lateral_half_width: b,
        lateral: 0.0,
        friction,
        lateral_friction: 0.0,
    };
    let stress = move |x: f64, y: f64, depth: f64| Tensor::of(wheel.stress(0.0, [x, y, depth], POISSON));
    RolledPatch {
        peak_pressure,
        half_width: a,
        lateral_half_width: b,
        lateral: 0.0,
        symmetry: Symmetry::Mirrored,
        travel: Travel::Forward,
        stress: Arc::new(stress),
    }
}

fn rail(patch: RolledPatch) -> RailInSpace {
    RailInSpace {
        steel: IsotropicElastic::new(210e3, POISSON).unwrap(),
        hardening: KinematicHardening::new(YIELD, 20e3).unwrap(),
        patches: vec![patch],
        initial: None,
    }
}

/// A coarse grid, for states whose kind does not depend on it.
const COARSE: SpaceResolution = SpaceResolution {
    columns_per_half_width: 8,
    rows_per_half_width: 6,
    layers_per_half_width: 12,
    period: 8,
    lateral_period: 5,
};

fn stabilised(rail: &RailInSpace, resolution: SpaceResolution, max_passes: usize) -> StabilisedSpace {
    let settings = SpaceStabilisation { resolution, max_passes, ..SpaceStabilisation::default() };
    stabilise_in_space(Interruption::NEVER, rail, &settings, |_| ()).unwrap()
}

/// p0/k and depth/a at first yield and p0/k at the limit of elastic shakedown by Melan's theorem,
/// without friction: numbers of an independent quadrature, four and two digits.
#[test]
fn limits_of_ellipses() {
    for (b_over_a, first, depth, limit) in [
        (2.0 / 3.0, 2.809, 0.38, 5.115),
        (1.0, 2.793, 0.48, 4.675),
        (2.0, 2.836, 0.62, 4.216),
        (5.0, 2.955, 0.71, 4.039),
    ] {
        let patch = patch(1.0, [1.0, b_over_a], 0.0);
        let (own_first, own_limit) = (patch.bounds().first_yield(), patch.bounds().shakedown_limit());
        println!("b/a {b_over_a}: {own_first:?} {own_limit:?}");
        assert!((own_first.ratio / first - 1.0).abs() < 3e-4, "b/a {b_over_a}: {own_first:?}");
        assert!((own_first.depth_over_a - depth).abs() < 0.01, "b/a {b_over_a}: {own_first:?}");
        assert!((own_limit.ratio / limit - 1.0).abs() < 3e-4, "b/a {b_over_a}: {own_limit:?}");
    }
    let sliding = patch(1.0, [1.0, 1.0], 0.1).bounds().shakedown_limit();
    assert!((sliding.ratio / 4.654 - 1.0).abs() < 3e-4, "{sliding:?}");
}

/// Ellipses with friction against an independent quadrature of point forces, in the whole section
/// and in the middle plane alone. At the surface of an ellipse that is no circle the quadrature is
/// extrapolated; its README estimates 0.5 % there, and 1 % of first yield.
#[test]
fn limits_of_sliding_ellipses_lie_in_the_middle() {
    let table = include_str!("../../../../../verification/point-contact-limits/limits.csv");
    let rows = table.lines().filter(|line| !line.starts_with(['#', 'b']));
    let rows: Vec<Vec<f64>> = rows.map(|row| row.split(',').map(|v| v.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 15);
    for row in rows {
        let [b_over_a, friction, first, first_depth, limit, limit_depth] = row[..6] else {
            panic!("{row:?}")
        };
        let patch = patch(1.0, [1.0, b_over_a], friction);
        let near = |value: f64, want: f64, depth: f64, surface: f64| {
            let accepted = if depth == 0.0 { surface } else { 5e-4 };
            assert!((value / want - 1.0).abs() < accepted, "{row:?}: {value}");
        };
        let [own_first, own_limit] = patch.bounds().in_the_middle();
        near(own_first.ratio, first, first_depth, 0.012);
        near(own_limit.ratio, limit, limit_depth, 5e-3);
        // Nothing beside the middle decides.
        let whole = [patch.bounds().first_yield(), patch.bounds().shakedown_limit()];
        for (middle, whole) in [own_first, own_limit].into_iter().zip(whole) {
            assert!((middle.ratio / whole.ratio - 1.0).abs() < 1e-5, "{row:?}: {middle:?} {whole:?}");
        }
    }
}

/// Without friction the limit is that of the alternating shear in vertical planes along the rail:
/// p0/k = p0 / max σ_xz.
#[test]
fn limit_without_friction_is_that_of_one_shear() {
    let patch = patch(1.0, [1.0, 1.0], 0.0);
    let mut largest = 0.0_f64;
    for i in 0..200 {
        for l in 1..60 {
            let stress = patch.stress.stress(0.01 * f64::from(i), 0.0, 0.02 * f64::from(l));
            largest = largest.max(stress.xz.abs());
        }
    }
    let limit = patch.bounds().shakedown_limit().ratio;
    // The places of the search are a hundredth of a apart, where the shear is flat.
    assert!((limit * largest - 1.0).abs() < 3e-4, "{limit} {largest}");
}

/// σ_xx of a long ellipse at 0.5 a below its middle differs from that of a line contact by these
/// shares of p0, numbers of an independent quadrature: so no ellipse is long enough to be a line.
#[test]
fn long_ellipses_are_no_lines() {
    let depth = 0.5_f64;
    // Johnson 1985, 4.49.
    let m = (1.0 + depth * depth).sqrt();
    let line = -((1.0 + 2.0 * depth * depth) / m - 2.0 * depth);
    for (b_over_a, difference) in [(5.0, 0.057), (20.0, 0.018), (333.0, 0.0012)] {
        let own = patch(1.0, [1.0, b_over_a], 0.0).stress.stress(0.0, 0.0, depth).xx;
        // Half a unit of the last digit, and the error of the quadrature of the ellipse.
        let allowed = if difference > 0.01 { 6e-4 } else { 1.2e-4 };
        assert!(((own - line).abs() - difference).abs() < allowed, "{b_over_a}: {own} {line}");
    }
}

/// One half of the rail and all of it: the same state, and in all of it one half is the mirror
/// image of the other.
#[test]
fn mirror_images() {
    let half = rail(patch(1300.0, [6.0, 6.0], 0.1));
    let mut whole = half.clone();
    whole.patches[0].symmetry = Symmetry::None;
    let [half, whole] = [half, whole].map(|rail| stabilised(&rail, COARSE, 2));
    let peak = whole.peak().unwrap().stress.largest();
    let (layers, rows) = (whole.grid()[2], whole.grid()[1]);
    let mut sides = 0.0_f64;
    for m in 1..rows {
        for l in 0..layers {
            let (one, other) = (whole.section[m * layers + l], whole.section[(rows - m) * layers + l]);
            sides = sides.max((one.stress - other.stress.across()).largest());
        }
    }
    // Round-off, through the iteration.
    assert!(sides < 1e-9 * peak, "{sides:e} of {peak}");
    for y in [0.0, 2.0, -2.0, 5.0] {
        for (one, other) in half.layers_at(y).iter().zip(whole.layers_at(y)) {
            let difference = (one.stress - other.stress).largest();
            assert!(difference < 1e-5 * peak, "{y}: {difference:e} of {peak}");
        }
    }
}

/// Circles 2 % on either side of the limit of elastic shakedown, which has four digits: the states
/// are those of the limit, and only beyond it does plastic strain alternate.
#[test]
fn states_on_both_sides_of_the_limit() {
    let limit = 4.675 * YIELD / 3f64.sqrt();
    let below = stabilised(&rail(patch(0.98 * limit, [6.0, 6.0], 0.0)), COARSE, 100);
    assert_eq!((below.state, below.alternating()), (RailState::ElasticShakedown, None));
    let above = stabilised(&rail(patch(1.02 * limit, [6.0, 6.0], 0.0)), COARSE, 100);
    assert_eq!(above.state, RailState::PlasticShakedown);
    let elastic = stabilised(&rail(patch(0.59 * limit, [6.0, 6.0], 0.0)), COARSE, 100);
    assert_eq!((elastic.state, elastic.passes.len()), (RailState::Elastic, 1));
    assert_eq!(elastic.peak().unwrap().stress.largest(), 0.0);
}

/// Largest difference of σ_xx and σ_yy below 0.06 a at three lateral places, over the peak.
fn difference(coarse: &StabilisedSpace, fine: &StabilisedSpace, [a, b]: [f64; 2]) -> f64 {
    let peak = fine.peak().unwrap().stress.largest();
    let mut most = 0.0_f64;
    for y in [0.0, 0.5 * b, b] {
        let there = fine.layers_at(y);
        for own in coarse.layers_at(y).iter().filter(|own| own.depth > 0.06 * a) {
            let next = there.partition_point(|layer| layer.depth < own.depth);
            let (Some(above), Some(below)) = (next.checked_sub(1).map(|i| there[i]), there.get(next)) else {
                continue;
            };
            let t = (own.depth - above.depth) / (below.depth - above.depth);
            let between = above.stress * (1.0 - t) + below.stress * t;
            let apart = own.stress - between;
            most = most.max(apart.xx.abs()).max(apart.yy.abs());
        }
    }
    most / peak
}

/// After two passages, of which the second changes the stress by a fifth: half as many columns,
/// rows and layers as by default, each alone.
#[test]
fn each_grid() {
    let rail = rail(patch(1300.0, [6.0, 6.0], 0.1));
    let usual = SpaceResolution::default();
    let fine = stabilised(&rail, usual, 2);
    for (name, resolution) in [
        ("columns", SpaceResolution { columns_per_half_width: 8, ..usual }),
        ("rows", SpaceResolution { rows_per_half_width: 6, ..usual }),
        ("layers", SpaceResolution { layers_per_half_width: 12, ..usual }),
    ] {
        let apart = difference(&stabilised(&rail, resolution, 2), &fine, [6.0, 6.0]);
        println!("{name}: {apart:.4}");
        // Measured 1.1 to 1.7 % of the peak; doubling the default ones changes 1 %.
        assert!(apart < 0.025, "{name}: {apart}");
    }
}

/// Twice the period along the rail, and twice that across it.
#[test]
fn each_period() {
    let rail = rail(patch(1300.0, [6.0, 6.0], 0.1));
    let usual = stabilised(&rail, COARSE, 1);
    for (name, resolution, doubled) in [
        ("along", SpaceResolution { period: 16, ..COARSE }, 0),
        ("across", SpaceResolution { lateral_period: 16, ..COARSE }, 1),
    ] {
        let longer = stabilised(&rail, resolution, 1);
        assert_eq!(longer.grid()[doubled], 2 * usual.grid()[doubled], "{name}");
        let apart = difference(&longer, &usual, [6.0, 6.0]);
        println!("{name}: {apart:.5}");
        assert!(apart > 0.0 && apart < 0.005, "{name}: {apart}");
    }
}

/// Largest difference of stress (MPa) and of plastic strain between two sections on one grid.
fn apart(one: &StabilisedSpace, other: &StabilisedSpace) -> [f64; 2] {
    assert_eq!(one.grid(), other.grid());
    let both = one.section.iter().zip(&other.section);
    both.fold([0.0; 2], |[stress, strain], (a, b)| {
        [f64::max(stress, (a.stress - b.stress).largest()), f64::max(strain, (a.strain - b.strain).largest())]
    })
}

/// A wheel far below first yield changes nothing that a heavy one has left, though it runs the
/// other way: to round-off, signs of the shears included.
#[test]
fn a_light_wheel_leaves_the_rail_as_it_is() {
    let heavy = patch(1300.0, [6.0, 6.0], 0.1);
    let light = RolledPatch { travel: Travel::Backward, ..patch(300.0, [6.0, 6.0], -0.1) };
    let alone = stabilised(&rail(heavy.clone()), COARSE, 1);
    let both = RailInSpace { patches: vec![heavy.clone(), light], ..rail(heavy) };
    let both = stabilised(&both, COARSE, 2);
    assert_eq!(both.passes[1].plastic_path, 0.0);
    let ([stress, strain], peak) = (apart(&alone, &both), alone.peak().unwrap().stress.largest());
    assert!(stress < 1e-9 * peak && strain < 1e-14, "{stress:e} of {peak}, {strain:e}");
    assert!(alone.section.iter().any(|layer| layer.strain.xz.abs() > 1e-4));
}

/// Wheels alike in turn are one wheel: to what the iteration within a passage leaves.
#[test]
fn wheels_alike_in_turn_are_one() {
    let own = patch(1300.0, [6.0, 6.0], 0.1);
    let one = stabilised(&rail(own.clone()), COARSE, 4);
    let two = RailInSpace { patches: vec![own.clone(), own.clone()], ..rail(own) };
    let two = stabilised(&two, COARSE, 4);
    let ([stress, _], peak) = (apart(&one, &two), one.peak().unwrap().stress.largest());
    // 1e-5 of the yield strain in each passage.
    assert!(stress < 1e-3 * peak, "{stress} of {peak}");
    assert_eq!(two.cycles.len(), 2);
}

/// Two wheels that run beside each other leave a stress on both sides; the lateral places are those
/// of the wheels.
#[test]
fn each_wheel_rolls_at_its_lateral_place() {
    let own = patch(1300.0, [6.0, 6.0], 0.0);
    let at = |lateral: f64| {
        let wheel = EllipticWheel {
            peak_pressure: 1300.0,
            half_width: 6.0,
            lateral_half_width: 6.0,
            lateral,
            friction: 0.0,
            lateral_friction: 0.0,
        };
        let stress = move |x: f64, y: f64, depth: f64| Tensor::of(wheel.stress(0.0, [x, y, depth], POISSON));
        RolledPatch { lateral, stress: Arc::new(stress), ..own.clone() }
    };
    let one = stabilised(&rail(own.clone()), COARSE, 1);
    let two = RailInSpace { patches: vec![at(-12.0), at(12.0)], ..rail(own.clone()) };
    let two = stabilised(&two, COARSE, 2);
    let depth = one.peak().unwrap().depth;
    let strain = |state: &StabilisedSpace, y: f64| {
        let layers = state.layers_at(y);
        let below = layers.iter().find(|layer| layer.depth >= depth).unwrap();
        below.strain.equivalent()
    };
    let alone = strain(&one, 0.0);
    for y in [-12.0, 12.0] {
        // Four half-widths apart the stress that the first wheel leaves changes the flow under the
        // second one by 6 %.
        let own = strain(&two, y);
        assert!((own / alone - 1.0).abs() < 0.1, "{y}: {own} of {alone}");
    }
    assert!(strain(&two, 0.0) < 0.1 * alone);
}

/// The same bits on any number of threads.
#[test]
fn threads_do_not_change_the_state() {
    let rail = rail(patch(1300.0, [6.0, 6.0], 0.1));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| stabilised(&rail, COARSE, 2))
    };
    assert_eq!(on(1), on(2));
}
