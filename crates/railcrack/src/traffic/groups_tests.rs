//! Groups of wheels.

use super::{Grouped, Groups};

/// Wheels whose effect is a point in the plane and whose rate is a power of its size.
fn wheels(count: usize) -> Vec<Grouped> {
    let wheel = |i: usize| {
        let turn = 0.618_033_988_749_895 * i as f64;
        let (size, lean) = (0.3 + turn.fract(), 0.2 * (7.0 * turn).sin());
        Grouped {
            share: 1.0 / count as f64,
            effect: vec![size, lean],
            rate: (size * size + lean * lean).powf(0.5 * 3.33),
        }
    };
    (0..count).map(wheel).collect()
}

#[test]
fn few_wheels_represent_themselves() {
    let few = wheels(5);
    let groups = Groups::of(&few, 5);
    assert_eq!((groups.representatives, groups.error), (vec![0, 1, 2, 3, 4], 0.0));
    assert_eq!(groups.shares, [0.2; 5]);
}

#[test]
fn representatives_keep_shares_and_mean_rate() {
    let many = wheels(1000);
    let groups = Groups::of(&many, 30);
    assert_eq!(groups.representatives.len(), 30);
    assert!((groups.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    // The default of `representatives_error`.
    assert!(groups.error.abs() < 0.01, "{}", groups.error);
    // Every wheel is close to its representative, most of all where it counts.
    let off = |i: usize| {
        let other = &many[groups.representatives[groups.group_of[i]]];
        (other.rate / many[i].rate - 1.0).abs() * many[i].rate
    };
    let mean: f64 = (0..1000).map(off).sum::<f64>() / many.iter().map(|wheel| wheel.rate).sum::<f64>();
    assert!(mean < 0.15, "{mean}");
    let fewer = Groups::of(&many, 3);
    assert_eq!(fewer.representatives.len(), 3);
    assert_eq!(Groups::of(&many, 30), groups, "no chance");
}

#[test]
fn equal_wheels_are_one_group() {
    let one = Grouped { share: 0.01, effect: vec![1.0, 2.0], rate: 3.0 };
    let groups = Groups::of(&vec![one; 100], 10);
    assert_eq!((groups.representatives.len(), groups.shares.len()), (1, 1));
    assert!((groups.shares[0] - 1.0).abs() < 1e-12 && groups.error.abs() < 1e-12);
}
