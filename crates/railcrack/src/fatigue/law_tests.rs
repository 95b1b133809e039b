//! Check values of the laws and the equivalent ranges.

use super::*;
use crate::fatigue::law::bold_range;
use crate::fatigue::{Bold, Forman, LawDeclaration, LawInput, Nasgro, ParisThreshold, RateTable, Walker};

/// Eight digits are given.
const DIGITS: f64 = 1e-6;

fn close(value: f64, want: f64) {
    assert!((value - want).abs() <= DIGITS * want.abs(), "{value:e}, not {want:e}");
}

/// The rate of `law` under ranges in MPa√m.
fn rate(law: &GrowthLaw, delta_ki: f64, delta_kii: f64) -> f64 {
    let unit = MPA_SQRT_MM;
    law.rate(LoadRange::new(delta_ki * unit, delta_kii * unit, delta_ki * unit))
}

fn of_rail_steel(rate: RateLaw) -> GrowthLaw {
    GrowthLaw { rate, ..GrowthLaw::RAIL_STEEL }
}

#[test]
fn every_declared_law_has_its_check_value_and_gives_its_constants_back() {
    for declaration in LawDeclaration::ALL {
        let LawInput::Constants(of) = declaration.input else { continue };
        let name = declaration.word.name;
        let defaults: Vec<f64> = of.all.iter().map(|constant| constant.default).collect();
        let law = (of.law)(&defaults).unwrap();
        close(law.rate(of.check.delta, of.check.ratio), of.check.rate);
        assert_eq!((law.declaration(), law.constants()), (*declaration, defaults.clone()), "{name}");
        // Distinct values: none goes into another one's place.
        let distinct: Vec<f64> = (0..defaults.len()).map(|i| 1.0 + i as f64).collect();
        assert_eq!((of.law)(&distinct).unwrap().constants(), distinct, "{name}");
        assert!((of.law)(&defaults[1..]).is_none(), "{name}");
        close(law.times(3.0).rate(of.check.delta, of.check.ratio), 3.0 * of.check.rate);
        let coefficient = of.all.iter().position(|constant| constant.key == of.coefficient.key).unwrap();
        assert_eq!(law.times(3.0).constants()[coefficient], 3.0 * defaults[coefficient], "{name}");
        assert!(of.exponent.is_none_or(|m| of.all.iter().any(|constant| constant.key == m.key)), "{name}");
        for constant in of.all {
            let (low, high) = constant.range;
            assert!((low..=high).contains(&constant.default), "{}", constant.key);
        }
    }
}

#[test]
fn paris() {
    let law = GrowthLaw::RAIL_STEEL;
    for ((ki, kii), want) in [
        ((10.0, 0.0), 4.275_924_2e-6),
        ((0.0, 10.0), 2.779_155_2e-6),
        ((9.0, 12.0), 1.268_700_1e-5),
        ((20.0, 20.0), 1.114_684_5e-4),
    ] {
        close(rate(&law, ki, kii), want);
    }
    assert_eq!(law.equivalent_range(3.0, 0.0), 3.0);
}

#[test]
fn nothing_grows_at_or_below_the_threshold() {
    let law = of_rail_steel(RateLaw::Paris(Paris { threshold: 4.0, ..Paris::RAIL_STEEL }));
    assert_eq!(rate(&law, 4.0, 0.0), 0.0);
    close(rate(&law, 4.001, 0.0), 2e-9 * 4.001_f64.powf(3.33));
    assert_eq!(rate(&GrowthLaw::RAIL_STEEL, 0.0, 0.0), 0.0);
}

/// Without the threshold of ΔK_II, Hourlier and Pineau's range has one at ΔK_th/√w.
#[test]
fn the_threshold_of_shear_is_an_axis_of_the_ellipse() {
    let (threshold, weight) = (4.0, 0.772_f64);
    let before = of_rail_steel(RateLaw::Paris(Paris { threshold, ..Paris::RAIL_STEEL }));
    let same = GrowthLaw { threshold_2: threshold / weight.sqrt(), ..before.clone() };
    let strong = GrowthLaw { threshold_2: 10.0, ..before.clone() };
    for i in 0..20 {
        let (sin, cos) = (0.08 * f64::from(i)).sin_cos();
        for size in [0.999, 1.001] {
            let (opening, shear) = (size * threshold * cos, size * threshold / weight.sqrt() * sin);
            assert_eq!(rate(&same, opening, shear), rate(&before, opening, shear), "{i} {size}");
            // On the ellipse of both thresholds the crack begins to grow at the rate of its range.
            let shear = size * 10.0 * sin;
            let delta = strong.equivalent_range(opening, shear);
            let want = if size > 1.0 { 2e-9 * delta.powf(3.33) } else { 0.0 };
            assert!((rate(&strong, opening, shear) - want).abs() <= 1e-9 * want, "{i} {size}");
        }
    }
    assert_eq!(rate(&strong, 0.0, 10.0), 0.0);
    assert!(rate(&before, 0.0, 10.0) > 0.0);
}

#[test]
fn without_a_threshold_of_opening_shear_counts_above_its_own() {
    let law = GrowthLaw { threshold_2: 10.0, ..GrowthLaw::RAIL_STEEL };
    assert_eq!(rate(&law, 0.0, 10.0), 0.0);
    assert_eq!(rate(&law, 5.0, 10.0), rate(&GrowthLaw::RAIL_STEEL, 5.0, 0.0));
    assert_eq!(rate(&law, 5.0, 10.01), rate(&GrowthLaw::RAIL_STEEL, 5.0, 10.01));
    // The range of which the rate is a function.
    let driven = |opening: f64, shear: f64| {
        law.driven_by(LoadRange::new(opening * MPA_SQRT_MM, shear * MPA_SQRT_MM, opening * MPA_SQRT_MM))
            / MPA_SQRT_MM
    };
    assert_eq!((driven(0.0, 10.0), driven(5.0, 9.9)), (0.0, 5.0));
    for (opening, shear) in [(5.0, 9.9), (5.0, 10.01), (0.0, 12.0)] {
        let of_range = law.rate.rate(driven(opening, shear), 0.0);
        assert!((rate(&law, opening, shear) / of_range - 1.0).abs() < 1e-12, "{opening} {shear}");
    }
    assert_eq!(law.shear_threshold().unwrap(), "dKII counts above 10");
    assert_eq!(GrowthLaw::RAIL_STEEL.shear_threshold(), None);
}

/// C (ΔK^m − T^m) with T = ΔK/u, u = √((6/4)² + (8/10)²) = 1.7, ΔK² = 6² + 0.772 8².
#[test]
fn laws_that_begin_at_zero_begin_on_the_ellipse() {
    let inside = ParisThreshold { c: 2e-9, m: 3.33, threshold: 4.0 };
    let law = GrowthLaw { threshold_2: 10.0, ..of_rail_steel(RateLaw::ParisThreshold(inside)) };
    let delta = (36.0_f64 + 0.772 * 64.0).sqrt();
    close(rate(&law, 6.0, 8.0), 2e-9 * delta.powf(3.33) * (1.0 - 1.7_f64.powf(-3.33)));
    let nasgro = Nasgro { c: 1e-9, n: 3.0, p: 0.5, q: 0.5, threshold: 4.0, kc: 40.0, alpha: 2.5, s: 0.3 };
    let free = of_rail_steel(RateLaw::Nasgro(Nasgro { threshold: 0.0, ..nasgro }));
    let law = GrowthLaw { threshold_2: 10.0, ..of_rail_steel(RateLaw::Nasgro(nasgro)) };
    close(rate(&law, 6.0, 8.0) / rate(&free, 6.0, 8.0), (1.0 - 1.0 / 1.7_f64).sqrt());
}

#[test]
fn paris_threshold_begins_at_zero() {
    let law = of_rail_steel(RateLaw::ParisThreshold(ParisThreshold { c: 2e-9, m: 3.33, threshold: 4.0 }));
    assert_eq!(rate(&law, 4.0, 0.0), 0.0);
    assert!(rate(&law, 4.001, 0.0) < 1e-3 * 2e-9 * 4.0_f64.powf(3.33) * 3.33);
    close(rate(&law, 10.0, 0.0), 2e-9 * (10.0_f64.powf(3.33) - 4.0_f64.powf(3.33)));
}

#[test]
fn bold() {
    let law = GrowthLaw {
        rate: RateLaw::Bold(Bold::RAIL_STEEL),
        equivalent: EquivalentRange::Bold,
        threshold_2: 0.0,
    };
    close(rate(&law, 10.0, 0.0), 2.695_658_9e-6);
    close(rate(&law, 0.0, 10.0), 9.052_781_1e-7);
    close(bold_range(0.0, 10.0), 7.594_937);
    close(rate(&law, 9.0, 12.0), 6.609_953e-6);
    close(bold_range(9.0, 12.0), 12.644_382);
    close(rate(&law, 20.0, 20.0), 7.680_857_3e-5);
    close(bold_range(20.0, 20.0), 24.281_243);
    assert_eq!([rate(&law, 4.0, 0.0), rate(&law, 0.0, 4.0)], [0.0, 0.0]);
}

#[test]
fn walker() {
    let law = RateLaw::Walker(Walker { c: 2e-9, m: 3.33, gamma: 0.6, threshold: 0.0 });
    for (ratio, want) in [(0.0, 7.846_998e-6), (0.3, 1.261_923e-5), (0.7, 3.901_019e-5)] {
        close(law.rate(12.0, ratio), want);
    }
}

#[test]
fn forman() {
    let law = RateLaw::Forman(Forman { c: 5e-8, m: 3.0, kc: 60.0, threshold: 0.0 });
    for (ratio, want) in [(0.0, 1.8e-6), (0.3, 2.88e-6), (0.7, 1.44e-5)] {
        close(law.rate(12.0, ratio), want);
    }
    assert_eq!(law.rate(60.0, 0.0), f64::INFINITY);
}

#[test]
fn nasgro() {
    let law = Nasgro { c: 1e-9, n: 3.0, p: 0.5, q: 0.5, threshold: 5.0, kc: 40.0, alpha: 2.5, s: 0.3 };
    for (ratio, closure, want) in
        [(0.0, 0.274_530, 6.022_975e-7), (0.3, 0.378_705, 1.220_730e-6), (-1.0, 0.203_280, 9.049_393e-8)]
    {
        assert!((law.closure(ratio) - closure).abs() < 1e-6, "R {ratio}: f = {}", law.closure(ratio));
        close(RateLaw::Nasgro(law).rate(12.0, ratio), want);
    }
    assert_eq!(RateLaw::Nasgro(law).rate(5.0, 0.0), 0.0);
    assert_eq!(RateLaw::Nasgro(law).rate(40.0, 0.0), f64::INFINITY);
}

#[test]
fn a_table_of_paris_law_is_paris_law_between_its_rows() {
    let rate = |delta: f64| 2e-9 * delta.powf(3.33);
    let table = RateTable::new([5.0, 8.0, 30.0].map(|delta| (delta, rate(delta))).to_vec()).unwrap();
    assert_eq!(table.covers(), (5.0, 30.0));
    let law = RateLaw::Table(table);
    for delta in [5.0, 6.0, 8.0, 12.0, 30.0, 40.0] {
        close(law.rate(delta, 0.0), rate(delta));
    }
    assert_eq!(law.rate(4.999, 0.0), 0.0);
    let refused = |rows: &[(f64, f64)]| RateTable::new(rows.to_vec()).unwrap_err().to_string();
    assert!(refused(&[(5.0, 1e-6)]).starts_with("1 rows"));
    assert!(refused(&[(5.0, 1e-6), (5.0, 2e-6)]).starts_with("row 2: delta_keq_mpa_sqrt_m = 5"));
    assert!(refused(&[(5.0, 1e-6), (6.0, 0.0)]).starts_with("row 2: rate_mm_per_cycle = 0"));
}

#[test]
fn equivalent_ranges() {
    close(EquivalentRange::Tanaka.of(9.0, 12.0), 20.378_169);
    close(EquivalentRange::Richard.of(9.0, 12.0), 19.072_22);
    close(EquivalentRange::RAIL_STEEL.of(9.0, 12.0), (81.0_f64 + 0.772 * 144.0).sqrt());
    for range in [EquivalentRange::Tanaka, EquivalentRange::Richard, EquivalentRange::RAIL_STEEL] {
        close(range.of(7.0, 0.0), 7.0);
    }
}

#[test]
fn the_ratio_counts_open_cracks_only() {
    assert_eq!(LoadRange::new(6.0, 0.0, 8.0).ratio, 0.25);
    assert_eq!(LoadRange::new(0.0, 3.0, -1.0).ratio, 0.0);
}
