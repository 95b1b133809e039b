//! Budget: requirements of a run, and resources of the machine and the disk.

use crate::setup::RunSize;
use railcrack_case::{Case, Kept};
use std::fs;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Bytes of a row of `sif.csv` and of `faces.csv`, about: eight and eleven fields.
const SIF_ROW: u64 = 90;
const FACE_ROW: u64 = 130;

/// Bytes of a sample of `[scatter]` with its life, about.
const SAMPLE: u64 = 300;

/// Approximate needs of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Memory, bytes.
    pub memory: u64,
    /// Disk, bytes: its tables, if every step takes two passages and the cracks do not grow.
    pub disk: u64,
}

impl Needs {
    /// The needs of the run of `case`.
    pub fn of(case: &Case) -> Self {
        Self::with(case, &RunSize::estimate(case))
    }

    /// The needs of the run of `case`, whose size is `size`.
    pub fn with(case: &Case, size: &RunSize) -> Self {
        let count = |n: usize| u64::try_from(n).unwrap_or(u64::MAX);
        let positions = count(case.positions(case.first_wheel()).len());
        let steps = count(case.growth.expected_steps()).saturating_add(1);
        let rows = |each: u64, size: u64| each.saturating_mul(positions).saturating_mul(size);
        let kept = |kept: Kept| match kept {
            Kept::All => steps,
            Kept::Ends => steps.min(2),
            Kept::None => 0,
        };
        let sif = rows(count(size.tips), 2 * SIF_ROW).saturating_mul(kept(case.output.sif));
        let faces = rows(count(size.face_points), FACE_ROW).saturating_mul(kept(case.output.faces));
        let samples =
            case.scatter.as_ref().map_or(0, |scatter| count(scatter.samples)).saturating_mul(SAMPLE);
        let memory = count(size.memory_bytes).saturating_add(samples);
        Self { memory, disk: sif.saturating_add(faces) }
    }
}

/// The available amounts; none if the system does not provide them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Memory of the machine, or of the group of processes where that is limited to less, bytes.
    pub memory: Option<u64>,
    /// Free disk of the folder, bytes.
    pub disk: Option<u64>,
}

impl Budget {
    /// For a run in `folder`, which need not exist yet.
    pub fn of(folder: &Path) -> Self {
        Self {
            memory: [machine_memory(), group_memory()].into_iter().flatten().min(),
            disk: free_disk(folder),
        }
    }

    /// Whether `runs` runs that each need `needs`, `at_once` of them at the same time, fit.
    ///
    /// Errors: they do not.
    pub fn allows(&self, needs: Needs, runs: usize, at_once: usize) -> Result<(), OverBudget> {
        let times = |each: u64, count: usize| each.saturating_mul(u64::try_from(count).unwrap_or(u64::MAX));
        let memory = times(needs.memory, at_once);
        if let Some(has) = self.memory.filter(|has| memory > *has) {
            return Err(OverBudget::Memory { needs: mb(memory), has: mb(has), at_once });
        }
        let disk = times(needs.disk, runs);
        match self.disk.filter(|has| disk > *has) {
            Some(has) => Err(OverBudget::Disk { needs: mb(disk), has: mb(has) }),
            None => Ok(()),
        }
    }
}

/// A run that is too large for its machine.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum OverBudget {
    /// Memory.
    #[error(
        "this needs about {needs} MB of memory{}, but the machine allows {has} MB: use larger elements ([mesh] \
         element_size_mm, interface_elements), fewer cracks, positions or samples ([scatter] samples){}; --no-limits runs it anyway",
        if *at_once > 1 { format!(" ({at_once} runs at once)") } else { String::new() },
        if *at_once > 1 { ", or fewer --threads" } else { "" }
    )]
    Memory {
        /// MB.
        needs: u64,
        /// MB.
        has: u64,
        /// Number of simultaneous runs.
        at_once: usize,
    },
    /// Disk.
    #[error(
        "the tables need about {needs} MB, but the disk of the folder has {has} MB left: choose another folder with --out, or fewer positions, steps or face elements; --no-limits runs it anyway"
    )]
    Disk {
        /// MB.
        needs: u64,
        /// MB.
        has: u64,
    },
}

/// Whole MB, rounded up, as `railcrack check` shows them.
pub fn mb(bytes: u64) -> u64 {
    bytes.div_ceil(1 << 20)
}

fn machine_memory() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// The smallest limit of the control groups that the process is in.
fn group_memory() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let limits = groups.lines().filter_map(|line| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, group) = (parts.next()?, parts.next()?.trim_start_matches('/'));
        let (root, file) = match controllers {
            "" => ("/sys/fs/cgroup", "memory.max"),
            of if of.split(',').any(|one| one == "memory") => {
                ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
            }
            _ => return None,
        };
        let folder = Path::new(root).join(group);
        let within = folder.ancestors().take_while(|folder| folder.starts_with(root));
        within.filter_map(|folder| limit(&folder.join(file))).min()
    });
    limits.min()
}

/// The number in a file; none for the word `max`.
fn limit(file: &Path) -> Option<u64> {
    fs::read_to_string(file).ok()?.trim().parse().ok()
}

/// Free disk where `folder` is, or would be.
fn free_disk(folder: &Path) -> Option<u64> {
    let whole: PathBuf = std::env::current_dir().ok()?.join(folder);
    free_disk_of(whole.ancestors().find(|folder| folder.exists())?)
}

#[cfg(unix)]
fn free_disk_of(folder: &Path) -> Option<u64> {
    let disk = rustix::fs::statvfs(folder).ok()?;
    disk.f_bavail.checked_mul(disk.f_frsize)
}

#[cfg(not(unix))]
fn free_disk_of(_: &Path) -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const MB: u64 = 1 << 20;

    #[test]
    fn what_does_not_fit_is_refused() {
        let budget = Budget { memory: Some(100 * MB), disk: Some(50 * MB) };
        let needs = Needs { memory: 40 * MB, disk: 20 * MB };
        assert_eq!(budget.allows(needs, 2, 2), Ok(()));
        let refused = budget.allows(needs, 2, 3);
        assert_eq!(refused, Err(OverBudget::Memory { needs: 120, has: 100, at_once: 3 }));
        assert_eq!(budget.allows(needs, 3, 2), Err(OverBudget::Disk { needs: 60, has: 50 }));
        let unknown = Budget { memory: None, disk: None };
        assert_eq!(unknown.allows(Needs { memory: u64::MAX, disk: u64::MAX }, 9, 9), Ok(()));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn linux_tells() {
        let budget = Budget::of(Path::new("not/there/yet"));
        assert!(budget.memory.is_some_and(|memory| memory > MB), "{budget:?}");
        assert!(budget.disk.is_some(), "{budget:?}");
    }
}
