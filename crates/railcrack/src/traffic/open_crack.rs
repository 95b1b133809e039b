//! An open crack under a wheel: K is linear in pressure and shear.

use crate::body::CrackedBody;
use crate::fatigue::{GrowthLaw, LoadRange};
use crate::field::HertzField;
use crate::fracture::Sif;
use crate::load::{Contact, HertzianContact};
use std::f64::consts::PI;

/// K of the tips of open cracks under half-ellipses of pressure and of shear, for half-widths
/// between which those of all wheels lie. It ranks wheels: with C and S of the open crack alone, the
/// contact of its faces is replaced by the friction of K_II under a negative K_I, and the shear of a
/// wheel by a half-ellipse with the same force and moment.
#[derive(Debug, Clone)]
pub struct OpenCrack {
    half_widths: Vec<f64>,
    /// K per MPa of peak pressure and of peak shear: `[half-width][position · tips + tip]`.
    pressed: Vec<Vec<Sif>>,
    sheared: Vec<Vec<Sif>>,
    tips: usize,
    face_friction: f64,
    /// Distance of the positions of each half-width, mm.
    spacing: Vec<f64>,
}

/// Half-widths of the table, positions of the wheel, and how far these reach beyond the mouths.
const WIDTHS: usize = 7;
const POSITIONS: usize = 41;
const REACH: f64 = 2.5;

impl OpenCrack {
    /// The cracks of `body`, whose mouths lie from `mouths[0]` to `mouths[1]` (mm), in a rail with
    /// Poisson's ratio `poisson`, under contacts with half-widths from `half_widths[0]` to
    /// `half_widths[1]` (mm, positive); μ_c = `face_friction`.
    #[must_use]
    pub fn new(
        body: &CrackedBody,
        mouths: [f64; 2],
        half_widths: [f64; 2],
        poisson: f64,
        face_friction: f64,
    ) -> Self {
        let [least, most] = half_widths;
        let count = if most > least * (1.0 + 1e-9) { WIDTHS } else { 1 };
        let width = |i: usize| least * (most / least).powf(i as f64 / (WIDTHS - 1) as f64);
        let half_widths: Vec<f64> = (0..count).map(width).collect();
        let (mut pressed, mut sheared) = (Vec::new(), Vec::new());
        for &half_width in &half_widths {
            let field = |friction| {
                HertzField::new(&HertzianContact { peak_pressure: 1.0, half_width, friction }, poisson)
            };
            let (smooth, rough) = (field(0.0), field(1.0));
            let (from, to) = (mouths[0] - REACH * half_width, mouths[1] + REACH * half_width);
            let (mut normal, mut shear) = (Vec::new(), Vec::new());
            for i in 0..POSITIONS {
                let xc = from + (to - from) * i as f64 / (POSITIONS - 1) as f64;
                let under = body.sifs_of_free_faces(|point| smooth.stress(point, xc));
                let both = body.sifs_of_free_faces(|point| rough.stress(point, xc));
                let less =
                    |(both, under): (&Sif, &Sif)| Sif { ki: both.ki - under.ki, kii: both.kii - under.kii };
                shear.extend(both.iter().zip(&under).map(less));
                normal.extend(under);
            }
            pressed.push(normal);
            sheared.push(shear);
        }
        let apart = |width: &f64| (mouths[1] - mouths[0] + 2.0 * REACH * width) / (POSITIONS - 1) as f64;
        let spacing = half_widths.iter().map(apart).collect();
        Self { half_widths, pressed, sheared, tips: body.tips.len().max(1), face_friction, spacing }
    }

    /// What drives the tips at all positions under `contact`, MPa √mm: K_I where it is positive, and
    /// of K_II what friction leaves, |K_II| − μ_c |K_I| where K_I is negative.
    #[must_use]
    pub fn history(&self, contact: &Contact) -> Vec<Sif> {
        let (peak, shear) = (contact.peak_pressure(), contact.peak_pressure() * contact.adhesion());
        // A moment M of the shear moves it by M/Q: K changes by M/Q times its slope.
        let moved = 2.0 * contact.shear_moment() / (PI * contact.half_width());
        let most = self.half_widths.len() - 1;
        let above = self.half_widths.partition_point(|width| *width < contact.half_width());
        let high = above.clamp(most.min(1), most);
        let low = high.saturating_sub(1);
        let (from, to) = (self.half_widths[low], self.half_widths[high]);
        let part =
            if to > from { ((contact.half_width() - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let count = self.pressed[0].len();
        let of_width = |width: usize, i: usize| {
            let (normal, along) = (self.pressed[width][i], &self.sheared[width]);
            let (before, after) = (i.saturating_sub(self.tips), (i + self.tips).min(count - 1));
            let steps = ((after - before) / self.tips).max(1) as f64;
            let slope = moved / (steps * self.spacing[width]);
            let of = |k: fn(&Sif) -> f64| {
                peak * k(&normal) + shear * k(&along[i]) + slope * (k(&along[after]) - k(&along[before]))
            };
            [of(|k| k.ki), of(|k| k.kii)]
        };
        (0..count)
            .map(|i| {
                let (a, b) = (of_width(low, i), of_width(high, i));
                let [ki, kii] = [0, 1].map(|mode| a[mode] + part * (b[mode] - a[mode]));
                let left = (kii.abs() - self.face_friction * (-ki).max(0.0)).max(0.0);
                Sif { ki: ki.max(0.0), kii: left.copysign(kii) }
            })
            .collect()
    }

    /// The rate (mm per cycle) of the fastest tip through `history` by `law`.
    #[must_use]
    pub fn rate(&self, history: &[Sif], law: &GrowthLaw) -> f64 {
        let of_tip = |tip: usize| {
            let own = || history.iter().skip(tip).step_by(self.tips);
            let range = |of: fn(&Sif) -> f64| {
                let (low, high) =
                    own().fold((0.0f64, 0.0f64), |(low, high), k| (low.min(of(k)), high.max(of(k))));
                high - low
            };
            let opening = range(|k| k.ki);
            law.rate(LoadRange::new(opening, range(|k| k.kii), opening))
        };
        (0..self.tips).map(of_tip).fold(0.0, f64::max)
    }
}
