//! Joined cracks: one crack is the same however it is divided into pieces, branches have the K of
//! an independent computation, and branches without effect change nothing.

use crate::common::{
    Absolute, Of, Relative, Rolling, StepControl, TENSION, body, close, column, default_elements,
    joined_body, junction, largest, open_sifs, order, polyline, rows, sifs_of, steel, surface_crack,
};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, LoadPath, Newton, Stepper};
use railcrack::crack::{Crack, End, Junction};
use railcrack::math::{Stress, Vec2};
use std::f64::consts::PI;

/// So deep that the surface changes K by about (l/depth)² = 1e-6.
const DEEP: f64 = -4000.0;
/// Error of K of an open crack whose pieces have the default elements each.
const DISCRETE: f64 = 1e-4;
/// The same for a crack with as many elements in all.
const WHOLE: f64 = 2e-4;

/// Tension and shear.
const MIXED: Stress = Stress { yy: 1.0, xy: 0.5, ..Stress::ZERO };

/// A crack from −3 to 3 mm divided at x, its second piece walked one way or the other.
fn cut(x: f64, walk: End) -> (Vec<Crack>, Vec<Junction>) {
    let (at, tip) = ((x, DEEP), (3.0, DEEP));
    let second = if walk == End::First { polyline(&[at, tip]) } else { polyline(&[tip, at]) };
    (vec![polyline(&[(-3.0, DEEP), at]), second], vec![junction(1, walk, 0)])
}

#[test]
fn buried_crack_in_two_pieces() {
    let want = (3.0 * PI).sqrt();
    for x in [-2.0, 0.0, 0.7, 2.9] {
        for walk in [End::First, End::Last] {
            let (cracks, junctions) = cut(x, walk);
            let k = sifs_of(&joined_body(&cracks, &junctions, default_elements()), |_| MIXED);
            for tip in k.chunks_exact(2) {
                close(tip[0], want, Relative(DISCRETE), "two linear elements per √r and one at the cut");
                close(tip[1], 0.5 * want, Relative(DISCRETE), "in shear as in tension");
            }
        }
    }
    let errors = [24, 48, 96].map(|elements| {
        let (cracks, junctions) = cut(0.7, End::First);
        sifs_of(&joined_body(&cracks, &junctions, elements), |_| MIXED)[0] / want - 1.0
    });
    for pair in errors.windows(2) {
        assert!(order(pair[0], pair[1]) > 1.8, "order of convergence: {pair:?}");
    }
}

fn cut_surface_crack(degrees: f64, share: f64) -> (Vec<Crack>, Vec<Junction>) {
    let along = Vec2::unit(-degrees.to_radians());
    let (at, tip) = (along * (6.0 * share), along * 6.0);
    let pieces = [vec![Vec2::default(), at], vec![at, tip]];
    (pieces.map(|points| Crack::polyline(points).unwrap()).to_vec(), vec![junction(1, End::First, 0)])
}

#[test]
fn surface_crack_in_two_pieces() {
    for degrees in [15.0, 30.0, 90.0] {
        let fine = open_sifs(&[surface_crack(0.0, 6.0, degrees)], 192, |_| TENSION);
        for share in [0.1, 0.5, 0.9] {
            let (cracks, junctions) = cut_surface_crack(degrees, share);
            let k = sifs_of(&joined_body(&cracks, &junctions, default_elements()), |_| TENSION);
            for mode in [0, 1] {
                close(k[mode], fine[mode], Of(WHOLE, fine[0]), "against 192 elements in one piece");
            }
        }
    }
}

/// The passage of the wheel over the crack in two pieces: closed faces, friction, slip in both
/// directions.
#[test]
fn surface_crack_in_two_pieces_under_the_wheel() {
    for (degrees, friction, wheel) in [(15.0, 0.5, 0.025), (15.0, 0.1, 0.4), (60.0, 0.3, -0.2)] {
        let mut rolling = Rolling::over(vec![surface_crack(0.0, 6.0, degrees)], friction, wheel);
        rolling.steps = StepControl { tolerance: 5e-4, ..StepControl::default() };
        let whole = rolling.solve();
        let (cracks, junctions) = cut_surface_crack(degrees, 0.6);
        let body = joined_body(&cracks, &junctions, default_elements());
        let pieces = rolling.on(&FaceProblem::new(&body, &[friction; 2]).unwrap(), &Newton::default());
        let (k, want) = (&pieces.passages[0].sifs[0], &whole.passages[0].sifs[0]);
        let peak = largest(want.iter().flat_map(|k| [k.ki, k.kii]));
        let difference = largest(k.iter().zip(want).flat_map(|(a, b)| [a.ki - b.ki, a.kii - b.kii])) / peak;
        close(difference, 0.0, Absolute(3e-3), "discretisation error of either");
        let violation = pieces.counts.complementarity_max;
        close(violation, 0.0, Absolute(1e-9), "violation of the contact conditions");
    }
}

/// Arms of a case of `branched-cracks`: the first two form one crack, or are joined at their ends,
/// the others join it.
fn arms(tips: &[(f64, f64)]) -> (Vec<Crack>, Vec<Junction>) {
    let at = |&(x, y): &(f64, f64)| (x, y + DEEP);
    let mut cracks = vec![polyline(&[at(&tips[0]), (0.0, DEEP)])];
    let mut junctions = Vec::new();
    for (i, tip) in tips.iter().enumerate().skip(1) {
        cracks.push(polyline(&[(0.0, DEEP), at(tip)]));
        junctions.push(junction(i, End::First, 0));
    }
    (cracks, junctions)
}

/// Largest difference of K from the table over its largest K, by case.
fn branched_misfit(elements: usize) -> Vec<f64> {
    let table = rows("branched-cracks/factors.csv");
    let [case, stress, x, y, k1, k2] =
        ["case", "stress", "tip_x_mm", "tip_y_mm", "ki", "kii"].map(|name| column(&table, name));
    let stresses = [
        Stress { xx: 1.0, ..Stress::ZERO },
        Stress { yy: 1.0, ..Stress::ZERO },
        Stress { xy: 1.0, ..Stress::ZERO },
    ];
    let count = 1 + largest(case.iter().copied()) as usize;
    let mut misfits = vec![0.0f64; count];
    for number in 0..count {
        let of_case: Vec<usize> = (0..case.len()).filter(|&row| case[row] as usize == number).collect();
        let arms_of_case = of_case.iter().filter(|&&row| stress[row] == 0.0);
        let (cracks, junctions) = arms(&arms_of_case.map(|&row| (x[row], y[row])).collect::<Vec<_>>());
        let body = joined_body(&cracks, &junctions, elements);
        for (index, load) in stresses.into_iter().enumerate() {
            let of_load = of_case.iter().filter(|&&row| stress[row] as usize == index);
            let k = sifs_of(&body, |_| load);
            for (tip, &row) in k.chunks_exact(2).zip(of_load) {
                let difference = largest([tip[0] / PI.sqrt() - k1[row], tip[1] / PI.sqrt() - k2[row]]);
                misfits[number] = misfits[number].max(difference);
            }
        }
    }
    misfits
}

/// Line, cross, star and an unsymmetric branch against an independent computation, and the order in
/// the elements.
#[test]
fn branched_cracks() {
    let misfits = [24, 48, 96].map(branched_misfit);
    for case in 0..misfits[0].len() {
        let [coarse, middle, fine] = [0, 1, 2].map(|level: usize| misfits[level][case]);
        println!("case {case}: {coarse:.1e} {middle:.1e} {fine:.1e}");
        close(middle, 0.0, Absolute(2e-5), "linear elements, over K of the order of one");
        // The reference has five decimals.
        let orders = [order(coarse, middle), order(middle, fine)];
        assert!(orders[0] > 1.8 && (orders[1] > 1.8 || fine < 1e-5), "case {case}: orders {orders:.2?}");
    }
}

/// The directions in which the pieces are walked, and which of them joins which, have no effect.
#[test]
fn order_and_walk_of_the_arms() {
    let tips = [(-1.0, DEEP), (1.0, DEEP), (0.5, DEEP - 1.0)];
    let centre = (0.0, DEEP);
    let through = [polyline(&[tips[0], centre, tips[1]]), polyline(&[tips[2], centre])];
    let ends = [polyline(&[centre, tips[2]]), polyline(&[tips[1], centre]), polyline(&[centre, tips[0]])];
    let one = sifs_of(&joined_body(&through, &[junction(1, End::Last, 0)], 96), |_| MIXED);
    let other = [junction(0, End::First, 1), junction(2, End::First, 1)];
    let other = sifs_of(&joined_body(&ends, &other, 96), |_| MIXED);
    // Tips of `through`: first, last, and the last of the branch that is walked to the junction.
    for (a, b) in [(0, 2), (1, 1), (2, 0)] {
        for mode in [0, 1] {
            let reason = "the through crack has one parameter, its halves have two";
            close(one[2 * a + mode], other[2 * b + mode], Absolute(2.0 * DISCRETE), reason);
        }
    }
}

/// The work of a uniform traction on compatible jumps at the junction, summed over the nodes and
/// integrated over the faces: a translation of the part on one side of the whole crack, or between
/// the branch and one half of it.
#[test]
fn junction_conserves_tractions() {
    let branch = [(0.3, DEEP), (1.1, DEEP - 0.9)];
    let cracks = [polyline(&[(-1.0, DEEP), branch[0], (1.0, DEEP + 0.2)]), polyline(&branch)];
    let body = joined_body(&cracks, &[junction(1, End::First, 0)], default_elements());
    let stress = Stress { xx: -0.7, yy: 1.0, xy: 0.4, zz: 0.0 };
    let forces = body.faces.nodal_forces(|_| stress);
    let points = &body.faces.points;
    for moving in [[(0, 0), (0, 1)], [(0, 0), (1, 0)]] {
        let (mut nodes, mut faces) = (Vec2::default(), Vec2::default());
        for (crack, segment) in moving {
            let own = || {
                points
                    .iter()
                    .zip(forces.chunks_exact(2))
                    .filter(|(p, _)| (p.crack, p.segment) == (crack, segment))
            };
            for (point, f) in own() {
                nodes = nodes + point.tangent * f[0] + point.tangent.left() * f[1];
            }
            let (from, to) = cracks[crack].segment(segment);
            // Linear in √r to zero at the tip: a third of the last element is missing.
            let tip = if segment == 0 && crack == 0 { from } else { to };
            let last = own().map(|(point, _)| (point.position - tip).length()).fold(f64::INFINITY, f64::min);
            let length = (to - from).length();
            faces = faces + stress.traction((to - from).left()) * ((length - last / 3.0) / length);
        }
        close(
            (nodes - faces).length(),
            0.0,
            Of(1e-6, faces.length()),
            "√r is g up to the square of the last element",
        );
    }
}

/// σ_xx and σ_yy grow to `at` times these.
struct Growing<'a>(&'a CrackedBody, Stress);

impl LoadPath for Growing<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        self.0.faces.nodal_forces(|_| self.1 * at)
    }
}

/// A closed branch that sticks has no effect.
#[test]
fn closed_sticking_branch_has_no_effect() {
    let cracks =
        [polyline(&[(-3.0, DEEP), (0.5, DEEP), (3.0, DEEP)]), polyline(&[(0.5, DEEP), (0.2, DEEP - 2.0)])];
    let body = joined_body(&cracks, &[junction(1, End::First, 0)], default_elements());
    let problem = FaceProblem::new(&body, &[0.9; 2]).unwrap();
    let expected = vec![1e-4; problem.points()];
    let mut stepper = Stepper::new(&problem, &Newton::default(), 2e-3, &expected);
    let stress = Stress { xx: -5.0, yy: 1.0, xy: 0.0, zz: 0.0 };
    for station in [0.5, 1.0] {
        stepper.advance(&Growing(&body, stress), station, &mut |_, _| {}).unwrap();
    }
    let k = stepper.solution().sifs(&body, stepper.load());
    let want = (3.0 * PI).sqrt();
    for tip in [0, 1] {
        close(k[tip].ki, want, Of(WHOLE, want), "the crack without a branch");
        close(k[tip].kii, 0.0, Of(WHOLE, want), "no shear");
    }
    close(largest([k[2].ki, k[2].kii]), 0.0, Of(WHOLE, want), "nothing at the tip of the branch");
}

/// A branch changes K of the main tips by the square of its length.
#[test]
fn short_branch_vanishes() {
    let of_length = |length: f64| {
        let at = (0.8, DEEP);
        let branch = polyline(&[at, (0.8 + 0.5 * length, DEEP - length)]);
        let cracks = [polyline(&[(-3.0, DEEP), at, (3.0, DEEP)]), branch];
        sifs_of(&joined_body(&cracks, &[junction(1, End::First, 0)], 96), |_| MIXED)
    };
    let without = {
        let crack = polyline(&[(-3.0, DEEP), (0.8, DEEP), (3.0, DEEP)]);
        sifs_of(&body(&[crack], 96), |_| MIXED)
    };
    let change = |length: f64| {
        let k = of_length(length);
        largest((0..4).map(|i| k[i] - without[i])) / without[0]
    };
    let changes = [0.1, 0.01].map(change);
    assert!((3e-4..1e-3).contains(&changes[0]), "{changes:?}: a branch of a thirtieth has an effect");
    close(changes[1], 0.0, Of(0.02, changes[0]), "a hundredth, and finer elements around the junction");
    close(change(0.001), 0.0, Absolute(1e-5), "finer elements around the junction; 1.4e-6");
}

/// A tip that comes straight to a free crack, `gap` (mm) from it, or has joined it where there is
/// none.
fn coming(gap: f64) -> CrackedBody {
    let wall = polyline(&[(0.0, DEEP - 2.0), (0.0, DEEP + 0.5), (0.0, DEEP + 2.0)]);
    let cracks = [polyline(&[(-4.0, DEEP + 0.5), (-gap, DEEP + 0.5)]), wall];
    let junctions = [junction(0, End::Last, 1)];
    joined_body(&cracks, if gap > 0.0 { &[] } else { &junctions }, default_elements())
}

fn energy(body: &CrackedBody) -> f64 {
    let forces = body.faces.nodal_forces(|_| MIXED);
    let jumps = body.compliance.times(&forces);
    0.5 * jumps.iter().zip(&forces).map(|(w, f)| w * f).sum::<f64>()
}

/// The energy is continuous when the tip joins. A ligament h has a compliance like 1/ln(1/h), so
/// the inverse of the difference in energy from the joined cracks is linear in ln h. Half the
/// elements give the same steps to 0.3 %.
#[test]
fn energy_is_continuous_at_the_junction() {
    let joined = energy(&coming(0.0));
    let inverse = [0.08, 0.04, 0.02, 0.01].map(|gap| joined / (joined - energy(&coming(gap))));
    let steps: Vec<f64> = inverse.windows(2).map(|pair| pair[1] - pair[0]).collect();
    for step in &steps[..2] {
        close(*step, steps[2], Relative(0.03), "the next term decreases with h");
    }
}

/// Down to where the engine resolves it the energy release rate is that of K,
/// (K_I² + K_II²)/E′ = dE/da.
#[test]
fn energy_release_rate_of_an_approaching_tip() {
    for gap in [0.64, 0.16, 0.04, 0.02] {
        let change = energy(&coming(0.98 * gap)) - energy(&coming(1.02 * gap));
        let k = sifs_of(&coming(gap), |_| MIXED);
        let release = (k[2].powi(2) + k[3].powi(2)) / steel().plane_strain_modulus();
        close(
            change / (0.04 * gap),
            release,
            Relative(0.02),
            "K to 0.4 %, and the noise of another mesh over 0.04 h",
        );
    }
}

/// A crack from the right and one from the left that join the same wall, and a T that is its own
/// mirror image.
#[test]
fn mirrored_junctions() {
    let mirrored = |crack: &Crack| {
        Crack::polyline(crack.points().iter().map(|p| Vec2::new(-p.x, p.y)).collect()).unwrap()
    };
    let cracks = vec![
        polyline(&[(1.0, 0.0), (0.4, -2.0), (0.7, -4.0)]),
        polyline(&[(-2.5, -4.3), (0.7, -4.0), (3.0, -3.0)]),
    ];
    let junctions = [junction(0, End::Last, 1)];
    let reflected: Vec<Crack> = cracks.iter().map(mirrored).collect();
    let rolling = Rolling::over(vec![cracks[0].clone()], 0.3, 0.1);
    let mirror = Rolling { travel: -1.0, ..Rolling::over(vec![reflected[0].clone()], 0.3, -0.1) };
    let histories = |rolling: &Rolling, cracks: &[Crack]| {
        let body = joined_body(cracks, &junctions, default_elements());
        let result = rolling.on(&FaceProblem::new(&body, &[0.3; 2]).unwrap(), &Newton::default());
        let passage = &result.passages[result.passages.len() - 1];
        passage.sifs.iter().flatten().map(|k| (k.ki, k.kii)).collect::<Vec<_>>()
    };
    let (k, m) = (histories(&rolling, &cracks), histories(&mirror, &reflected));
    let peak = largest(k.iter().flat_map(|k| [k.0, k.1]));
    let difference = largest(k.iter().zip(&m).flat_map(|(a, b)| [a.0 - b.0, a.1 + b.1])) / peak;
    close(difference, 0.0, Absolute(1e-11), "round-off");
}
