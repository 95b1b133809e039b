//! The rail as a beam: its section, its bending on an elastic foundation, and its temperature.

use crate::material::IsotropicElastic;
use crate::math::OutOfRange;
use num_complex::Complex64 as Complex;

/// An axle of the train.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axle {
    /// Position relative to the wheel at x_c, mm along +x.
    pub at: f64,
    /// Q, load of one of its wheels, N.
    pub wheel_load: f64,
}

/// A rail on an elastic foundation under the axles of a train.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// The cross-section of the rail.
    pub section: RailSection,
    /// k, N/mm per mm of deflection of one rail, MPa.
    pub foundation: f64,
    /// The axles, at least one.
    pub axles: Vec<Axle>,
}

impl Track {
    /// Rejects an invalid section, a foundation modulus that is not positive, a track without
    /// axles, and axle loads that do not press on the rail.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.section.check()?;
        OutOfRange::unless_positive("foundation modulus k (N/mm\u{b2})", self.foundation)?;
        let count = self.axles.len();
        OutOfRange::unless(count > 0, "axles", count as f64, "one at least")?;
        for axle in &self.axles {
            OutOfRange::unless_finite("position of an axle (mm)", axle.at)?;
            OutOfRange::unless_positive("wheel load of an axle (N)", axle.wheel_load)?;
        }
        Ok(())
    }

    /// Bending of a rail of `steel` on this track. Errors: [`Track::check`].
    pub fn bending(&self, steel: &IsotropicElastic) -> Result<Bending, OutOfRange> {
        self.check()?;
        let beta = (0.25 * self.foundation / (steel.young() * self.section.second_moment)).sqrt().sqrt();
        Ok(Bending { track: self.clone(), beta })
    }
}

/// Euler's beam on Winkler's foundation: with s the distance from an axle,
///
/// M(s) = Q/(4β) e^(−β|s|) (cos β|s| − sin β|s|),  β = (k/(4 E I))^(1/4),
///
/// positive where the head is compressed: σ_xx = −M (h − d)/I at the depth d. Axles add.
///
/// Source: Timoshenko 1926; Esveld, Modern Railway Track, 5.4.
#[derive(Debug, Clone, PartialEq)]
pub struct Bending {
    track: Track,
    /// β, 1/mm.
    beta: f64,
}

/// βs beyond which e^(−βs) is less than round-off.
const NO_MORE: f64 = 40.0;

/// Terms of the series of the moment, and β times the largest distance for it: 1e-12 of its value.
const ORDER: usize = 10;
const OF_SERIES: f64 = 0.15;

impl Bending {
    /// The track.
    pub fn track(&self) -> &Track {
        &self.track
    }

    /// 1/β, mm.
    pub fn length(&self) -> f64 {
        1.0 / self.beta
    }

    /// M (N mm) at `x` (mm from x_c).
    pub fn moment(&self, x: f64) -> f64 {
        self.track.axles.iter().map(|axle| self.moment_of(axle, x)).sum()
    }

    fn moment_of(&self, axle: &Axle, x: f64) -> f64 {
        let s = self.beta * (x - axle.at).abs();
        if s > NO_MORE {
            return 0.0;
        }
        0.25 * axle.wheel_load / self.beta * (-s).exp() * (s.cos() - s.sin())
    }

    /// M (N mm) at each `x` (mm from x_c): where they are close together, by the series about the
    /// first of them under the axles that are beside all of them.
    pub fn moments(&self, x: &[f64]) -> Vec<f64> {
        let Some(&first) = x.first() else { return Vec::new() };
        let (least, most) = x.iter().fold((first, first), |(a, b), x| (a.min(*x), b.max(*x)));
        let is_near = self.beta * (most - first).max(first - least) <= OF_SERIES;
        let (beside, over): (Vec<&Axle>, Vec<&Axle>) =
            self.track.axles.iter().partition(|axle| is_near && !(least..=most).contains(&axle.at));
        let mut series = [0.0; ORDER];
        for axle in beside {
            // M = Q/(4β) Re (1 + i) e^((−1 + i) s), and s grows or falls with x.
            let s = self.beta * (first - axle.at);
            let scale = 0.25 * axle.wheel_load / self.beta * (-s.abs()).exp();
            let (sin, cos) = s.abs().sin_cos();
            let mut term = Complex::new(1.0, 1.0) * Complex::new(cos, sin) * scale;
            let step = Complex::new(-1.0, 1.0) * (self.beta * s.signum());
            for (power, coefficient) in series.iter_mut().enumerate() {
                *coefficient += term.re;
                term *= step / (power as f64 + 1.0);
            }
        }
        let at = |x: &f64| {
            let along = x - first;
            let beside = series.iter().rev().fold(0.0, |sum, coefficient| sum * along + coefficient);
            beside + over.iter().map(|axle| self.moment_of(axle, *x)).sum::<f64>()
        };
        x.iter().map(at).collect()
    }

    /// σ_xx (MPa) at `x` (mm from x_c) and `depth` (mm): linear through the height of the rail,
    /// zero below its foot.
    pub fn stress(&self, x: f64, depth: f64) -> f64 {
        self.stress_by(self.moment(x), depth)
    }

    /// σ_xx (MPa) at `depth` (mm) under a `moment` (N mm).
    pub fn stress_by(&self, moment: f64, depth: f64) -> f64 {
        let RailSection { second_moment, neutral_axis_depth, height } = self.track.section;
        if height.is_some_and(|height| depth > height) {
            return 0.0;
        }
        -moment * (neutral_axis_depth - depth.max(0.0)) / second_moment
    }

    /// Deflection w (mm, downwards) and its slope w′ at `x` (mm from x_c): w = Qβ/(2k) e^(−β|s|)
    /// (cos β|s| + sin β|s|).
    pub fn deflection(&self, x: f64) -> (f64, f64) {
        let of = |axle: &Axle| {
            let s = x - axle.at;
            let t = self.beta * s.abs();
            let scale = 0.5 * axle.wheel_load * self.beta / self.track.foundation * (-t).exp();
            (scale * (t.cos() + t.sin()), -2.0 * self.beta * scale * t.sin() * s.signum())
        };
        self.track.axles.iter().map(of).fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }
}

/// Temperature of a continuously welded rail: σ_xx = E α (T_neutral − T), tension in winter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Temperature {
    /// T, °C.
    pub rail: f64,
    /// T_neutral, at which the rail carries no axial force, °C.
    pub neutral: f64,
    /// α, 1/K.
    pub expansion: f64,
}

impl Temperature {
    /// α of rail steel, 1/K, as common in track engineering (1.15e-5 to 1.2e-5).
    pub const RAIL_STEEL_EXPANSION: f64 = 1.15e-5;

    /// Rejects temperatures that are not finite and an expansion that is not positive.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_finite("temperature of the rail (\u{b0}C)", self.rail)?;
        OutOfRange::unless_finite("neutral temperature (\u{b0}C)", self.neutral)?;
        OutOfRange::unless_positive("thermal expansion (1/K)", self.expansion)
    }

    /// σ_xx (MPa) in a rail of `steel`. A rail is free to contract sideways: σ_zz = 0.
    pub fn stress(&self, steel: &IsotropicElastic) -> f64 {
        steel.young() * self.expansion * (self.neutral - self.rail)
    }
}

/// Cross-section of a rail in bending.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailSection {
    /// I about the horizontal axis, mm⁴, positive.
    pub second_moment: f64,
    /// h, depth of the neutral axis below the running surface, mm, positive.
    pub neutral_axis_depth: f64,
    /// H, from the running surface to the foot, mm; none where it is not known.
    pub height: Option<f64>,
}

impl RailSection {
    /// Rejects a section without second moment or neutral-axis depth, and a neutral axis below the
    /// foot.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_positive("second moment of area (mm\u{2074})", self.second_moment)?;
        let depth = self.neutral_axis_depth;
        OutOfRange::unless_positive("depth of the neutral axis (mm)", depth)?;
        let inside = self.height.is_none_or(|height| depth < height);
        OutOfRange::unless(
            inside,
            "depth of the neutral axis (mm)",
            depth,
            "less than the height of the rail",
        )
    }
}

/// A rail section with a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedSection {
    /// The name in EN 13674-1.
    pub name: &'static str,
    /// Older names of the same section.
    pub aliases: &'static [&'static str],
    /// H, mm.
    pub height: f64,
    /// h, depth of the neutral axis below the running surface, mm.
    pub neutral_axis_depth: f64,
    /// Area, cm².
    pub area_cm2: f64,
    /// Width of the head, mm.
    pub head_width: f64,
    /// Width of the foot, mm.
    pub foot_width: f64,
    /// I, cm⁴.
    pub second_moment_cm4: f64,
    /// Section modulus of the head, cm³: I/W = h.
    pub head_modulus_cm3: f64,
    /// Section modulus of the foot, cm³: I/W = H − h.
    pub foot_modulus_cm3: f64,
}

/// The sections that are known by name. Source: EN 13674-1, annex of rail profiles, quoted from
/// memory; I/W_head = h and I/W_foot = H − h to 0.1 mm.
pub const SECTIONS: &[NamedSection] = &[
    NamedSection {
        name: "60E1",
        aliases: &["UIC60", "UIC 60"],
        height: 172.0,
        neutral_axis_depth: 91.05,
        area_cm2: 76.70,
        head_width: 72.0,
        foot_width: 150.0,
        second_moment_cm4: 3038.3,
        head_modulus_cm3: 333.6,
        foot_modulus_cm3: 375.5,
    },
    NamedSection {
        name: "54E1",
        aliases: &["UIC54", "UIC 54"],
        height: 159.0,
        neutral_axis_depth: 83.9,
        area_cm2: 69.77,
        head_width: 70.0,
        foot_width: 140.0,
        second_moment_cm4: 2337.9,
        head_modulus_cm3: 278.7,
        foot_modulus_cm3: 311.2,
    },
    NamedSection {
        name: "49E1",
        aliases: &["S49", "S 49"],
        height: 149.0,
        neutral_axis_depth: 75.6,
        area_cm2: 62.92,
        head_width: 67.0,
        foot_width: 125.0,
        second_moment_cm4: 1816.0,
        head_modulus_cm3: 240.3,
        foot_modulus_cm3: 247.5,
    },
];

impl NamedSection {
    /// The section called `name`, regardless of case.
    pub fn of(name: &str) -> Option<&'static Self> {
        let same = |other: &str| other.eq_ignore_ascii_case(name.trim());
        SECTIONS.iter().find(|section| same(section.name) || section.aliases.iter().any(|alias| same(alias)))
    }

    /// The data of its bending.
    pub fn section(&self) -> RailSection {
        RailSection {
            second_moment: 1e4 * self.second_moment_cm4,
            neutral_axis_depth: self.neutral_axis_depth,
            height: Some(self.height),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::NamedSection;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn track(foundation: f64, wheel_load: f64) -> Bending {
        let section = NamedSection::of("60E1").unwrap().section();
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        Track { section, foundation, axles: vec![Axle { at: 0.0, wheel_load }] }.bending(&steel).unwrap()
    }

    #[test]
    fn check_values_of_the_60e1() {
        // (k, Q) → 1/β (mm), M0 (kN m), σ at the top under the wheel, largest tension there: to the
        // digits given.
        let cases = [
            (50.0, 100e3, 845.2496, 21.13124, -63.3249, 13.1639),
            (30.0, 112.5e3, 960.389, 27.01094, -80.9448, 16.8268),
        ];
        for (foundation, load, length, moment, top, tension) in cases {
            let bending = track(foundation, load);
            assert!((bending.length() - length).abs() < 6e-4, "{}", bending.length());
            assert!((bending.moment(0.0) * 1e-6 - moment).abs() < 6e-6, "{}", bending.moment(0.0));
            assert!((bending.stress(0.0, 0.0) - top).abs() < 6e-5, "{}", bending.stress(0.0, 0.0));
            let at = FRAC_PI_2 * bending.length();
            for side in [-1.0, 1.0] {
                assert!(
                    (bending.stress(side * at, 0.0) - tension).abs() < 6e-5,
                    "{}",
                    bending.stress(at, 0.0)
                );
                let beside = |dx: f64| bending.stress(side * at + dx, 0.0);
                assert!(beside(1.0) < beside(0.0) && beside(-1.0) < beside(0.0), "largest at π/(2β)");
            }
        }
        assert!((FRAC_PI_2 * track(50.0, 100e3).length() - 1327.715).abs() < 6e-4);
    }

    #[test]
    fn the_foundation_carries_the_axles_and_the_moment_is_the_curvature() {
        let bending = track(50.0, 100e3);
        let (step, reach) = (1.0, 20.0 * bending.length());
        let points = (2.0 * reach / step) as usize;
        let at = |i: usize| -reach + step * (i as f64 + 0.5);
        let reaction: f64 = (0..points).map(|i| 50.0 * bending.deflection(at(i)).0 * step).sum();
        assert!((reaction / 100e3 - 1.0).abs() < 1e-6, "{reaction}"); // midpoint rule with a cusp, (β step)²
        let stiffness = 210e3 * bending.track().section.second_moment;
        for x in [-2000.0, -300.0, 10.0, 700.0] {
            let slope = (bending.deflection(x + 0.5).0 - bending.deflection(x - 0.5).0) / 1.0;
            assert!((slope - bending.deflection(x).1).abs() < 1e-9);
            let curvature = bending.deflection(x + 0.5).1 - bending.deflection(x - 0.5).1;
            assert!((-stiffness * curvature - bending.moment(x)).abs() < 1e-5 * bending.moment(0.0));
        }
    }

    #[test]
    fn axles_add_and_the_foot_has_the_other_sign() {
        let one = track(50.0, 100e3);
        let mut two = one.track().clone();
        two.axles.push(Axle { at: -1800.0, wheel_load: 60e3 });
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let bending = two.bending(&steel).unwrap();
        let sum = one.moment(40.0) + 0.6 * one.moment(1840.0);
        assert!((bending.moment(40.0) / sum - 1.0).abs() < 1e-14);
        assert_eq!(one.stress(5.0, one.track().section.neutral_axis_depth), 0.0);
        assert!(one.stress(0.0, 171.0) > 0.0 && one.stress(0.0, 173.0) == 0.0);
        assert!(one.moment(PI * one.length()).abs() < 0.05 * one.moment(0.0));
    }

    #[test]
    fn tracks_that_are_none_are_refused() {
        let good = track(50.0, 100e3).track().clone();
        let message = |track: Track| track.check().unwrap_err().to_string();
        assert!(
            message(Track { foundation: 0.0, ..good.clone() }).contains("k (N/mm²) = 0: must be positive")
        );
        assert!(message(Track { axles: vec![], ..good.clone() }).contains("axles = 0"));
        let pulling = vec![Axle { at: 0.0, wheel_load: -1.0 }];
        assert!(message(Track { axles: pulling, ..good.clone() }).contains("wheel load of an axle (N) = -1"));
        let section = RailSection { neutral_axis_depth: 200.0, ..good.section };
        assert!(message(Track { section, ..good }).contains("less than the height"));
    }

    #[test]
    fn thirty_kelvin_below_neutral() {
        let winter = Temperature { rail: -5.0, neutral: 25.0, expansion: Temperature::RAIL_STEEL_EXPANSION };
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        assert!((winter.stress(&steel) - 72.45).abs() < 1e-12);
        let nowhere = Temperature { rail: f64::NAN, ..winter };
        assert!(nowhere.check().unwrap_err().to_string().contains("must be finite"));
        assert!(Temperature { expansion: 0.0, ..winter }.check().is_err() && winter.check().is_ok());
    }

    #[test]
    fn moduli_second_moment_and_height_fit_each_other() {
        const TOLERANCE: f64 = 0.1; // mm: four digits of each
        for section in SECTIONS {
            let [above, below] = [section.head_modulus_cm3, section.foot_modulus_cm3]
                .map(|modulus| 10.0 * section.second_moment_cm4 / modulus);
            assert!((above - section.neutral_axis_depth).abs() < TOLERANCE, "{}: {above}", section.name);
            assert!((above + below - section.height).abs() < TOLERANCE, "{}: {below}", section.name);
            assert!(section.section().check().is_ok());
        }
    }

    #[test]
    fn known_by_old_and_new_names() {
        assert_eq!(NamedSection::of("uic 60"), NamedSection::of("60E1"));
        assert!(NamedSection::of("60E1").is_some() && NamedSection::of("61E1").is_none());
    }
}
