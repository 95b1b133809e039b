//! The way of cracks in space from one step to the next.

use super::body::CloseCracks;
use super::front_motion::FrontSpeeds;
use super::shape::SpaceCrack;
use crate::growth::{FrontInterval, FrontShape, GrowthSettings, RunStop, TipStop};
use crate::math::RailBox;

/// Cycles that fall short by this fraction are the cycles asked for.
const CYCLES_ROUNDING: f64 = 1e-12;
/// The ligament of a buried crack to the surface, over its half axis, that is used up.
const LIGAMENT: f64 = 0.05;

/// Cracks at the start of a step.
pub(super) struct Start<'a> {
    pub shapes: &'a [FrontShape],
    /// Why each no longer grows.
    pub stopped: &'a [Option<TipStop>],
    /// The speeds of those that grow.
    pub speeds: &'a [FrontSpeeds],
    /// Whether the rail breaks.
    pub breaks: bool,
    pub step: usize,
    pub load_cycles: f64,
}

/// The way from one step to the next.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Way {
    /// The shapes of the next step.
    pub shapes: Vec<FrontShape>,
    /// Why each crack no longer grows.
    pub stopped: Vec<Option<TipStop>>,
    pub interval: Option<FrontInterval>,
    /// Cycles by the speeds at the start of the step: what the fronts are grown by.
    pub cycles: f64,
    pub stop: Option<RunStop>,
    /// Cracks that would have met.
    pub meetings: Vec<CloseCracks>,
}

impl Way {
    /// The way of `start`: the fastest of all cracks grows by the increment, the others as far in
    /// the same cycles. A crack that is arrested, or would leave the rail, use up its ligament or
    /// meet another one stops for good where it is, and the others grow on.
    pub fn new(start: &Start, growth: &GrowthSettings, rail: RailBox) -> Self {
        let mut way = Self {
            shapes: start.shapes.to_vec(),
            stopped: start.stopped.to_vec(),
            interval: None,
            cycles: 0.0,
            stop: None,
            meetings: Vec::new(),
        };
        let most = growth.stop_after_cycles.unwrap_or(f64::INFINITY);
        let critical = growth.critical_length.unwrap_or(f64::INFINITY);
        way.stop = if start.breaks {
            Some(RunStop::Fracture)
        } else if start.shapes.iter().any(|shape| shape.depth >= critical) {
            Some(RunStop::CriticalLength)
        } else if start.load_cycles >= most * (1.0 - CYCLES_ROUNDING) {
            Some(RunStop::Cycles)
        } else {
            (start.step >= growth.steps).then_some(RunStop::StepsDone)
        };
        if way.stop.is_some() {
            return way;
        }
        let mut last = way.stopped.iter().flatten().next().copied();
        for (stopped, speeds) in way.stopped.iter_mut().zip(start.speeds) {
            if stopped.is_none() && speeds.fastest().is_none() {
                *stopped = Some(TipStop::Arrest);
                last = *stopped;
            }
        }
        // Each turn of the loop stops a crack or ends it.
        loop {
            let growing = (0..start.shapes.len()).filter(|&k| way.stopped[k].is_none());
            let fastest = growing
                .filter_map(|crack| {
                    start.speeds[crack].fastest().map(|(motion, speed)| (crack, motion, speed))
                })
                .reduce(|a, b| if b.2 > a.2 { b } else { a });
            let Some((crack, motion, speed)) = fastest else {
                way.stop = Some(RunStop::NoTipGrows(last.unwrap_or(TipStop::Arrest)));
                return way;
            };
            let wanted = growth.increment * start.shapes[crack].depth / speed;
            let left = most - start.load_cycles;
            let (cycles, is_settled) = if wanted <= left { (wanted, false) } else { (left, true) };
            let moved = |k: usize| match way.stopped[k] {
                None => start.speeds[k].moved(&start.shapes[k], cycles),
                Some(_) => start.shapes[k],
            };
            let next: Vec<FrontShape> = (0..start.shapes.len()).map(moved).collect();
            let leaving = (0..next.len())
                .filter(|&k| way.stopped[k].is_none())
                .find_map(|k| leaves(&next[k], rail).map(|stop| (k, stop)));
            if let Some((crack, stop)) = leaving {
                way.stopped[crack] = Some(stop);
                last = Some(stop);
            } else if let Some(close) = meeting(&next) {
                for crack in [close.first, close.second] {
                    way.stopped[crack] = way.stopped[crack].or(Some(TipStop::Coalescence));
                }
                last = Some(TipStop::Coalescence);
                way.meetings.push(close);
            } else {
                way.shapes = next;
                way.interval = Some(FrontInterval { crack, motion, speed, cycles, is_settled });
                way.cycles = cycles;
                return way;
            }
        }
    }

    /// The cycles in which `crack` grows: none of one that has stopped.
    pub fn cycles_of(&self, crack: usize) -> f64 {
        if self.stopped[crack].is_none() { self.cycles } else { 0.0 }
    }
}

/// Two cracks of these shapes that are too close to be computed.
fn meeting(shapes: &[FrontShape]) -> Option<CloseCracks> {
    let cracks: Vec<SpaceCrack> = shapes.iter().filter_map(|shape| shape.crack().ok()).collect();
    if cracks.len() < shapes.len() { None } else { CloseCracks::among(&cracks) }
}

/// Whether a crack of this shape would leave the rail, or has no ligament left.
fn leaves(shape: &FrontShape, rail: RailBox) -> Option<TipStop> {
    let deepest = shape.buried.unwrap_or(0.0) + shape.depth;
    let [x, _, depth] = shape.frame().position(deepest, 0.0);
    let inside = depth < rail.depth && (shape.middle[0] + x - rail.centre).abs() < 0.5 * rail.width;
    if !inside {
        return Some(TipStop::LeavesRail);
    }
    let spent = shape.buried.is_some_and(|centre| centre - shape.depth < LIGAMENT * shape.depth);
    spent.then_some(TipStop::BreakOut)
}

#[cfg(test)]
mod tests {
    use super::super::body::FrontPoint;
    use super::*;
    use std::f64::consts::PI;

    const RAIL: RailBox = RailBox { centre: 0.0, width: 300.0, depth: 172.0 };

    /// A semicircle of 4 mm.
    fn circle(x: f64, lateral: f64) -> FrontShape {
        FrontShape {
            dip: 0.5 * PI,
            strike: 0.0,
            depth: 4.0,
            half_length: 4.0,
            middle: [x, lateral],
            buried: None,
        }
    }

    /// The speeds of a semicircle whose points all grow at `rate`.
    fn speeds(shape: &FrontShape, rate: f64) -> FrontSpeeds {
        let front: Vec<FrontPoint> = (0..=16)
            .map(|i| {
                let (sin, cos) = (PI * f64::from(i) / 16.0).sin_cos();
                let position = [0.0, shape.half_length * cos, shape.depth * sin];
                FrontPoint { crack: 0, phi: PI * f64::from(i) / 16.0, position, normal: [sin, cos] }
            })
            .collect();
        FrontSpeeds::nearest(shape, &front, &vec![rate; front.len()])
    }

    fn way(
        shapes: &[FrontShape],
        stopped: &[Option<TipStop>],
        rates: &[f64],
        growth: &GrowthSettings,
    ) -> Way {
        let speeds: Vec<FrontSpeeds> =
            shapes.iter().zip(rates).map(|(shape, rate)| speeds(shape, *rate)).collect();
        let start = Start { shapes, stopped, speeds: &speeds, breaks: false, step: 0, load_cycles: 0.0 };
        Way::new(&start, growth, RAIL)
    }

    fn settings() -> GrowthSettings {
        GrowthSettings { steps: 5, increment: 0.05, ..GrowthSettings::default() }
    }

    #[test]
    fn the_fastest_crack_grows_by_the_increment_and_the_others_in_its_cycles() {
        let shapes = [circle(0.0, 0.0), circle(20.0, 0.0), circle(40.0, 0.0)];
        let next = way(&shapes, &[None; 3], &[1e-6, 2e-6, 0.0], &settings());
        assert_eq!((next.stop, &next.stopped[..]), (None, &[None, None, Some(TipStop::Arrest)][..]));
        let grown: Vec<f64> = next.shapes.iter().map(|shape| shape.depth - 4.0).collect();
        for (grown, want) in grown.iter().zip([0.1, 0.2, 0.0]) {
            assert!((grown - want).abs() < 1e-9, "{grown} {want}");
        }
        assert!((next.cycles - 1e5).abs() < 1e-3 && next.interval.unwrap().crack == 1, "{next:?}");
        assert_eq!([next.cycles_of(1), next.cycles_of(2)], [next.cycles, 0.0]);
        // What has stopped stays stopped, whatever its rate.
        let later = way(&shapes, &[None, Some(TipStop::Arrest), None], &[1e-6, 2e-6, 1e-6], &settings());
        assert_eq!((later.interval.unwrap().crack, later.shapes[1]), (0, shapes[1]));
        let critical = GrowthSettings { critical_length: Some(4.0), ..settings() };
        assert_eq!(way(&shapes, &[None; 3], &[1e-6; 3], &critical).stop, Some(RunStop::CriticalLength));
    }

    #[test]
    fn cracks_that_would_meet_stop_and_the_others_grow_on() {
        // The first two lie beside each other, 0.3 mm apart, and each grows by 0.2 mm.
        let shapes = [circle(0.0, 0.0), circle(0.0, 8.3), circle(50.0, 0.0)];
        let next = way(&shapes, &[None; 3], &[2e-6, 2e-6, 1e-6], &settings());
        let joined = Some(TipStop::Coalescence);
        assert_eq!((next.stop, &next.stopped[..]), (None, &[joined, joined, None][..]));
        assert_eq!(next.shapes[..2], shapes[..2]);
        // Now the third one sets the pace.
        assert!((next.shapes[2].depth - 4.2).abs() < 1e-9 && next.meetings.len() == 1, "{next:?}");
        let alone = way(&shapes[..2], &[None; 2], &[2e-6, 2e-6], &settings());
        assert_eq!(alone.stop, Some(RunStop::NoTipGrows(TipStop::Coalescence)));
    }

    #[test]
    fn a_crack_that_would_leave_the_rail_stops_alone() {
        let shallow = FrontShape { dip: 0.2, ..circle(145.99, 0.0) };
        let shapes = [shallow, circle(0.0, 0.0)];
        let next = way(&shapes, &[None; 2], &[3e-6, 1e-6], &settings());
        assert_eq!((next.stop, &next.stopped[..]), (None, &[Some(TipStop::LeavesRail), None][..]));
        assert!((next.shapes[1].depth - 4.2).abs() < 1e-9, "{next:?}");
    }
}
