//! The load: wheel–rail contact, the wheel's passage, bending on the track, temperature.

mod carter;
mod contact;
mod contact_kind;
mod ellipse;
mod hertz;
mod passage;
mod rail_section;
mod table;
mod temperature;
mod track;
mod unfelt_gap;

pub use carter::CarterContact;
pub use contact::{Contact, WheelLoad};
pub use contact_kind::ContactKind;
pub use ellipse::{HertzEllipse, WheelOnRail};
pub use hertz::HertzianContact;
pub use passage::{Passage, Travel};
pub use rail_section::{NamedSection, RailSection, SECTIONS};
pub use table::{ContactRow, ContactTableError, TableContact};
pub use temperature::Temperature;
pub use track::{Axle, Bending, Track};
pub use unfelt_gap::{SurfacePart, unfelt_gap};
