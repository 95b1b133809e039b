//! Fourier transforms along the rail of many signals, on the grid and its layers.

use super::bounds;
use super::complex::Complex;
use super::rail::{RolledRail, ShakedownError};
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// The transform X_k = Σ_n x_n e^(−2π i k n / N) of signals of length N, a power of two.
///
/// Signals are stored side by side: sample n of all of them is contiguous, so that one butterfly
/// processes all of them.
///
/// Source: Stockham's self-sorting form of radix four (Cooley & Tukey 1965; Van Loan 1992,
/// Computational Frameworks for the Fast Fourier Transform, 1.7).
#[derive(Debug, Clone)]
pub(super) struct Fourier {
    length: usize,
    /// e^(−2π i n / N).
    roots: Vec<(f64, f64)>,
}

/// Complex signals: sample n of signal j at n · signals + j.
#[derive(Debug, Clone, Default)]
pub(super) struct Signals {
    pub re: Vec<f64>,
    pub im: Vec<f64>,
    spare_re: Vec<f64>,
    spare_im: Vec<f64>,
}

impl Signals {
    /// Zero signals; `samples` = length · number of signals.
    pub(super) fn zeros(samples: usize) -> Self {
        let zeros = || vec![0.0; samples];
        Self { re: zeros(), im: zeros(), spare_re: zeros(), spare_im: zeros() }
    }

    /// Waves k and −k, at `plus` and `minus`, of the two real signals that a complex one consists
    /// of.
    #[inline(always)]
    pub(super) fn separated(&self, plus: usize, minus: usize) -> (Complex, Complex) {
        let (a, b) = (self.re[plus], self.im[plus]);
        let (c, d) = (self.re[minus], self.im[minus]);
        (Complex { re: 0.5 * (a + c), im: 0.5 * (b - d) }, Complex { re: 0.5 * (b + d), im: 0.5 * (c - a) })
    }

    /// The inverse of [`Signals::separated`].
    #[inline(always)]
    pub(super) fn combine(&mut self, plus: usize, minus: usize, one: Complex, other: Complex) {
        if plus == minus {
            (self.re[plus], self.im[plus]) = (one.re, other.re);
            return;
        }
        (self.re[plus], self.im[plus]) = (one.re - other.im, one.im + other.re);
        (self.re[minus], self.im[minus]) = (one.re + other.im, other.re - one.im);
    }

    /// Makes the spare samples the samples.
    fn exchange(&mut self) {
        std::mem::swap(&mut self.re, &mut self.spare_re);
        std::mem::swap(&mut self.im, &mut self.spare_im);
    }
}

impl Fourier {
    /// The transform of signals of `length` samples, a power of two.
    pub(super) fn new(length: usize) -> Self {
        let root = |n: usize| (-2.0 * std::f64::consts::PI * n as f64 / length as f64).sin_cos();
        let roots = (0..length).map(root).map(|(sin, cos)| (cos, sin)).collect();
        Self { length, roots }
    }

    /// Transforms `signals` in place.
    pub(super) fn forward(&self, signals: &mut Signals) {
        let Signals { re, im, spare_re, spare_im } = signals;
        if self.stages([re, im], [spare_re, spare_im]) {
            signals.exchange();
        }
    }

    /// The inverse of [`Fourier::forward`] times N: the same with real and imaginary parts
    /// interchanged.
    pub(super) fn backward(&self, signals: &mut Signals) {
        let Signals { re, im, spare_re, spare_im } = signals;
        if self.stages([im, re], [spare_im, spare_re]) {
            signals.exchange();
        }
    }

    /// [`Fourier::forward`] of every block of `block` samples of `signals`, one after the other.
    pub(super) fn forward_blocks(&self, signals: &mut Signals, block: usize) {
        for from in (0..signals.re.len()).step_by(block) {
            let Signals { re, im, spare_re, spare_im } = &mut *signals;
            let part = from..from + block;
            let [re, im] = [&mut re[part.clone()], &mut im[part.clone()]];
            let [to_re, to_im] = [&mut spare_re[part.clone()], &mut spare_im[part]];
            if self.stages([re, im], [to_re, to_im]) {
                re.copy_from_slice(to_re);
                im.copy_from_slice(to_im);
            }
        }
    }

    /// [`Fourier::backward`] of every block of `block` samples of `signals`, one after the other.
    pub(super) fn backward_blocks(&self, signals: &mut Signals, block: usize) {
        let exchange = |s: &mut Signals| {
            std::mem::swap(&mut s.re, &mut s.im);
            std::mem::swap(&mut s.spare_re, &mut s.spare_im);
        };
        exchange(signals);
        self.forward_blocks(signals, block);
        exchange(signals);
    }

    /// Transforms the signals `one`, real and imaginary parts, with `other` for every second stage.
    /// Returns whether the result is in `other`.
    fn stages(&self, one: [&mut [f64]; 2], other: [&mut [f64]; 2]) -> bool {
        let lanes = one[0].len() / self.length;
        let ([mut re, mut im], [mut to_re, mut to_im]) = (one, other);
        let (mut rest, mut stride, mut is_in_other) = (self.length, 1, false);
        while rest > 1 {
            let radix = if rest.is_multiple_of(4) { 4 } else { 2 };
            for part in 0..rest / radix {
                let root = |power: usize| self.roots[power * part * stride];
                let from = ButterflyInput { re, im, block: stride * lanes, part, parts: rest / radix };
                let to = (part * radix * stride * lanes, &mut *to_re, &mut *to_im);
                if radix == 4 {
                    Arch::new().dispatch(Four { from, to, roots: [root(1), root(2), root(3)] });
                } else {
                    Arch::new().dispatch(Two { from, to });
                }
            }
            std::mem::swap(&mut re, &mut to_re);
            std::mem::swap(&mut im, &mut to_im);
            (rest, stride, is_in_other) = (rest / radix, stride * radix, !is_in_other);
        }
        is_in_other
    }
}

/// The input of a butterfly: blocks `part`, `part + parts`, `part + 2 parts`, ….
struct ButterflyInput<'a> {
    re: &'a [f64],
    im: &'a [f64],
    block: usize,
    part: usize,
    parts: usize,
}

impl<'a> ButterflyInput<'a> {
    #[inline(always)]
    fn leg(&self, leg: usize) -> (&'a [f64], &'a [f64]) {
        let from = (self.part + leg * self.parts) * self.block;
        (&self.re[from..from + self.block], &self.im[from..from + self.block])
    }
}

/// The output of a butterfly: offset of the first block, real and imaginary parts.
type ButterflyOutput<'a> = (usize, &'a mut [f64], &'a mut [f64]);

struct Four<'a> {
    from: ButterflyInput<'a>,
    to: ButterflyOutput<'a>,
    roots: [(f64, f64); 3],
}

impl WithSimd for Four<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let block = self.from.block;
        let [(ar, ai), (br, bi), (cr, ci), (dr, di)] = [0, 1, 2, 3].map(|leg| self.from.leg(leg));
        let (first, re, im) = self.to;
        let (re, im) = (&mut re[first..first + 4 * block], &mut im[first..first + 4 * block]);
        let (re_low, re_high) = re.split_at_mut(2 * block);
        let (im_low, im_high) = im.split_at_mut(2 * block);
        let ((r0, r1), (r2, r3)) = (re_low.split_at_mut(block), re_high.split_at_mut(block));
        let ((i0, i1), (i2, i3)) = (im_low.split_at_mut(block), im_high.split_at_mut(block));
        let [(w1r, w1i), (w2r, w2i), (w3r, w3i)] = self.roots;
        for n in 0..block {
            let (even_r, even_i) = (ar[n] + cr[n], ai[n] + ci[n]);
            let (odd_r, odd_i) = (ar[n] - cr[n], ai[n] - ci[n]);
            let (sum_r, sum_i) = (br[n] + dr[n], bi[n] + di[n]);
            // −i (b − d).
            let (turn_r, turn_i) = (bi[n] - di[n], dr[n] - br[n]);
            (r0[n], i0[n]) = (even_r + sum_r, even_i + sum_i);
            let (tr, ti) = (odd_r + turn_r, odd_i + turn_i);
            (r1[n], i1[n]) = (w1r * tr - w1i * ti, w1r * ti + w1i * tr);
            let (tr, ti) = (even_r - sum_r, even_i - sum_i);
            (r2[n], i2[n]) = (w2r * tr - w2i * ti, w2r * ti + w2i * tr);
            let (tr, ti) = (odd_r - turn_r, odd_i - turn_i);
            (r3[n], i3[n]) = (w3r * tr - w3i * ti, w3r * ti + w3i * tr);
        }
    }
}

struct Two<'a> {
    from: ButterflyInput<'a>,
    to: ButterflyOutput<'a>,
}

impl WithSimd for Two<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        // Last stage only, with the single root 1.
        let block = self.from.block;
        let [(ar, ai), (br, bi)] = [0, 1].map(|leg| self.from.leg(leg));
        let (first, re, im) = self.to;
        let (r0, r1) = re[first..first + 2 * block].split_at_mut(block);
        let (i0, i1) = im[first..first + 2 * block].split_at_mut(block);
        for n in 0..block {
            (r0[n], i0[n]) = (ar[n] + br[n], ai[n] + bi[n]);
            (r1[n], i1[n]) = (ar[n] - br[n], ai[n] - bi[n]);
        }
    }
}

/// Resolution of stress and strain around the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Number of columns, and of layers where the rail may yield, per half-width of the contact; a
    /// power of two, so that both edges of the contact lie on columns.
    pub per_half_width: u32,
    /// Least period of the waves, in half-widths of the contact; see `docs/dev/shakedown.md`.
    pub period: u32,
}

impl Default for Resolution {
    /// The resolution measured in `docs/dev/shakedown.md`: within 2 % of the largest residual
    /// stress.
    fn default() -> Self {
        Self { per_half_width: 32, period: 16 }
    }
}

/// Columns and layers of one computation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RailGrid {
    /// Number of columns, a power of two.
    pub columns: usize,
    /// mm.
    pub spacing: f64,
    pub layers: Layers,
    /// Depth of the even layers, mm.
    pub fine_depth: f64,
}

/// p0/k beyond which the plastic zone is deeper than ten half-widths. No elastic half-plane carries
/// such a load, and the pressure ceases to be Hertzian at much lower loads.
const HEAVIEST: f64 = 20.0;
/// Factor by which the plastic zone is deeper than the zone of the elastic passage above yield,
/// because the yielded part sheds load, and …
const SPREAD: f64 = 1.35;
/// … increase of its depth, over a.
const SPREAD_OVER_A: f64 = 0.1;
/// Least period over the depth of the even layers.
const PERIOD_OVER_DEPTH: f64 = 4.5;
/// Depth of all layers over that of the even ones: flow in the lower layers shows that more even
/// layers are needed.
const MARGIN: f64 = 1.15;
/// Depth over a beyond which the sizes of layers and columns double, because deeper zones are
/// larger in all directions.
const COARSER_BEYOND: f64 = 4.0;
/// Half-widths on each side of the contact in which flow is admitted and the extrapolation acts.
const ACTIVE: f64 = 3.0;

/// The columns in which flow is admitted around a contact of half-width `a` (mm).
pub(super) fn active_columns(a: f64, spacing: f64, columns: usize) -> Range<usize> {
    let (half, middle) = ((ACTIVE * a / spacing).round() as usize, columns / 2);
    middle - half..middle + half
}

impl RailGrid {
    /// The grid for `rail`, with even layers to slightly below the depth at which its elastic
    /// passage yields.
    pub(super) fn of(rail: &RolledRail, resolution: Resolution) -> Result<Self, ShakedownError> {
        Self::check_load(rail)?;
        let a = rail.contact.half_width();
        let depth = yield_depth(rail)?.max(a);
        Ok(Self::down_to(rail, resolution, SPREAD * depth + SPREAD_OVER_A * a))
    }

    /// Checks that a half-plane can carry the load of `rail`.
    pub(super) fn check_load(rail: &RolledRail) -> Result<(), ShakedownError> {
        let ratio = rail.pressure_ratio();
        let accepted = ratio > 0.0 && ratio <= HEAVIEST;
        if accepted { Ok(()) } else { Err(ShakedownError::Load { ratio, most: HEAVIEST }) }
    }

    /// The grid for `rail` with even layers down to `fine_depth` (mm).
    pub(super) fn down_to(rail: &RolledRail, resolution: Resolution, fine_depth: f64) -> Self {
        let a = rail.contact.half_width();
        let mut spacing = a / f64::from(resolution.per_half_width.next_power_of_two());
        let mut reach = COARSER_BEYOND * a;
        while fine_depth > reach {
            (spacing, reach) = (2.0 * spacing, 2.0 * reach);
        }
        let period = (f64::from(resolution.period) * a).max(PERIOD_OVER_DEPTH * fine_depth);
        let columns = ((period / spacing).ceil() as usize).next_power_of_two();
        Self {
            columns,
            spacing,
            layers: Layers::graded(spacing, fine_depth, MARGIN * fine_depth),
            fine_depth,
        }
    }

    /// Abscissa of column `i` from the centre of the contact, mm.
    pub(super) fn abscissa(&self, i: usize) -> f64 {
        (i as f64 - 0.5 * self.columns as f64) * self.spacing
    }
}

/// The greatest depth (mm) at which the elastic passage reaches the yield stress; 0 for none.
fn yield_depth(rail: &RolledRail) -> Result<f64, ShakedownError> {
    // Step of the search over a, and its end: beyond a depth d the stress of the wheel is at most
    // p0 a/d.
    const STEP: f64 = 0.05;
    let a = rail.contact.half_width();
    let field = rail.forward_field()?;
    let limit = rail.hardening.yield_radius().powi(2);
    let path: Vec<f64> = bounds::path_abscissae().into_iter().map(|x| x * a).collect();
    let yields = |depth: f64| {
        let offset = rail.initial_stress(depth);
        let size = |x: f64| {
            let s = (field.stress(x, depth) + offset).deviator();
            s.iter().map(|c| c * c).sum::<f64>()
        };
        path.iter().any(|&x| size(x) > limit)
    };
    let deepest = (rail.pressure_ratio() / STEP).ceil() as usize;
    Ok((1..=deepest).rev().map(|i| STEP * i as f64 * a).find(|&depth| yields(depth)).unwrap_or(0.0))
}

/// Layers of the rail from the surface down, each with one plastic strain at every abscissa.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    /// Depths of the interfaces, mm: 0 first.
    interfaces: Vec<f64>,
}

/// Thickness of a layer over that of the layer above, below the even layers, where there is no
/// plastic flow.
const GROWTH: f64 = 1.2;
/// Thickness of a layer over that of the layer above at the surface, …
const SURFACE_GROWTH: f64 = 2.0;
/// … where the first layer has the even thickness over two to this power. Under friction the stress
/// at the edges of the contact varies with the square root of the depth.
const SURFACE_LAYERS: i32 = 5;

impl Layers {
    /// Layers of `thickness` (mm) down to `fine_depth` (mm), thinner ones at the surface, and
    /// increasingly thick ones from there to `depth` (mm).
    pub(super) fn graded(thickness: f64, fine_depth: f64, depth: f64) -> Self {
        let mut interfaces = vec![0.0];
        // 2⁻⁵, 2⁻⁵, 2⁻⁴, …, 2⁻¹ of the thickness make up one layer.
        let surface = (0..SURFACE_LAYERS).rev().map(|i| thickness * SURFACE_GROWTH.powi(-i - 1));
        interfaces.extend(surface);
        let (mut bottom, mut next, mut count) = (0.0, thickness, 0.0);
        while bottom < depth {
            count += 1.0;
            bottom = if bottom < fine_depth {
                count * thickness
            } else {
                next *= GROWTH;
                bottom + next
            };
            interfaces.push(bottom);
        }
        Self { interfaces }
    }

    /// Number of layers.
    pub fn count(&self) -> usize {
        self.interfaces.len() - 1
    }

    /// Depth of the upper face of layer `i`, mm.
    pub(crate) fn top(&self, i: usize) -> f64 {
        self.interfaces[i]
    }

    /// Thickness of layer `i`, mm.
    pub(crate) fn thickness(&self, i: usize) -> f64 {
        self.interfaces[i + 1] - self.interfaces[i]
    }

    /// Depths of the midplanes of the layers, mm.
    pub(crate) fn middles(&self) -> Vec<f64> {
        self.interfaces.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect()
    }

    /// Depths of the interfaces, mm, the surface first.
    pub fn interfaces(&self) -> &[f64] {
        &self.interfaces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_sum_and_inverts() {
        for length in [2, 4, 8, 16, 32, 64] {
            for lanes in [1, 3] {
                let mut signals = Signals::zeros(length * lanes);
                for n in 0..length * lanes {
                    (signals.re[n], signals.im[n]) = ((0.7 * n as f64).sin(), (1.3 * n as f64).cos());
                }
                let (re, im) = (signals.re.clone(), signals.im.clone());
                let fourier = Fourier::new(length);
                fourier.forward(&mut signals);
                for k in 0..length {
                    for lane in 0..lanes {
                        let (mut want_re, mut want_im) = (0.0, 0.0);
                        for n in 0..length {
                            let turn = -2.0 * std::f64::consts::PI * (k * n) as f64 / length as f64;
                            let at = n * lanes + lane;
                            want_re += re[at] * turn.cos() - im[at] * turn.sin();
                            want_im += re[at] * turn.sin() + im[at] * turn.cos();
                        }
                        let (got_re, got_im) = (signals.re[k * lanes + lane], signals.im[k * lanes + lane]);
                        // Round-off of sums of `length` terms.
                        assert!((got_re - want_re).hypot(got_im - want_im) < 1e-12, "{length}, {k}");
                    }
                }
                fourier.backward(&mut signals);
                let n = length as f64;
                assert!(signals.re.iter().zip(&re).all(|(a, b)| (a / n - b).abs() < 1e-14));
                assert!(signals.im.iter().zip(&im).all(|(a, b)| (a / n - b).abs() < 1e-14));
            }
        }
    }
}
