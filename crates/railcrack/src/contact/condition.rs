//! Conditions on components of the jump: held, or free of contact force.

/// The condition on a component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Condition {
    /// Held at this jump, mm.
    Held(f64),
    /// Free with q_i + c_i q_{i+1} = 0; the value is c_i.
    Free(f64),
}

/// Error of conditions that do not determine the jumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Degenerate;

impl Condition {
    /// Whether the same quantity is prescribed.
    pub(super) fn is_like(self, other: Self) -> bool {
        match (self, other) {
            (Self::Held(_), Self::Held(_)) => true,
            (Self::Free(one), Self::Free(other)) => one == other,
            _ => false,
        }
    }

    /// The jump at which it is held, mm.
    pub(super) fn held(self) -> Option<f64> {
        match self {
            Self::Held(at) => Some(at),
            Self::Free(_) => None,
        }
    }
}
