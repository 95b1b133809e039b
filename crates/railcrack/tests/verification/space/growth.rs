//! Growth in space by the loop of the plane: mixes of wheels, wear, resumed runs.

use crate::common::{Of, Relative, close, steel};
use railcrack::growth::{
    Axles, FrontDeviation, FrontShape, FrontTurns, Grinding, Growth, GrowthError, GrowthSettings,
    GrowthState, NetworkContact, PassageSettings, StepRecord, StressMoves, SurfaceRemoval, Unobserved,
};
use railcrack::load::Passage;
use railcrack::math::RailBox;
use railcrack::space::{EllipticWheel, SpaceRail, SpaceResolution, SpaceWheel, WheelPatch};

fn shape() -> FrontShape {
    FrontShape {
        dip: 30f64.to_radians(),
        strike: 0.0,
        length: 4.0,
        half_length: 5.0,
        middle: [0.0, 0.0],
        buried: None,
        strip: None,
        turns: None,
        deviation: None,
    }
}

/// A wheel at `lateral` (mm) with a `share` of the axles.
fn wheel(lateral: f64, share: f64) -> SpaceWheel {
    SpaceWheel {
        wheel: EllipticWheel {
            peak_pressure: 845.0,
            half_width: 6.0,
            lateral_half_width: 5.0,
            lateral,
            friction: -0.3,
            lateral_friction: 0.0,
        }
        .into(),
        share,
        bending: None,
        residual: None,
        fluid: None,
        passages: PassageSettings {
            passage: Passage { from: -18.0, to: 18.0, positions: 21 },
            ..PassageSettings::default()
        },
        toughness: None,
    }
}

fn rail(wheels: Vec<SpaceWheel>, friction: f64, wear: f64) -> SpaceRail {
    let maintenance = SurfaceRemoval { wear, stress: StressMoves::WithSurface, ..SurfaceRemoval::NONE };
    SpaceRail {
        network: NetworkContact::Whole,
        standing: None,
        steel: steel(),
        wheels,
        friction: vec![friction],
        resolution: SpaceResolution::new(2, 2),
        growth: GrowthSettings { steps: 2, maintenance: Some(maintenance), ..GrowthSettings::default() },
        mode_3_weight: None,
        fields: None,
        rail: RailBox::default(),
        kernel: None,
    }
}

/// A head check that has turned down: 3 mm at 25°, then a branch of 2 mm at 70°.
fn folded() -> FrontShape {
    let turns = Some(FrontTurns::fold(3.0, 45f64.to_radians()));
    FrontShape { dip: 25f64.to_radians(), length: 2.0, strip: Some(3.0), turns, ..shape() }
}

fn run(rail: SpaceRail) -> Vec<StepRecord> {
    run_of(rail, shape())
}

fn run_of(rail: SpaceRail, shape: FrontShape) -> Vec<StepRecord> {
    let mut growth = Growth::new(rail, GrowthState::initial_in_space(vec![shape]).unwrap());
    std::iter::from_fn(|| growth.next_step(&Unobserved).unwrap()).collect()
}

/// The shape of the only crack in a step.
fn shape_in(step: &StepRecord) -> FrontShape {
    step.geometry.space().unwrap().shapes[0]
}

fn lengths(steps: &[StepRecord]) -> Vec<f64> {
    steps.iter().flat_map(|step| step.geometry.lengths()).collect()
}

#[test]
fn a_mix_of_equal_wheels_is_the_wheel() {
    let one = run(rail(vec![wheel(1.0, 1.0)], 0.2, 0.0));
    let two = run(rail(vec![wheel(1.0, 0.3), wheel(1.0, 0.7)], 0.2, 0.0));
    assert_eq!((one.len(), two.len()), (3, 3));
    for (a, b) in one.iter().zip(&two) {
        // Later cracks differ by round-off, and their jumps by the tolerance of the contact.
        let allowed = if a.step == 0 { 1e-12 } else { 1e-6 };
        close(b.load_cycles, a.load_cycles, Of(allowed, a.load_cycles.max(1.0)), "0.3 r + 0.7 r");
        for (a, b) in a.tips.iter().zip(&b.tips) {
            close(b.rate, a.rate, Relative(allowed), "0.3 r + 0.7 r");
        }
        assert_eq!(b.other_wheels.len(), 1);
    }
    for (a, b) in lengths(&one).into_iter().zip(lengths(&two)) {
        close(b, a, Relative(1e-12), "the same path");
    }
}

#[test]
fn wheels_on_both_sides_of_the_crack_grow_it_alike() {
    // One is the mirror image of the other, and so are their parts of the front.
    let steps = run(rail(vec![wheel(2.0, 0.5), wheel(-2.0, 0.5)], 0.2, 0.0));
    let tips = &steps[0].tips;
    for (left, right) in tips.iter().zip(tips.iter().rev()) {
        close(left.rate, right.rate, Relative(1e-6), "mirrored passages, tolerance of the contact 1e-8");
        let shares = [left.shares.values()[0], right.shares.values()[1]];
        close(shares[0], shares[1], Relative(1e-6), "mirrored passages");
    }
    // Each grows the part of the front that is nearer to it, the first the end of larger z.
    assert!(tips[1].shares.values()[0] != tips[1].shares.values()[1]);
}

#[test]
fn without_friction_one_passage_is_enough() {
    let steps = run(rail(vec![wheel(0.0, 1.0)], 0.0, 0.0));
    assert!(steps.iter().all(|step| step.passages.len() == 1 && step.counts.passages == 1));
    let steps = run(rail(vec![wheel(0.0, 1.0)], 0.2, 0.0));
    assert!(steps.iter().all(|step| step.passages.len() > 1));
}

#[test]
fn wear_takes_from_the_mouth_what_it_takes_from_the_surface() {
    let free = run(rail(vec![wheel(0.0, 1.0)], 0.2, 0.0));
    let wear = 1e-7;
    let worn = run(rail(vec![wheel(0.0, 1.0)], 0.2, wear));
    // Growth sets the pace in both: the first step has the same increment and the same cycles by
    // the rate at its start.
    assert!(free[1].removed == 0.0 && worn[1].removed > 0.0);
    let taken = lengths(&free)[1] - lengths(&worn)[1];
    close(taken, worn[1].removed / 30f64.to_radians().sin(), Relative(1e-9), "w/sin(dip)");
}

#[test]
fn a_free_front_with_two_harmonics_is_an_ellipse() {
    let buried = FrontShape { length: 1.5, half_length: 2.5, buried: Some(4.0), ..shape() };
    for shape in [shape(), buried, folded()] {
        let of = |shape| {
            let mut rail = rail(vec![wheel(1.5, 1.0)], 0.0, 0.0);
            rail.growth.steps = 1;
            run_of(rail, shape)
        };
        let ellipses = of(shape);
        let free = of(FrontShape { deviation: FrontDeviation::none(2), ..shape });
        for (want, got) in ellipses.iter().zip(&free) {
            let cycles = want.load_cycles.max(1.0);
            close(got.load_cycles, want.load_cycles, Of(1e-6, cycles), "the same motions");
            let [want, got] = [want, got].map(shape_in);
            for (want, got) in [
                (want.length, got.length),
                (want.half_length, got.half_length),
                (want.middle[1], got.middle[1]),
                (want.buried.unwrap_or(0.0), got.buried.unwrap_or(0.0)),
                (0.0, got.deviation.unwrap().largest()),
            ] {
                close(got, want, Of(1e-6, 1.0), "the same motions");
            }
        }
        assert!(shape_in(&free[1]).half_length > 1.001 * shape.half_length, "it grows along the surface");
    }
}

#[test]
fn a_free_front_under_wear_keeps_its_deepest_point() {
    let shape = FrontShape { deviation: FrontDeviation::none(4), ..shape() };
    let [free, worn] = [0.0, 1e-7].map(|wear| run_of(rail(vec![wheel(0.0, 1.0)], 0.2, wear), shape));
    let [grown, left] = [&free[1], &worn[1]].map(shape_in);
    let taken = worn[1].removed / 30f64.to_radians().sin();
    close(left.length, grown.length - taken, Relative(1e-9), "w/sin(dip)");
    assert!(left.deviation.unwrap().largest() > 1e-3 && left.half_length < grown.half_length);
}

#[test]
fn a_folded_crack_grows_alike_on_both_sides_of_its_middle() {
    let steps = run_of(rail(vec![wheel(2.0, 0.5), wheel(-2.0, 0.5)], 0.2, 0.0), folded());
    for step in &steps {
        // The sides of the strip have points at φ < 0 and φ > 180°, above the fold.
        let fold = 3.0 * 25f64.to_radians().sin();
        for (one, other) in step.tips.iter().zip(step.tips.iter().rev()) {
            close(one.rate, other.rate, Relative(1e-6), "mirrored passages, tolerance of the contact 1e-8");
            let (a, b) = (one.front().unwrap(), other.front().unwrap());
            close(a.phi + b.phi, std::f64::consts::PI, Of(1e-12, 1.0), "points face each other");
            assert_eq!(a.phi < 0.0 || a.phi > std::f64::consts::PI, -one.y < fold - 1e-9, "{a:?}");
        }
    }
    let [first, last] = [&steps[0], &steps[2]].map(shape_in);
    assert!(last.length > first.length && last.half_length >= first.half_length, "{last:?}");
    assert_eq!((last.strip, last.dip), (first.strip, first.dip));
    close(last.middle[1], 0.0, Of(1e-6, 1.0), "mirrored passages");
    close(steps[2].tips[0].length, 3.0 + last.length, Of(1e-12, 1.0), "the way over the fold");
}

#[test]
fn wear_shortens_the_strip_of_a_folded_crack_and_then_its_branch() {
    let wear = 1e-7;
    let free = run_of(rail(vec![wheel(0.0, 1.0)], 0.2, 0.0), folded());
    let worn = run_of(rail(vec![wheel(0.0, 1.0)], 0.2, wear), folded());
    let [free, left] = [&free[1], &worn[1]].map(shape_in);
    close(left.length, free.length, Relative(1e-9), "the branch grows as without wear");
    let taken = worn[1].removed / 25f64.to_radians().sin();
    close(left.strip.unwrap(), 3.0 - taken, Of(1e-9, 1.0), "w/sin(dip of the strip)");
}

#[test]
fn grinding_takes_the_strip_of_a_folded_crack_and_then_its_branch() {
    let grinding = Some(Grinding { depth: 1.5, interval: Axles(1e4), first: None });
    let mut often = rail(vec![wheel(0.0, 1.0)], 0.2, 0.0);
    let maintenance = SurfaceRemoval { grinding, stress: StressMoves::WithSurface, ..SurfaceRemoval::NONE };
    often.growth = GrowthSettings { steps: 8, maintenance: Some(maintenance), ..often.growth };
    let steps = run_of(often, folded());
    let depth = |step: &StepRecord| step.tips.iter().map(|tip| -tip.y).fold(0.0, f64::max);
    // The fold is 1.27 mm deep.
    let unfolded = steps.iter().position(|step| shape_in(step).strip.is_none()).unwrap();
    let [before, after] = [&steps[unfolded - 1], &steps[unfolded]];
    let grown = before.tips.iter().map(|tip| tip.increment).fold(0.0, f64::max);
    let lost = depth(before) - depth(after);
    assert!(lost <= 1.5 + 1e-9 && lost > 1.5 - 1.01 * grown - 1e-9, "{lost} {grown}");
    let front = after.tips.iter().map(|tip| tip.front().unwrap().phi).fold(0.0, f64::min);
    assert_eq!((front, after.tips[0].y), (0.0, 0.0), "a planar crack");
    assert!(depth(steps.last().unwrap()) < 1.0, "{:?}", steps.last().map(depth));
}

/// A crack that turns, and its mirror image under wheels whose shear is turned round; without
/// friction between the faces the order of the positions does not matter.
#[test]
fn a_crack_turns_as_its_mirror_image_and_alike_on_both_sides() {
    let run = |dip: f64, friction: f64| {
        let mirrored = |lateral: f64| {
            let mut wheel = wheel(lateral, 0.5);
            if let WheelPatch::Ellipse(ellipse) = &mut wheel.wheel {
                ellipse.friction = friction;
            }
            wheel
        };
        let mut rail = rail(vec![mirrored(2.0), mirrored(-2.0)], 0.0, 0.0);
        rail.growth.turns_in_space = true;
        rail.growth.steps = 4;
        run_of(rail, FrontShape { dip, ..shape() })
    };
    let dip = 35f64.to_radians();
    let [one, other] = [run(dip, 0.3), run(std::f64::consts::PI - dip, -0.3)];
    assert!(one.len() == 5 && other.len() == 5, "{} {}", one.len(), other.len());
    for (a, b) in one.iter().zip(&other) {
        let [a, b] = [a, b].map(shape_in);
        close(a.path_length(), b.path_length(), Relative(1e-4), "mirrored loads, tolerance of load steps");
        close(a.front_dip() + b.front_dip(), std::f64::consts::PI, Of(2e-3, 1.0), "mirrored turns");
        close(a.middle[1], 0.0, Of(1e-6, 1.0), "mirrored passages");
    }
    let turned = shape_in(&one[4]).front_dip() - dip;
    assert!(turned.abs() > 0.02, "{turned}");
    let of_step = one[0].tips[0].front().unwrap().turn.unwrap();
    let first = shape_in(&one[1]).front_dip() - dip;
    close(-of_step, first, Of(1e-12, 1.0), "the turn of the record, positive as a kink");
}

#[test]
fn a_resumed_run_goes_on_with_the_same_bits() {
    resumes(shape(), false);
    resumes(folded(), true);
    resumes(FrontShape { deviation: FrontDeviation::none(4), ..folded() }, false);
}

fn resumes(shape: FrontShape, turns_in_space: bool) {
    let mix = || {
        let mut rail = rail(vec![wheel(1.0, 0.6), wheel(-1.0, 0.4)], 0.2, 1e-7);
        rail.growth.turns_in_space = turns_in_space;
        rail
    };
    let whole = run_of(mix(), shape);
    let mut state = GrowthState::initial_in_space(vec![shape]).unwrap();
    for want in &whole {
        let mut growth = Growth::new(mix(), state);
        let got = growth.next_step(&Unobserved).unwrap().unwrap();
        assert_eq!(
            (&got.tips, &got.geometry, got.load_cycles),
            (&want.tips, &want.geometry, want.load_cycles)
        );
        // Through the bytes of a checkpoint.
        let stored = postcard::to_stdvec(growth.state()).unwrap();
        state = postcard::from_bytes(&stored).unwrap();
    }
    assert!(state.ended.is_some());
}

#[test]
fn a_state_in_the_plane_is_refused() {
    let plane = GrowthState::initial(&crate::common::surface_crack(0.0, 4.0, 30.0).into());
    let mut growth = Growth::new(rail(vec![wheel(0.0, 1.0)], 0.2, 0.0), plane);
    let error = growth.next_step(&Unobserved).unwrap_err();
    assert!(matches!(error, GrowthError::Geometry { step: 0, .. }), "{error}");
}
