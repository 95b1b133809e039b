//! `[solver]`: the engine of the cracked rail and the solver of the contact conditions.

use crate::schema::{Choice, Sections, Word, choice, read_by_word, section};
use railcrack::growth::NetworkContact;

section! {
    SOLVER "solver", Defaulted, "Engine and solvers.";
    ENGINE: Engine = choice("engine", "Engine used for the cracked rail.");
    SOLVER_CONTACT: ContactSolver = choice("contact", "Solver of the contact conditions on the crack faces.");
    NETWORK: NetworkContact = choice("network", "How the contact conditions of many cracks are solved.");
}

read_by_word!(Engine, ContactSolver, NetworkContact);

/// Whether the engine of `sections` is that in space.
pub(crate) fn is_in_space(sections: &Sections) -> bool {
    let engine = sections.one(&SOLVER).and_then(|solver| solver.get(ENGINE));
    engine.is_some_and(Engine::is_in_space)
}

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

/// Domain of the cracks of an engine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EngineDomain {
    /// A plane rail of whatever boundary, on a mesh.
    Rail,
    /// The half-plane.
    HalfPlane,
    /// The half-space.
    HalfSpace,
}

/// Names and domain of an engine, for texts and checks; its computation is a file of
/// `case/engines`.
struct EngineDeclaration {
    word: Word,
    method: &'static str,
    domain: EngineDomain,
}

impl Engine {
    const fn declaration(self) -> EngineDeclaration {
        match self {
            Self::Xfem => EngineDeclaration {
                word: Word::now("xfem", "extended finite elements"),
                method: "extended finite elements",
                domain: EngineDomain::Rail,
            },
            Self::Dislocation => EngineDeclaration {
                word: Word::now("dislocation", "distributed dislocations in a half-plane"),
                method: "distributed dislocations",
                domain: EngineDomain::HalfPlane,
            },
            Self::Space => EngineDeclaration {
                word: Word::now("space", "planar cracks with elliptical fronts in the half-space"),
                method: "boundary elements in space",
                domain: EngineDomain::HalfSpace,
            },
        }
    }

    /// The method of computation, in words.
    #[must_use]
    pub fn method(self) -> &'static str {
        self.declaration().method
    }

    /// The domain of the cracks.
    #[must_use]
    pub fn domain(self) -> EngineDomain {
        self.declaration().domain
    }

    /// Whether its cracks are in space.
    #[must_use]
    pub fn is_in_space(self) -> bool {
        self.domain() == EngineDomain::HalfSpace
    }

    /// The engines of cracks in the plane.
    pub fn in_the_plane() -> impl Iterator<Item = Self> {
        Self::WORDS.iter().map(|(engine, _)| *engine).filter(|engine| !engine.is_in_space())
    }
}

impl Choice for Engine {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Xfem, Self::Xfem.declaration().word),
        (Self::Dislocation, Self::Dislocation.declaration().word),
        (Self::Space, Self::Space.declaration().word),
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
