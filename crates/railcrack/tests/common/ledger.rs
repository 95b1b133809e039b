//! Measurements of the verification tests, for the page docs/dev/verification.md.

use super::requirements::REQUIREMENTS;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

/// By requirement, the largest ratio of measured to allowed error (1: the tolerance is used up).
static WORST: Mutex<BTreeMap<usize, f64>> = Mutex::new(BTreeMap::new());

/// Records an `error` measured by the running test, the `allowed` one and the `reason` for it,
/// under its requirement of that `quantity`. Of many measurements the one closest to its tolerance
/// is kept.
pub fn measured_as(quantity: &str, error: f64, allowed: f64, reason: &str) {
    let share = if allowed > 0.0 { error / allowed } else { f64::from(error != 0.0) };
    note(quantity, share, [&format!("{error:.1e}"), &format!("{allowed:e}"), reason]);
}

/// [`measured_as`] for the only requirement of the running test.
pub fn measured(error: f64, allowed: f64, reason: &str) {
    measured_as("", error, allowed, reason);
}

/// Records an observed `order` of convergence and the `least` that is required.
pub fn measured_order(order: f64, least: f64, reason: &str) {
    note("", least / order, [&format!("order {order:.2}"), &format!("at least {least:.1}"), reason]);
}

fn note(quantity: &str, share: f64, fields: [&str; 3]) {
    let thread = std::thread::current();
    let Some(test) = thread.name() else { return };
    let Some(index) = REQUIREMENTS.iter().position(|r| r.test == test && r.quantity == quantity) else {
        return;
    };
    let mut worst = WORST.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    if worst.get(&index).is_some_and(|&old| old >= share) {
        return;
    }
    worst.insert(index, share);
    let row = format!("{}\t{test}\t{}\n", REQUIREMENTS[index].says, fields.join("\t"));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("verification");
    // A folder that cannot be written costs the page a row, not the test its verdict.
    let _ = std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(folder.join(format!("{index:03}.row")), row));
}
