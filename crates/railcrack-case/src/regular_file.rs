//! Files that can be read to their end.

use std::fs::File;
use std::path::Path;

/// Opens the file `path` for reading if it is a regular one: a device may be endless, and a pipe
/// has no content until another program writes to it.
///
/// Errors: those of the system; anything else than a regular file.
pub fn open_regular(path: &Path) -> std::io::Result<File> {
    if cfg!(target_arch = "wasm32") {
        return Err(std::io::Error::other("a page computes without files, from the text of the case alone"));
    }
    let mut options = File::options();
    options.read(true);
    // Without this flag, opening a pipe waits for its writer.
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(
        &mut options,
        rustix::fs::OFlags::NONBLOCK.bits().cast_signed(),
    );
    let file = options.open(path)?;
    let kind = file.metadata()?.file_type();
    if kind.is_dir() {
        return Err(std::io::Error::other("it is a folder, not a file"));
    }
    if !kind.is_file() {
        return Err(std::io::Error::other("it is a pipe or a device, not a regular file"));
    }
    Ok(file)
}
