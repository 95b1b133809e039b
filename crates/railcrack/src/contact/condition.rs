//! Conditions on a component of the jump: held, or free of contact force.

/// The condition of a component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Condition {
    /// The jump, mm.
    Held(f64),
    /// No contact force q_i + c_i q_{i+1}; c_i.
    Free(f64),
}

/// Conditions under which the jumps are not determined.
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
