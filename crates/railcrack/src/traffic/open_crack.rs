//! An open crack under a wheel: K is linear in pressure and shear.

use crate::body::CrackedBody;
use crate::fatigue::{GrowthLaw, LoadRange};
use crate::field::HertzField;
use crate::fracture::Sif;
use crate::load::{Contact, HertzianContact};

/// K of the tips of open cracks under half-ellipses of pressure and of shear, for half-widths
/// between which those of all wheels lie. It ranks wheels: contact of the faces and friction are
/// absent, and so is the distribution of the shear within the contact.
#[derive(Debug, Clone)]
pub struct OpenCrack {
    half_widths: Vec<f64>,
    /// K per MPa of peak pressure and of peak shear: `[half-width][position · tips + tip]`.
    pressed: Vec<Vec<Sif>>,
    sheared: Vec<Vec<Sif>>,
    tips: usize,
}

/// Half-widths of the table, positions of the wheel, and how far these reach beyond the mouths.
const WIDTHS: usize = 7;
const POSITIONS: usize = 41;
const REACH: f64 = 2.5;

impl OpenCrack {
    /// The cracks of `body`, whose mouths lie from `mouths[0]` to `mouths[1]` (mm), in a rail with
    /// Poisson's ratio `poisson`, under contacts with half-widths from `half_widths[0]` to
    /// `half_widths[1]` (mm, positive).
    #[must_use]
    pub fn new(body: &CrackedBody, mouths: [f64; 2], half_widths: [f64; 2], poisson: f64) -> Self {
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
        Self { half_widths, pressed, sheared, tips: body.tips.len().max(1) }
    }

    /// K_I and K_II (MPa √mm) of the tips at all positions under `contact`, the shear of which is
    /// taken to be distributed like its pressure.
    #[must_use]
    pub fn history(&self, contact: &Contact) -> Vec<Sif> {
        let (peak, shear) = (contact.peak_pressure(), contact.peak_pressure() * contact.adhesion());
        let above = self.half_widths.partition_point(|width| *width < contact.half_width());
        let high = above.clamp(1.min(self.half_widths.len() - 1), self.half_widths.len() - 1);
        let low = high.saturating_sub(1);
        let (from, to) = (self.half_widths[low], self.half_widths[high]);
        let part =
            if to > from { ((contact.half_width() - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let at = |table: &[Vec<Sif>], i: usize| {
            let (a, b) = (table[low][i], table[high][i]);
            Sif { ki: a.ki + part * (b.ki - a.ki), kii: a.kii + part * (b.kii - a.kii) }
        };
        (0..self.pressed[0].len())
            .map(|i| {
                let (p, q) = (at(&self.pressed, i), at(&self.sheared, i));
                Sif { ki: peak * p.ki + shear * q.ki, kii: peak * p.kii + shear * q.kii }
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
            let opening = range(|k| k.ki.max(0.0));
            law.rate(LoadRange::new(opening, range(|k| k.kii), opening))
        };
        (0..self.tips).map(of_tip).fold(0.0, f64::max)
    }
}
