//! What the verification tests measured, for the page docs/verification.md.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

/// A measured error with what is allowed and why.
#[derive(Debug, Clone)]
struct Measurement {
    error: f64,
    allowed: f64,
    reason: String,
}

/// By test, the measurement that comes closest to its tolerance.
static WORST: Mutex<BTreeMap<String, Measurement>> = Mutex::new(BTreeMap::new());

/// Notes a measured `error` of the running test, what is `allowed` and the `reason` for it. Of each test, the page gets the one that comes
/// closest to its tolerance.
pub fn measured(error: f64, allowed: f64, reason: &str) {
    let thread = std::thread::current();
    let Some(test) = thread.name().filter(|name| name.contains("::")) else { return };
    let mut worst = WORST.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let share = |m: &Measurement| if m.allowed > 0.0 { m.error / m.allowed } else { m.error };
    let new = Measurement { error, allowed, reason: reason.into() };
    if worst.get(test).is_some_and(|old| share(old) >= share(&new)) {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("verification");
    let row = format!("{test}\t{:.1e}\t{:.0e}\t{}\n", new.error, new.allowed, new.reason);
    // A folder that cannot be written costs the page a row, not the test its verdict.
    let _ = std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(folder.join(format!("{}.row", test.replace("::", "."))), row));
    worst.insert(test.to_owned(), new);
}
