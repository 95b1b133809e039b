//! One sampled crack on a computed path.

use super::events::{Fate, Limits};
use super::failure::Question;
use super::family::Family;
use super::walk::{SampledRates, SampledShares, Track, Walk};
use crate::log::{RunInfo, WheelInfo};
use railcrack::growth::{MOST_WHEELS, SurfaceRemoval};
use railcrack_case::{Scatter, normal};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The cracks that are sampled, and their scatter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sampling<'a> {
    /// The cracks at different speeds.
    pub family: &'a Family,
    /// The question to them.
    pub question: Question,
    /// Standard deviations.
    pub scatter: &'a Scatter,
    /// The wheels of a mix.
    pub mix: &'a [WheelInfo],
    /// Rate (mm per axle) below which growth stops; zero where it is not looked at.
    pub arrest_rate: f64,
    /// Whether the samples break where k1 reaches their own toughness; otherwise where the run
    /// does.
    pub has_own_toughness: bool,
}

impl<'a> Sampling<'a> {
    /// Samples of a run in `family` with `scatter`, as `question` asks for them.
    pub fn of_run(info: &'a RunInfo, question: Question, family: &'a Family, scatter: &'a Scatter) -> Self {
        Self {
            family,
            question,
            scatter,
            mix: info.mix(),
            arrest_rate: if info.maintenance.is_some() { 0.0 } else { info.arrest_rate },
            has_own_toughness: scatter.toughness_std > 0.0,
        }
    }
}

/// Keys of the quantities whose scatter is described by one deviate each.
pub(crate) const KEYS: [&str; 5] =
    ["paris_c_log_std", "paris_m_std", "toughness_std", "detectable_depth_std", "wear_std"];

/// A separate stream of random numbers for later quantities, so that the samples of the first four
/// do not change.
const LATER: u64 = 0x5EED_0000_0000;

/// Deviates of the coefficient: quantiles of an additive sequence by the golden ratio, any first
/// part of which covers all probabilities evenly. Its quantiles and shares are those of the
/// distribution to about 1/n for n samples, not 1/√n.
struct EvenDeviates(u64);

impl EvenDeviates {
    fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed ^ EVEN).next_u64())
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        normal::quantile(((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64)
    }
}

/// 2⁶⁴ times the golden ratio less one.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
/// The stream in which that sequence begins.
const EVEN: u64 = 0xE7E4_0000_0000;

/// Standard normal deviates, two at a time (Box & Muller), the same on any machine.
struct Deviates {
    source: Pcg64Mcg,
    spare: Option<f64>,
}

impl Deviates {
    fn new(seed: u64) -> Self {
        Self { source: Pcg64Mcg::seed_from_u64(seed), spare: None }
    }

    /// In (0, 1].
    fn uniform(&mut self) -> f64 {
        ((self.source.next_u64() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        let (sine, cosine) = (2.0 * PI * self.uniform()).sin_cos();
        self.spare = Some(radius * sine);
        radius * cosine
    }
}

/// Standard normal deviates of one sample.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Draw {
    /// Deviates of [`KEYS`].
    pub deviates: [f64; KEYS.len()],
    /// Deviate of the share of each wheel.
    pub shares: [f64; MOST_WHEELS],
}

/// Draws, one sample after the other.
pub(crate) struct Draws {
    even: EvenDeviates,
    first: Deviates,
    later: Deviates,
    wears: bool,
    wheels: usize,
}

impl Draws {
    /// Draws of the quantities that `scatter`, with the wheels of `mix`.
    pub fn of(scatter: &Scatter, mix: &[WheelInfo]) -> Self {
        Self {
            even: EvenDeviates::new(scatter.seed as u64),
            first: Deviates::new(scatter.seed as u64),
            later: Deviates::new(scatter.seed as u64 ^ LATER),
            wears: scatter.wear_std > 0.0,
            wheels: if scatter.share_log_std > 0.0 { mix.len() } else { 0 },
        }
    }

    /// The next sample.
    pub fn next(&mut self) -> Draw {
        let c = self.even.next();
        let [m, toughness, detected] = [0; 3].map(|_| self.first.next());
        let wear = if self.wears { self.later.next() } else { 0.0 };
        let mut shares = [0.0; MOST_WHEELS];
        shares.iter_mut().take(self.wheels).for_each(|z| *z = self.later.next());
        Draw { deviates: [c, m, toughness, detected, wear], shares }
    }

    /// The share of all values, in (0, 1), at which another quantity is drawn.
    pub fn share(&mut self) -> f64 {
        (self.later.uniform()).min(1.0 - f64::EPSILON)
    }
}

/// One sample.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    /// Its deviates.
    pub draw: Draw,
    /// Whether the crack grows faster at first than it is removed.
    pub grows: bool,
    /// Million gross tonnes until the rail fails, and from the detectable crack to then; infinite
    /// where it never does, or not as far as the courses go.
    pub to_critical: f64,
    pub way: f64,
    /// Million gross tonnes at which its course ends without a failure, where it is not known what
    /// follows; infinite otherwise.
    pub outlives: f64,
    /// Its own depth (mm) from which it is detected.
    pub found_from: Option<f64>,
    /// How it ends.
    pub fate: Fate,
}

/// Courses along which samples are evaluated.
pub(crate) struct Sampler<'a> {
    of: Sampling<'a>,
    /// The wheels of a mix whose shares scatter.
    mix: &'a [WheelInfo],
    limits: Limits,
    walk: Walk<'a>,
}

/// Samples that one thread makes at a time.
const CHUNK: usize = 256;

impl<'a> Sampler<'a> {
    /// Samples of `of`.
    pub fn of(of: Sampling<'a>) -> Self {
        // Shares that do not scatter leave the rates as they are, to the last bit.
        let mix = if of.scatter.share_log_std > 0.0 { of.mix } else { &[] };
        let walk = Walk::through(of.family, of.question.tonnes, of.question.removal);
        Self { limits: of.question.limits(), mix, walk, of }
    }

    /// The results of `of` for each sample of `draws` and its depths over traffic.
    pub fn each<T: Send>(&self, draws: &[Draw], of: impl Fn(Sample, &Track) -> T + Sync) -> Vec<T> {
        let of_chunk = |draws: &[Draw]| {
            let mut track = Track::default();
            let of_one = |draw| {
                let sample = self.sample(draw, &mut track);
                of(sample, &track)
            };
            draws.iter().map(of_one).collect::<Vec<T>>()
        };
        draws.par_chunks(CHUNK).flat_map_iter(of_chunk).collect()
    }

    /// The sample `draw`; `track` receives its depths over traffic.
    pub fn sample(&self, draw: &Draw, track: &mut Track) -> Sample {
        let [c, m, toughness, detected, wear] = draw.deviates;
        let Sampling { scatter, question: Question { tonnes, removal, .. }, .. } = self.of;
        let shares = draw.shares.map(|z| (scatter.share_log_std * z).exp());
        let wear = (removal.wear + scatter.wear_std * wear).max(0.0);
        let rates = SampledRates {
            faster: (scatter.c_log_std * c).exp(),
            steeper: scatter.m_std * m,
            shares: SampledShares::of(self.mix, shares, tonnes),
            removal: SurfaceRemoval { wear, ..removal },
            arrest_rate: self.of.arrest_rate,
        };
        let own = scatter.toughness.filter(|_| self.of.has_own_toughness);
        let depth = self.limits.detectable_depth;
        let limits = Limits {
            toughness: own.map(|value| value + scatter.toughness_std * toughness),
            detectable_depth: depth.map(|depth| (depth + scatter.detectable_depth_std * detected).max(0.0)),
            ..self.limits
        };
        let walked = self.walk.walk(&rates, &limits, track);
        let to_critical = walked.fate.failure().unwrap_or(f64::INFINITY);
        let outlives = match walked.fate {
            Fate::Outlives(mgt) => mgt,
            _ => f64::INFINITY,
        };
        // A crack that is not detectable before the rail fails leaves no time to find it.
        let seen = walked.window.map_or(0.0, |window| window.length());
        let way = if to_critical.is_finite() { seen } else { f64::INFINITY };
        Sample {
            draw: *draw,
            grows: walked.grows,
            to_critical,
            way,
            outlives,
            found_from: limits.detectable_depth,
            fate: walked.fate,
        }
    }
}
