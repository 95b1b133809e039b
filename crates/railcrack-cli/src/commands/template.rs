//! Templates of case files.

use clap::ValueEnum;

/// A kind of case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// A head check under a braking wheel
    HeadCheck,
    /// Two cracks inclined away from each other
    Squat,
    /// Head checks in a curve under driven wheels
    Curve,
    /// Nine parallel cracks
    Network,
    /// A head check in a rail with a measured residual stress
    ResidualStress,
    /// A study of the friction of wheel and crack faces
    Study,
}

impl Template {
    /// The text of the file.
    pub fn text(self) -> &'static str {
        match self {
            Self::HeadCheck => include_str!("../../templates/head-check.toml"),
            Self::Squat => include_str!("../../templates/squat.toml"),
            Self::Curve => include_str!("../../templates/curve.toml"),
            Self::Network => include_str!("../../templates/network.toml"),
            Self::ResidualStress => include_str!("../../templates/residual-stress.toml"),
            Self::Study => include_str!("../../templates/study.toml"),
        }
    }

    /// Names and texts of the files that it names, written next to it.
    pub fn beside(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::ResidualStress => {
                &[("residual-stress.csv", include_str!("../../templates/residual-stress.csv"))]
            }
            _ => &[],
        }
    }
}
