//! Why tips stop and runs end.

use crate::crack::CrackEnd;
use crate::math::Vec2;
use serde::{Deserialize, Serialize};

/// A tip that broke out, and where its ligament ends on the running surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BreakOut {
    /// The tip: it stays where it was.
    pub tip: CrackEnd,
    /// The point of the surface, mm.
    pub surface: Vec2,
}

/// Why a tip stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum TipStop {
    /// ΔK_eq at or below the threshold, or a rate below the arrest rate.
    Arrest,
    /// The ligament to the running surface is spent: a spall.
    BreakOut,
    /// It joins a crack, with the increment of this step where the step is made; without an
    /// increment, it came so close that no junction can be made.
    Coalescence,
    /// The next increment would leave the rail.
    LeavesRail,
}

impl TipStop {
    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrest => "arrest",
            Self::BreakOut => "break-out",
            Self::Coalescence => "meets-crack",
            Self::LeavesRail => "leaves-rail",
        }
    }
}

/// Why the run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum RunStop {
    /// All increments done.
    StepsDone,
    /// The number of load cycles asked for.
    Cycles,
    /// A crack reached the critical length.
    CriticalLength,
    /// A piece of the rail is wholly detached.
    Detached,
    /// No tip grows; the reason of the last one that stopped.
    NoTipGrows(TipStop),
}

impl RunStop {
    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::StepsDone => "steps-done",
            Self::Cycles => "cycles",
            Self::CriticalLength => "critical-length",
            Self::Detached => "detached",
            Self::NoTipGrows(stop) => stop.name(),
        }
    }
}
