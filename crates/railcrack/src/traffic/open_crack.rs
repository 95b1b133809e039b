//! An open crack under a wheel, as a surrogate for the closed one.

use crate::body::CrackedBody;
use crate::fatigue::{GrowthLaw, LoadRange};
use crate::field::HertzField;
use crate::fracture::Sif;
use crate::load::{Contact, HertzianContact};
use std::f64::consts::PI;

/// Nodal forces on the faces of open cracks under half-ellipses of pressure and of shear, for
/// half-widths between which those of all wheels lie, and K = S f of what friction leaves of them.
///
/// It ranks wheels: forces that close the faces are carried by the faces, and of the shear at such
/// a point |t| − μ_c |n| drives the crack. Compliance, stick and the order of events are absent,
/// and the shear of a wheel is a half-ellipse with the same force and moment.
#[derive(Debug, Clone)]
pub struct OpenCrack {
    half_widths: Vec<f64>,
    /// Nodal forces per MPa of peak pressure and of peak shear: `[half-width][position]`, 2p each.
    pressed: Vec<Vec<Vec<f64>>>,
    sheared: Vec<Vec<Vec<f64>>>,
    /// Distance of the positions of each half-width, mm.
    spacing: Vec<f64>,
    /// S, row by row.
    influence: Vec<Vec<f64>>,
    face_friction: f64,
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
                let under = body.faces.nodal_forces(|point| smooth.stress(point, xc));
                let both = body.faces.nodal_forces(|point| rough.stress(point, xc));
                shear.push(both.iter().zip(&under).map(|(both, under)| both - under).collect());
                normal.push(under);
            }
            pressed.push(normal);
            sheared.push(shear);
        }
        let apart = |width: &f64| (mouths[1] - mouths[0] + 2.0 * REACH * width) / (POSITIONS - 1) as f64;
        let spacing = half_widths.iter().map(apart).collect();
        let rows = &body.sif_influence;
        let influence = (0..rows.rows()).map(|i| rows.row(i).to_vec()).collect();
        Self { half_widths, pressed, sheared, spacing, influence, face_friction }
    }

    /// K_I and K_II (MPa √mm) of what drives the tips under `contact`, at all positions, those of
    /// one position side by side.
    #[must_use]
    pub fn history(&self, contact: &Contact) -> Vec<Sif> {
        let (peak, shear) = (contact.peak_pressure(), contact.peak_pressure() * contact.adhesion());
        // A moment M of the shear moves it by M/Q: forces change by M/Q times their slope.
        let moved = 2.0 * contact.shear_moment() / (PI * contact.half_width());
        let most = self.half_widths.len() - 1;
        let above = self.half_widths.partition_point(|width| *width < contact.half_width());
        let high = above.clamp(most.min(1), most);
        let low = high.saturating_sub(1);
        let (from, to) = (self.half_widths[low], self.half_widths[high]);
        let part =
            if to > from { ((contact.half_width() - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let unknowns = self.influence.first().map_or(0, Vec::len);
        let mut history = Vec::with_capacity(POSITIONS * self.influence.len() / 2);
        let mut forces = vec![0.0; unknowns];
        for i in 0..POSITIONS {
            forces.fill(0.0);
            let (before, after) = (i.saturating_sub(1), (i + 1).min(POSITIONS - 1));
            for (width, weight) in [(low, 1.0 - part), (high, part)] {
                let slope = weight * moved / ((after - before) as f64 * self.spacing[width]);
                let (normal, along) = (&self.pressed[width], &self.sheared[width]);
                for (j, force) in forces.iter_mut().enumerate() {
                    *force += weight * (peak * normal[i][j] + shear * along[i][j])
                        + slope * (along[after][j] - along[before][j]);
                }
            }
            self.leave_to_the_faces(&mut forces);
            history.extend(self.influence.chunks_exact(2).map(|rows| {
                let k = |row: &[f64]| row.iter().zip(&forces).map(|(a, b)| a * b).sum();
                Sif { ki: k(&rows[0]), kii: k(&rows[1]) }
            }));
        }
        history
    }

    /// Takes from nodal `forces` what closed faces carry.
    fn leave_to_the_faces(&self, forces: &mut [f64]) {
        for force in forces.as_chunks_mut::<2>().0 {
            let [along, across] = *force;
            if across < 0.0 {
                let left = (along.abs() + self.face_friction * across).max(0.0);
                *force = [left.copysign(along), 0.0];
            }
        }
    }

    /// The rate (mm per cycle) of the fastest tip through `history` by `law`.
    #[must_use]
    pub fn rate(&self, history: &[Sif], law: &GrowthLaw) -> f64 {
        let tips = (self.influence.len() / 2).max(1);
        let of_tip = |tip: usize| {
            let own = || history.iter().skip(tip).step_by(tips);
            let range = |of: fn(&Sif) -> f64| {
                let wider = |(low, high): (f64, f64), k: &Sif| (low.min(of(k)), high.max(of(k)));
                let (low, high) = own().fold((0.0, 0.0), wider);
                high - low
            };
            let opening = range(|k| k.ki.max(0.0));
            law.rate(LoadRange::new(opening, range(|k| k.kii), opening))
        };
        (0..tips).map(of_tip).fold(0.0, f64::max)
    }
}
