//! Growth laws whose rates are not those of rail steel: constants in another unit.

use super::laws::{LawInput, Paris, RateLaw};

/// A growth rate that is not that of rail steel.
#[derive(Debug, Clone, PartialEq)]
pub struct UnusualRate {
    /// The range at which it is compared, MPa√m.
    pub range: f64,
    /// da/dN of the law at that range without a threshold, mm per cycle.
    pub rate: f64,
    /// da/dN of rail steel, mm per cycle.
    pub of_steel: f64,
    /// Their ratio.
    pub ratio: f64,
    /// The unit in which the law is probably given; none where no usual one makes it one of steel.
    pub unit: Option<OtherRateUnit>,
}

/// A unit of growth laws other than mm per cycle and MPa√m.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherRateUnit {
    /// Length of the rate.
    pub length: &'static str,
    /// Unit of the range.
    pub range: &'static str,
    /// Millimetres in its length.
    pub rate_factor: f64,
    /// Its units of the range in 1 MPa√m.
    pub range_factor: f64,
    /// The coefficient in mm per cycle and MPa√m; none of a table.
    pub coefficient: Option<f64>,
}

/// Ranges at which laws are compared, MPa√m: within the stable growth of every steel.
const COMPARED: [f64; 2] = [10.0, 20.0];
/// Factor from the rate of rail steel, either way, beyond which a law is none of rail steel:
/// measured laws of rail and wheel steels lie within 6 ([`RAIL_STEELS`](super::RAIL_STEELS)), and
/// [a limit of a standard](super::ACCEPTED_GROWTH) at 5.
const UNUSUAL: f64 = 30.0;
/// Factor within which a guess of the unit must come.
const GUESSED: f64 = 12.0;

const N_MM: (&str, f64) = ("N/mm^1.5", 31.622_776_601_683_793);
const MPA_M: (&str, f64) = ("MPa sqrt(m)", 1.0);

/// A unit of length and one of ranges, each with its size, and the factor by which others must fit
/// better.
type Units = ((&'static str, f64), (&'static str, f64), f64);

/// Pairs of units in which laws are published, the usual ones first: length and its millimetres,
/// range and its units in 1 MPa√m, and the factor by which the others must fit better.
const UNITS: [Units; 8] = [
    (("m", 1e3), MPA_M, 1.0),
    (("mm", 1.0), N_MM, 1.0),
    (("inches", 25.4), ("ksi sqrt(in)", 0.910_048), 1.0),
    (("m", 1e3), N_MM, 3.0),
    (("nm", 1e-6), MPA_M, 3.0),
    (("um", 1e-3), MPA_M, 3.0),
    (("m", 1e3), ("Pa sqrt(m)", 1e6), 3.0),
    (("mm", 1.0), ("kgf/mm^1.5", 3.224_616), 3.0),
];

/// A rate at a range, that of rail steel, and that of the law with its own usual constants.
struct Compared {
    range: f64,
    rate: f64,
    of_steel: f64,
    usual: f64,
}

impl Compared {
    fn ratio(&self) -> f64 {
        self.rate / self.of_steel
    }

    /// The distance of the ratio from 1.
    fn distance(&self) -> f64 {
        self.ratio().ln().abs()
    }

    /// The distance from the nearer one of rail steel and the usual constants.
    fn least_distance(&self) -> f64 {
        self.distance().min((self.rate / self.usual).ln().abs())
    }
}

impl RateLaw {
    /// The rate of this law, at 10 or 20 MPa√m and R = 0, that is farther than a factor of 30 from
    /// that of rail steel; none where both are nearer. A table is compared within its rows, other
    /// laws without their thresholds.
    #[must_use]
    pub fn unusual_rate(&self) -> Option<UnusualRate> {
        let compared = self.compared(1.0, 1.0);
        let worst = compared.into_iter().max_by(|a, b| a.distance().total_cmp(&b.distance()))?;
        (worst.distance() > UNUSUAL.ln()).then(|| UnusualRate {
            range: worst.range,
            rate: worst.rate,
            of_steel: worst.of_steel,
            ratio: worst.ratio(),
            unit: self.probable_unit(),
        })
    }

    /// The rates of a law in the unit of `length` millimetres and of `range` units of the range in
    /// 1 MPa√m, with those of rail steel.
    fn compared(&self, length: f64, range: f64) -> [Compared; 2] {
        let (law, steel) = (self.with_threshold(0.0), RateLaw::Paris(Paris::RAIL_STEEL));
        let usual = self.with_usual_constants().map_or_else(|| steel.clone(), |law| law.with_threshold(0.0));
        let law = match law.coefficient_in(length, range) {
            Some(c) => law.changed(|of| Some(of.coefficient), |_| c).unwrap_or(law),
            None => law,
        };
        let (length, range) = if matches!(law, Self::Table(_)) { (length, range) } else { (1.0, 1.0) };
        COMPARED.map(|own| {
            let own = match &law {
                Self::Table(table) => own.clamp(table.covers().0 / range, table.covers().1 / range),
                _ => own,
            };
            // Just above the first row, below which nothing grows.
            let rate = length * law.rate(own * range * (1.0 + 1e-9), 0.0);
            Compared { range: own, rate, of_steel: steel.rate(own, 0.0), usual: usual.rate(own, 0.0) }
        })
    }

    /// The law of the same kind with its usual constants; none of a table.
    fn with_usual_constants(&self) -> Option<Self> {
        let LawInput::Constants(of) = self.declaration().input else { return None };
        (of.law)(&of.all.iter().map(|constant| constant.default).collect::<Vec<f64>>())
    }

    /// The coefficient in mm per cycle and MPa√m of a law in another unit; none of a table.
    fn coefficient_in(&self, length: f64, range: f64) -> Option<f64> {
        let (of, place) = self.place_of(|of| Some(of.coefficient))?;
        let LawInput::Constants(_) = self.declaration().input else { return None };
        let values = self.constants();
        // The power of the unit of K in the coefficient: that of the rate under scaled K.
        let scale = |(constant, value): (&super::Constant, &f64)| {
            if constant.unit == super::laws::K_UNIT { value * range } else { *value }
        };
        let scaled = (of.law)(&of.all.iter().zip(&values).map(scale).collect::<Vec<_>>())?;
        let factor = scaled.rate(COMPARED[0] * range, 0.0) / self.rate(COMPARED[0], 0.0);
        Some(values[place] * length * factor).filter(|value| value.is_finite())
    }

    /// The unit that makes the rates those of rail steel.
    fn probable_unit(&self) -> Option<OtherRateUnit> {
        let distance = |(length, range, factor): &((&str, f64), (&str, f64), f64)| {
            let [one, other] = self.compared(length.1, range.1);
            one.least_distance().max(other.least_distance()) + factor.ln()
        };
        let best = UNITS.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let &((length, rate_factor), (range, range_factor), _) = best;
        (distance(best) <= GUESSED.ln()).then(|| OtherRateUnit {
            length,
            range,
            rate_factor,
            range_factor,
            coefficient: self.with_threshold(0.0).coefficient_in(rate_factor, range_factor),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fatigue::{LawDeclaration, RAIL_STEELS, RateTable};

    fn paris(c: f64, m: f64) -> RateLaw {
        Paris { c, m, threshold: 0.0 }.into()
    }

    /// The unit, the range and the coefficient.
    fn guessed(law: &RateLaw) -> Option<(&'static str, &'static str, Option<f64>)> {
        let unit = law.unusual_rate().unwrap().unit?;
        Some((unit.length, unit.range, unit.coefficient))
    }

    #[test]
    fn known_laws_are_usual() {
        for steel in RAIL_STEELS {
            assert_eq!(steel.growth_law().rate.unusual_rate(), None, "{}", steel.name);
        }
        for declaration in LawDeclaration::ALL {
            let LawInput::Constants(of) = declaration.input else { continue };
            let defaults: Vec<f64> = of.all.iter().map(|constant| constant.default).collect();
            assert_eq!((of.law)(&defaults).unwrap().unusual_rate(), None, "{}", declaration.word.name);
        }
        // A threshold is no unit.
        assert_eq!(RateLaw::from(Paris { c: 2e-9, m: 3.33, threshold: 12.0 }).unusual_rate(), None);
    }

    #[test]
    fn units_of_published_laws() {
        // BS 7910, and Barsom's law of ferritic steels: 6.9e-12 m per cycle and MPa√m with the
        // exponent 3. In inches and ksi√in it has 3.6e-10, too near to steel in mm to be another
        // unit.
        assert_eq!(paris(3.6e-10, 3.0).unusual_rate(), None);
        let (c, near) = (6.9e-9, |got: Option<f64>, want: f64| (got.unwrap() / want - 1.0).abs() < 0.05);
        for (given, length, range, want) in [
            (5.21e-13, "mm", "N/mm^1.5", 1.6475e-8),
            (1e-12, "m", "MPa sqrt(m)", 1e-9),
            (6.9e-12, "m", "MPa sqrt(m)", c),
            (6.9e-3, "nm", "MPa sqrt(m)", c),
        ] {
            let (found_length, found_range, coefficient) = guessed(&paris(given, 3.0)).unwrap();
            assert_eq!((found_length, found_range), (length, range), "{given}");
            assert!(near(coefficient, want), "{given}: {coefficient:?}");
        }
        assert_eq!(guessed(&paris(1e-25, 3.0)), None);
    }

    /// Every law with its coefficient in m per cycle, or in N/mm^1.5.
    #[test]
    fn units_are_guessed_for_every_law() {
        for declaration in LawDeclaration::ALL {
            let LawInput::Constants(of) = declaration.input else { continue };
            let defaults: Vec<f64> = of.all.iter().map(|constant| constant.default).collect();
            let law = (of.law)(&defaults).unwrap();
            let place = of.all.iter().position(|one| one.key == of.coefficient.key).unwrap();
            let own = defaults[place];
            let power = law.with_threshold(0.0).coefficient_in(1.0, N_MM.1).unwrap() / own;
            // In both, Forman's law with the exponent 3 has the same constant.
            let is_either = (1e3 - power).abs() < 0.1;
            for (factor, length, range) in [(1e-3, "m", "MPa sqrt(m)"), (power.recip(), "mm", "N/mm^1.5")] {
                let other = law.changed(|of| Some(of.coefficient), |c| c * factor).unwrap();
                let (found_length, found_range, coefficient) = guessed(&other).unwrap();
                let is_it = (found_length, found_range) == (length, range);
                assert!(is_it || is_either, "{}: {found_length}, {found_range}", declaration.word.name);
                assert!((coefficient.unwrap() / own - 1.0).abs() < 1e-9, "{}", declaration.word.name);
            }
        }
    }

    #[test]
    fn tables_are_compared_within_their_rows() {
        let table = |rate: f64, range: f64| -> RateLaw {
            let row = |k: f64| (range * k, rate * 2e-9 * k.powf(3.33));
            RateTable::new(vec![row(12.0), row(18.0), row(40.0)]).unwrap().into()
        };
        assert_eq!(table(1.0, 1.0).unusual_rate(), None);
        assert_eq!(guessed(&table(1e-3, 1.0)), Some(("m", "MPa sqrt(m)", None)));
        assert_eq!(guessed(&table(1.0, N_MM.1)), Some(("mm", "N/mm^1.5", None)));
    }
}
