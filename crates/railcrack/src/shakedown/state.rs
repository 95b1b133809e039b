//! Stabilised state, and the passages that lead to it.

use super::eigenstress::Columns;
use super::fourier::{Layers, RailGrid};
use super::plane_strain::PlaneStrain;
use super::rail::{PlasticStrain, RolledRail, ShakedownError, Travel};
use super::streamline::{SteadyPassage, SteadyProblem, first_column};
use crate::material::IsotropicElastic;
use crate::math::Stress;
use crate::words::{Choice, Word};

/// The asymptotic response to repeated passages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RailState {
    /// The rail never yields.
    Elastic,
    /// The rail yields in the first passages and is elastic in all later ones.
    ElasticShakedown,
    /// Every passage yields in both directions: plastic strain alternates.
    PlasticShakedown,
    /// The last of the allowed passages still changed the rail.
    NotStabilised,
}

impl Choice for RailState {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Elastic, Word::now("elastic", "never yields")),
        (Self::ElasticShakedown, Word::now("elastic shakedown", "yields in the first passages only")),
        (
            Self::PlasticShakedown,
            Word::now("plastic shakedown", "plastic strain alternates in every passage"),
        ),
        (Self::NotStabilised, Word::now("not stabilised", "the last passage still changed the rail")),
    ];
}

/// Method for the stabilised plastic state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Each passage starts from the state left by the previous one.
    PassByPass,
    /// The upstream state is set to the downstream state in every iteration. An elastic-shakedown
    /// state is not unique: the result is admissible, but need not be the state to which passages
    /// lead.
    Direct,
}

impl Choice for Method {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::PassByPass,
            Word::now("pass-by-pass", "each passage starts from the state left by the previous one"),
        ),
        (
            Self::Direct,
            Word::now(
                "direct",
                "the downstream state becomes the upstream state in every iteration: cheaper, but possibly a different admissible state",
            ),
        ),
    ];
}

/// Record of one passage, or of the single computation of [`Method::Direct`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassRecord {
    /// Number of the passage, from 1.
    pub pass: usize,
    /// Number of elastic redistributions.
    pub iterations: usize,
    /// Largest change of σ_xx or σ_zz of the residual stress from before the passage to after it,
    /// MPa.
    pub stress_change: f64,
    /// Largest change of the plastic strain from before the passage to after it, √(2/3) |Δε_p|.
    pub strain_change: f64,
    /// Largest equivalent plastic strain after the passage, √(2/3) |ε_p|.
    pub largest_strain: f64,
    /// Largest accumulated plastic strain of the passage, √(2/3) ∫ |dε_p|.
    pub plastic_path: f64,
    /// Largest magnitude of σ_xx or σ_zz left by the passages so far, without the initial residual
    /// stress, MPa.
    pub left_stress: f64,
}

/// Residual stress and plastic strain of one layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerState {
    /// Depth of its midplane, mm.
    pub depth: f64,
    /// Residual stress, including the initial one, MPa.
    pub stress: Stress,
    /// Plastic strain.
    pub strain: PlasticStrain,
    /// Accumulated plastic strain per passage, √(2/3) ∫ |dε_p|, in the stabilised state.
    pub plastic_per_pass: f64,
}

/// A range of depths, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthRange {
    /// Upper end.
    pub from: f64,
    /// Lower end.
    pub to: f64,
}

/// Stress and plastic strain around the load in the last passage, in the order of travel: a rail
/// point passes the columns one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// Abscissae of the columns from the centre of the contact, mm, upstream first.
    pub abscissae: Vec<f64>,
    /// Stress due to the wheel, plastic strain and manufacturing, MPa; column i and layer j at i ·
    /// layers + j.
    pub stress: Vec<Stress>,
    /// Plastic strain, likewise.
    pub strain: Vec<PlasticStrain>,
}

/// Residuals of the conditions of a stabilised state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Admissibility {
    /// Largest |s − X| − R over the whole cycle, over R: at most round-off and tolerance for an
    /// admissible state.
    pub overshoot: f64,
    /// Largest difference of the plastic strain downstream and upstream, √(2/3) |Δε_p|: zero for a
    /// state that repeats.
    pub drift: f64,
    /// Largest imbalance of a layer between two columns, over R.
    pub imbalance: f64,
}

/// The rail after its passages.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilisedRail {
    /// The asymptotic response.
    pub state: RailState,
    /// The method used.
    pub method: Method,
    /// The passages in order.
    pub passes: Vec<PassRecord>,
    /// The layers of the rail.
    pub layers: Layers,
    /// Residual stress and plastic strain of each layer, from the surface down.
    pub profile: Vec<LayerState>,
    /// Depths between which plastic strain alternates, in plastic shakedown.
    pub alternating: Option<DepthRange>,
    /// The last passage.
    pub cycle: Cycle,
    /// Residuals of the yield condition, of periodicity and of equilibrium.
    pub admissibility: Admissibility,
}

impl StabilisedRail {
    /// Number of elastic redistributions in all passages, a measure of the cost.
    pub fn iterations(&self) -> usize {
        self.passes.iter().map(|pass| pass.iterations).sum()
    }

    /// The largest difference of σ_xx or σ_zz of the residual stress from `other`, MPa, at the
    /// depths of this state.
    pub fn stress_difference(&self, other: &Self) -> f64 {
        let difference = |layer: &LayerState| {
            let there = other.residual_stress(layer.depth);
            (layer.stress.xx - there.xx).abs().max((layer.stress.zz - there.zz).abs())
        };
        self.profile.iter().map(difference).fold(0.0, f64::max)
    }

    /// The residual stress at `depth` (mm), MPa: linear between the midplanes of the layers,
    /// constant beyond them.
    pub fn residual_stress(&self, depth: f64) -> Stress {
        let next = self.profile.partition_point(|layer| layer.depth < depth);
        match (next.checked_sub(1).map(|i| self.profile[i]), self.profile.get(next)) {
            (Some(above), Some(below)) => {
                let t = (depth - above.depth) / (below.depth - above.depth);
                above.stress * (1.0 - t) + below.stress * t
            }
            (Some(end), None) => end.stress,
            (None, Some(&end)) => end.stress,
            (None, None) => Stress::ZERO,
        }
    }

    /// The stress path of layer `j` over the stabilised cycle, MPa: in the order of travel, then
    /// the unloaded state.
    pub fn stress_path(&self, j: usize) -> Vec<Stress> {
        let layers = self.profile.len();
        let mut path: Vec<Stress> = self.cycle.stress.iter().skip(j).step_by(layers).copied().collect();
        path.push(self.profile[j].stress);
        path
    }

    /// The stress path at the running surface, MPa: the stress of the wheel there, and the residual
    /// stress of the uppermost layer. `rail` is the computed rail.
    pub fn surface_path(&self, rail: &RolledRail) -> Vec<Stress> {
        let (Some(top), Ok(field)) = (self.profile.first(), rail.field()) else { return Vec::new() };
        let mut path = self.stress_path(0);
        for (stress, &x) in path.iter_mut().zip(&self.cycle.abscissae) {
            let wheel = |depth: f64| field.stress(x, depth);
            *stress = *stress + wheel(0.0) - wheel(top.depth);
        }
        path
    }
}

/// Zero strain or stress on all columns of `grid`.
pub(super) fn unstrained(grid: &RailGrid) -> Columns {
    let size = grid.columns * grid.layers.count();
    [vec![0.0; size], vec![0.0; size], vec![0.0; size]]
}

/// The residual stress of a rail in which `strain` depends on depth alone: σ_xx = −E′ (ε_xx + ν
/// ε_zz), σ_zz = −E′ (ε_zz + ν ε_xx), σ_yy = σ_xy = 0.
pub(super) fn layer_stress(steel: &IsotropicElastic, strain: PlasticStrain) -> Stress {
    let (modulus, poisson) = (steel.plane_strain_modulus(), steel.poisson());
    Stress {
        xx: -modulus * (strain.xx + poisson * strain.zz),
        zz: -modulus * (strain.zz + poisson * strain.xx),
        ..Stress::ZERO
    }
}

/// −1 if the computation is the mirror image of the rail: the factor of abscissae and shears.
pub(super) fn mirror_sign(travel: Travel) -> f64 {
    match travel {
        Travel::Forward => 1.0,
        Travel::Backward => -1.0,
    }
}

/// Stress and strain of `passage`, and their admissibility. Errors: an invalid contact.
pub(super) fn stabilised_cycle(
    rail: &RolledRail,
    grid: &RailGrid,
    problem: &mut SteadyProblem<PlaneStrain, 3>,
    passage: &SteadyPassage<3>,
) -> Result<(Cycle, Admissibility), ShakedownError> {
    let depths = grid.layers.middles();
    let layers = depths.len();
    let strain_at = |at: usize| [0, 1, 2].map(|c| passage.strain[c][at]);
    let entering = &passage.entering;
    let mut residual = unstrained(grid);
    problem.elasticity.eigenstress.stress(&passage.strain, entering, &mut residual);
    let imbalance = problem.elasticity.eigenstress.imbalance(&passage.strain, entering);
    let field = rail.forward_field()?;
    let (poisson, young) = (rail.steel.poisson(), rail.steel.young());
    let (radius, back) = (rail.hardening.yield_radius(), rail.hardening.back_stress_modulus());
    let side = mirror_sign(rail.travel);
    let mut cycle = Cycle {
        abscissae: (0..grid.columns).rev().map(|i| side * grid.abscissa(i)).collect(),
        stress: Vec::with_capacity(grid.columns * layers),
        strain: Vec::with_capacity(grid.columns * layers),
    };
    let mut overshoot = f64::NEG_INFINITY;
    for i in (0..grid.columns).rev() {
        for (j, &depth) in depths.iter().enumerate() {
            let at = i * layers + j;
            let strain = PlasticStrain::from_deviator(strain_at(at));
            let (xx, yy) = (residual[0][at], residual[1][at]);
            let own = Stress { xx, yy, zz: poisson * (xx + yy) - young * strain.zz, xy: residual[2][at] };
            let wheel = field.stress(grid.abscissa(i), depth);
            let stress = own + wheel + rail.initial_stress(depth);
            let (s, e) = (stress.deviator(), strain_at(at));
            let size = [0, 1, 2].map(|c| s[c] - back * e[c]).iter().map(|c| c * c).sum::<f64>().sqrt();
            overshoot = overshoot.max(size / radius - 1.0);
            cycle.stress.push(Stress { xy: side * stress.xy, ..stress });
            cycle.strain.push(PlasticStrain { xy: side * strain.xy, ..strain });
        }
    }
    let drift = first_column(&passage.strain, layers)
        .iter()
        .zip(entering)
        .map(|(a, b)| PlasticStrain::from_deviator([0, 1, 2].map(|c| a[c] - b[c])).equivalent())
        .fold(0.0, f64::max);
    Ok((cycle, Admissibility { overshoot, drift, imbalance: imbalance / radius }))
}
