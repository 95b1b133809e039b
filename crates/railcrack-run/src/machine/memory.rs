//! Memory of this process.

/// Address space (bytes) of a computation beside its threads, and of each of them: the buffers of
/// matrix products have twice the size of the last cache, and little of them is touched.
const ADDRESSES: u64 = 1_000_000_000;
const ADDRESSES_OF_THREAD: u64 = 600_000_000;

/// Why the address space of this process (`ulimit -v`) does not suffice for `threads` threads; none
/// where it does.
#[must_use]
pub fn short_of_address_space(threads: usize) -> Option<String> {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, getrlimit};
        let limit = getrlimit(Resource::As).current?;
        let needed = ADDRESSES + ADDRESSES_OF_THREAD * threads as u64;
        let gigabytes = |bytes: u64| 1e-9 * bytes as f64;
        (limit < needed).then(|| {
            format!(
                "the address space is limited to {:.1} GB (ulimit -v), and {threads} of them need {:.1} GB, of which little is used: raise the limit, or give fewer threads (RAYON_NUM_THREADS)",
                gigabytes(limit),
                gigabytes(needed)
            )
        })
    }
    #[cfg(not(unix))]
    {
        let _ = (threads, ADDRESSES, ADDRESSES_OF_THREAD);
        None
    }
}

/// Peak memory of this process so far, MB (10⁶ bytes): `VmHWM` on Linux, none elsewhere.
pub(crate) fn peak_memory_mb() -> Option<f64> {
    peak_of(&std::fs::read_to_string("/proc/self/status").ok()?)
}

fn peak_of(status: &str) -> Option<f64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_is_read_from_the_line_of_the_kernel() {
        assert_eq!(peak_of("Name:\tx\nVmHWM:\t   12500 kB\nVmRSS:\t 1 kB\n"), Some(12.8));
        assert_eq!(peak_of("Name:\tx\n"), None);
    }
}
