//! Shape of a crack, and why cracks cannot be computed.

use super::plane::PlaneFrame;
use crate::growth::FrontTurns;
use crate::interruption::Interrupted;
use crate::linear::LinearError;
use thiserror::Error;

/// Extent of a crack: open to the surface or closed below it.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Extent {
    /// The crack breaks the surface: its front runs from one end of the mouth to the other, and
    /// `length` is measured from the mouth down the dip.
    SurfaceBreaking,
    /// The front is closed; the middle of the crack lies at this distance (mm) from the trace of
    /// its plane in the surface, along the dip.
    Buried {
        /// Distance of the middle from the trace of the plane, mm.
        centre: f64,
    },
}

/// A crack with a smooth front, star-shaped about the middle of its mouth or, if buried, about its
/// centre, in the plane into which it unrolls.
///
/// With φ the parametric angle, the front lies at ζ = ζ₀ + c g(φ) cos φ and s = s₀ + l g(φ) sin φ;
/// φ runs from 0 at the end with larger ζ through 90° at the deepest point to 180°, or to 360°
/// where the front is closed. g = 1 + Σ (b_k cos kφ + a_k sin kφ).
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SpaceCrack {
    /// Angle between its plane, at the mouth if it turns, followed downwards, and +x, radians.
    pub dip: f64,
    /// Turn of the plane about the vertical through `middle`, from +x to the positive lateral
    /// direction, radians.
    pub strike: f64,
    /// Semi-axis c along the surface, mm.
    pub half_length: f64,
    /// Semi-axis l down the dip, mm.
    pub length: f64,
    /// x and lateral position (mm) of the middle of the trace of the plane in the surface.
    pub middle: [f64; 2],
    /// Whether the front is open or closed.
    pub extent: Extent,
    /// Length (mm) of a rectangular strip between the mouth and the half-ellipse.
    pub strip: Option<f64>,
    /// How it turns from the mouth down; none for a planar crack.
    pub turns: Option<FrontTurns>,
    /// [b_0, a_0], [b_1, a_1], …: relative deviations of the front from the ellipse.
    pub deviation: Vec<[f64; 2]>,
}

/// Deviation g − 1 of a front above which its points stay in order along each ray: with it the
/// point at the distance r of the disc moves to r (1 + (g − 1) r²), which increases up to r = 1
/// where g − 1 > −1/3.
const LEAST_DEVIATION: f64 = -0.3;
/// Deviation up to which the cells are not much longer than those of the ellipse.
const LARGEST_DEVIATION: f64 = 0.5;

/// An inadmissible crack.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ShapeError {
    /// A semi-axis that is not positive and finite.
    #[error("semi-axis {value} mm of a crack: must be positive and finite")]
    HalfAxis {
        /// The given value, mm.
        value: f64,
    },
    /// A dip outside the admissible range.
    #[error("dip of {degrees}° of a crack: must lie between 5° and 175°")]
    Dip {
        /// The given value, degrees.
        degrees: f64,
    },
    /// A strike outside the admissible range.
    #[error("strike of {degrees}° of a crack: must lie between −180° and 180°")]
    Strike {
        /// The given value, degrees.
        degrees: f64,
    },
    /// A buried crack that reaches the surface.
    #[error(
        "buried crack whose middle lies {centre} mm down the dip: its semi-axis {length} mm reaches the surface"
    )]
    ReachesSurface {
        /// Distance of the middle from the trace of the plane, mm.
        centre: f64,
        /// Semi-axis down the dip, mm.
        length: f64,
    },
    /// A buried crack that turns.
    #[error("a buried crack that turns: must break the surface")]
    BuriedTurns,
    /// A crack that turns too close to its mouth.
    #[error("a crack that turns {value:.3} mm from its mouth: must be straight for at least {least:.3} mm")]
    Straight {
        /// Length of its straight part, mm.
        value: f64,
        /// The least length, mm.
        least: f64,
    },
    /// A fold that is too sharp, or not the lower end of a strip.
    #[error(
        "fold of {degrees}° of a crack {at:.3} mm from its mouth: must lie between −90° and 90° and end a strip"
    )]
    Fold {
        /// The turn, degrees.
        degrees: f64,
        /// Its distance from the mouth, mm.
        at: f64,
    },
    /// A front that is not star-shaped about its middle.
    #[error(
        "deviation {value:.3} of the front from its ellipse at {degrees}°: must lie between {LEAST_DEVIATION} and {LARGEST_DEVIATION}"
    )]
    Deviation {
        /// g − 1 there.
        value: f64,
        /// The parametric angle, degrees.
        degrees: f64,
    },
}

/// Least straight part of a crack without a strip that turns, relative to its length: three rows
/// of cells lie in it, and the integrals of narrow ones take long.
pub(super) const LEAST_STRAIGHT: f64 = 0.06;
/// The straight part, relative to the length, of a crack whose first arcs become a chord.
pub(super) const CHORD: f64 = 1.2 * LEAST_STRAIGHT;

impl SpaceCrack {
    /// A semi-ellipse that breaks the surface: `dip` in radians, half the length of its mouth and
    /// its length down the dip in mm.
    pub fn surface_breaking(dip: f64, half_length: f64, length: f64) -> Result<Self, ShapeError> {
        Self::new(dip, half_length, length, Extent::SurfaceBreaking)
    }

    /// A buried ellipse whose middle lies `centre` mm from the trace of its plane.
    pub fn buried(dip: f64, half_length: f64, length: f64, centre: f64) -> Result<Self, ShapeError> {
        Self::new(dip, half_length, length, Extent::Buried { centre })
    }

    fn new(dip: f64, half_length: f64, length: f64, extent: Extent) -> Result<Self, ShapeError> {
        let (middle, deviation) = ([0.0; 2], Vec::new());
        Self { dip, strike: 0.0, half_length, length, middle, extent, strip: None, turns: None, deviation }
            .checked()
    }

    /// Returns the crack if it is admissible.
    ///
    /// Errors: a length that is not positive; a dip below 5° or above 175°, or a strike above 180°;
    /// a front that is not star-shaped; a strip or turns of a buried crack; turns too close to the
    /// mouth; a fold that is not the lower end of a strip.
    pub fn checked(self) -> Result<Self, ShapeError> {
        for value in [self.half_length, self.length].into_iter().chain(self.strip) {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ShapeError::HalfAxis { value });
            }
        }
        let dips = self.turns.iter().flat_map(FrontTurns::pieces).scan(self.dip, |dip, [_, turn]| {
            *dip += turn;
            Some(*dip)
        });
        for degrees in std::iter::once(self.dip).chain(dips).map(f64::to_degrees) {
            if !(5.0 - 1e-9..=175.0 + 1e-9).contains(&degrees) {
                return Err(ShapeError::Dip { degrees });
            }
        }
        if let Some(turns) = &self.turns {
            self.check_turns(turns)?;
        }
        let degrees = self.strike.to_degrees();
        if !(-180.0..=180.0).contains(&degrees) {
            return Err(ShapeError::Strike { degrees });
        }
        for degrees in 0..360 {
            let value = self.radius_factor(f64::from(degrees).to_radians()) - 1.0;
            if !(value > LEAST_DEVIATION && value < LARGEST_DEVIATION) {
                return Err(ShapeError::Deviation { value, degrees: f64::from(degrees) });
            }
            if let Extent::Buried { centre } = self.extent {
                let reach = self.length * (1.0 + value) * f64::from(degrees).to_radians().sin();
                if (centre + reach).is_nan() || centre + reach <= 0.0 {
                    return Err(ShapeError::ReachesSurface { centre, length: self.length });
                }
            }
        }
        Ok(self)
    }

    fn check_turns(&self, turns: &FrontTurns) -> Result<(), ShapeError> {
        if self.extent != Extent::SurfaceBreaking {
            return Err(ShapeError::BuriedTurns);
        }
        let least = self.strip.map_or(LEAST_STRAIGHT * self.length, |strip| strip * (1.0 - 1e-9));
        if turns.straight.is_nan() || turns.straight < least {
            return Err(ShapeError::Straight { value: turns.straight, least });
        }
        let mut from = turns.straight;
        for &[length, turn] in turns.pieces() {
            let at_strip = self.strip.is_some_and(|strip| (from - strip).abs() <= 1e-9 * strip);
            let is_fold = length == 0.0;
            let degrees = turn.to_degrees();
            if is_fold && !(at_strip && degrees.abs() <= 90.0 + 1e-9) {
                return Err(ShapeError::Fold { degrees, at: from });
            }
            from += length;
        }
        Ok(())
    }

    /// The directions of its plane, at the mouth if it turns.
    pub fn frame(&self) -> PlaneFrame {
        PlaneFrame::turned(self.dip, self.strike)
    }

    /// Whether the crack equals the other one but for its place along the surface.
    pub(super) fn is_copy_of(&self, other: &Self) -> bool {
        let at_origin = |crack: &Self| Self { middle: [0.0; 2], ..crack.clone() };
        at_origin(self) == at_origin(other)
    }

    /// g(φ).
    pub(super) fn radius_factor(&self, phi: f64) -> f64 {
        let of = |(k, [b, a]): (usize, &[f64; 2])| {
            let (sin, cos) = (k as f64 * phi).sin_cos();
            b * cos + a * sin
        };
        1.0 + self.deviation.iter().enumerate().map(of).sum::<f64>()
    }

    /// (s, ζ) relative to the middle of the trace (mm) of the point (X, Y) of the unit disc; X goes
    /// to ζ, Y to s, from the lower end of a strip. The deviation of the front fades out as the
    /// square of the radius.
    pub fn point(&self, disc: [f64; 2]) -> [f64; 2] {
        let [x, y] = disc;
        let factor = if self.deviation.is_empty() {
            1.0
        } else {
            1.0 + (self.radius_factor(y.atan2(x)) - 1.0) * (x * x + y * y)
        };
        let centre = match self.extent {
            Extent::SurfaceBreaking => self.strip.unwrap_or(0.0),
            Extent::Buried { centre } => centre,
        };
        [centre + self.length * y * factor, self.half_length * x * factor]
    }
}

/// Smallest admissible distance of two cracks, relative to their smallest semi-axis: down to this
/// distance the integrals between them are verified, and cells resolve the ligament.
pub(super) const LEAST_DISTANCE: f64 = 0.05;

/// Reasons why a body in space cannot be built.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpaceError {
    /// The stiffness of the cracks is not positive definite: the cells are too coarse, most likely
    /// for the thin flap above a crack of this dip.
    #[error(
        "the cells of crack {} in space (dip {:.1}°, semi-axes {:.3} mm down the dip and {:.3} mm along the surface) are too \
         coarse, most likely for the flap above it: its stiffness is not positive definite; use more cells (space_cells, \
         space_rings) or a steeper crack", crack + 1, shape.dip.to_degrees(), shape.length, shape.half_length
    )]
    TooCoarse {
        /// The crack, from 0.
        crack: usize,
        /// Its shape.
        shape: Box<SpaceCrack>,
    },
    /// A matrix that cannot be inverted for another reason.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
    /// Cracks that meet, or nearly meet.
    #[error(transparent)]
    Close(#[from] CloseCracks),
}

/// Two cracks in space that meet, or nearly meet.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "cracks {} and {} in space are {distance:.3e} mm apart: must be at least {least:.3e} mm, {LEAST_DISTANCE} of the smallest \
     semi-axis of the two", first + 1, second + 1
)]
pub struct CloseCracks {
    /// One of them, from 0.
    pub first: usize,
    /// The other one.
    pub second: usize,
    /// Their distance, mm.
    pub distance: f64,
    /// The smallest admissible distance, mm.
    pub least: f64,
}

impl CloseCracks {
    /// The first two of `cracks` that are too close to each other.
    pub fn among(cracks: &[SpaceCrack]) -> Option<Self> {
        let pairs = (0..cracks.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
        let of = |(first, second): (usize, usize)| {
            let axes = [&cracks[first], &cracks[second]].map(|crack| crack.length.min(crack.half_length));
            let least = LEAST_DISTANCE * axes[0].min(axes[1]);
            let distance = cracks[first].distance(&cracks[second]);
            (distance < least).then_some(Self { first, second, distance, least })
        };
        pairs.into_iter().find_map(of)
    }
}
