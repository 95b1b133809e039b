//! Size of the integration domain of the SIFs at a tip.

use super::cuts::{Cuts, SHARP_KINK};
use super::settings::XfemSettings;
use super::sif::SifDomain;
use crate::crack::point_to_segment;
use crate::math::Vec2;

/// Smallest ratio of the outer to the inner radius of a domain: with an inner radius of 1.5
/// elements, more than an element lies between them. A smaller inner radius extends into the
/// elements at the tip and costs 0.9 % of K.
const SMALLEST: f64 = 2.0;

/// Distance, in elements, between a tip and its neighbour below which K is unreliable, since both
/// lie in one element. Measured against fine elements of the other engine: within 0.1 % of the
/// largest K down to 1.4 elements, 0.8 % at 0.6, 6 % at 0.4.
const TRUSTED: f64 = 1.0;

/// The nearest neighbour of a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Neighbour {
    Crack(usize),
    Surface,
}

/// The domain of tip `tip`, around which elements have the size `size` (mm): as in `settings`, but
/// extending no farther than the nearest other crack or the running surface, down to [`SMALLEST`].
/// Neighbours inside the smallest domain contribute to its integral through their faces. The remark
/// reports a neighbour that is too near.
pub(super) fn domain_of(
    cuts: &Cuts,
    tip: usize,
    size: f64,
    settings: &XfemSettings,
) -> (SifDomain, Option<String>) {
    let inner = settings.domain_inner * size;
    let wanted = settings.domain_outer * size;
    let (distance, neighbour) = nearest(cuts, tip);
    let outer = wanted.min(distance.max(SMALLEST * inner));
    let domain = SifDomain { inner, outer };
    let remark = (distance < TRUSTED * size).then(|| {
        let path = &cuts.tips[tip];
        let at = path.position();
        let near = match neighbour {
            Neighbour::Crack(crack) => format!("crack {}", crack + 1),
            Neighbour::Surface => "the running surface".to_owned(),
        };
        format!(
            "crack {}: its tip at ({:.3}, {:.3}) mm is {distance:.3} mm from {near}, {:.2} of an element: its K cannot be trusted; smaller \
             elements (element_size_mm) resolve it",
            path.crack + 1,
            at.x,
            at.y,
            distance / size
        )
    });
    (domain, remark)
}

/// Distance, in elements, between a tip and the last sharp kink of its crack below which K is
/// unreliable, since crack-face friction around the corner is not resolved. Measured against fine
/// elements of the other engine, kinks of 40° and 70° to either side: up to 15 % of the largest K
/// at a quarter of an element, 8 % at one, 6 % at 1.6, 4 % at 2.4.
const TRUSTED_PART: f64 = 1.25;

/// A remark on a last segment after a sharp kink that is too short for elements of `size` (mm).
pub(super) fn short_part(cuts: &Cuts, tip: usize, size: f64) -> Option<String> {
    let path = &cuts.tips[tip];
    let (from, to) = path.last_segment();
    let length = (to - from).length();
    let turn = path.last_turn().filter(|&turn| turn > SHARP_KINK && length < TRUSTED_PART * size)?;
    Some(format!(
        "crack {}: its tip at ({:.3}, {:.3}) mm is {length:.3} mm behind a kink of {:.0}°, {:.2} of an element: its K under friction cannot be \
         trusted; larger increments, or smaller elements (element_size_mm), resolve it",
        path.crack + 1,
        to.x,
        to.y,
        turn.to_degrees(),
        length / size
    ))
}

/// Distance (mm) from a tip to the nearest other crack or the surface.
fn nearest(cuts: &Cuts, tip: usize) -> (f64, Neighbour) {
    let path = &cuts.tips[tip];
    let at: Vec2 = path.position();
    let others = cuts.paths.iter().enumerate().filter(|(crack, _)| *crack != path.crack);
    let cracks = others.map(|(crack, other)| {
        let distances = other.points.windows(2).map(|pair| point_to_segment(at, pair[0], pair[1]));
        (distances.fold(f64::INFINITY, f64::min), Neighbour::Crack(crack))
    });
    cracks.fold((-at.y, Neighbour::Surface), |best, one| if one.0 < best.0 { one } else { best })
}
