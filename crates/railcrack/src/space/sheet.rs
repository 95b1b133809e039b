//! A crack as a surface in the rail.

use super::plane::PlaneFrame;
use super::shape::SpaceCrack;
use crate::growth::FrontWay;

/// A point of a surface over a plane (s, ζ).
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetPoint {
    /// x, lateral, depth, mm.
    pub position: [f64; 3],
    /// Derivatives of the position in s and ζ.
    pub tangents: [[f64; 3]; 2],
    /// Unit normal.
    pub normal: [f64; 3],
}

/// The surface of a crack over the plane (s, ζ) into which it unrolls: s is the distance from the
/// mouth along the way down its middle, ζ that along the trace of the mouth.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    way: FrontWay,
    strike: f64,
    middle: [f64; 2],
    /// The frame of a plane.
    plane: Option<PlaneFrame>,
}

impl Sheet {
    pub fn of(crack: &SpaceCrack) -> Self {
        let way = FrontWay::new(crack.dip, crack.turns.as_ref());
        let plane = way.is_straight().then(|| crack.frame());
        Self { way, strike: crack.strike, middle: crack.middle, plane }
    }

    /// The frame of its plane; none for a crack that turns.
    pub fn plane(&self) -> Option<&PlaneFrame> {
        self.plane.as_ref()
    }

    /// The way down its middle.
    pub fn way(&self) -> &FrontWay {
        &self.way
    }

    /// x, lateral and depth (mm) of the point (s, ζ).
    pub fn place(&self, point: [f64; 2]) -> [f64; 3] {
        self.framed(point).0
    }

    /// Directions at s: normal, down the way, along the trace; on a fold those above it.
    pub fn frame(&self, s: f64) -> PlaneFrame {
        self.framed([s, 0.0]).1
    }

    /// The point (s, ζ).
    pub fn at(&self, point: [f64; 2]) -> SheetPoint {
        let (position, frame) = self.framed(point);
        let [normal, along, across] = frame.directions();
        SheetPoint { position, tangents: [along, across], normal }
    }

    /// The place of the point (s, ζ) and the directions there.
    pub fn framed(&self, [s, zeta]: [f64; 2]) -> ([f64; 3], PlaneFrame) {
        let s = s.max(0.0);
        let (frame, [along, across, depth]) = match self.plane {
            Some(frame) => (frame, frame.position(s, zeta)),
            None => {
                let point = self.way.at(s);
                let [out, depth] = point.place;
                let frame = PlaneFrame::turned(point.dip, self.strike);
                // The trace is the horizontal of the way turned by a right angle.
                let [_, _, [across, along, _]] = frame.directions();
                (frame, [out * along + zeta * across, zeta * along - out * across, depth])
            }
        };
        let [x, lateral] = self.middle;
        ([x + along, lateral + across, depth], frame)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::FrontTurns;

    #[test]
    fn tangents_are_the_derivatives_of_the_position() {
        let turns = Some(FrontTurns::after(1.0).and(2.0, 0.7));
        let crack = SpaceCrack::surface_breaking(0.5, 4.0, 5.0).unwrap();
        let sheet = Sheet::of(&SpaceCrack { strike: 0.4, middle: [1.0, -2.0], turns, ..crack.clone() });
        let h = 1e-6;
        for s in [0.4, 1.7, 3.6] {
            let point = sheet.at([s, 0.8]);
            for (step, tangent) in [[h, 0.0], [0.0, h]].into_iter().zip(point.tangents) {
                let [ahead, behind] =
                    [1.0, -1.0].map(|sign| sheet.place([s + sign * step[0], 0.8 + sign * step[1]]));
                for c in 0..3 {
                    assert!(((ahead[c] - behind[c]) / (2.0 * h) - tangent[c]).abs() < 1e-8, "{s}");
                }
            }
        }
        // A way without turns is the plane.
        let straight = Some(FrontTurns::after(1.0).and(2.0, 0.0));
        let [plane, way] =
            [None, straight].map(|turns| Sheet::of(&SpaceCrack { strike: 0.4, turns, ..crack.clone() }));
        for (a, b) in plane.place([3.3, -0.6]).into_iter().zip(way.place([3.3, -0.6])) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}
