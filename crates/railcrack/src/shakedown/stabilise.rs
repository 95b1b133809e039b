//! Iteration over passages up to the stabilised state.

use super::bounds::{ShakedownLimit, utilisation};
use super::fourier::{Layers, RailGrid, Resolution, active_columns};
use super::passages::Passages;
use super::plane_strain::PlaneStrain;
use super::rail::{PlasticStrain, RolledRail, ShakedownError};
use super::state::{
    DepthRange, LayerState, Method, PassRecord, RailState, StabilisedRail, layer_stress, mirror_sign,
    stabilised_cycle, unstrained,
};
use super::streamline::{FlowLaw, SteadyPassage, SteadyProblem, Upstream, first_column};
use crate::interruption::Interruption;
use crate::math::{OutOfRange, Stress};

/// Settings of the stabilisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stabilisation {
    /// The method.
    pub method: Method,
    /// Resolution in columns and layers.
    pub resolution: Resolution,
    /// Number of passages after which the rail counts as not stabilised.
    pub max_passes: usize,
    /// Change of the residual stress by a passage, over the largest residual stress left by
    /// passages, below which it counts as stabilised.
    pub pass_tolerance: f64,
}

impl Default for Stabilisation {
    fn default() -> Self {
        Self {
            method: Method::PassByPass,
            resolution: Resolution::default(),
            max_passes: 500,
            // Passages change the stress by ever smaller amounts, which halve within two to ten
            // passages: the remaining change is some thousandths.
            pass_tolerance: 5e-4,
        }
    }
}

/// Change of the plastic strain at which the iteration within a passage ends, times 2 G over R:
/// some 1e-3 MPa.
pub(super) const TOLERANCE: f64 = 1e-5;
/// The same tolerance for the direct method, whose plastic strain drifts by this amount in each
/// iteration without any change of the stress.
const DIRECT_TOLERANCE: f64 = 2e-4;
/// Change of the plastic strain by a passage, over the yield strain, above which the rail has not
/// stabilised even if the stress has: a shear along the rail leaves no residual stress and may
/// continue.
pub(super) const STRAIN_TOLERANCE: f64 = 1e-2;
/// Number of redistributions after which a passage has failed; the softest steels (C = E/10⁴) take
/// some hundreds.
pub(super) const MOST_ITERATIONS: usize = 3000;
/// Number of times that the even layers are extended downwards because there is flow below them.
pub(super) const EXTENSIONS: usize = 8;
/// A layer alternates if its accumulated plastic strain in a passage is this many times the plastic
/// strain that it retains: in a layer that settles the two are equal; …
const ALTERNATING: f64 = 4.0;
/// … and if the path is at least this fraction of the longest: shorter ones, in single layers at
/// the surface, come and go with the number of columns.
const ALTERNATING_SHARE: f64 = 1e-2;

/// The state to which repeated passages over `rail` lead. `watch` receives every passage, and
/// starts again with the first one if the plastic zone turns out to need more layers.
///
/// Errors: a load or contact outside the range of the model; a passage that does not converge.
///
/// Source: Dang Van & Maitournam 1993, J. Mech. Phys. Solids 41, 1691–1710 (steady flow under
/// moving loads).
pub fn stabilise(
    rail: &RolledRail,
    settings: &Stabilisation,
    watch: impl FnMut(&PassRecord),
) -> Result<StabilisedRail, ShakedownError> {
    stabilise_unless(Interruption::NEVER, rail, settings, watch)
}

/// [`stabilise`] that stops on an `interruption`.
pub fn stabilise_unless(
    interruption: Interruption<'_>,
    rail: &RolledRail,
    settings: &Stabilisation,
    mut watch: impl FnMut(&PassRecord),
) -> Result<StabilisedRail, ShakedownError> {
    check_rail(rail)?;
    let mut grid = RailGrid::of(rail, settings.resolution)?;
    for _ in 0..EXTENSIONS {
        let mut run = PassIteration::new(rail, settings, &grid)?;
        let flown = run.all_passes(interruption, &mut watch)?;
        if flown <= grid.fine_depth {
            return run.finish();
        }
        grid = RailGrid::down_to(rail, settings.resolution, 1.25 * flown);
    }
    Err(ShakedownError::Bottomless { depth: grid.fine_depth })
}

/// Checks that [`stabilise`] can compute `rail`.
///
/// Errors: a load, contact or initial residual stress outside the range of the model.
pub fn check_rail(rail: &RolledRail) -> Result<(), ShakedownError> {
    RailGrid::check_load(rail)?;
    let contact = &rail.contact;
    OutOfRange::unless_positive("peak pressure (MPa)", contact.peak_pressure())?;
    OutOfRange::unless_positive("half width (mm)", contact.half_width())?;
    let within = (-1.0..=1.0).contains(&contact.adhesion());
    OutOfRange::unless(within, "friction", contact.adhesion(), "between -1 and 1")?;
    contact.check()?;
    // The profile is linear between its rows, and |s| convex: its largest value occurs at a row.
    for &(depth, xx, zz) in rail.initial.iter().flat_map(|profile| profile.rows()) {
        let s = Stress { xx, zz, ..Stress::ZERO }.deviator();
        let utilisation = s.iter().map(|c| c * c).sum::<f64>().sqrt() / rail.hardening.yield_radius();
        if utilisation > 1.0 {
            return Err(ShakedownError::Initial { utilisation, depth });
        }
    }
    Ok(())
}

/// The iteration over passages on one grid.
struct PassIteration<'a> {
    rail: &'a RolledRail,
    settings: &'a Stabilisation,
    grid: &'a RailGrid,
    passages: Passages<PlaneStrain, 3>,
    passes: Vec<PassRecord>,
    stabilised: bool,
}

impl<'a> PassIteration<'a> {
    fn new(
        rail: &'a RolledRail,
        settings: &'a Stabilisation,
        grid: &'a RailGrid,
    ) -> Result<Self, ShakedownError> {
        let field = rail.forward_field()?;
        let layers = grid.layers.middles();
        let mut background = unstrained(grid);
        for (j, &depth) in layers.iter().enumerate() {
            let initial = rail.initial_stress(depth);
            for i in 0..grid.columns {
                let stress = field.stress(grid.abscissa(i), depth) + initial;
                for (component, value) in background.iter_mut().zip(stress.deviator()) {
                    component[i * layers.len() + j] = value;
                }
            }
        }
        let problem = SteadyProblem {
            elasticity: PlaneStrain::new(&rail.steel, grid),
            law: FlowLaw::new(&rail.steel, &rail.hardening),
            background,
            active: active_columns(rail.contact.half_width(), grid.spacing, grid.columns),
            strain_scale: 2.0 * rail.steel.shear_modulus() / rail.hardening.yield_radius(),
            tolerance: match settings.method {
                Method::PassByPass => TOLERANCE,
                Method::Direct => DIRECT_TOLERANCE,
            },
            max_iterations: MOST_ITERATIONS,
        };
        let passages = Passages::new(problem, layers.len());
        Ok(Self { rail, settings, grid, passages, passes: Vec::new(), stabilised: false })
    }

    /// Computes all passages and returns the greatest depth with plastic strain, mm. Ends early if
    /// this depth lies below the even layers.
    fn all_passes(
        &mut self,
        interruption: Interruption<'_>,
        watch: &mut impl FnMut(&PassRecord),
    ) -> Result<f64, ShakedownError> {
        let yield_strain = self.rail.hardening.yield_stress() / self.rail.steel.young();
        let most = match self.settings.method {
            Method::PassByPass => self.settings.max_passes.max(1),
            Method::Direct => 1,
        };
        let mut flown = 0.0;
        while !self.stabilised && self.passes.len() < most {
            let record = self.pass(interruption)?;
            flown = self.flown();
            if flown > self.grid.fine_depth {
                return Ok(flown);
            }
            self.stabilised = record.stress_change <= self.settings.pass_tolerance * record.left_stress
                && record.strain_change <= STRAIN_TOLERANCE * yield_strain;
            watch(&record);
            self.passes.push(record);
        }
        Ok(flown)
    }

    /// The next passage.
    fn pass(&mut self, interruption: Interruption<'_>) -> Result<PassRecord, ShakedownError> {
        let upstream = match self.settings.method {
            Method::PassByPass => Upstream::Given,
            Method::Direct => Upstream::Downstream,
        };
        let start = self.passages.guess();
        let passage = self.passages.advance(start, upstream, interruption)?;
        let leaving = first_column(&passage.strain, passage.entering.len());
        Ok(record(self.rail, self.passes.len() + 1, &leaving, passage))
    }

    /// The greatest depth with plastic strain, mm; 0 for none.
    fn flown(&self) -> f64 {
        let Some(last) = &self.passages.last else { return 0.0 };
        let deepest = last.path.iter().rposition(|&path| path > 0.0);
        deepest.map_or(0.0, |j| self.grid.layers.interfaces()[j + 1])
    }

    fn finish(self) -> Result<StabilisedRail, ShakedownError> {
        let leaving = self.passages.entering.clone();
        let layers = leaving.len();
        let (limit, state) = (self.rail.shakedown_limit()?, self.state()?);
        let (mut problem, passage) = self.passages.into_last();
        let (cycle, admissibility) = stabilised_cycle(self.rail, self.grid, &mut problem, &passage)?;
        let depths = self.grid.layers.middles();
        let mirror = mirror_sign(self.rail.travel);
        let layer = |j: usize| {
            let strain = PlasticStrain::from_deviator(leaving[j]);
            let residual = layer_stress(&self.rail.steel, strain);
            LayerState {
                depth: depths[j],
                stress: residual + self.rail.initial_stress(depths[j]),
                strain: PlasticStrain { xy: mirror * strain.xy, ..strain },
                plastic_per_pass: passage.path[j],
            }
        };
        let profile: Vec<LayerState> = (0..layers).map(layer).collect();
        let alternating = match state {
            RailState::PlasticShakedown => Some(alternating(self.rail, &self.grid.layers, &passage, limit)),
            _ => None,
        };
        Ok(StabilisedRail {
            state,
            method: self.settings.method,
            passes: self.passes,
            layers: self.grid.layers.clone(),
            profile,
            alternating,
            cycle,
            admissibility,
        })
    }

    /// Unlimited linear kinematic hardening cannot ratchet, and where a constant backstress and
    /// residual stress exist with which the passage is elastic, it becomes elastic in the end
    /// (Melan 1938); both are known at every depth without layers. So once the passages repeat, the
    /// loads alone distinguish the states, without discretisation error.
    fn state(&self) -> Result<RailState, ShakedownError> {
        let rail = self.rail;
        let limit = rail.shakedown_limit()?;
        let initial = |depth: f64| rail.initial_stress(depth).deviator();
        let radius = rail.hardening.yield_radius();
        let field = rail.forward_field()?;
        let (_, utilisation) =
            utilisation(&|x, depth| field.stress(x, depth), rail.contact.half_width(), radius, initial);
        Ok(if !self.stabilised {
            RailState::NotStabilised
        } else if utilisation <= 1.0 && self.passes.iter().all(|pass| pass.plastic_path == 0.0) {
            RailState::Elastic
        } else if rail.pressure_ratio() <= limit.ratio {
            RailState::ElasticShakedown
        } else {
            RailState::PlasticShakedown
        })
    }
}

/// The change by `passage`, a number from 1.
fn record(rail: &RolledRail, pass: usize, leaving: &[[f64; 3]], passage: &SteadyPassage<3>) -> PassRecord {
    let came = &passage.entering;
    let mut record = PassRecord {
        pass,
        iterations: passage.iterations,
        stress_change: 0.0,
        strain_change: 0.0,
        largest_strain: 0.0,
        plastic_path: passage.path.iter().copied().fold(0.0, f64::max),
        left_stress: 0.0,
    };
    for j in 0..came.len() {
        let change = PlasticStrain::from_deviator([0, 1, 2].map(|c| leaving[j][c] - came[j][c]));
        let by = layer_stress(&rail.steel, change);
        let strain = PlasticStrain::from_deviator(leaving[j]);
        let stress = layer_stress(&rail.steel, strain);
        record.stress_change = record.stress_change.max(by.xx.abs()).max(by.zz.abs());
        record.strain_change = record.strain_change.max(change.equivalent());
        record.largest_strain = record.largest_strain.max(strain.equivalent());
        record.left_stress = record.left_stress.max(stress.xx.abs()).max(stress.zz.abs());
    }
    record
}

/// The depth range of alternating plastic strain, from the layers or, if the zone is thinner than
/// one layer, from the elastic paths.
fn alternating(
    rail: &RolledRail,
    layers: &Layers,
    passage: &SteadyPassage<3>,
    limit: ShakedownLimit,
) -> DepthRange {
    let (came, leaving) = (&passage.entering, first_column(&passage.strain, layers.count()));
    let kept =
        |j: usize| PlasticStrain::from_deviator([0, 1, 2].map(|c| leaving[j][c] - came[j][c])).equivalent();
    let alternates = alternating_streamlines(&passage.path, kept);
    let interfaces = layers.interfaces();
    let from = alternates.iter().position(|own| *own).map(|j| interfaces[j]);
    let to = alternates.iter().rposition(|own| *own).map(|j| interfaces[j + 1]);
    let (from, to) = from.zip(to).unwrap_or_else(|| {
        let depth = limit.depth_over_a * rail.contact.half_width();
        (depth, depth)
    });
    DepthRange { from, to }
}

/// Which streamlines alternate, from the accumulated plastic strain of a passage (`path`) and the
/// plastic strain that each one keeps of it.
pub(super) fn alternating_streamlines(path: &[f64], kept: impl Fn(usize) -> f64) -> Vec<bool> {
    let longest = path.iter().copied().fold(0.0, f64::max);
    let alternates = |j: usize| path[j] > ALTERNATING * kept(j) && path[j] > ALTERNATING_SHARE * longest;
    (0..path.len()).map(alternates).collect()
}
