//! How the contact conditions of many cracks are solved.

use crate::words::{Choice, Word};

/// How the contact conditions of many cracks are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NetworkContact {
    /// All cracks together, event by event.
    #[default]
    Whole,
    /// Each crack with its neighbours, event by event, under the forces of all others: in sweeps
    /// until they agree. For dry cracks and an engine that makes bodies by groups; others are
    /// followed as a whole.
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
                "each crack with its neighbours, in sweeps until they agree within network_tolerance; for dozens of cracks in a half-plane, with the newton solver, without fluid and without fields",
            ),
        ),
    ];
}
