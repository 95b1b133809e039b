//! First yield and shakedown of the rail under the contact of one wheel.

use super::wheel_patch::sliding_ellipse;
use railcrack::field::wheel_under;
use railcrack::load::{Contact, Travel, WheelLoad};
use railcrack::material::IsotropicElastic;
use railcrack::math::Tensor;
use railcrack::shakedown::space::{RolledPatch, Symmetry};
use railcrack::shakedown::{ContactBounds, DepthBounds};
use railcrack::space::EllipticWheel;
use railcrack_case::Case;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// A limit of the peak pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelBound {
    /// p0/k, with k = σ_y/√3 (von Mises).
    pub ratio: f64,
    /// Depth that decides, over the half-width of the contact along the rail.
    pub depth_over_a: f64,
}

/// First yield and the limit of elastic shakedown of the rail of a case under the contact of one of
/// its wheels alone: in the half-space below a patch, which counts as a Hertz ellipse that slides
/// along the rail with the same shear over normal force, and in plane strain below a line contact.
pub struct WheelBounds<'a> {
    /// First yield.
    pub first_yield: WheelBound,
    /// The limit of elastic shakedown.
    pub shakedown: WheelBound,
    contact: &'a Contact,
    steel: &'a IsotropicElastic,
    ellipse: Option<EllipticWheel>,
}

impl<'a> WheelBounds<'a> {
    /// Those of the wheel `number` (from 0) of `case`; none where it misses the cracks.
    #[must_use]
    pub fn of(case: &'a Case, number: usize) -> Option<Self> {
        let (contact, steel) = (case.wheels[number].wheel.contact()?, &case.steel);
        let ellipse = sliding_ellipse(case, number);
        let [first_yield, shakedown] = match &ellipse {
            Some(ellipse) => below_ellipse(ellipse, steel.poisson()),
            None => below_line(contact, steel, |bounds| {
                let (first, limit) = (bounds.first_yield(), bounds.shakedown_limit());
                [(first.ratio, first.depth_over_a), (limit.ratio, limit.depth_over_a)]
                    .map(|(ratio, depth_over_a)| WheelBound { ratio, depth_over_a })
            })?,
        };
        Some(Self { first_yield, shakedown, contact, steel, ellipse })
    }

    /// Both at each of `depths_over_a`, in the middle of the contact.
    #[must_use]
    pub fn by_depth(&self, depths_over_a: &[f64]) -> Vec<DepthBounds> {
        match &self.ellipse {
            Some(ellipse) => rolled(ellipse, self.steel.poisson()).bounds().by_depth(0.0, depths_over_a),
            None => below_line(self.contact, self.steel, |bounds| bounds.by_depth(depths_over_a))
                .unwrap_or_default(),
        }
    }
}

fn below_line<T>(
    contact: &Contact,
    steel: &IsotropicElastic,
    of: impl FnOnce(&ContactBounds) -> T,
) -> Option<T> {
    let load = WheelLoad { contact: contact.clone(), track: None, temperature: None };
    let wheel = wheel_under(&load, steel).ok()?;
    Some(of(&ContactBounds::new(contact, wheel.as_ref())))
}

/// Shapes whose bounds are kept: they are asked for by many warnings of a run, and by all runs of a
/// study.
const KEPT: usize = 64;
/// Ratio of the semi-axes, friction and ν, as bits.
type Shape = [u64; 3];

/// First yield and the limit of shakedown.
fn below_ellipse(ellipse: &EllipticWheel, poisson: f64) -> [WheelBound; 2] {
    static KNOWN: Mutex<VecDeque<(Shape, [WheelBound; 2])>> = Mutex::new(VecDeque::new());
    let slenderness = ellipse.lateral_half_width / ellipse.half_width;
    let shape = [slenderness, ellipse.friction, poisson].map(f64::to_bits);
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, bounds)) = known().iter().find(|(own, _)| *own == shape) {
        return *bounds;
    }
    // The same bits for every contact of this shape.
    let unit =
        EllipticWheel { peak_pressure: 1.0, half_width: 1.0, lateral_half_width: slenderness, ..*ellipse };
    let bounds = rolled(&unit, poisson).bounds().in_the_middle();
    let bounds = bounds.map(|own| WheelBound { ratio: own.ratio, depth_over_a: own.depth_over_a });
    let mut all = known();
    all.push_back((shape, bounds));
    if all.len() > KEPT {
        all.pop_front();
    }
    bounds
}

/// `ellipse` as a contact that rolls the rail.
fn rolled(ellipse: &EllipticWheel, poisson: f64) -> RolledPatch {
    let own @ EllipticWheel { peak_pressure, half_width, lateral_half_width, lateral, .. } = *ellipse;
    let stress = move |x: f64, y: f64, depth: f64| Tensor::of(own.stress(0.0, [x, y, depth], poisson));
    RolledPatch {
        peak_pressure,
        half_width,
        lateral_half_width,
        lateral,
        symmetry: Symmetry::Mirrored,
        travel: Travel::Forward,
        stress: Arc::new(stress),
    }
}
