//! The cracked rail in extended finite elements, condensed to its face points.

use super::basis::Elasticity;
use super::border::Border;
use super::columns::ColumnStore;
use super::condense::{Condensed, System};
use super::cuts::Cuts;
use super::domain::{domain_of, short_part};
use super::field::Inside;
use super::interface::{Interface, Station};
use super::sif::{SifContext, SifFunctional};
use super::space::Space;
use super::trace;
use crate::body::{BodyError, BodyFields, BodyTimes, CrackedBody, FaceMesh, FieldLoad, RailEnds};
use crate::bulk::{BlockCorrection, BulkError, BulkRail, CorrectionAtPoints};
use crate::crack::{CrackNetwork, CrackTip};
use crate::linear::{LinearError, spd_inverse};
use crate::load::HertzianContact;
use crate::math::{Matrix, Stress, Vec2};
use crate::mesh::{MeshError, QuadMesh};
use std::sync::Arc;
use std::time::Instant;
use thiserror::Error;

/// A network of cracks that the finite-element engine cannot represent.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum XfemError {
    /// A crack that leaves the mesh.
    #[error("crack {crack} leaves the mesh: {covered} of {length} mm lie inside")]
    OutsideMesh {
        /// Number of the crack, from 1.
        crack: usize,
        /// Length inside of the mesh, mm.
        covered: f64,
        /// Its length, mm.
        length: f64,
    },
    /// Grid lines that do not form a mesh.
    #[error("the mesh cannot be made: {0}")]
    Mesh(#[from] MeshError),
    /// The uncracked rail.
    #[error("the rail cannot be computed: {0}")]
    Bulk(#[from] BulkError),
    /// Linear algebra.
    #[error("the enriched system cannot be solved: {0}")]
    Linear(#[from] LinearError),
}

/// Resolution around the tips and along the faces. Numbers without a unit count elements at the
/// tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct XfemSettings {
    /// Radius within which nodes carry √r functions.
    pub enrichment: EnrichmentRadius,
    /// Radius up to which the weight of the domain of integration of the SIFs is 1.
    pub domain_inner: f64,
    /// Radius at which the weight has fallen to 0.
    pub domain_outer: f64,
    /// Distance between face points away from mouth, tips and kinks, mm; `None`: the length of
    /// crack in an element.
    pub interface_spacing: Option<f64>,
}

/// Radius of the √r functions around a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EnrichmentRadius {
    /// In elements at the tip.
    Elements(f64),
    /// In mm.
    Fixed(f64),
}

impl Default for XfemSettings {
    fn default() -> Self {
        Self {
            enrichment: EnrichmentRadius::Elements(2.5),
            domain_inner: 1.5,
            domain_outer: 4.5,
            interface_spacing: None,
        }
    }
}

/// The cracked rail: C, A, S at the face points.
#[derive(Debug, Clone)]
pub struct XfemBody {
    pub(super) inside: Inside,
    tips: Vec<CrackTip>,
    compliance: Matrix,
    stiffness: Matrix,
    sif_influence: Matrix,
    dofs: usize,
    remarks: Vec<String>,
    pub(super) times: BodyTimes,
    ends: Option<BlockEnds>,
}

/// Effect of the ends of a block on the faces.
#[derive(Debug, Clone)]
struct BlockEnds {
    points: usize,
    correction: CorrectionAtPoints,
    contact: HertzianContact,
}

impl RailEnds for BlockEnds {
    fn stresses(&self, xc: f64) -> Vec<Stress> {
        let wheel = self.correction.wheel_nearest(xc);
        (0..self.points).map(|k| wheel.stress(k)).collect()
    }
}

impl XfemBody {
    /// The rail on `background` with `network` of cracks.
    pub fn new(
        background: &Arc<BulkRail>,
        network: &CrackNetwork,
        settings: XfemSettings,
    ) -> Result<Self, XfemError> {
        Self::with_columns(background, network, settings, &mut ColumnStore::default())
    }

    /// [`XfemBody::new`] with the columns solved for other cracks on the same background.
    pub fn with_columns(
        background: &Arc<BulkRail>,
        network: &CrackNetwork,
        settings: XfemSettings,
        columns: &mut ColumnStore,
    ) -> Result<Self, XfemError> {
        let mut times = BodyTimes::default();
        let mut clock = Instant::now();
        let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
        let mesh = background.mesh();
        let Discretisation { cuts, sizes, space, interface } = Discretisation::new(mesh, network, &settings)?;
        times.enrichment_s = lap();
        let elasticity = Elasticity::new(*background.steel());
        let border = Border::new(&cuts, &space, &elasticity);
        times.border_s = lap();
        let context =
            SifContext { mesh, cuts: &cuts, space: &space, interface: &interface, elasticity: &elasticity };
        let mut remarks = Vec::new();
        let mut functionals: Vec<SifFunctional> = Vec::new();
        for (tip, &size) in sizes.iter().enumerate() {
            let (domain, remark) = domain_of(&cuts, tip, size, &settings);
            functionals.extend(context.functionals(tip, domain));
            remarks.extend(remark);
            remarks.extend(short_part(&cuts, tip, size));
        }
        times.sif_s = lap();
        let jumps = trace::jumps(background, &cuts, &space, &interface);
        let duality = interface.duality();
        let system = System {
            rail: background,
            space: &space,
            border: &border,
            jumps: &jumps,
            functionals: &functionals,
            duality: &duality,
        };
        let Condensed { compliance, sif_influence, elimination } = system.condensed(columns)?;
        let stiffness = spd_inverse(&compliance)?;
        times.condensation_s = lap();
        let tips = network.tips();
        let dofs = background.factor().order() + space.unknowns();
        let rail = Arc::clone(background);
        Ok(Self {
            inside: Inside { rail, cuts, space, interface, duality, elimination },
            tips,
            compliance,
            stiffness,
            sif_influence,
            dofs,
            remarks,
            times,
            ends: None,
        })
    }
}

impl XfemBody {
    /// Adds the effect of the ends of a block on the stress under the wheel.
    pub(super) fn add_ends(
        &mut self,
        correction: &BlockCorrection,
        contact: &HertzianContact,
    ) -> Result<(), BulkError> {
        let points: Vec<Vec2> = self.faces().samples.iter().map(|sample| sample.point).collect();
        self.ends =
            Some(BlockEnds { points: points.len(), correction: correction.at(&points)?, contact: *contact });
        Ok(())
    }

    /// Adds a remark for the user.
    pub(super) fn remark(&mut self, text: String) {
        self.remarks.push(text);
    }
}

/// The part of the cracked mesh that does not need its stiffness.
pub(super) struct Discretisation {
    pub cuts: Cuts,
    /// Size of the elements at each tip, mm.
    pub sizes: Vec<f64>,
    pub space: Space,
    pub interface: Interface,
}

impl Discretisation {
    pub(super) fn new(
        mesh: &QuadMesh,
        network: &CrackNetwork,
        settings: &XfemSettings,
    ) -> Result<Self, XfemError> {
        let mut cuts = Cuts::new(mesh, network);
        let sizes: Vec<f64> = cuts.tips.iter().map(|tip| element_size(mesh, tip.position())).collect();
        let radius: Vec<f64> = cuts
            .poles
            .iter()
            .map(|pole| element_size(mesh, pole.position()))
            .map(|size| match settings.enrichment {
                EnrichmentRadius::Elements(elements) => elements * size,
                EnrichmentRadius::Fixed(radius) => radius,
            })
            .collect();
        let space = Space::new(mesh, &mut cuts, &radius);
        let interface = Interface::new(mesh, network, &cuts, settings.interface_spacing);
        for (index, crack) in network.cracks().iter().enumerate() {
            let own = |s: &&Station| cuts.pieces[s.piece].crack == index;
            let covered: f64 = interface.stations.iter().filter(own).map(|s| s.length).sum();
            let length = crack.length();
            if (covered - length).abs() > COVERAGE * length {
                return Err(XfemError::OutsideMesh { crack: index + 1, covered, length });
            }
        }
        Ok(Self { cuts, sizes, space, interface })
    }
}

/// Relative difference between the length of a crack and that of its pieces in elements that
/// round-off explains.
const COVERAGE: f64 = 1e-8;

/// Size (mm) of the elements at a point: the longest side of the element that contains it.
fn element_size(mesh: &QuadMesh, at: Vec2) -> f64 {
    let size = mesh.element(mesh.locate(at).unwrap_or(0)).size();
    size.x.max(size.y)
}

impl CrackedBody for XfemBody {
    fn faces(&self) -> &FaceMesh {
        &self.inside.interface.faces
    }

    fn tips(&self) -> &[CrackTip] {
        &self.tips
    }

    fn compliance(&self) -> &Matrix {
        &self.compliance
    }

    fn stiffness(&self) -> &Matrix {
        &self.stiffness
    }

    fn sif_influence(&self) -> &Matrix {
        &self.sif_influence
    }

    fn dofs(&self) -> usize {
        self.dofs
    }

    fn ends(&self) -> Option<&dyn RailEnds> {
        self.ends.as_ref().map(|ends| ends as &dyn RailEnds)
    }

    fn fields(&self, loads: &[FieldLoad]) -> Result<Option<BodyFields>, BodyError> {
        let contact = self.ends.as_ref().map(|ends| &ends.contact);
        match self.inside.fields(loads, contact) {
            Ok(fields) => Ok(Some(fields)),
            Err(reason) => Err(BodyError { reason: Box::new(reason) }),
        }
    }

    fn times(&self) -> BodyTimes {
        self.times
    }

    fn remarks(&self) -> &[String] {
        &self.remarks
    }
}
