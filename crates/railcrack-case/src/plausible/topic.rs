//! A remark about a number of a case.

/// Subject of a remark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// The growth law: no life follows from it.
    GrowthLaw,
    /// The load of a wheel and that of its axle.
    Load,
    /// Another quantity.
    Quantity,
}

/// A number of a case that is probably not the one that is meant.
#[derive(Debug, Clone, PartialEq)]
pub struct Implausible {
    /// Its subject.
    pub topic: Topic,
    /// One sentence with the number, what is usual, and the guess of its unit.
    pub text: String,
}
