//! Contacts of profiles.

use super::*;
use crate::load::{HertzEllipse, WheelOnRail};
use crate::material::IsotropicElastic;

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

/// An arc of the radius `radius` (mm) from `from` to `to` (y, mm), highest at y = 0.
fn arc(radius: f64, from: f64, to: f64) -> Vec<[f64; 2]> {
    let count = ((to - from) / 0.2).round() as usize;
    let y = |i: usize| from + (to - from) * i as f64 / count as f64;
    (0..=count).map(|i| [y(i), radius - (radius * radius - y(i) * y(i)).sqrt()]).collect()
}

/// A straight wheel profile that falls by `slope` towards +y.
fn straight(slope: f64) -> Vec<[f64; 2]> {
    (-200..=200).map(|i| [0.25 * f64::from(i), slope * 0.25 * f64::from(i)]).collect()
}

fn smoothed(points: &[[f64; 2]]) -> Profile {
    Profile::smoothed(points, 1.0).unwrap()
}

fn contacts(rail: &Profile, wheel: &Profile, position: WheelPosition, normal: f64) -> Vec<ProfileContact> {
    let pair = ProfilePair { rail, wheel, radius: 460.0, position, steel: &steel() };
    pair.contacts(normal).unwrap()
}

fn near(got: f64, want: f64, relative: f64) {
    assert!((got / want - 1.0).abs() < relative, "{got}, {want}");
}

#[test]
fn arcs_are_a_hertz_contact() {
    for radius in [300.0, 80.0] {
        let (rail, wheel) = (smoothed(&arc(radius, -35.0, 35.0)), smoothed(&straight(0.0)));
        let found = contacts(&rail, &wheel, WheelPosition::default(), 85e3);
        let [one] = found[..] else { panic!("{} patches", found.len()) };
        let want = HertzEllipse::new(
            &WheelOnRail {
                wheel_load: 85e3,
                wheel_radius: 460.0,
                rail_head_radius: radius,
                wheel_profile_radius: f64::INFINITY,
            },
            &steel(),
        )
        .unwrap();
        // The grid of 0.05 mm across, on which the ends of the patch lie.
        near(one.ellipse.peak_pressure, want.peak_pressure, 2e-3);
        near(one.ellipse.along, want.along, 2e-3);
        near(one.ellipse.across, want.across, 4e-3);
        near(one.area, std::f64::consts::PI * want.along * want.across, 4e-3);
        near(one.normal_force, 85e3, 1e-9);
        assert!(one.y.abs() < 0.05 && one.angle.abs() < 1e-3 && one.ahead == 0.0);
        let half = one.outline.half_length(0.6 * want.across);
        near(half, 0.8 * want.along, 4e-3);
    }
}

#[test]
fn yaw_moves_the_contact_ahead() {
    // On a cone of slope −γ, a wheel turned by ψ touches R γ ψ ahead (small angles).
    let (rail, wheel) = (smoothed(&arc(300.0, -35.0, 35.0)), smoothed(&straight(-0.05)));
    let position = WheelPosition { yaw: 0.02, ..WheelPosition::default() };
    let found = contacts(&rail, &wheel, position, 85e3);
    near(found[0].ahead, 460.0 * 0.05 * 0.02, 0.02);
    near(found[0].angle, -0.05, 0.02);
    near(found[0].y, -0.05 * 300.0, 0.02);
}

#[test]
fn two_patches_share_the_load() {
    // A wheel that follows the head but for a hollow touches it 12 mm to either side.
    let away = |[y, z]: [f64; 2]| [y, z - 2e-3 * (y.abs() - 12.0).powi(2)];
    let hollow: Vec<[f64; 2]> = arc(80.0, -25.0, 25.0).into_iter().map(away).collect();
    let (rail, wheel) = (smoothed(&arc(80.0, -35.0, 35.0)), smoothed(&hollow));
    let found = contacts(&rail, &wheel, WheelPosition::default(), 85e3);
    let [left, right] = found[..] else { panic!("{} patches", found.len()) };
    near(left.normal_force + right.normal_force, 85e3, 1e-9);
    near(left.normal_force, right.normal_force, 1e-3);
    near(-left.y, right.y, 1e-3);
    near(right.y, 12.0, 0.02);
}

#[test]
fn mirrored_profiles_have_mirrored_patches() {
    let [rail, wheel] = standard();
    let flip =
        |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().rev().map(|[y, z]| [-y, *z]).collect() };
    let position = WheelPosition { shift: -8.0, yaw: 0.005, roll: 1e-3 };
    let mirrored = WheelPosition { shift: 8.0, yaw: -0.005, roll: -1e-3 };
    let one = contacts(&smoothed(&rail), &smoothed(&wheel), position, 60e3);
    let other = contacts(&smoothed(&flip(&rail)), &smoothed(&flip(&wheel)), mirrored, 60e3);
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(other.iter().rev()) {
        assert!((one.y + other.y).abs() < 0.02, "{} {}", one.y, other.y);
        near(other.ellipse.peak_pressure, one.ellipse.peak_pressure, 2e-3);
        near(other.ahead, one.ahead, 2e-3);
    }
}

#[test]
fn smoothing_removes_the_scatter_of_measured_points() {
    // Points 0.2 mm apart with an error of ±5 µm from point to point.
    let mut points = arc(80.0, -35.0, 35.0);
    for (i, point) in points.iter_mut().enumerate() {
        point[1] += 5e-3 * (2.0 * (0.618_033_988_749_895 * i as f64).fract() - 1.0);
    }
    let wheel = smoothed(&straight(0.0));
    let exact = contacts(&smoothed(&arc(80.0, -35.0, 35.0)), &wheel, WheelPosition::default(), 85e3)[0];
    let peak = |half_length: f64| {
        let rail = Profile::smoothed(&points, half_length).unwrap();
        contacts(&rail, &wheel, WheelPosition::default(), 85e3)
            .iter()
            .map(|own| own.ellipse.peak_pressure)
            .fold(0.0, f64::max)
    };
    near(peak(3.0), exact.ellipse.peak_pressure, 0.02);
    // Unsmoothed, the scatter shows.
    assert!((peak(0.3) / exact.ellipse.peak_pressure - 1.0).abs() > 0.03, "{}", peak(0.3));
}

/// The profiles of the Manchester benchmark, from their definitions: the rail UIC 60 at 1:40, arcs
/// of 300, 80 and 13 mm that meet 10.475 and 26 mm from its middle, and the wheel S1002 (EN 13715)
/// up to its flange.
fn standard() -> [Vec<[f64; 2]>; 2] {
    let inclination = (1.0f64 / 40.0).atan();
    let [top_y, top_z] = upright_rail(inclination);
    let (sin, cos) = inclination.sin_cos();
    let rail = |i: i32| {
        let angle = 1.5 * f64::from(i) / 1600.0;
        let [y, z] = upright_rail(angle);
        let (y, z) = (y - top_y, z - top_z);
        [cos * y + sin * z, cos * z - sin * y]
    };
    let wheel = |i: i32| {
        let y = -38.4 + 0.25 * f64::from(i);
        [y, s1002(y)]
    };
    [(-1600..=1600).map(rail).collect(), (0..=390).map(wheel).collect()]
}

/// The point of the upright head where its tangent falls by `angle` towards +y.
fn upright_rail(angle: f64) -> [f64; 2] {
    let (mut centre, mut radius) = ([0.0, 300.0], 300.0);
    for (end, following) in [(10.475, 80.0), (26.0, 13.0)] {
        let last = f64::asin((end - centre[0]) / radius);
        if angle.abs() <= last {
            break;
        }
        let away: f64 = radius - following;
        centre = [centre[0] + away * last.sin(), centre[1] - away * last.cos()];
        radius = following;
    }
    let y = centre[0] + radius * angle.abs().sin();
    [y.copysign(angle), centre[1] - radius * angle.cos()]
}

fn s1002(y: f64) -> f64 {
    let sum = |terms: &[f64]| terms.iter().rev().fold(0.0, |sum, term| sum * y + term);
    if y >= 32.15796 {
        1.364_323_640 - 0.066_666_667 * y
    } else if y >= -26.0 {
        sum(&[
            0.0,
            -3.358_537_058e-2,
            1.565_681_624e-3,
            -2.810_427_944e-5,
            5.844_240_864e-8,
            -1.562_379_023e-8,
            5.309_217_349e-15,
            -5.957_839_843e-12,
            2.646_656_573e-13,
        ])
    } else if y >= -35.0 {
        sum(&[
            -4.320_221_063e3,
            -1.038_384_026e3,
            -1.065_501_873e2,
            -6.051_367_875,
            -2.054_332_446e-1,
            -4.169_739_389e-3,
            -4.687_195_829e-5,
            -2.252_755_540e-7,
        ])
    } else {
        16.446 - (13.0f64 * 13.0 - (y + 26.210_665).powi(2)).sqrt()
    }
}

/// A wheelset position of the benchmark, case on the right rail, and the patch that CONTACT
/// computes with its full theory.
struct Published {
    /// Lateral displacement (mm), roll and yaw (rad) of the wheelset.
    wheelset: [f64; 3],
    normal: f64,
    y: f64,
    angle: f64,
    approach: f64,
    peak: f64,
}

/// `mbench_a22_right.ref_out` of CONTACT, revision 2707 (E. Vollebregt, 2025): wheelset, FN,
/// YCP(R), DELTCP(TR), APPROACH, PMAX.
const PUBLISHED: [Published; 10] = [
    row([0.0, 0.0, 0.0], [9997.0, -8.6600, -0.0290, 1.596e-2, 338.3]),
    row([0.5, -2.304e-5, 1.2e-3], [9870.0, -16.0300, -0.0568, 1.948e-2, 632.5]),
    row([1.0, -5.049e-5, 2.4e-3], [9827.0, -18.5418, -0.0696, 2.448e-2, 741.3]),
    row([2.0, -1.128e-4, 4.8e-3], [9799.0, -19.6178, -0.0806, 2.480e-2, 744.8]),
    row([3.0, -1.803e-4, 7.2e-3], [9774.0, -20.5627, -0.0923, 2.439e-2, 713.2]),
    row([4.0, -2.557e-4, 9.6e-3], [9745.0, -21.7944, -0.1078, 2.370e-2, 664.4]),
    row([4.5, -2.977e-4, 1.08e-2], [9726.0, -22.6421, -0.1185, 2.310e-2, 625.5]),
    row([5.0, -3.554e-4, 1.2e-2], [9619.0, -33.4470, -0.2905, 2.719e-2, 1556.0]),
    row([5.5, -4.777e-4, 1.32e-2], [9629.0, -34.4157, -0.3363, 2.926e-2, 1486.0]),
    row([6.0, -6.272e-4, 1.44e-2], [9709.0, -35.3954, -0.4176, 2.728e-2, 1149.0]),
];

const fn row(wheelset: [f64; 3], [normal, y, angle, approach, peak]: [f64; 5]) -> Published {
    Published { wheelset, normal, y, angle, approach, peak }
}

/// Errors of the fast theory, largest where the radius of the head changes from 80 to 13 mm within
/// the patch, and for the long conformal patches at 0 and 0.5 mm: of pressure and approach, place
/// (mm) and angle (rad).
const PRESSURE: f64 = 0.13;
const APPROACH: f64 = 0.25;
const PLACE: f64 = 2.5;
const TILT: f64 = 0.025;

impl Published {
    /// The place of the wheel's profile: its origin 750 mm from the middle of the wheelset, that of
    /// the rail 760.5326 mm from the middle of the track (1435 mm, 14 mm below the top), and the
    /// roll about the axle, 460 mm above.
    fn position(&self) -> WheelPosition {
        let [shift, roll, yaw] = self.wheelset;
        WheelPosition { shift: 750.0 + shift - 760.5326 - 460.0 * roll, yaw, roll }
    }

    fn contacts(&self) -> Vec<ProfileContact> {
        // CONTACT's example: G = 82 GPa, ν = 0.28.
        let steel = IsotropicElastic::new(2.0 * 82e3 * 1.28, 0.28).unwrap();
        let [rail, wheel] = standard().map(|points| Profile::smoothed(&points, 0.5).unwrap());
        let pair = ProfilePair {
            rail: &rail,
            wheel: &wheel,
            radius: 460.0,
            position: self.position(),
            steel: &steel,
        };
        pair.contacts(self.normal).unwrap()
    }
}

#[test]
fn the_manchester_benchmark() {
    for published in &PUBLISHED {
        let found = published.contacts();
        let main = found.iter().max_by(|a, b| a.normal_force.total_cmp(&b.normal_force)).unwrap();
        near(main.ellipse.peak_pressure, published.peak, PRESSURE);
        near(main.approach, published.approach, APPROACH);
        assert!((main.y - published.y).abs() < PLACE && (main.angle - published.angle).abs() < TILT);
    }
}

#[test]
fn refused() {
    let (rail, wheel) = (smoothed(&arc(300.0, -35.0, 35.0)), smoothed(&straight(0.0)));
    let says = |position: WheelPosition, normal: f64| {
        let pair = ProfilePair { rail: &rail, wheel: &wheel, radius: 460.0, position, steel: &steel() };
        pair.contacts(normal).unwrap_err().to_string()
    };
    let aside = WheelPosition { shift: 120.0, ..WheelPosition::default() };
    assert!(says(aside, 1e4).contains("the wheel is not above the rail head"));
    let at_end = WheelPosition { shift: 60.0, ..WheelPosition::default() };
    assert!(says(at_end, 1e4).contains("at the end of one of the profiles"));
    assert!(says(WheelPosition::default(), 0.0).contains("normal force (N) = 0"));
    assert!(says(WheelPosition::default(), 1e12).contains("no approach up to 1 mm"));
    assert!(Profile::smoothed(&arc(300.0, -35.0, 35.0), 0.0).unwrap_err().to_string().contains("positive"));
}
