//! Finite-element engine with one mesh and one factor for all growth steps of a run.

use super::body::{Discretisation, XfemSize, cracked_body_with, factor_entries};
use super::columns::ColumnStore;
use super::error::XfemError;
use super::refined_region::{MeshSettings, RefinedRegion, ResolvedLayers};
use super::settings::XfemSettings;
use crate::body::{BodyEngine, BodyError, CrackedBody};
use crate::bulk::{BottomSupport, Boundary, BulkRail, SideSupport};
use crate::crack::CrackNetwork;
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use crate::math::RailBox;
use crate::stopwatch::Stopwatch;
use std::sync::Arc;

/// Boundary of the rail in the finite-element engine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RailEnd {
    /// A half-plane. The mesh is held at such a distance that the boundary has no influence.
    HalfPlane {
        /// Abscissa of the centre of the mesh, mm.
        centre: f64,
    },
    /// A block on supports.
    Block {
        /// Its extent.
        extent: RailBox,
        /// Support of the bottom.
        bottom: BottomSupport,
        /// Support of the sides.
        sides: SideSupport,
    },
}

/// Half-width and depth of the mesh of a half-plane, over the extent of the refined region. A
/// boundary held at this distance changes K by about (l/R)² × 8: less than 1e-3.
const FAR: f64 = 150.0;
/// Largest number of enlargements of the refined region.
const ENLARGEMENTS: usize = 20;

impl RailEnd {
    /// Extent of the mesh that is fine in the region `refined`.
    pub fn extent(&self, refined: &RefinedRegion) -> RailBox {
        match self {
            Self::HalfPlane { centre } => {
                let size = refined.upper - refined.lower;
                let reach = FAR * size.x.max(size.y);
                RailBox { width: 2.0 * reach, depth: reach, centre: *centre }
            }
            Self::Block { extent, .. } => *extent,
        }
    }

    fn boundary(&self) -> Boundary {
        match *self {
            Self::HalfPlane { .. } => Boundary::HalfPlane,
            Self::Block { bottom, sides, .. } => Boundary::Block { bottom, sides },
        }
    }
}

/// Extended finite elements for all growth steps of a run. The mesh is refined around the initial
/// cracks with room for some growth, and its stiffness is factored once. When a crack leaves the
/// refined region, the mesh is made for the next of a fixed sequence of regions: first those given,
/// then enlargements of the last one. The mesh of a step thus depends on its cracks and on the
/// initial ones alone, not on the number of steps. A clone shares the factor and the columns solved
/// with it.
#[derive(Debug, Clone)]
pub struct XfemEngine {
    steel: IsotropicElastic,
    end: RailEnd,
    settings: XfemSettings,
    /// The refined region of the initial cracks.
    initial: RefinedRegion,
    /// The regions for cracks that have left it, in the order of their sizes.
    further: Vec<RefinedRegion>,
    /// The refined region of the present mesh.
    refined: RefinedRegion,
    background: Option<Arc<BulkRail>>,
    columns: ColumnStore,
}

impl XfemEngine {
    /// The engine for the cracks `initial` at the beginning of the run, with elements of the same
    /// size at all cracks.
    pub fn new(
        initial: &CrackNetwork,
        steel: IsotropicElastic,
        mesh: MeshSettings,
        end: RailEnd,
        settings: XfemSettings,
    ) -> Self {
        Self::with_region(RefinedRegion::new(initial, mesh), steel, end, settings)
    }

    /// The engine with a mesh that is fine in the region `refined`.
    pub fn with_region(
        refined: RefinedRegion,
        steel: IsotropicElastic,
        end: RailEnd,
        settings: XfemSettings,
    ) -> Self {
        Self {
            steel,
            end,
            settings,
            initial: refined.clone(),
            further: Vec::new(),
            refined,
            background: None,
            columns: ColumnStore::default(),
        }
    }

    /// This engine with a mesh that is fine in the first of the larger regions `further` that holds
    /// the cracks, once they have left the region of this engine.
    pub fn followed_by(self, further: Vec<RefinedRegion>) -> Self {
        Self { further, ..self }
    }

    /// This engine with a mesh that also resolves `layers`; to be called before the mesh is made.
    pub fn resolving(self, layers: ResolvedLayers) -> Self {
        let refined = self.initial.resolving(layers);
        let further = self.further.into_iter().map(|region| region.resolving(layers)).collect();
        Self { initial: refined.clone(), further, refined, ..self }
    }

    /// A text of all data on which mesh and factor of the rail depend for the initial cracks. Two
    /// rails with the same text have the same bits.
    pub fn rail_in_words(&self) -> String {
        let (extent, boundary) = (self.end.extent(&self.initial), self.end.boundary());
        // The shortest decimals that read back to the same bits.
        format!("{:?} {extent:?} {boundary:?} {:?}", self.steel, self.initial)
    }

    /// Takes over mesh, factor and columns of `other`, if this engine has none yet and would make
    /// identical ones.
    pub fn take_over(&mut self, other: &Self) {
        if self.background.is_some()
            || other.refined != self.initial
            || self.rail_in_words() != other.rail_in_words()
        {
            return;
        }
        self.background = other.background.clone();
        self.columns = other.columns.clone();
    }

    /// Displacement unknowns of the mesh for the largest of the given regions, computed without
    /// making it; infinite on overflow.
    pub fn mesh_unknowns(&self) -> f64 {
        let largest = self.largest();
        largest.mesh_unknowns(self.end.extent(largest))
    }

    /// A number that [`XfemEngine::mesh_unknowns`] does not exceed, which takes no integration.
    pub fn most_mesh_unknowns(&self) -> f64 {
        let largest = self.largest();
        largest.most_mesh_unknowns(self.end.extent(largest))
    }

    /// The largest of the given regions.
    fn largest(&self) -> &RefinedRegion {
        self.further.last().unwrap_or(&self.initial)
    }

    /// Size of the system of `network`, without factoring it.
    pub fn size(&self, network: &CrackNetwork) -> Result<XfemSize, XfemError> {
        self.size_within(&self.region_for(network).0, network)
    }

    /// [`XfemEngine::size`] with the mesh for the largest of the given regions.
    pub fn largest_size(&self, network: &CrackNetwork) -> Result<XfemSize, XfemError> {
        self.size_within(self.largest(), network)
    }

    fn size_within(&self, refined: &RefinedRegion, network: &CrackNetwork) -> Result<XfemSize, XfemError> {
        let mesh = refined.mesh(self.end.extent(refined))?;
        // All but a few of the unknowns on the boundary are free.
        let mesh_unknowns = 2 * mesh.node_count();
        let Discretisation { space, interface, .. } = Discretisation::new(&mesh, network, &self.settings)?;
        Ok(XfemSize {
            mesh_unknowns,
            enriched_unknowns: space.unknowns(),
            face_points: interface.faces.points.len(),
            factor_entries: factor_entries(mesh_unknowns),
        })
    }

    /// The refined region that holds `network`, and its predecessor in the sequence of
    /// enlargements, if any.
    fn region_for(&self, network: &CrackNetwork) -> (RefinedRegion, Option<RefinedRegion>) {
        let mut given = std::iter::once(&self.initial).chain(&self.further);
        let mut refined = given.find(|region| region.holds(network)).unwrap_or(self.largest()).clone();
        let mut before = None;
        for _ in 0..ENLARGEMENTS {
            if refined.holds(network) {
                break;
            }
            let larger = refined.enlarged();
            before = Some(std::mem::replace(&mut refined, larger));
        }
        (refined, before)
    }

    /// The mesh for `network`, made and factored unless it exists already.
    pub fn background(&mut self, network: &CrackNetwork) -> Result<&Arc<BulkRail>, XfemError> {
        self.background_unless(Interruption::NEVER, network)
    }

    /// [`XfemEngine::background`] that stops on an `interruption`.
    pub(crate) fn background_unless(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<&Arc<BulkRail>, XfemError> {
        let (refined, _) = self.region_for(network);
        if refined != self.refined || self.background.is_none() {
            // The memory of the previous mesh is freed first.
            self.background = None;
            self.columns = ColumnStore::default();
            let mesh = refined.mesh(self.end.extent(&refined))?;
            let rail = BulkRail::new_unless(interruption, mesh, &self.steel, self.end.boundary())?;
            self.background = Some(Arc::new(rail));
            self.refined = refined;
        }
        Ok(self.background.as_ref().expect("made above"))
    }

    fn cracked(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, XfemError> {
        let started = Stopwatch::start();
        self.background_unless(interruption, network)?;
        let mesh_s = started.seconds();
        let background = self.background.as_ref().expect("made above");
        let mut body =
            cracked_body_with(background, network, self.settings, &mut self.columns, interruption)?;
        body.times.mesh_s = mesh_s;
        self.remark_on_region(network, &mut body);
        Ok(body)
    }

    /// Adds a remark if the refined region was enlarged. It depends on the cracks alone, so that a
    /// run resumed at this step gives the same remark.
    fn remark_on_region(&self, network: &CrackNetwork, body: &mut CrackedBody) {
        let (refined, before) = self.region_for(network);
        if before.is_some_and(|before| before.was_left_by(network)) {
            body.remarks.push(format!(
                "a crack left the refined region of the mesh, which now extends from x = {:.1} to {:.1} mm and to a depth of {:.1} mm",
                refined.lower.x, refined.upper.x, -refined.lower.y
            ));
        }
    }
}

impl BodyEngine for XfemEngine {
    fn body_unless(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, BodyError> {
        self.cracked(interruption, network).map_err(|reason| BodyError { reason: Box::new(reason) })
    }

    fn forget(&mut self) {
        self.columns.clear();
    }

    fn resolution(&self, network: &CrackNetwork) -> f64 {
        self.region_for(network).0.resolution(network)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::Crack;

    #[test]
    fn forgetting_frees_memory_and_changes_no_body() {
        let network = CrackNetwork::from(Crack::surface_breaking(0.0, 4.0, 0.5).unwrap());
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let (end, settings) = (RailEnd::HalfPlane { centre: 0.0 }, XfemSettings::default());
        let mesh = MeshSettings { element_size: 0.5, expected_growth: 1.0 };
        let mut engine = XfemEngine::new(&network, steel, mesh, end, settings);
        let bits = |body: &CrackedBody| body.compliance.entries().to_vec();
        let before = engine.body(&network).unwrap();
        assert!(engine.columns.is_kept());
        engine.forget();
        assert!(!engine.columns.is_kept());
        assert_eq!(bits(&engine.body(&network).unwrap()), bits(&before));
    }

    /// A crack that has outgrown the first mesh gets that of the next region, whatever the engine
    /// did before; one that has become short again gets the first one.
    #[test]
    fn a_mesh_depends_on_the_cracks_alone() {
        let of = |length: f64| CrackNetwork::from(Crack::surface_breaking(0.0, length, 0.5).unwrap());
        let (short, long) = (of(4.0), of(7.0));
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let end = RailEnd::HalfPlane { centre: 0.0 };
        let region = |growth: f64| RefinedRegion::with_sizes(&short, &[0.5], growth);
        let fresh = || {
            XfemEngine::with_region(region(1.5), steel, end, XfemSettings::default())
                .followed_by(vec![region(3.0)])
        };
        let bits = |body: &CrackedBody| (body.dofs, body.sif_influence.entries().to_vec());
        let [first, then] = [&short, &long].map(|network| bits(&fresh().body(network).unwrap()));
        assert!(first.0 < then.0, "a larger mesh: {} {}", first.0, then.0);
        let mut engine = fresh();
        for (network, want) in [(&short, &first), (&long, &then), (&short, &first)] {
            let body = engine.body(network).unwrap();
            assert_eq!(&bits(&body), want);
            assert!(body.remarks.is_empty(), "{:?}", body.remarks);
        }
        let beyond = engine.body(&of(13.0)).unwrap();
        assert!(beyond.dofs > then.0, "{}", beyond.dofs);
    }
}
