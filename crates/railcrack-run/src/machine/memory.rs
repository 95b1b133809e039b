//! Memory of this process.

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
