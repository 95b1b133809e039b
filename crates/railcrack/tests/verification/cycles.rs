//! Load cycles converge to second order in the increment.

use crate::common::measured_order;
use crate::common::{order, steel, surface_crack};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::fatigue::DirectionCriterion;
use railcrack::field::HertzWheel;
use railcrack::growth::{Growth, GrowthSettings, GrowthState, Unobserved};
use railcrack::load::HertzianContact;
use railcrack::plane::PlaneRail;

/// Load cycles in which a straight crack at 30° grows from 6 to 6 · 1.08⁶ mm in `steps` increments,
/// and those by the rate at the start of each alone.
fn cycles(steps: usize) -> (f64, f64) {
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.3 };
    let engine = DislocationEngine { steel: steel(), resolution: FaceResolution::default() };
    let wheel = HertzWheel::new(&contact, &steel()).unwrap();
    let mut problem = PlaneRail::new(engine, wheel, vec![0.3]);
    problem.growth = GrowthSettings {
        steps,
        increment: 1.08_f64.powf(6.0 / steps as f64) - 1.0,
        criterion: DirectionCriterion::Coplanar,
        ..GrowthSettings::default()
    };
    let mut growth = Growth::new(problem, GrowthState::initial(&surface_crack(0.0, 6.0, 30.0).into()));
    let (mut last, mut euler) = (0.0, 0.0);
    while let Some(record) = growth.next_step(&Unobserved).unwrap() {
        last = record.load_cycles;
        euler += record.tips[0].increment / record.tips[0].rate;
    }
    (last, euler)
}

#[test]
fn of_second_order_along_a_straight_path() {
    let [coarse, middle, fine] = [6, 12, 24].map(cycles);
    let observed = order(coarse.0 - middle.0, middle.0 - fine.0);
    let of_euler = order(coarse.1 - middle.1, middle.1 - fine.1);
    // Load steps follow K to 2e-3 of its peak, which is seen in the smallest differences.
    measured_order(observed, 1.7, "differences of 8, 4 and 2 % increments");
    assert!(observed > 1.7, "order {observed}: {coarse:?}, {middle:?}, {fine:?}");
    assert!(of_euler < 1.3, "the rate at the start alone has order {of_euler}");
}
