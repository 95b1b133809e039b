//! Files on the disk: their names and locks, checksums of what was written, and files that are
//! replaced whole.

pub(crate) mod changes;
mod checksum;
#[cfg(test)]
pub(crate) mod faults;
pub mod files;
mod inner;
mod json;
mod lock;
mod replace;
mod stored_name;
pub(crate) mod words;

pub use checksum::sha256;
pub(crate) use checksum::{
    CHECKSUM_BYTES, Checksum, Seal, Sealing, checksums, is_signed, read_sums, sign, sums_text, write_sums,
};
pub use files::VERSION;
pub use inner::inner_folder;
pub(crate) use inner::own_folder;
pub(crate) use json::{json_text, read_json, read_json_if_there, write_json};
pub use lock::{FolderLock, LOCK_FILE};
pub use replace::{Durability, read_if_there, replace_file};
pub(crate) use replace::{PARTIAL, partial_of, put_in_place, read_file, remove, replace_shared, stage_file};
pub(crate) use stored_name::{check_inputs, check_stored_name};
