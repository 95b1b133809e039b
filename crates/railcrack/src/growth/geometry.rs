//! The cracks of a run, in the plane or in space.

use super::{BreakOut, DeferredGrowth, FrontShape, TipStop};
use crate::crack::{Crack, CrackNetwork, CrackTip, Junction};
use serde::{Deserialize, Serialize};

/// The cracks between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Geometry {
    /// Polylines in the plane of the rail.
    Plane(PlaneGeometry),
    /// Planar cracks with curved fronts.
    Space(SpaceGeometry),
}

/// Cracks in the plane between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlaneGeometry {
    /// The cracks.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other.
    pub junctions: Vec<Junction>,
    /// Tips that have broken out.
    pub break_outs: Vec<BreakOut>,
    /// `stopped[crack][tip]`: why a tip no longer grows; the tips of a crack are its ends below the
    /// surface, joined ones counted.
    pub stopped: Vec<Vec<Option<TipStop>>>,
    /// `deferred[crack][tip]`: growth that is not in the cracks yet.
    pub deferred: Vec<Vec<DeferredGrowth>>,
}

/// Cracks in space between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpaceGeometry {
    /// Their shapes.
    pub shapes: Vec<FrontShape>,
    /// The line of each down the dip through its middle, projected on the plane of the rail.
    pub sections: Vec<Crack>,
    /// Why each no longer grows.
    pub stopped: Vec<Option<TipStop>>,
}

impl PlaneGeometry {
    /// `network`, none of whose tips has stopped.
    #[must_use]
    pub fn initial(network: &CrackNetwork) -> Self {
        let tips = || network.cracks().iter().map(|crack| crack.tips().len());
        Self {
            cracks: network.cracks().to_vec(),
            junctions: network.junctions().to_vec(),
            break_outs: Vec::new(),
            stopped: tips().map(|tips| vec![None; tips]).collect(),
            deferred: tips().map(|tips| vec![DeferredGrowth::default(); tips]).collect(),
        }
    }

    /// Growth at the tips of crack `crack` (from 0) that is not in it yet, mm.
    #[must_use]
    pub fn deferred_at(&self, crack: usize) -> f64 {
        self.deferred[crack].iter().map(|deferred| deferred.length).sum()
    }
}

impl Geometry {
    /// The cracks as polylines, of cracks in space their sections.
    #[must_use]
    pub fn cracks(&self) -> &[Crack] {
        match self {
            Self::Plane(plane) => &plane.cracks,
            Self::Space(space) => &space.sections,
        }
    }

    /// Where cracks have joined each other; nowhere in space.
    #[must_use]
    pub fn junctions(&self) -> &[Junction] {
        match self {
            Self::Plane(plane) => &plane.junctions,
            Self::Space(_) => &[],
        }
    }

    /// Cracks in space; none in the plane.
    #[must_use]
    pub fn space(&self) -> Option<&SpaceGeometry> {
        match self {
            Self::Plane(_) => None,
            Self::Space(space) => Some(space),
        }
    }

    /// Whether the tip, or the crack of a front point, stopped in an earlier step.
    #[must_use]
    pub fn has_stopped(&self, tip: CrackTip) -> bool {
        let stop = match self {
            Self::Plane(plane) => plane.stopped.get(tip.crack).and_then(|tips| tips.get(tip.tip)).copied(),
            Self::Space(space) => space.stopped.get(tip.crack).copied(),
        };
        stop.flatten().is_some()
    }

    /// The length (mm) of every crack: in the plane along the polyline with the deferred growth of
    /// its tips, in space the half axis down the dip.
    #[must_use]
    pub fn lengths(&self) -> Vec<f64> {
        match self {
            Self::Plane(plane) => {
                let length = |(i, crack): (usize, &Crack)| crack.length() + plane.deferred_at(i);
                plane.cracks.iter().enumerate().map(length).collect()
            }
            Self::Space(space) => space.shapes.iter().map(|shape| shape.length).collect(),
        }
    }
}
