//! Interruption by signals: the first stops the computation after saving, the second at once.

use crate::exit::Exit;
use signal_hook::consts::{SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(unix)]
use std::time::Duration;

/// SIGHUP is not among them: a run under `nohup` must outlive its terminal.
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// The remains of an interrupted computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Remains {
    /// Finished steps, after which `--resume` continues.
    FinishedSteps,
    /// No results.
    Nothing,
}

impl Remains {
    /// The sentence for standard error.
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::FinishedSteps => {
                "interrupted; repeat the command with --resume to continue after the last finished step"
            }
            Self::Nothing => "interrupted: no results are written; repeat the command to start again",
        }
    }
}

/// Interruption requested by a signal.
#[derive(Debug, Clone, Default)]
pub struct Interruption {
    asked: Arc<AtomicBool>,
    /// The computation has stopped, and its results are being written.
    stopped: Arc<AtomicBool>,
}

impl Interruption {
    /// Installs handlers of SIGINT and SIGTERM for a computation of which `remains` is left behind.
    /// The second signal ends the program at once.
    ///
    /// Errors: the system refuses to install the handlers.
    pub fn listen(remains: Remains) -> std::io::Result<Self> {
        let interruption = Self::default();
        interruption.install(remains)?;
        Ok(interruption)
    }

    /// Records that the computation has stopped on request, so that the time limit for writing the
    /// results applies from now on.
    pub fn acknowledge(&self) {
        if self.asked() {
            self.stopped.store(true, Ordering::Relaxed);
        }
    }

    #[cfg(unix)]
    fn install(&self, remains: Remains) -> std::io::Result<()> {
        use std::time::Instant;
        // `timeout` and some shells send a signal to the program and again to its process group,
        // which must count as one request.
        const ONE_WISH: Duration = Duration::from_millis(500);
        let mut signals = signal_hook::iterator::Signals::new(SIGNALS)?;
        let (asked, stopped) = (Arc::clone(&self.asked), Arc::clone(&self.stopped));
        std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
            let mut first: Option<Instant> = None;
            for _ in signals.forever() {
                asked.store(true, Ordering::Relaxed);
                if first.is_none() {
                    let stopped = Arc::clone(&stopped);
                    std::thread::spawn(move || end_soon(&stopped, remains));
                }
                if first.get_or_insert_with(Instant::now).elapsed() > ONE_WISH {
                    std::process::exit(i32::from(Exit::Interrupted.code()));
                }
            }
        })?;
        Ok(())
    }

    #[cfg(not(unix))]
    fn install(&self, _: Remains) -> std::io::Result<()> {
        raise_on_signal(&self.asked)
    }

    /// Whether a signal has arrived.
    pub fn asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}

/// A flag set by SIGINT and SIGTERM, for commands that normally end with a signal. The second
/// signal ends the program at once.
///
/// Errors: the system refuses to install the handlers.
pub fn end_on_signal() -> std::io::Result<Arc<AtomicBool>> {
    let asked = Arc::default();
    raise_on_signal(&asked)?;
    Ok(asked)
}

fn raise_on_signal(asked: &Arc<AtomicBool>) -> std::io::Result<()> {
    use signal_hook::flag;
    for signal in SIGNALS {
        // The order matters: the first signal finds the flag unset and sets it, the second finds
        // it set.
        flag::register_conditional_shutdown(signal, i32::from(Exit::Interrupted.code()), Arc::clone(asked))?;
        flag::register(signal, Arc::clone(asked))?;
    }
    Ok(())
}

/// Time limits for the computation to stop and for its results to be written.
#[cfg(unix)]
const TO_STOP: Duration = Duration::from_millis(700);
#[cfg(unix)]
const TO_WRITE: Duration = Duration::from_secs(10);

/// Ends the program if it does not end by itself, because an assembly, a factorisation or a report
/// does not check for signals. A run may be killed at any moment: its finished steps are on disk,
/// and `--resume` continues after them; other results count as none until they are whole.
#[cfg(unix)]
fn end_soon(stopped: &AtomicBool, remains: Remains) {
    use std::io::Write;
    std::thread::sleep(TO_STOP);
    if stopped.load(Ordering::Relaxed) {
        std::thread::sleep(TO_WRITE);
    }
    // A failure to write to standard error cannot be reported.
    let _ = writeln!(std::io::stderr(), "{}", remains.sentence());
    std::process::exit(i32::from(Exit::Interrupted.code()));
}
