//! Ctrl-C and the like: once to stop after saving, twice to stop at once.

use crate::exit::Exit;
use signal_hook::consts::{SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(unix)]
use std::time::Duration;

/// SIGHUP is not among them: a run under `nohup` must outlive its terminal.
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// Whether the user wants the run to stop.
#[derive(Debug, Clone, Default)]
pub struct Interruption {
    asked: Arc<AtomicBool>,
    /// The computation has stopped, and what was computed is being written.
    stopped: Arc<AtomicBool>,
}

impl Interruption {
    /// Listens to SIGINT and SIGTERM from now on. The second signal ends the program at once.
    ///
    /// Errors: the system refuses to install the handlers.
    pub fn listen() -> std::io::Result<Self> {
        let interruption = Self::default();
        interruption.install()?;
        Ok(interruption)
    }

    /// The computation has stopped where it was asked to: what follows is the end of the program,
    /// and it is waited for.
    pub fn acknowledge(&self) {
        if self.asked() {
            self.stopped.store(true, Ordering::Relaxed);
        }
    }

    #[cfg(unix)]
    fn install(&self) -> std::io::Result<()> {
        use std::time::Instant;
        // `timeout` and some shells send a signal to the program and again to its group: that is
        // one wish, not two.
        const ONE_WISH: Duration = Duration::from_millis(500);
        let mut signals = signal_hook::iterator::Signals::new(SIGNALS)?;
        let (asked, stopped) = (Arc::clone(&self.asked), Arc::clone(&self.stopped));
        std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
            let mut first: Option<Instant> = None;
            for _ in signals.forever() {
                asked.store(true, Ordering::Relaxed);
                if first.is_none() {
                    let stopped = Arc::clone(&stopped);
                    std::thread::spawn(move || end_soon(&stopped));
                }
                if first.get_or_insert_with(Instant::now).elapsed() > ONE_WISH {
                    std::process::exit(i32::from(Exit::Interrupted.code()));
                }
            }
        })?;
        Ok(())
    }

    #[cfg(not(unix))]
    fn install(&self) -> std::io::Result<()> {
        raise_on_signal(&self.asked)
    }

    /// Whether a signal has come.
    pub fn asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}

/// A flag that SIGINT and SIGTERM raise from now on, for commands that end in this way as a rule.
/// The second signal ends the program at once.
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
        // In this order: the first signal finds the flag down and raises it, the second finds
        // it up.
        flag::register_conditional_shutdown(signal, i32::from(Exit::Interrupted.code()), Arc::clone(asked))?;
        flag::register(signal, Arc::clone(asked))?;
    }
    Ok(())
}

/// How long a computation has to stop by itself, and the writing of what it has then.
#[cfg(unix)]
const TO_STOP: Duration = Duration::from_millis(700);
#[cfg(unix)]
const TO_WRITE: Duration = Duration::from_secs(10);

/// Ends the program where it does not end by itself: an assembly, a factorisation or a report does
/// not look for signals. A run may be killed at any moment: its finished steps are on the disk, and
/// `--resume` goes on behind them.
#[cfg(unix)]
fn end_soon(stopped: &AtomicBool) {
    use std::io::Write;
    std::thread::sleep(TO_STOP);
    if stopped.load(Ordering::Relaxed) {
        std::thread::sleep(TO_WRITE);
    }
    // Nobody is left to tell when standard error itself is gone.
    let _ = writeln!(
        std::io::stderr(),
        "interrupted; the same command with --resume goes on behind the last finished step"
    );
    std::process::exit(i32::from(Exit::Interrupted.code()));
}
