//! The shape of a path in the words of the paper: co-planar, branched up or down, parallel to the
//! surface.

use crate::case_run::CrackGrowth;
use serde::Deserialize;

/// Side to which a branch turns from the line of the initial crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Towards the running surface.
    Up,
    /// Into the rail.
    Down,
}

/// Increment and side at which a path leaves the line of the initial crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// The increment that leaves it, from 1.
    pub increment: usize,
    /// To which side.
    pub side: Side,
}

/// A path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathShape {
    /// The first increment more than 20° off the initial crack; none where there is none.
    pub branch: Option<Branch>,
    /// Increments of the path.
    pub increments: usize,
    /// Depth of its end, mm.
    pub depth: f64,
    /// Angle of the line from the tip of the initial crack to its end, below the surface, degrees
    /// in (−90, 90]: of a path that ends above that tip it is negative. None where nothing has
    /// grown.
    pub inclination: Option<f64>,
    /// The same from where it has branched.
    pub inclination_after: Option<f64>,
    /// Extent in +x from there, mm.
    pub along_after: Option<f64>,
}

/// Deviation (degrees) from the initial crack that counts as a branch: more than the slow turns of
/// co-planar growth, less than the kinks of 60° to 76° that compete with it.
const BRANCHED: f64 = 20.0;

/// A path this close (degrees) to the direction of the surface runs parallel to it.
const PARALLEL: f64 = 10.0;

/// Increments on the line of the initial crack after which growth was co-planar at first.
const COPLANAR_FIRST: usize = 3;

/// The course of a path, as statements name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PathCourse {
    /// It stays on the line of the initial crack.
    CoPlanar,
    /// It does so for at least three increments.
    CoPlanarFirst,
    /// It branches towards the running surface.
    Up,
    /// It branches into the rail.
    Down,
    /// It branches and runs parallel to the surface from there.
    Parallel,
    /// It does so in the direction of travel.
    ParallelWithTravel,
}

impl PathShape {
    /// The path of `crack`.
    pub fn new(crack: &CrackGrowth) -> Self {
        let points = &crack.points;
        let tip = crack.initial_points - 1;
        let heading = |i: usize| [points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]];
        let first = heading(tip - 1);
        let grown = tip..points.len() - 1;
        // Deeper is positive, whichever way the crack leans.
        let deviation = |i: usize| {
            let part = heading(i);
            let cross = first[0] * part[1] - first[1] * part[0];
            let along = first[0] * part[0] + first[1] * part[1];
            cross.atan2(along).to_degrees() * first[0].signum()
        };
        let branch = grown.clone().find(|&i| deviation(i).abs() > BRANCHED);
        let inclination = |from: usize| {
            let (a, b) = (points.get(from)?, points.last()?);
            let (across, down) = (b[0] - a[0], b[1] - a[1]);
            (across != 0.0 || down != 0.0).then(|| down.atan2(across.abs()).to_degrees())
        };
        Self {
            branch: branch.map(|i| Branch {
                increment: i - tip + 1,
                side: if deviation(i) > 0.0 { Side::Down } else { Side::Up },
            }),
            increments: grown.len(),
            depth: points.last().map_or(0.0, |p| p[1]),
            inclination: inclination(tip),
            inclination_after: branch.and_then(inclination),
            along_after: branch.and_then(|i| Some(points.last()?[0] - points[i][0])),
        }
    }

    /// The increment of its branch; one more than it has where it does not branch.
    pub fn branch_increment(&self) -> usize {
        self.branch.map_or(self.increments + 1, |branch| branch.increment)
    }

    /// Whether it is of this `course`, under a wheel that travels in the direction of the sign of
    /// `travel` along x.
    pub fn is(&self, course: PathCourse, travel: f64) -> bool {
        let branches_to = |side: Side| self.branch.is_some_and(|branch| branch.side == side);
        let is_parallel = self.inclination_after.is_some_and(|angle| angle.abs() <= PARALLEL);
        match course {
            PathCourse::CoPlanar => self.branch.is_none() && self.increments > 0,
            PathCourse::CoPlanarFirst => self.branch_increment() > COPLANAR_FIRST,
            PathCourse::Up => branches_to(Side::Up),
            PathCourse::Down => branches_to(Side::Down),
            PathCourse::Parallel => is_parallel,
            PathCourse::ParallelWithTravel => {
                is_parallel && self.along_after.is_some_and(|along| along * travel > 0.0)
            }
        }
    }

    /// A few words: `co-planar`, `up at 3`.
    pub fn words(&self) -> String {
        match self.branch {
            None if self.increments == 0 => "none".into(),
            None => "co-planar".into(),
            Some(Branch { increment, side: Side::Up }) => format!("up at {increment}"),
            Some(Branch { increment, side: Side::Down }) => format!("down at {increment}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[[f64; 2]]) -> PathShape {
        PathShape::new(&CrackGrowth { points: points.to_vec(), initial_points: 2, ..CrackGrowth::default() })
    }

    #[test]
    fn sides_do_not_depend_on_the_lean() {
        for sign in [1.0, -1.0] {
            let at = |x: f64, depth: f64| [sign * x, depth];
            let down = path(&[at(0.0, 0.0), at(6.0, 2.0), at(7.0, 2.3), at(7.2, 3.5)]);
            assert_eq!(down.branch, Some(Branch { increment: 2, side: Side::Down }), "{down:?}");
            assert_eq!(down.branch_increment(), 2);
            let up = path(&[at(0.0, 0.0), at(6.0, 2.0), at(7.0, 1.9)]);
            assert_eq!(up.branch, Some(Branch { increment: 1, side: Side::Up }));
            assert!(
                up.is(PathCourse::Parallel, sign)
                    && up.is(PathCourse::ParallelWithTravel, sign)
                    && up.inclination_after.unwrap() < 0.0
            );
            assert!((up.along_after.unwrap() - sign).abs() < 1e-12, "{up:?}");
            // Straight up, past the vertical.
            let back = path(&[at(0.0, 0.0), at(6.0, 2.0), at(5.9, 1.0)]);
            assert_eq!(back.branch.map(|b| b.side), Some(Side::Up));
        }
    }

    #[test]
    fn a_straight_path_is_coplanar() {
        let straight = path(&[[0.0, 0.0], [6.0, 2.0], [9.0, 3.1]]);
        assert!(straight.is(PathCourse::CoPlanar, 1.0) && !straight.is(PathCourse::Parallel, 1.0));
        assert_eq!(straight.branch_increment(), 2);
        assert!(!path(&[[0.0, 0.0], [6.0, 2.0]]).is(PathCourse::CoPlanar, 1.0), "nothing has grown");
    }
}
