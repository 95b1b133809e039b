//! Foreign processes, of which none is started. Where the kernels of linear algebra cannot read the
//! sizes of caches from the system, they ask the program `lscpu` that the variable PATH finds, and
//! end the program where it cannot be started: then there is no program to be found.

#[cfg(any(target_os = "linux", test))]
use std::{io::Result, path::Path};

/// Folder of the processors.
#[cfg(target_os = "linux")]
const PROCESSORS: &str = "/sys/devices/system/cpu";
/// A path that leads to no program.
#[cfg(target_os = "linux")]
const NOWHERE: &str = "/nonexistent";

/// Starts this program again without a path to other programs where these would be asked. Returns
/// where that is not needed, or not possible.
#[cfg(target_os = "linux")]
pub fn start_alone() {
    use std::os::unix::process::CommandExt;
    let is_alone = std::env::var_os("PATH").is_some_and(|path| path == NOWHERE);
    if is_alone || caches(Path::new(PROCESSORS)).is_ok() {
        return;
    }
    if let Ok(program) = std::env::current_exe() {
        // It returns only where the system refuses.
        let _ =
            std::process::Command::new(program).args(std::env::args_os().skip(1)).env("PATH", NOWHERE).exec();
    }
}

/// Elsewhere no program is asked.
#[cfg(not(target_os = "linux"))]
pub fn start_alone() {}

/// Reads what the kernels read of the caches in the folder `processors`.
///
/// Errors: a file of them cannot be read.
#[cfg(any(target_os = "linux", test))]
fn caches(processors: &Path) -> Result<()> {
    for processor in std::fs::read_dir(processors)? {
        let cache = processor?.path().join("cache");
        if !cache.is_dir() {
            continue;
        }
        for index in std::fs::read_dir(cache)? {
            let index = index?.path();
            let is_index = index.file_name().is_some_and(|name| name.to_string_lossy().starts_with("index"));
            if index.is_dir() && is_index {
                for file in std::fs::read_dir(index)? {
                    std::fs::read_to_string(file?.path())?;
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn caches_that_cannot_be_read_are_found() {
        let place = std::env::temp_dir().join(format!("railcrack-caches-{}", std::process::id()));
        let _ = fs::remove_dir_all(&place);
        assert!(caches(&place).is_err());
        let index = place.join("cpu0/cache/index0");
        fs::create_dir_all(&index).unwrap();
        fs::write(index.join("size"), "32K\n").unwrap();
        assert!(caches(&place).is_ok());
        fs::create_dir(index.join("power")).unwrap();
        assert!(caches(&place).is_err());
        fs::remove_dir_all(&place).unwrap();
    }
}
