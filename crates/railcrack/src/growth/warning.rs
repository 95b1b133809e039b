//! Warnings of a step.

use serde::{Deserialize, Serialize};

/// Kinds of warnings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WarningKind {
    /// How the engine represents the cracks.
    Engine,
    /// The other contact solver took over.
    ContactFallback,
    /// Two kinks are nearly as good.
    NearTie,
    /// The history of K still changes from passage to passage.
    Passages,
    /// The residual stress, and how it was balanced.
    ResidualStress,
    /// Whether the model still describes the case.
    Validity,
}

impl WarningKind {
    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Engine => "engine",
            Self::ContactFallback => "contact-fallback",
            Self::NearTie => "near-tie",
            Self::Passages => "passages",
            Self::ResidualStress => "residual-stress",
            Self::Validity => "validity",
        }
    }
}

/// Something the reader of the results must know.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// The step at which it arose.
    pub step: usize,
    /// Its kind.
    pub kind: WarningKind,
    /// One sentence with its numbers.
    pub text: String,
}

impl Warning {
    /// The warning with the wheel (from 0) of a mix that it is about.
    #[must_use]
    pub(crate) fn under_wheel(self, wheel: usize) -> Self {
        Self { text: format!("wheel {}, {}", wheel + 1, self.text), ..self }
    }
}
