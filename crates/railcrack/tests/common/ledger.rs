//! What the verification tests measured, for the page docs/verification.md.

use super::requirements::REQUIREMENTS;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

/// By requirement, how close the measurements came to what is allowed (1: all of it).
static WORST: Mutex<BTreeMap<usize, f64>> = Mutex::new(BTreeMap::new());

/// Notes an `error` that the running test measured, what is `allowed` and the `reason` for it, as
/// its requirement of that `quantity`. Of many measurements the one that comes closest to what is
/// allowed stays.
pub fn measured_as(quantity: &str, error: f64, allowed: f64, reason: &str) {
    let share = if allowed > 0.0 { error / allowed } else { f64::from(error != 0.0) };
    note(quantity, share, [&format!("{error:.1e}"), &format!("{allowed:e}"), reason]);
}

/// [`measured_as`] for the only requirement of the running test.
pub fn measured(error: f64, allowed: f64, reason: &str) {
    measured_as("", error, allowed, reason);
}

/// Notes an observed `order` of convergence and the `least` that is required.
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
