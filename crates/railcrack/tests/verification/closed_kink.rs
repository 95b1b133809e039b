//! Clipping of k1 at zero decides between growth straight ahead and branching.

use railcrack::fatigue::{DirectionCriterion, EquivalentRange, GrowthLaw, HourlierPineau};
use railcrack::fracture::{Sif, SifHistory};

/// K_II alternates on a closed crack. At the kink of the largest k1, ±76.6° with k1 = 1.2316 K_II
/// (Amestoy & Leblond 1992), Δk1 is once that value where it is clipped and twice that where
/// negative k1 counts; straight ahead there is w Δk2² = 0.772 (2 K_II)². So the first grows
/// co-planar, and the second branches.
#[test]
fn alternating_mode_two() {
    let history = SifHistory { samples: [100.0, -100.0].map(|kii| Sif { ki: 0.0, kii }).to_vec() };
    let kink = |criterion, mode_2_weight| {
        let equivalent = EquivalentRange::HourlierPineau { mode_2_weight };
        let law = GrowthLaw { equivalent, ..GrowthLaw::RAIL_STEEL };
        HourlierPineau { law, criterion, kink_friction: 0.0 }.kink(&history).unwrap()
    };
    let steel = 0.772;
    assert!(kink(DirectionCriterion::MaxRate, steel).angle.abs() < 1e-6);
    assert!(kink(DirectionCriterion::MaxRateUnclipped, steel).angle.to_degrees() > 60.0);
    // Without the weight of mode II it is the kink of the largest k1.
    let largest = kink(DirectionCriterion::MaxRateUnclipped, 0.0);
    let off = (largest.angle.to_degrees() / 76.6 - 1.0).abs();
    // The published angle has three digits.
    assert!(off < 1e-3 && (largest.delta_k1 / 123.16 - 1.0).abs() < 1e-4, "{largest:?}");
}
