//! `[solver]`: the engine of the cracked rail and the solver of the contact conditions.

use crate::schema::{Choice, Sections, Word, choice, read_by_word, section};
use railcrack::growth::NetworkContact;

section! {
    SOLVER "solver", Defaulted, "Engine and solvers.";
    ENGINE: Engine = choice("engine", "Engine of the cracked rail.");
    SOLVER_CONTACT: ContactSolver = choice("contact", "Solver of the contact conditions on the crack faces.");
    NETWORK: NetworkContact = choice("network",
        "Solution of the contact conditions of many cracks. By default groups from 24 cracks on where possible, with dislocations in a half-plane, otherwise whole.")
        .optional();
}

read_by_word!(Engine, ContactSolver, NetworkContact);

/// The engine of `sections`; none where its key has an error.
pub(crate) fn engine_of(sections: &Sections) -> Option<Engine> {
    sections.one(&SOLVER)?.get(ENGINE)
}

/// Engines that compute the cracked rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// Cracks in the plane.
    Plane(PlaneEngine),
    /// Planar cracks with curved fronts in the half-space.
    Space,
}

/// Engines of cracks in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneEngine {
    /// Extended finite elements, on a mesh of the rail, whatever its boundary.
    Xfem,
    /// Distributed dislocations in a half-plane.
    Dislocation,
}

impl Engine {
    /// The method of computation, in words.
    #[must_use]
    pub fn method(self) -> &'static str {
        match self {
            Self::Plane(PlaneEngine::Xfem) => "extended finite elements",
            Self::Plane(PlaneEngine::Dislocation) => "distributed dislocations",
            Self::Space => "boundary elements in space",
        }
    }

    /// Whether its cracks are in space.
    #[must_use]
    pub fn is_in_space(self) -> bool {
        self == Self::Space
    }
}

impl Choice for Engine {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Plane(PlaneEngine::Xfem), Word::now("xfem", "extended finite elements")),
        (
            Self::Plane(PlaneEngine::Dislocation),
            Word::now("dislocation", "distributed dislocations in a half-plane"),
        ),
        (Self::Space, Word::now("space", "cracks with curved fronts in a half-space")),
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

impl ContactSolver {
    /// Its method, as a phrase of a sentence.
    #[must_use]
    pub fn method(self) -> &'static str {
        match self {
            Self::Newton => "Newton's method",
            Self::Latin => "the LATIN method",
        }
    }
}

impl Choice for ContactSolver {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Newton, Word::now("newton", "active sets, exact complementarity")),
        (Self::Latin, Word::now("latin", "the LATIN method of the paper")),
    ];
}
