//! A warning of a step, and the test of a kink in a rail whose toughness is not given.

use serde::{Deserialize, Serialize};

/// Kinds of warnings; each has a section in the user's book ([`WarningKind::page`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WarningKind {
    /// Representation of the cracks by the engine.
    Engine,
    /// Fallback to the other contact solver.
    ContactFallback,
    /// Two kinks of nearly equal rate.
    NearTie,
    /// A kink that extends under one load and arrests.
    PopIn,
    /// A history of K that still changes from passage to passage.
    Passages,
    /// Residual stress and its balancing.
    ResidualStress,
    /// Limits of validity of the model.
    Validity,
    /// Accuracy of K where contact is followed in groups of cracks.
    Groups,
    /// Numbers of the case that are probably not those that are meant.
    Input,
}

impl WarningKind {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Engine,
        Self::ContactFallback,
        Self::NearTie,
        Self::PopIn,
        Self::Passages,
        Self::ResidualStress,
        Self::Validity,
        Self::Groups,
        Self::Input,
    ];

    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Engine => "engine",
            Self::ContactFallback => "contact-fallback",
            Self::NearTie => "near-tie",
            Self::PopIn => "pop-in",
            Self::Passages => "passages",
            Self::ResidualStress => "residual-stress",
            Self::Validity => "validity",
            Self::Groups => "groups",
            Self::Input => "input",
        }
    }

    /// The section of the user's book that says what warnings of this kind mean and what to do.
    #[must_use]
    pub fn page(self) -> String {
        format!("docs/warnings.md#{}", self.name())
    }
}

/// A warning to the reader of the results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// The step at which it arose.
    pub step: usize,
    /// Its kind.
    pub kind: WarningKind,
    /// One sentence with its numbers.
    pub text: String,
    /// How grave it is among the warnings that say the same with other numbers, where these can be
    /// ordered: the larger, the graver.
    pub severity: Option<f64>,
}

impl Warning {
    /// The same warning, marked with the wheel (from 0) of a mix that it concerns.
    #[must_use]
    pub(crate) fn under_wheel(self, wheel: usize) -> Self {
        Self { text: format!("wheel {}, {}", wheel + 1, self.text), ..self }
    }
}

/// A real kink at the tip with the largest k1, in a rail whose toughness is not given: whether it
/// would arrest in a steel of the usual toughness. It has no effect on the run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PopInTest {
    /// The crack, from 0.
    pub crack: usize,
    /// The tip, from 0.
    pub tip: usize,
    /// The largest k1 of a virtual kink, MPa √mm.
    pub k1: f64,
    /// Its direction, radians.
    pub angle: f64,
    /// Length of the real kink, mm.
    pub length: f64,
    /// The largest k1 at its end, MPa √mm; `None` where the kinked crack cannot be computed.
    pub k1_after: Option<f64>,
}

impl PopInTest {
    /// Length of the kink by default, mm.
    pub const LENGTH: f64 = 2.0;

    /// Whether k1 at the end of the kink falls below `toughness` (MPa √mm).
    #[must_use]
    pub fn arrests(&self, toughness: f64) -> bool {
        self.k1_after.is_some_and(|k1| k1 < toughness)
    }
}
