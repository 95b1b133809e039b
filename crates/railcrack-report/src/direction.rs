//! Direction of a crack tip, in words.

use crate::numbers::fixed;
use railcrack::growth::{RunStop, TipStop};
use railcrack_run::CrackSummary;
use railcrack_run::csv::TipRow;

/// A kink (degrees) beyond which the path is said to branch.
const BRANCH_DEG: f64 = 30.0;
/// A heading within this of the horizontal (degrees) is level.
const LEVEL_DEG: f64 = 0.5;

/// Direction of the last segment at a tip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Course {
    /// Into the rail.
    Downward,
    /// Parallel to the running surface.
    Level,
    /// Towards the running surface.
    Upward,
    /// Broken out at the running surface.
    Spall,
}

impl Course {
    /// Every course, in the order of reading.
    pub(crate) const ALL: [Self; 4] = [Self::Downward, Self::Level, Self::Upward, Self::Spall];

    /// One word.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Downward => "downward",
            Self::Level => "level",
            Self::Upward => "upward",
            Self::Spall => "spall",
        }
    }
}

/// The last segment of a tip.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Heading {
    /// Degrees below the surface, of the last segment; negative: upwards.
    now: f64,
    /// The same at the beginning.
    before: f64,
    /// The largest kink that the path made: step, degrees.
    branch: Option<(usize, f64)>,
    /// Whether the tip broke out at the surface.
    spalled: bool,
}

/// Direction at the tip of `crack` with the rows `history`, by step; none where the crack is a
/// point.
pub(crate) fn heading(crack: &CrackSummary, history: &[&TipRow]) -> Option<Heading> {
    let (first, last) = (history.first()?, history.last()?);
    let now = below_surface(&crack.points_mm, last.place)?;
    let before = below_surface(&crack.initial_points_mm, first.place)?;
    let kinks = history.iter().filter(|row| row.increment > 0.0);
    let branch = kinks
        .filter_map(|row| Some((row.step, row.turn_deg.or(row.kink_deg)?)))
        .reduce(|most, next| if next.1.abs() > most.1.abs() { next } else { most })
        .filter(|kink| kink.1.abs() > BRANCH_DEG);
    Some(Heading { now, before, branch, spalled: last.stop == Some(RunStop::NoTipGrows(TipStop::BreakOut)) })
}

/// Degrees below the surface of the segment that ends at the end of `points` nearer to `tip`.
fn below_surface(points: &[[f64; 2]], tip: [f64; 2]) -> Option<f64> {
    let distance = |p: &[f64; 2]| (p[0] - tip[0]).hypot(p[1] - tip[1]);
    let (first, last) = (points.first()?, points.last()?);
    let (from, to) = if distance(last) <= distance(first) {
        (points.get(points.len().checked_sub(2)?)?, last)
    } else {
        (points.get(1)?, first)
    };
    Some((from[1] - to[1]).atan2((to[0] - from[0]).abs()).to_degrees())
}

impl Heading {
    /// Its course.
    pub(crate) fn course(&self) -> Course {
        match self {
            Self { spalled: true, .. } => Course::Spall,
            Self { now, .. } if *now > LEVEL_DEG => Course::Downward,
            Self { now, .. } if *now < -LEVEL_DEG => Course::Upward,
            _ => Course::Level,
        }
    }

    /// Angles and branch, a few words.
    pub(crate) fn note(&self) -> String {
        let (now, before) = (angle(self.now), angle(self.before));
        let side = if self.now < -LEVEL_DEG { " above the horizontal" } else { " below the horizontal" };
        let short = |text: &str| text.strip_suffix(side).map(str::to_owned);
        let mut text = match short(&before) {
            Some(before) if now.ends_with(side) => format!("{now}, initially {before}"),
            _ => format!("{now}, initially {before}"),
        };
        if let Some((step, kink)) = self.branch {
            text.push_str(&format!("; kinks by {}° in step {step}", fixed(kink, 0)));
        }
        text
    }

    /// For the end of a sentence.
    pub(crate) fn sentence(&self) -> String {
        match self.course() {
            Course::Spall => "and breaks out at the running surface: a spall".to_owned(),
            Course::Upward => format!("upward, towards a spall ({})", self.note()),
            course => format!("{} ({})", course.word(), self.note()),
        }
    }
}

fn angle(degrees: f64) -> String {
    match degrees {
        LEVEL_DEG.. => format!("{}° below the horizontal", fixed(degrees, 0)),
        _ if degrees < -LEVEL_DEG => format!("{}° above the horizontal", fixed(-degrees, 0)),
        _ => "level".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_those_of_the_segment_at_the_tip() {
        let points = [[0.0, 0.0], [1.0, -1.0], [2.0, -1.0], [3.0, 0.732]];
        assert!((below_surface(&points, [3.0, 0.732]).unwrap() + 60.0).abs() < 1e-2);
        assert!((below_surface(&points, [0.0, 0.1]).unwrap() + 45.0).abs() < 1e-9);
        assert_eq!(below_surface(&[[0.0, 0.0]], [0.0, 0.0]), None);
        // A crack that leans left goes down as well.
        assert!((below_surface(&[[0.0, 0.0], [-1.0, -1.0]], [-1.0, -1.0]).unwrap() - 45.0).abs() < 1e-9);
    }

    #[test]
    fn words_say_where_it_goes() {
        let heading = |now: f64| Heading { now, before: 15.0, branch: None, spalled: false };
        assert_eq!(
            [30.0, -20.0, 0.1].map(|now| heading(now).course().word()),
            ["downward", "upward", "level"]
        );
        let branched = Heading { branch: Some((3, -62.4)), ..heading(77.0) };
        assert_eq!(
            branched.note(),
            "77° below the horizontal, initially 15°; kinks by \u{2212}62° in step 3"
        );
        assert!(Heading { spalled: true, ..heading(-5.0) }.sentence().contains("a spall"));
    }
}
