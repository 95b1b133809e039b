//! Cracked rails in extended finite elements, condensed to their face points, and their size.

use super::basis::Elasticity;
use super::border::{Border, face_jumps};
use super::columns::ColumnStore;
use super::condense::{Condensed, System};
use super::cuts::Cuts;
use super::error::XfemError;
use super::field::Inside;
use super::interface::{Interface, Station};
use super::settings::{EnrichmentRadius, XfemSettings};
use super::sif::{SifContext, SifFunctional, domain_of, short_part};
use super::space::Space;
use crate::body::{BodyTimes, CrackedBody, thin_flaps};
use crate::bulk::{Boundary, BulkRail};
use crate::crack::CrackNetwork;
use crate::field::RailEnds;
use crate::interruption::Interruption;
use crate::linear::{LinearError, spd_inverse_unless};
use crate::math::Vec2;
use crate::mesh::QuadMesh;
use crate::stopwatch::Stopwatch;
use std::sync::Arc;

/// The rail on `background` with `network` of cracks.
pub fn cracked_body(
    background: &Arc<BulkRail>,
    network: &CrackNetwork,
    settings: XfemSettings,
) -> Result<CrackedBody, XfemError> {
    cracked_body_with(background, network, settings, &mut ColumnStore::default(), Interruption::NEVER)
}

/// [`cracked_body`] with reuse of results for other cracks on the same background that stops on an
/// `interruption`.
pub fn cracked_body_with(
    background: &Arc<BulkRail>,
    network: &CrackNetwork,
    settings: XfemSettings,
    columns: &mut ColumnStore,
    interruption: Interruption<'_>,
) -> Result<CrackedBody, XfemError> {
    let (body, inside) = reduced(background, network, settings, columns, interruption)?;
    Ok(CrackedBody { fields: Some(Arc::new(inside)), ..body })
}

/// [`cracked_body`], and the data from which its fields follow.
pub(super) fn reduced(
    background: &Arc<BulkRail>,
    network: &CrackNetwork,
    settings: XfemSettings,
    columns: &mut ColumnStore,
    interruption: Interruption<'_>,
) -> Result<(CrackedBody, Inside), XfemError> {
    let mut times = BodyTimes::default();
    let mut clock = Stopwatch::start();
    let mut lap = || clock.lap();
    let mesh = background.mesh();
    let Discretisation { cuts, sizes, space, interface } = Discretisation::new(mesh, network, &settings)?;
    interruption.check()?;
    times.enrichment_s = lap();
    let elasticity = Elasticity::new(*background.steel());
    let border = Border::new(&cuts, &space, &elasticity, interruption)?;
    times.border_s = lap();
    let context =
        SifContext { mesh, cuts: &cuts, space: &space, interface: &interface, elasticity: &elasticity };
    // At 2° the error of K is 0.6 %.
    let mut remarks = thin_flaps(network, 2, "smaller elements (element_size_mm)");
    let mut functionals: Vec<SifFunctional> = Vec::new();
    for (tip, &size) in sizes.iter().enumerate() {
        interruption.check()?;
        let (domain, remark) = domain_of(mesh, &cuts, tip, size, &settings);
        functionals.extend(context.functionals(tip, domain));
        remarks.extend(remark.into_iter().chain(short_part(&cuts, tip, size)));
    }
    times.sif_s = lap();
    let (rail, duality) = (Arc::clone(background), interface.duality());
    let system = System {
        rail: background,
        space: &space,
        border: &border,
        jumps: &face_jumps(background, &cuts, &space, &interface),
        functionals: &functionals,
        duality: &duality,
    };
    let Condensed { compliance, sif_influence, elimination } = system.condensed(columns, interruption)?;
    let stiffness = spd_inverse_unless(interruption, &compliance).map_err(|reason| {
        match (reason, settings.interface_spacing) {
            (LinearError::NotPositiveDefinite { .. }, Some(spacing)) => {
                XfemError::FacePoints { spacing, reason }
            }
            (LinearError::NotPositiveDefinite { .. }, None) => XfemError::TooCoarse { reason },
            _ => reason.into(),
        }
    })?;
    times.condensation_s = lap();
    let matrices = [compliance, stiffness, sif_influence];
    let ends = (background.boundary() != Boundary::HalfPlane)
        .then(|| -> Arc<dyn RailEnds> { Arc::<BulkRail>::clone(background) });
    let body = CrackedBody {
        dofs: background.order() + space.unknowns(),
        ends,
        times,
        remarks,
        ..CrackedBody::new(interface.faces.clone(), network.tips(), matrices)
    };
    let inside = Inside { rail, cuts, space, interface, duality, elimination };
    Ok((body, inside))
}

/// The cracked mesh without its stiffness.
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

/// Relative difference between the length of a crack and that of its pieces in elements that is
/// accepted as round-off.
const COVERAGE: f64 = 1e-8;

/// Size (mm) of the elements at a point: the longest side of the element that contains it.
fn element_size(mesh: &QuadMesh, at: Vec2) -> f64 {
    let size = mesh.element(mesh.locate(at).unwrap_or(0)).size();
    size.x.max(size.y)
}

/// Entries of the factor over n log2 n: nested dissection of a plane grid, measured from 20k to 60k
/// unknowns.
const FACTOR_ENTRIES: f64 = 6.0;

/// Estimated number of entries of the factor of a mesh with this number of unknowns.
pub(super) fn factor_entries(unknowns: usize) -> usize {
    (FACTOR_ENTRIES * unknowns as f64 * (unknowns as f64).log2()) as usize
}

/// Size of the system of a cracked rail in finite elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct XfemSize {
    /// Displacement unknowns of the mesh.
    pub mesh_unknowns: usize,
    /// Unknowns of the enrichments.
    pub enriched_unknowns: usize,
    /// Points of the crack faces.
    pub face_points: usize,
    /// Estimated number of entries of the factor.
    pub factor_entries: usize,
}
