//! The load: wheel–rail contact, the wheel's passage, bending on the track, temperature.

mod carter;
mod contact;
mod contact_kind;
mod hertz;
mod passage;
mod table;
mod track;

pub use carter::CarterContact;
pub use contact::{Contact, SurfacePart, WheelLoad, uncoupled_gap};
pub use contact_kind::ContactKind;
pub use hertz::{HertzEllipse, HertzianContact, WheelOnRail};
pub use passage::{Passage, Travel};
pub use table::{ContactRow, ContactTableError, TableContact};
pub use track::{Axle, Bending, NamedSection, RailSection, SECTIONS, Temperature, Track};
