//! Cracks of two points as semi-ellipses in space, those of three as folded cracks.

use crate::schema::SectionValues;
use crate::tables::{CRACK_LATERAL, STRIKE};
use railcrack::crack::Crack;
use railcrack::growth::{FrontShape, FrontTurns};
use railcrack::math::Vec2;
use std::f64::consts::PI;

/// The shape of a crack of two points, or of three from its mouth on, which may not be admissible.
pub(super) fn front_shape(crack: &Crack, half_length: f64, section: &SectionValues) -> Option<FrontShape> {
    match *crack.points() {
        [one, other] => Some(planar_shape(crack, [one, other], half_length, section)),
        [mouth, fold, deepest] if crack.is_surface_breaking() => {
            let dip = |from: Vec2, to: Vec2| (-(to - from).angle()).rem_euclid(2.0 * PI);
            let [above, below] = [dip(mouth, fold), dip(fold, deepest)];
            let strip = (fold - mouth).length();
            Some(FrontShape {
                dip: above,
                strike: section.get(STRIKE).unwrap_or(0.0).to_radians(),
                length: (deepest - fold).length(),
                half_length,
                middle: [mouth.x, section.get(CRACK_LATERAL).unwrap_or(0.0)],
                buried: None,
                strip: Some(strip),
                turns: Some(FrontTurns::fold(strip, below - above)),
                deviation: None,
            })
        }
        _ => None,
    }
}

fn planar_shape(
    crack: &Crack,
    [mut top, mut bottom]: [Vec2; 2],
    half_length: f64,
    section: &SectionValues,
) -> FrontShape {
    if bottom.y > top.y {
        std::mem::swap(&mut top, &mut bottom);
    }
    let dip = -(bottom - top).angle();
    let length = crack.length();
    // Intersection of the plane with the surface; a crack parallel to it has none and is refused
    // below.
    let to_surface = -top.y / dip.sin();
    let buried = (!crack.is_surface_breaking()).then_some(to_surface + 0.5 * length);
    let lateral = section.get(CRACK_LATERAL).unwrap_or(0.0);
    let strike = section.get(STRIKE).unwrap_or(0.0).to_radians();
    // A buried crack turns about its own middle.
    let (aside, ahead) = strike.sin_cos();
    let away = buried.unwrap_or(0.0) * dip.cos();
    FrontShape {
        dip: dip.rem_euclid(2.0 * PI),
        strike,
        length: if buried.is_some() { 0.5 * length } else { length },
        half_length,
        middle: [top.x - to_surface * dip.cos() + away * (1.0 - ahead), lateral - away * aside],
        buried,
        strip: None,
        turns: None,
        deviation: None,
    }
}
