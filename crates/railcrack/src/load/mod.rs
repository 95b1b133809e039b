//! The wheel: Hertzian contact and its passage over the rail.

mod hertz;
mod passage;

pub use hertz::HertzianContact;
pub use passage::Passage;
