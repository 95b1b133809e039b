//! `[solver]`: the engine of the cracked rail and the solver of the contact conditions.

use crate::schema::{Choice, Word, choice, read_by_word, section};
use railcrack::plane::NetworkContact;

section! {
    SOLVER "solver", Defaulted, "Solvers.";
    ENGINE: Engine = choice("engine", "Engine that computes the cracked rail.");
    SOLVER_CONTACT: ContactSolver = choice("contact", "Solver of the contact conditions on the crack faces.");
    NETWORK: NetworkContact = choice("network", "How the contact of many cracks is followed.");
}

read_by_word!(Engine, ContactSolver, NetworkContact);

/// Engines that compute the cracked rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// Extended finite elements.
    Xfem,
    /// Distributed dislocations in a half-plane.
    Dislocation,
    /// Planar cracks with curved fronts in the half-space.
    Space,
}

impl Choice for Engine {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Xfem, Word::now("xfem", "extended finite elements")),
        (Self::Dislocation, Word::now("dislocation", "distributed dislocations in a half-plane")),
        (Self::Space, Word::now("space", "planar cracks with elliptical fronts in the half-space")),
    ];
}

/// Solvers of the contact conditions on the crack faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactSolver {
    /// Active sets, exact complementarity.
    Newton,
    /// The LATIN method.
    Latin,
}

impl Choice for ContactSolver {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Newton, Word::now("newton", "active sets, exact complementarity")),
        (Self::Latin, Word::now("latin", "the LATIN method of the paper")),
    ];
}
