//! Folders within a folder of results: they are entered and made without following links, so that
//! nothing outside is written or removed. The folder itself is the user's choice, by whatever path.

use crate::error::OutputError;
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

/// Whether a folder that is not there is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Missing {
    Make,
    Leave,
}

/// The folder `inner` of `folder`: plain names, separated by `/`. It is made where it is not there.
///
/// Errors: one of them is a link, or no folder; the system refuses.
pub fn inner_folder(folder: &Path, inner: &str) -> std::result::Result<PathBuf, OutputError> {
    let path = folder.join(inner);
    enter(folder, inner, Missing::Make).map_err(OutputError::io("create", &path))?;
    Ok(path)
}

/// The folder `inner` of `folder`, whether or not it is there.
///
/// Errors: one of its names is a link, or no folder; the system refuses.
pub(crate) fn own_folder(folder: &Path, inner: &str) -> std::result::Result<PathBuf, OutputError> {
    let path = folder.join(inner);
    match enter(folder, inner, Missing::Leave) {
        Err(reason) if reason.kind() != ErrorKind::NotFound => Err(OutputError::io("use", &path)(reason)),
        _ => Ok(path),
    }
}

/// The refusal of a link.
pub(super) fn is_a_link() -> Error {
    Error::other("it is a link, and nothing is written through a link within a folder of results")
}

#[cfg(unix)]
fn enter(folder: &Path, inner: &str, missing: Missing) -> Result<()> {
    use rustix::fs::{AtFlags, CWD, FileType, Mode, OFlags, mkdirat, openat, statat};
    use rustix::io::Errno;
    let directory = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
    let mut at = openat(CWD, folder, directory, Mode::empty())?;
    for name in inner.split('/') {
        if missing == Missing::Make {
            match mkdirat(&at, name, Mode::from_raw_mode(0o777)) {
                Ok(()) | Err(Errno::EXIST) => {}
                Err(reason) => return Err(reason.into()),
            }
        }
        at = match openat(&at, name, directory | OFlags::NOFOLLOW, Mode::empty()) {
            Ok(next) => next,
            Err(reason) => {
                let there = statat(&at, name, AtFlags::SYMLINK_NOFOLLOW);
                let is_link = there.is_ok_and(|there| FileType::from_raw_mode(there.st_mode).is_symlink());
                return Err(if is_link { is_a_link() } else { reason.into() });
            }
        };
    }
    Ok(())
}

#[cfg(not(unix))]
fn enter(folder: &Path, inner: &str, missing: Missing) -> Result<()> {
    let mut path = folder.to_path_buf();
    for name in inner.split('/') {
        path.push(name);
        match path.symlink_metadata() {
            Ok(there) if there.is_symlink() => return Err(is_a_link()),
            Ok(there) if there.is_dir() => {}
            Ok(_) => return Err(ErrorKind::NotADirectory.into()),
            Err(_) if missing == Missing::Make => std::fs::create_dir(&path)?,
            Err(reason) => return Err(reason),
        }
    }
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::symlink;

    #[test]
    fn no_link_leads_out() {
        let place = std::env::temp_dir().join(format!("railcrack-inner-{}", std::process::id()));
        let _ = fs::remove_dir_all(&place);
        let (folder, outside) = (place.join("folder"), place.join("outside"));
        fs::create_dir_all(&folder).unwrap();
        fs::create_dir_all(outside.join("001")).unwrap();
        assert_eq!(inner_folder(&folder, "runs/001").unwrap(), folder.join("runs/001"));
        assert!(folder.join("runs/001").is_dir());
        own_folder(&folder, "runs/001").unwrap();
        own_folder(&folder, "runs/002/plots").unwrap();
        assert!(!folder.join("runs/002").exists());
        symlink(&outside, folder.join("linked")).unwrap();
        symlink(outside.join("001"), folder.join("runs/003")).unwrap();
        symlink(outside.join("nowhere"), folder.join("runs/004")).unwrap();
        fs::write(folder.join("file"), "").unwrap();
        for inner in ["linked", "linked/001", "linked/002", "runs/003", "runs/004"] {
            for entered in [inner_folder(&folder, inner), own_folder(&folder, inner)] {
                assert!(entered.unwrap_err().to_string().contains("it is a link"), "{inner}");
            }
        }
        assert!(inner_folder(&folder, "file").is_err() && own_folder(&folder, "file/a").is_err());
        assert!(!outside.join("002").exists() && !outside.join("nowhere").exists());
        // The folder itself may be reached by a link.
        symlink(&folder, place.join("by-link")).unwrap();
        inner_folder(&place.join("by-link"), "runs/001").unwrap();
        fs::remove_dir_all(&place).unwrap();
    }
}
