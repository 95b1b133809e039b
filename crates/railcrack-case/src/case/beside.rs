//! Two cracks that meet where one begins, computed with a gap: a V of two cracks from one mouth,
//! and a branch.

use railcrack::crack::{Crack, CrackNetwork, segment_distance};
use railcrack::math::Vec2;

/// The gap over the length of the shorter crack.
pub(super) const GAP: f64 = 0.02;

/// A crack that begins beside another one.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Beside {
    /// With its mouth at this x, mm.
    Mouth(f64),
    /// With this first point, below the surface.
    Buried(Vec2),
}

/// The `crack` that meets the `other` one, moved so that they have a gap; none where they meet
/// elsewhere than at its first point.
pub(super) fn beside(crack: &Crack, other: &Crack) -> Option<Beside> {
    let gap = GAP * crack.length().min(other.length());
    let first = *crack.points().first()?;
    let touches = other.points().windows(2).any(|part| distance(first, part[0], part[1]) < gap);
    if !touches {
        return None;
    }
    let is_apart = |moved: &Crack| {
        let meet = CrackNetwork::new(vec![moved.clone(), other.clone()]).is_err();
        let pairs = || moved.points().windows(2).flat_map(|a| other.points().windows(2).map(move |b| (a, b)));
        !meet && pairs().all(|(a, b)| segment_distance(a[0], a[1], b[0], b[1]) > 0.1 * gap)
    };
    // On the surface it keeps its mouth, within the rail it leaves a bridge.
    if crack.is_surface_breaking() {
        let moved = [-gap, gap].into_iter().find(|by| is_apart(&crack.moved(*by)));
        return moved.map(|by| Beside::Mouth(first.x + by));
    }
    let (start, next) = crack.segment(0);
    let begin = start + (next - start) * (gap / (next - start).length());
    let points = std::iter::once(begin).chain(crack.points().iter().skip(1).copied()).collect();
    let cut = Crack::polyline(points).ok().filter(is_apart)?;
    cut.points().first().map(|point| Beside::Buried(*point))
}

/// The distance (mm) of the point p from the segment a–b.
fn distance(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let share = (p - a).dot(along) / along.dot(along);
    (p - (a + along * share.clamp(0.0, 1.0))).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(mouth: f64, angle: f64) -> Crack {
        Crack::surface_breaking(mouth, 4.0, f64::to_radians(angle)).unwrap()
    }

    fn line(points: [[f64; 2]; 2]) -> Crack {
        Crack::polyline(points.iter().map(|[x, y]| Vec2::new(*x, *y)).collect()).unwrap()
    }

    #[test]
    fn a_v_and_a_branch_have_a_gap() {
        // Away from the other crack, on either side.
        assert_eq!(beside(&straight(0.0, 160.0), &straight(0.0, 20.0)), Some(Beside::Mouth(-0.08)));
        assert_eq!(beside(&straight(0.0, 20.0), &straight(0.0, 160.0)), Some(Beside::Mouth(0.08)));
        let main = line([[0.0, 0.0], [4.0, -2.0]]);
        let Some(Beside::Buried(begin)) = beside(&line([[2.0, -1.0], [2.0, -2.0]]), &main) else { panic!() };
        assert!((begin - Vec2::new(2.0, -1.02)).length() < 1e-12, "{begin:?}");
        // Crossing cracks do not meet at a first point.
        assert_eq!(beside(&line([[2.0, -0.5], [2.0, -2.0]]), &main), None);
    }
}
