//! The cracks of a run, in the plane or in space.

use super::{BreakOut, DeferredGrowth, FrontShape, TipStop};
use crate::crack::{Crack, CrackNetwork, CrackTip, Junction};
use serde::{Deserialize, Serialize};

/// The cracks between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Geometry {
    /// Polylines in the plane of the rail.
    Plane(PlaneGeometry),
    /// Cracks with curved fronts.
    Space(SpaceGeometry),
}

/// Cracks in the plane between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlaneGeometry {
    /// The cracks.
    pub cracks: Vec<Crack>,
    /// Junctions between them.
    pub junctions: Vec<Junction>,
    /// Tips that have broken out at the surface.
    pub break_outs: Vec<BreakOut>,
    /// `stopped[crack][tip]`: why a tip no longer grows; the tips of a crack are its ends below the
    /// surface, including those that have joined another crack.
    pub stopped: Vec<Vec<Option<TipStop>>>,
    /// `deferred[crack][tip]`: growth that has not been added to the cracks yet.
    pub deferred: Vec<Vec<DeferredGrowth>>,
    /// `courses[crack][tip]`: how the path of a tip has turned.
    pub courses: Vec<Vec<TipCourse>>,
}

/// How the path of a tip turned in the previous step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct TipCourse {
    /// dθ/ds at its start, rad/mm; of the limit path, of the whole step.
    pub curvature: f64,
    /// Decay of the curvature along the path by its own turn, 1/mm.
    pub decay: f64,
    /// Its growth, mm; 0 where nothing is known.
    pub span: f64,
    /// The turns that theory gives up to its start less all turns made up to its end, radians.
    pub balance: f64,
    /// The best kink that the tip expects at its end, radians, if its path went on smoothly.
    pub expected: Option<f64>,
}

/// Cracks in space between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpaceGeometry {
    /// Their shapes.
    pub shapes: Vec<FrontShape>,
    /// The line down the dip through the middle of each crack, projected onto the plane of the
    /// rail.
    pub sections: Vec<Crack>,
    /// Why each crack no longer grows, if it has stopped.
    pub stopped: Vec<Option<TipStop>>,
}

impl PlaneGeometry {
    /// The geometry of `network` at the start of a run, with all tips free to grow.
    #[must_use]
    pub fn initial(network: &CrackNetwork) -> Self {
        let tips = || network.cracks().iter().map(|crack| crack.tips().len());
        Self {
            cracks: network.cracks().to_vec(),
            junctions: network.junctions().to_vec(),
            break_outs: Vec::new(),
            stopped: tips().map(|tips| vec![None; tips]).collect(),
            deferred: tips().map(|tips| vec![DeferredGrowth::default(); tips]).collect(),
            courses: tips().map(|tips| vec![TipCourse::default(); tips]).collect(),
        }
    }

    /// Growth at the tips of crack `crack` (from 0) that has not been added to it yet, mm.
    pub(crate) fn deferred_at(&self, crack: usize) -> f64 {
        self.deferred[crack].iter().map(|deferred| deferred.length).sum()
    }
}

impl Geometry {
    /// The cracks as polylines; cracks in space are given by their sections.
    #[must_use]
    pub fn cracks(&self) -> &[Crack] {
        match self {
            Self::Plane(plane) => &plane.cracks,
            Self::Space(space) => &space.sections,
        }
    }

    /// Junctions between cracks; in space there are none.
    #[must_use]
    pub fn junctions(&self) -> &[Junction] {
        match self {
            Self::Plane(plane) => &plane.junctions,
            Self::Space(_) => &[],
        }
    }

    /// The cracks in space; `None` for cracks in the plane.
    #[must_use]
    pub fn space(&self) -> Option<&SpaceGeometry> {
        match self {
            Self::Plane(_) => None,
            Self::Space(space) => Some(space),
        }
    }

    /// Whether the tip, or the crack to which a front point belongs, stopped in an earlier step.
    pub(crate) fn has_stopped(&self, tip: CrackTip) -> bool {
        let stop = match self {
            Self::Plane(plane) => plane.stopped.get(tip.crack).and_then(|tips| tips.get(tip.tip)).copied(),
            Self::Space(space) => space.stopped.get(tip.crack).copied(),
        };
        stop.flatten().is_some()
    }

    /// The length (mm) of every crack: in the plane the length of the polyline plus the deferred
    /// growth of its tips, in space [`FrontShape::path_length`].
    #[must_use]
    pub fn lengths(&self) -> Vec<f64> {
        match self {
            Self::Plane(plane) => {
                let length = |(i, crack): (usize, &Crack)| crack.length() + plane.deferred_at(i);
                plane.cracks.iter().enumerate().map(length).collect()
            }
            Self::Space(space) => space.shapes.iter().map(FrontShape::path_length).collect(),
        }
    }
}
