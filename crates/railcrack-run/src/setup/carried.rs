//! Residual stress that the rail of a run carries.

use super::layered::{LayeredStress, SectionStress};
use railcrack::bulk::{
    BottomSupport, Boundary, BulkError, BulkRail, ElasticField, SideSupport, StressAtPoints,
};
use railcrack::field::{DepthProfile, StressField, Sum};
use railcrack::math::{Stress, Vec2};
use railcrack::residual::{
    BalancedStress, PlasticField, PlasticFieldError, ProjectionLoss, RecoveryLoss, projection_loss,
};
use railcrack::space::StandingStress;
use railcrack::xfem::{XfemEngine, XfemError};
use railcrack_case::{Case, PlasticSource};
use std::sync::Arc;
use thiserror::Error;

/// A residual stress that cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CarriedStressError {
    /// Its mesh cannot be generated.
    #[error("the plastic stress cannot be balanced: {0}")]
    Mesh(#[from] XfemError),
    /// It cannot be balanced.
    #[error("the plastic stress cannot be balanced: {0}")]
    Balance(#[from] BulkError),
    /// It cannot be projected onto a mesh.
    #[error("the plastic stress cannot be used: {0}")]
    Field(#[from] PlasticFieldError),
    /// The stabilised state of the rail is required but was not computed.
    #[error("the plastic stress of the rolled rail was not computed")]
    NotRolled,
}

/// The residual stress of a run: the stress given as balanced, the stress before the first passage,
/// and the balance of the plastic stress.
#[derive(Clone)]
pub struct CarriedStress {
    /// Their sum; none where the rail carries nothing.
    pub field: Option<Arc<dyn StressField>>,
    /// In space, what rolling has left under a patch, which varies across the rail; it adds to the
    /// field.
    pub standing: Option<Arc<dyn StandingStress>>,
    /// Depths at which it is reported, increasing, mm.
    pub depths: Vec<f64>,
    /// Losses of a plastic stress in its projection onto the mesh.
    pub projection: Option<Projection>,
    /// Its release by the free sides of a block.
    pub release: Option<Release>,
}

/// Losses of a plastic stress in its projection onto the mesh of the rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    /// From cells to nodes of its own mesh; none where it was given at nodes.
    pub recovery: Option<RecoveryLoss>,
    /// From there to the mesh of the rail, within the rail's width and depth.
    pub loss: ProjectionLoss,
    /// Left, right end and depth of its own mesh, mm.
    pub extent: (f64, f64, f64),
}

/// The stress on the middle line that the free sides of a block release.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Release {
    /// Where it is largest, mm.
    pub depth: f64,
    /// σ_xx with the sides held along x, MPa.
    pub held: f64,
    /// σ_xx with the sides free, MPa.
    pub free: f64,
    /// Whether the run uses the released stress, or the held one.
    pub carried: bool,
}

/// A balanced profile, cut off at free sides.
struct Cut<'a>(&'a DepthProfile);

impl ElasticField for Cut<'_> {
    fn stress(&self, point: Vec2) -> Stress {
        StressField::stress(self.0, point)
    }

    fn displacement(&self, _: Vec2) -> Vec2 {
        Vec2::default()
    }

    fn smooth_within(&self, _: Vec2) -> f64 {
        f64::INFINITY
    }
}

/// Stress or strain that rolling leaves in the rail of a case in the plane.
#[derive(Debug, Clone, PartialEq)]
pub enum RolledStress {
    /// Under a line contact: a plastic stress, still to be balanced.
    Plastic(PlasticField),
    /// Under a patch: the balanced stress in the plane of the cracks, that of manufacturing
    /// included. The rail beside the plane balances it, which the plane cannot do.
    Balanced(LayeredStress),
    /// The same for cracks in space, across the rail.
    Across(Arc<SectionStress>),
}

/// The plastic stress of `case` that is still to be balanced. `rolled` is what the stabilised state
/// leaves.
///
/// Errors: it cannot be made; it is that of the stabilised state, which was not computed.
pub fn plastic_field(
    case: &Case,
    rolled: Option<&RolledStress>,
) -> Result<Option<PlasticField>, CarriedStressError> {
    Ok(match (case.plastic_stress(), rolled) {
        (None, _)
        | (Some(PlasticSource::Rolled), Some(RolledStress::Balanced(_) | RolledStress::Across(_))) => None,
        (Some(PlasticSource::Rolled), Some(RolledStress::Plastic(field))) => Some(field.clone()),
        (Some(PlasticSource::Rolled), None) => return Err(CarriedStressError::NotRolled),
        (Some(source), _) => source.given_field()?,
    })
}

impl CarriedStress {
    /// The residual stress of a run of `case`: the stress given as balanced, that of `rolled` under
    /// a patch, and the balance of `plastic` on the mesh of `engine`, the finite-element engine of
    /// the case, whichever engine computes the cracks; none in space.
    ///
    /// Errors: the plastic stress cannot be balanced.
    pub(super) fn balanced(
        case: &Case,
        rolled: Option<&RolledStress>,
        plastic: Option<&PlasticField>,
        mut engine: Option<&mut XfemEngine>,
    ) -> Result<Self, CarriedStressError> {
        let mut parts: Vec<Box<dyn StressField>> = Vec::new();
        let mut depths: Vec<f64> = Vec::new();
        let (mut release, mut standing) = (None, None);
        let free_sides = matches!(case.boundary(), Boundary::Block { sides: SideSupport::Free, .. });
        let initial = match (case.plastic_stress(), rolled) {
            (Some(PlasticSource::Rolled), Some(RolledStress::Balanced(field))) => {
                depths.extend(field.depths().filter(|depth| *depth <= case.rail.depth));
                parts.push(Box::new(field.clone()));
                None
            }
            (Some(PlasticSource::Rolled), Some(RolledStress::Across(section))) => {
                depths.extend(section.depths());
                standing = Some(Arc::clone(section) as Arc<dyn StandingStress>);
                None
            }
            (Some(PlasticSource::Rolled), _) => case.shakedown.initial_residual.as_ref(),
            _ => None,
        };
        for file in case.residual_stress.iter().chain(initial) {
            let profile = file.content();
            depths.extend(profile.rows().iter().map(|row| row.0));
            if let Some(engine) = engine.as_mut().filter(|_| free_sides) {
                release = Some(Release::of_profile(case, engine.background(&case.cracks)?, profile)?);
            }
            parts.push(Box::new(profile.clone()));
        }
        let mut projection = None;
        if let Some((plastic, engine)) = plastic.zip(engine) {
            let rail = Arc::clone(engine.background(&case.cracks)?);
            let balanced = BalancedStress::new(&rail, |point| plastic.plastic_stress(point))?;
            depths.extend(balanced.depths().iter().filter(|depth| **depth <= case.rail.depth));
            projection = Some(Projection {
                recovery: plastic.recovery_loss(),
                loss: projection_loss(&rail, plastic, case.rail),
                extent: plastic.extent(),
            });
            if free_sides {
                release = Some(Release::of_plastic(case, &rail, plastic, &balanced)?);
            }
            parts.push(Box::new(balanced));
        }
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        let field = match parts.len() {
            0 => None,
            1 => parts.pop().map(Arc::from),
            _ => Some(Arc::new(Sum(parts)) as Arc<dyn StressField>),
        };
        Ok(Self { field, standing, depths, projection, release })
    }
}

impl Release {
    /// A balanced stress is used unchanged; its release by the sides is only reported.
    fn of_profile(case: &Case, rail: &BulkRail, profile: &DepthProfile) -> Result<Self, BulkError> {
        let displacements = rail.cancel(&[&Cut(profile)])?;
        let points: Vec<Vec2> = profile
            .rows()
            .iter()
            .map(|row| Vec2::new(case.rail.centre, -row.0))
            .filter(|p| -p.y <= case.rail.depth)
            .collect();
        let released = StressAtPoints::new(rail, &points)?.stress(&displacements[0]);
        let of = |(point, released): (&Vec2, &Stress)| {
            let held = StressField::stress(profile, *point).xx;
            Release { depth: -point.y, held, free: held + released.xx, carried: false }
        };
        Ok(largest(points.iter().zip(&released).map(of)))
    }

    /// The balance with free sides against that with sides that are held along x.
    fn of_plastic(
        case: &Case,
        rail: &BulkRail,
        plastic: &PlasticField,
        balanced: &BalancedStress,
    ) -> Result<Self, BulkError> {
        let bottom = match case.boundary() {
            Boundary::Block { bottom, .. } => bottom,
            Boundary::HalfPlane => BottomSupport::Clamped,
        };
        let boundary = Boundary::Block { bottom, sides: SideSupport::Rollers };
        let rollers = BulkRail::new(rail.mesh().clone(), rail.steel(), boundary)?;
        let held = BalancedStress::new(&rollers, |point| plastic.plastic_stress(point))?;
        Ok(largest(balanced.depths().iter().map(|&depth| {
            let point = Vec2::new(case.rail.centre, -depth);
            let (held, free) = (held.stress(point).xx, balanced.stress(point).xx);
            Release { depth, held, free, carried: true }
        })))
    }
}

/// The depth at which the sides release most.
fn largest(releases: impl Iterator<Item = Release>) -> Release {
    let none = Release { depth: 0.0, held: 0.0, free: 0.0, carried: false };
    let size = |release: &Release| (release.held - release.free).abs();
    releases.fold(none, |most, next| if size(&next) >= size(&most) { next } else { most })
}
