//! Advance of cracks in space from one step to the next.

use super::front_motion::FrontSpeeds;
use super::shape::{CHORD, CloseCracks, LEAST_DISTANCE, LEAST_STRAIGHT, ShapeError, SpaceCrack};
use super::worn::{Worn, worn};
use crate::growth::{
    ChangingCrack, Event, FrontShape, FrontTurns, GrowthSettings, LEAST_PART, LargestCracks, Mover, Moving,
    RunStop, StepSize, StepStart, TipStop, WearingCrack, is_worth_a_step, least_length, nothing_grows,
    run_stop, spent_ligament, standstill,
};
use crate::math::RailBox;

/// Part of a step to which the place is known at which two cracks meet.
const MEETING: f64 = 1e-4;

/// Cracks at the start of a step.
pub(super) struct Start<'a> {
    pub shapes: &'a [FrontShape],
    /// Why each crack no longer grows, if it has stopped.
    pub stopped: &'a [Option<TipStop>],
    /// The motions of all fronts with their speeds.
    pub movers: &'a [Mover],
    /// The best kink (radians) of each crack down its middle, and the least length (mm) over which
    /// it turns; zero for one that stays in its plane.
    pub kinks: &'a [[f64; 2]],
    /// Whether the rail fractures.
    pub breaks: bool,
    pub at: StepStart<'a>,
}

impl Start<'_> {
    /// The speeds of the front of `crack` (from 0).
    fn speeds(&self, crack: usize) -> FrontSpeeds {
        FrontSpeeds::of_movers(&self.shapes[crack], crack, self.movers)
    }

    /// The increments (mm) of all fronts at `pace`; zero of cracks that have `stopped`.
    fn increments(&self, pace: &StepSize, stopped: &[Option<TipStop>]) -> Vec<FrontSpeeds> {
        let of = |crack: usize| {
            self.speeds(crack).map(|index, rate| {
                let length = self.shapes[crack].length;
                let grows = stopped[crack].is_none() && rate > 0.0;
                if grows { pace.increment(&Mover { crack, index, rate, length }) } else { 0.0 }
            })
        };
        (0..self.shapes.len()).map(of).collect()
    }

    /// The shapes after these increments, turned towards their best kinks.
    fn moved(&self, increments: &[FrontSpeeds], growth: &GrowthSettings) -> Vec<FrontShape> {
        let of = |(crack, (increment, shape)): (usize, (&FrontSpeeds, &FrontShape))| {
            let moved = increment.moved(shape);
            let (from, grown) = (shape.path_length(), moved.path_length() - shape.path_length());
            let [kink, least] = self.kinks[crack];
            let turn = growth.turning.turn(kink, grown, least);
            if turn == 0.0 || grown <= 0.0 {
                return moved;
            }
            let turns = shape.turns.unwrap_or_else(|| FrontTurns::after(from));
            // A kink turns counter-clockwise, the dip grows clockwise.
            let turns = turns.and_at(from, grown, -turn);
            let least = if moved.strip.is_some() { 0.0 } else { LEAST_STRAIGHT * moved.length };
            if turns.straight >= least {
                return FrontShape { turns: Some(turns), ..moved };
            }
            // The first arcs become the chord that the rows at the mouth need.
            let (dip, turns) = turns.cut(moved.dip, 0.0, CHORD * moved.length);
            FrontShape { dip, turns, ..moved }
        };
        increments.iter().zip(self.shapes).enumerate().map(of).collect()
    }
}

/// The advance from one step to the next.
#[derive(Debug, Clone)]
pub(super) struct FrontAdvance {
    /// The shapes of the next step.
    pub shapes: Vec<FrontShape>,
    /// Why each crack no longer grows, if it has stopped.
    pub stopped: Vec<Option<TipStop>>,
    /// The increment of each motion of each front, mm.
    pub increments: Vec<FrontSpeeds>,
    /// StepSize of the step; `None` where the run ends with it.
    pub pace: Option<StepSize>,
    pub stop: Option<RunStop>,
    /// Cracks that would have met each other.
    pub meetings: Vec<CloseCracks>,
}

impl FrontAdvance {
    /// The advance from `start`: the fastest of all cracks grows by the increment, the others by
    /// their growth in the same number of cycles. A crack that is arrested, or would leave the
    /// rail, use up its ligament or meet another crack, stops for good where it is, and the others
    /// continue to grow. Meanwhile, wear and grinding remove the running surface.
    pub fn new(start: &Start, growth: &GrowthSettings, rail: RailBox) -> Self {
        let grows = |crack: usize| start.speeds(crack).fastest().is_some();
        let at_rest = |(crack, stop): (usize, &Option<TipStop>)| {
            stop.or_else(|| standstill(false, grows(crack), growth))
        };
        let mut stopped: Vec<Option<TipStop>> = start.stopped.iter().enumerate().map(at_rest).collect();
        let mut meetings = Vec::new();
        let mut part = 1.0;
        // Every round but the last stops a crack or shortens the step to end at an event.
        let (pace, increments, mut shapes) = loop {
            let pace = pace(start, growth, &stopped, part);
            let increments = start.increments(&pace, &stopped);
            let next: Vec<FrontShape> = start.moved(&increments, growth);
            let close = meeting(&next, &stopped);
            let meets = close.as_ref().and_then(|_| part_until_meeting(start, &increments, &stopped, growth));
            let meets = meets.map(|part| Event { part, ends_run: false });
            let events = first_event(start, &next, &stopped, pace.removal, growth).into_iter().chain(meets);
            if let Some(event) = Event::first(events.collect())
                .filter(|event| part > LEAST_PART && is_worth_a_step(*event, &pace, &start.at, growth))
            {
                part *= event.part;
                continue;
            }
            let leaving = (0..next.len())
                .filter(|&k| stopped[k].is_none())
                .find_map(|k| leaves(&next[k], rail).map(|stop| (k, stop)));
            if let Some((crack, stop)) = leaving {
                stopped[crack] = Some(stop);
            } else if let Some(close) = close {
                for crack in [close.first, close.second] {
                    stopped[crack] = stopped[crack].or(Some(TipStop::Coalescence));
                }
                meetings.push(close);
            } else {
                break (pace, increments, next);
            }
        };
        if pace.removal > 0.0 {
            remove_surface(start, pace.removal, &mut shapes, &mut stopped);
        }
        let length = start.shapes.iter().map(FrontShape::path_length).fold(0.0, f64::max);
        let depth = start.shapes.iter().map(|shape| -shape.deepest().y).fold(0.0, f64::max);
        let largest = LargestCracks { breaks: start.breaks, length, depth };
        let stops: Vec<_> = start.stopped.iter().copied().zip(stopped.iter().copied()).collect();
        let stop = run_stop(growth, &start.at, largest).or_else(|| nothing_grows(&stops));
        if stop.is_some() {
            let increments = increments.iter().map(|increment| increment.map(|_, _| 0.0)).collect();
            let shapes = start.shapes.to_vec();
            return Self { shapes, stopped, increments, pace: None, stop, meetings };
        }
        Self { shapes, stopped, increments, pace: Some(pace), stop, meetings }
    }
}

/// The part of the step, whose end would be `next`, after which the first of these events occurs: a
/// crack of critical length, one that is worn away, a buried one that has spent its ligament.
/// `None` where there is none.
fn first_event(
    start: &Start,
    next: &[FrontShape],
    stopped: &[Option<TipStop>],
    removal: f64,
    growth: &GrowthSettings,
) -> Option<Event> {
    let of = |(crack, (before, after)): (usize, (&FrontShape, &FrontShape))| {
        if stopped[crack].is_some() {
            return None;
        }
        let cut = removal / before.mouth_sine().unwrap_or_else(|| before.dip.sin());
        let (length, is_open) = (before.path_length(), before.buried.is_none());
        let least = || least_length(start.at.worn.longest_of(crack, length), resolution(before));
        let changing = ChangingCrack {
            length,
            growth: after.length - before.length,
            // A buried crack is not shortened.
            cut: if is_open { cut } else { 0.0 },
            least: (is_open && removal > 0.0).then(least),
        };
        let ligament = |shape: &FrontShape, cut: f64| {
            let least = spent_ligament(shape.length, resolution(shape));
            Some(shape.buried? - cut - shape.length - least)
        };
        let surfacing = ligament(before, 0.0)
            .zip(ligament(after, cut))
            .filter(|(room, left)| *room > 0.0 && *left < 0.0)
            .map(|(room, left)| room / (room - left));
        let during = |part: f64| Event { part, ends_run: false };
        Event::first(changing.events(growth).chain(surfacing.map(during)).collect())
    };
    Event::first(start.shapes.iter().zip(next).enumerate().filter_map(of).collect())
}

/// The pace of the cracks that have not stopped, and of the removal of the surface.
fn pace(start: &Start, growth: &GrowthSettings, stopped: &[Option<TipStop>], part: f64) -> StepSize {
    let growing = start.movers.iter().filter(|mover| stopped[mover.crack].is_none() && mover.rate > 0.0);
    let there = (0..start.shapes.len()).filter(|&crack| stopped[crack] != Some(TipStop::WornAway));
    let wearing = there.map(|crack| {
        let shape = &start.shapes[crack];
        let mouth_sine = shape.mouth_sine().unwrap_or(1.0);
        WearingCrack { mouth_sine, longest: start.at.worn.longest_of(crack, shape.path_length()) }
    });
    let moving = Moving {
        all: start.movers,
        growing: &growing.copied().collect::<Vec<_>>(),
        some_are_left: stopped.iter().any(Option::is_none),
        wearing: &wearing.collect::<Vec<_>>(),
    };
    StepSize::of(&moving, &start.at, growth, part)
}

/// Removes `removal` (mm) from the surface above cracks of `shapes`: those that are worn away or
/// that the surface has reached stop.
fn remove_surface(start: &Start, removal: f64, shapes: &mut [FrontShape], stopped: &mut [Option<TipStop>]) {
    for (crack, (shape, stop)) in shapes.iter_mut().zip(stopped).enumerate() {
        if *stop == Some(TipStop::WornAway) {
            continue;
        }
        let longest = start.at.worn.longest_of(crack, start.shapes[crack].path_length());
        let (left, fate) = worn(shape, removal, longest, resolution(shape));
        *shape = left;
        *stop = match fate {
            Worn::Left => *stop,
            Worn::BrokenOut => stop.or(Some(TipStop::BreakOut)),
            Worn::Away => Some(TipStop::WornAway),
        };
    }
}

/// The length (mm) that cells resolve ahead of a crack of `shape`: half the smallest distance for
/// which the integrals between cracks are verified.
pub(super) fn resolution(shape: &FrontShape) -> f64 {
    0.5 * LEAST_DISTANCE * shape.length
}

/// Two cracks of these shapes that are too close for the computation, and have not both stopped.
fn meeting(shapes: &[FrontShape], stopped: &[Option<TipStop>]) -> Option<CloseCracks> {
    let cracks: Vec<SpaceCrack> = shapes.iter().filter_map(|shape| shape.crack().ok()).collect();
    let close = if cracks.len() < shapes.len() { None } else { CloseCracks::among(&cracks) };
    close.filter(|close| [close.first, close.second].iter().any(|&crack| stopped[crack].is_none()))
}

/// The part of the step after which two cracks that grow by `increments`, and meet at its end, have
/// come as close as they can be computed; `None` where they are so at the start.
fn part_until_meeting(
    start: &Start,
    increments: &[FrontSpeeds],
    stopped: &[Option<TipStop>],
    growth: &GrowthSettings,
) -> Option<f64> {
    let meets = |part: f64| {
        let shorter = increments.iter().map(|increment| increment.map(|_, grown| part * grown));
        meeting(&start.moved(&shorter.collect::<Vec<_>>(), growth), stopped).is_some()
    };
    if meets(0.0) {
        return None;
    }
    let (mut apart, mut close) = (0.0, 1.0);
    while close - apart > MEETING {
        let middle = 0.5 * (apart + close);
        if meets(middle) {
            close = middle;
        } else {
            apart = middle;
        }
    }
    // What is left of the way to a place that an earlier step has located is no step.
    (apart > 2.0 * MEETING).then_some(apart)
}

/// Whether a crack of this shape would leave the rail, turns up to the surface, or has no ligament
/// left.
fn leaves(shape: &FrontShape, rail: RailBox) -> Option<TipStop> {
    if matches!(shape.crack(), Err(ShapeError::Dip { .. })) {
        return Some(TipStop::BreakOut);
    }
    let deepest = shape.deepest();
    let inside = -deepest.y < rail.depth && (deepest.x - rail.centre).abs() < 0.5 * rail.width;
    if !inside {
        return Some(TipStop::LeavesRail);
    }
    let least = spent_ligament(shape.length, resolution(shape));
    let spent = shape.buried.is_some_and(|centre| centre - shape.length < least);
    spent.then_some(TipStop::BreakOut)
}

#[cfg(test)]
mod tests {
    use super::super::body::FrontPoint;
    use super::super::division::{VERTEX_LAYER, is_outside};
    use super::*;
    use crate::growth::{Axles, Grinding, SurfaceRemoval, Turning, WornSurface};
    use std::f64::consts::PI;

    const RAIL: RailBox = RailBox { centre: 0.0, width: 300.0, depth: 172.0 };

    /// A semicircle of 4 mm.
    fn circle(x: f64, lateral: f64) -> FrontShape {
        FrontShape {
            dip: 0.5 * PI,
            strike: 0.0,
            length: 4.0,
            half_length: 4.0,
            middle: [x, lateral],
            buried: None,
            strip: None,
            turns: None,
            deviation: None,
        }
    }

    /// The speeds of a semicircle whose points all grow at `rate`.
    fn speeds(shape: &FrontShape, rate: f64) -> FrontSpeeds {
        let front: Vec<FrontPoint> = (0..=16)
            .map(|i| {
                let (sin, cos) = (PI * f64::from(i) / 16.0).sin_cos();
                let position = [0.0, shape.half_length * cos, shape.length * sin];
                let phi = PI * f64::from(i) / 16.0;
                let counts = is_outside(VERTEX_LAYER, phi);
                FrontPoint { crack: 0, phi, position, normal: [sin, cos], counts }
            })
            .collect();
        FrontSpeeds::nearest(shape, &front, &vec![rate; front.len()])
    }

    fn advance(
        shapes: &[FrontShape],
        stopped: &[Option<TipStop>],
        rates: &[f64],
        growth: &GrowthSettings,
    ) -> FrontAdvance {
        let of = |(crack, (shape, rate)): (usize, (&FrontShape, &f64))| {
            speeds(shape, *rate).movers(crack, shape.length).collect::<Vec<_>>()
        };
        let movers: Vec<Mover> = shapes.iter().zip(rates).enumerate().flat_map(of).collect();
        let worn = WornSurface::default();
        let at = StepStart { share: growth.increment, ..StepStart::standing(&worn) };
        let kinks = vec![[0.0; 2]; shapes.len()];
        let start = Start { shapes, stopped, movers: &movers, kinks: &kinks, breaks: false, at };
        FrontAdvance::new(&start, growth, RAIL)
    }

    fn settings() -> GrowthSettings {
        GrowthSettings { steps: 5, increment: 0.05, turning: Turning::Kink, ..GrowthSettings::default() }
    }

    #[test]
    fn the_fastest_crack_grows_by_the_increment_and_the_others_in_its_cycles() {
        let shapes = [circle(0.0, 0.0), circle(20.0, 0.0), circle(40.0, 0.0)];
        let next = advance(&shapes, &[None; 3], &[1e-6, 2e-6, 0.0], &settings());
        assert_eq!((next.stop, &next.stopped[..]), (None, &[None, None, Some(TipStop::Arrest)][..]));
        let grown: Vec<f64> = next.shapes.iter().map(|shape| shape.length - 4.0).collect();
        for (grown, want) in grown.iter().zip([0.1, 0.2, 0.0]) {
            assert!((grown - want).abs() < 1e-9, "{grown} {want}");
        }
        let pace = next.pace.as_ref().unwrap();
        assert!(
            (pace.cycles - 1e5).abs() < 1e-3 && pace.interval(|_| false).unwrap().mover.crack == 1,
            "{next:?}"
        );
        // A stopped crack stays stopped, whatever its rate.
        let later = advance(&shapes, &[None, Some(TipStop::Arrest), None], &[1e-6, 2e-6, 1e-6], &settings());
        let pace = later.pace.as_ref().unwrap();
        assert_eq!((pace.interval(|_| false).unwrap().mover.crack, later.shapes[1]), (0, shapes[1]));
        let critical = GrowthSettings { critical_length: Some(4.0), ..settings() };
        assert_eq!(advance(&shapes, &[None; 3], &[1e-6; 3], &critical).stop, Some(RunStop::CriticalLength));
    }

    #[test]
    fn equally_fast_ends_grow_alike_whichever_sets_the_pace() {
        let shapes = [circle(0.0, 0.0)];
        let smooth = GrowthSettings { turning: Turning::Over(f64::INFINITY), ..settings() };
        let mover = |index: usize, rate: f64| Mover { crack: 0, index, rate, length: 4.0 };
        // Both ends become faster; round-off makes one of them the leader.
        let movers = |ends: f64, tip: f64| [mover(0, tip), mover(1, ends), mover(2, ends * (1.0 + 1e-13))];
        let worn = WornSurface::default();
        let at = StepStart { share: 0.05, ..StepStart::standing(&worn) };
        let start = |movers, at| Start {
            shapes: &shapes,
            stopped: &[None],
            movers,
            kinks: &[[0.0; 2]],
            breaks: false,
            at,
        };
        let [before, now] = [movers(2e-6, 1e-6), movers(2.4e-6, 1.1e-6)];
        let first = FrontAdvance::new(&start(&before, at), &smooth, RAIL).pace.unwrap();
        let earlier = first.progress(&before, |_| false).earlier.unwrap();
        let at = StepStart { earlier: Some(&earlier), passed: first.cycles, ..at };
        let next = FrontAdvance::new(&start(&now, at), &smooth, RAIL);
        assert_eq!(next.shapes[0].middle, [0.0, 0.0], "{next:?}");
    }

    #[test]
    fn cracks_that_would_meet_stop_and_the_others_grow_on() {
        // The first two lie side by side, 0.3 mm apart, and each grows by 0.2 mm.
        let shapes = [circle(0.0, 0.0), circle(0.0, 8.3), circle(50.0, 0.0)];
        let next = advance(&shapes, &[None; 3], &[2e-6, 2e-6, 1e-6], &settings());
        let joined = Some(TipStop::Coalescence);
        assert_eq!((next.stop, &next.stopped[..]), (None, &[joined, joined, None][..]));
        assert_eq!(next.shapes[..2], shapes[..2]);
        // Now the third one sets the pace.
        assert!((next.shapes[2].length - 4.2).abs() < 1e-9 && next.meetings.len() == 1, "{next:?}");
        let alone = advance(&shapes[..2], &[None; 2], &[2e-6, 2e-6], &settings());
        assert_eq!(alone.stop, Some(RunStop::NoTipGrows(TipStop::Coalescence)));
    }

    #[test]
    fn a_step_ends_where_cracks_meet() {
        // A wide gap of 0.35 mm closes to the least distance of 0.05 of the length within a step.
        let shapes = [circle(0.0, 0.0), circle(0.0, 8.35)];
        let smooth = GrowthSettings { turning: Turning::Over(f64::INFINITY), ..settings() };
        let next = advance(&shapes, &[None; 2], &[2e-6; 2], &smooth);
        assert_eq!((next.stop, &next.stopped[..]), (None, &[None, None][..]));
        let [first, second] = [0, 1].map(|k| next.shapes[k]);
        let gap = 8.35 - first.half_length - second.half_length;
        let least = LEAST_DISTANCE * first.length.min(second.length);
        assert!(gap >= least && gap < 1.01 * least, "{gap} {least}");
        let after = advance(&next.shapes, &next.stopped, &[2e-6; 2], &smooth);
        assert_eq!(after.stop, Some(RunStop::NoTipGrows(TipStop::Coalescence)));
    }

    #[test]
    fn a_crack_that_would_leave_the_rail_stops_alone() {
        let shallow = FrontShape { dip: 0.2, ..circle(145.99, 0.0) };
        let shapes = [shallow, circle(0.0, 0.0)];
        let next = advance(&shapes, &[None; 2], &[3e-6, 1e-6], &settings());
        assert_eq!((next.stop, &next.stopped[..]), (None, &[Some(TipStop::LeavesRail), None][..]));
        assert!((next.shapes[1].length - 4.2).abs() < 1e-9, "{next:?}");
    }

    #[test]
    fn in_the_balance_of_growth_and_wear_the_length_stays() {
        let shapes = [FrontShape { dip: (0.6f64).asin(), ..circle(0.0, 0.0) }];
        let maintained = |wear, grinding| {
            let maintenance = SurfaceRemoval { wear, grinding, ..SurfaceRemoval::NONE };
            GrowthSettings { maintenance: Some(maintenance), ..settings() }
        };
        // w = sin(dip) dl/dN.
        let next = advance(&shapes, &[None], &[1e-6], &maintained(0.6e-6, None));
        let pace = next.pace.as_ref().unwrap();
        assert!((pace.cycles - 2e5).abs() < 1e-3 && (pace.removal - 0.12).abs() < 1e-12, "{next:?}");
        assert!((next.shapes[0].length - 4.0).abs() < 1e-9 && next.stop.is_none(), "{next:?}");
        // The step ends where the worn crack has its critical length.
        let critical = GrowthSettings {
            critical_length: Some(4.05),
            turning: Turning::Over(f64::INFINITY),
            ..maintained(0.3e-6, None)
        };
        let next = advance(&shapes, &[None], &[1e-6], &critical);
        assert!((next.shapes[0].length - 4.05).abs() < 1e-9, "{next:?}");
        // A crack at rest is not stopped for good, since the surface comes closer.
        let at_rest = advance(&shapes, &[None], &[0.0], &maintained(0.6e-6, None));
        assert_eq!((at_rest.stop, at_rest.stopped[0]), (None, None));
        assert!((at_rest.shapes[0].length - 3.8).abs() < 1e-9, "{at_rest:?}");
        let deep = Grinding { depth: 2.5, interval: Axles(1e5), first: Some(Axles(0.0)) };
        let gone = advance(&shapes, &[None], &[1e-6], &maintained(0.0, Some(deep)));
        assert_eq!(gone.stop, Some(RunStop::NoTipGrows(TipStop::WornAway)), "{gone:?}");
    }
}
