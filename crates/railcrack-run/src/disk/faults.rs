//! Faults of the disk, made up for tests: the n-th change to the files of a folder fails.

use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Fault at a change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Half of a write arrives, then the disk is full; the changes after it succeed.
    Full,
    /// The change is refused; those after it succeed.
    Refused,
    /// The process is killed before the change: nothing after it arrives.
    Killed,
    /// The process is killed when half of a write has arrived.
    KilledWithin,
}

pub(crate) const FAULTS: [Fault; 4] = [Fault::Full, Fault::Refused, Fault::Killed, Fault::KilledWithin];

/// Pending faults, by folder, for tests that run in parallel.
static WAITING: Mutex<Vec<Plan>> = Mutex::new(Vec::new());

struct Plan {
    folder: PathBuf,
    fault: Fault,
    /// The change that fails, from 0.
    at: usize,
    changes: usize,
}

/// Does `work` while the change `at` to files below `folder` meets `fault`; how many changes there
/// were, with those that did not arrive.
pub(crate) fn during(folder: &Path, fault: Fault, at: usize, work: impl FnOnce()) -> usize {
    let plans = || WAITING.lock().unwrap_or_else(PoisonError::into_inner);
    plans().push(Plan { folder: folder.to_path_buf(), fault, at, changes: 0 });
    work();
    let mut plans = plans();
    let own = plans.iter().position(|plan| plan.folder == folder).unwrap();
    plans.swap_remove(own).changes
}

/// How much of `content` arrives at `path`, and the answer of the system.
pub(super) fn at(path: &Path, content: &[u8]) -> (usize, Result<()>) {
    let whole = (content.len(), Ok(()));
    let mut plans = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(plan) = plans.iter_mut().find(|plan| path.starts_with(&plan.folder)) else { return whole };
    let change = plan.changes;
    plan.changes += 1;
    let failed = |kind: ErrorKind| Err(Error::new(kind, "made up"));
    match plan.fault {
        _ if change < plan.at => whole,
        Fault::Full if change == plan.at => (content.len() / 2, failed(ErrorKind::StorageFull)),
        Fault::Refused if change == plan.at => (0, failed(ErrorKind::Other)),
        Fault::Full | Fault::Refused => whole,
        Fault::KilledWithin if change == plan.at => (content.len() / 2, failed(ErrorKind::Other)),
        Fault::Killed | Fault::KilledWithin => (0, failed(ErrorKind::Other)),
    }
}
