//! Treatment of the contact of many cracks.

use crate::words::{Choice, Word};

/// Treatment of the contact of many cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NetworkContact {
    /// All cracks are followed together, event by event.
    #[default]
    Whole,
    /// Each crack is followed with its neighbours, event by event, under the forces of all others,
    /// in sweeps until they agree. For engines that build bodies by groups; with finite elements,
    /// cracks are followed together.
    Groups,
}

impl Choice for NetworkContact {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Whole,
            Word::now("whole", "all cracks together; the cost grows with the square of their number"),
        ),
        (
            Self::Groups,
            Word::now(
                "groups",
                "each crack with its neighbours, in sweeps until they agree within network_tolerance; for dozens of cracks, with the dislocation or the space engine and the newton solver, without trapped fluid and without fields",
            ),
        ),
    ];
}
