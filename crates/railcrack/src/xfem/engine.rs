//! Finite-element engine with one mesh and one factor for all growth steps of a run.

use super::body::{Discretisation, cracked_body_with};
use super::columns::ColumnStore;
use super::error::XfemError;
use super::refined_region::{MeshSettings, RefinedRegion, ResolvedLayers};
use super::row::MeshedRow;
use super::settings::XfemSettings;
use super::size::{XfemSize, factor_entries};
use crate::body::{BodyEngine, BodyError, CrackedBody};
use crate::bulk::{BottomSupport, Boundary, BulkRail, SideSupport};
use crate::crack::CrackNetwork;
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use crate::math::RailBox;
use std::sync::Arc;
use std::time::Instant;

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
    fn extent(&self, refined: &RefinedRegion) -> RailBox {
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
/// cracks with room for their growth, and its stiffness is factored once. When a crack leaves the
/// refined region, that region is enlarged in fixed steps. A clone shares the factor and the
/// columns solved with it.
#[derive(Debug, Clone)]
pub struct XfemEngine {
    steel: IsotropicElastic,
    end: RailEnd,
    settings: XfemSettings,
    /// The refined region of the initial cracks.
    initial: RefinedRegion,
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
            refined,
            background: None,
            columns: ColumnStore::default(),
        }
    }

    /// This engine with a mesh that also resolves `layers`; to be called before the mesh is made.
    pub fn resolving(self, layers: ResolvedLayers) -> Self {
        let refined = self.initial.resolving(layers);
        Self { initial: refined.clone(), refined, ..self }
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

    /// Displacement unknowns of the mesh for the initial cracks, computed without making it;
    /// infinite on overflow.
    pub fn mesh_unknowns(&self) -> f64 {
        self.initial.mesh_unknowns(self.end.extent(&self.initial))
    }

    /// A number that [`XfemEngine::mesh_unknowns`] does not exceed, which takes no integration.
    pub fn most_mesh_unknowns(&self) -> f64 {
        self.initial.most_mesh_unknowns(self.end.extent(&self.initial))
    }

    /// Size of the system of `network`, without factoring it.
    pub fn size(&self, network: &CrackNetwork) -> Result<XfemSize, XfemError> {
        let mesh = self.refined.mesh(self.end.extent(&self.refined))?;
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

    /// Size of the systems of `network` with A in blocks.
    pub fn size_by_groups(&self, network: &CrackNetwork) -> Result<XfemSize, XfemError> {
        let (refined, _) = self.region_for(network);
        self.row(network, &refined).size()
    }

    fn row<'a>(&'a self, network: &'a CrackNetwork, refined: &'a RefinedRegion) -> MeshedRow<'a> {
        let (extent, settings) = (self.end.extent(refined), self.settings);
        MeshedRow { network, steel: &self.steel, refined, extent, settings }
    }

    /// The refined region that holds `network`, and its predecessor in the sequence of
    /// enlargements, if any.
    fn region_for(&self, network: &CrackNetwork) -> (RefinedRegion, Option<RefinedRegion>) {
        let mut refined = self.initial.clone();
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
            let mesh = refined.mesh(self.end.extent(&refined))?;
            let rail = BulkRail::new_unless(interruption, mesh, &self.steel, self.end.boundary())?;
            self.background = Some(Arc::new(rail));
            self.columns = ColumnStore::default();
            self.refined = refined;
        }
        Ok(self.background.as_ref().expect("made above"))
    }

    fn cracked(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, XfemError> {
        let started = Instant::now();
        self.background_unless(interruption, network)?;
        let mesh_s = started.elapsed().as_secs_f64();
        let background = self.background.as_ref().expect("made above");
        let mut body =
            cracked_body_with(background, network, self.settings, &mut self.columns, interruption)?;
        body.times.mesh_s = mesh_s;
        self.remark_on_region(network, &mut body);
        Ok(body)
    }

    fn by_groups(
        &self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, XfemError> {
        let (refined, _) = self.region_for(network);
        let mut body = self.row(network, &refined).body(interruption)?;
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

    /// None for a block, in which the forces between distant cracks differ from those of the
    /// half-plane.
    fn body_by_groups(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<Option<CrackedBody>, BodyError> {
        if self.end.boundary() != Boundary::HalfPlane {
            return Ok(None);
        }
        self.by_groups(interruption, network)
            .map(Some)
            .map_err(|reason| BodyError { reason: Box::new(reason) })
    }

    fn forget(&mut self) {
        self.columns.clear();
    }

    fn resolution(&self, network: &CrackNetwork) -> f64 {
        self.refined.resolution(network)
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
}
