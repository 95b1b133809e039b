//! Ctrl-C and the like: once to stop after saving, twice to stop at once.

use crate::exit::Exit;
use signal_hook::consts::{SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// SIGHUP is not among them: a run under `nohup` must outlive its terminal.
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// Whether the user wants the run to stop.
#[derive(Debug, Clone, Default)]
pub struct Interruption {
    asked: Arc<AtomicBool>,
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

    #[cfg(unix)]
    fn install(&self) -> std::io::Result<()> {
        use std::time::{Duration, Instant};
        // `timeout` and some shells send a signal to the program and again to its group: that is one wish, not two.
        const ONE_WISH: Duration = Duration::from_millis(500);
        let mut signals = signal_hook::iterator::Signals::new(SIGNALS)?;
        let asked = Arc::clone(&self.asked);
        std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
            let mut first: Option<Instant> = None;
            for _ in signals.forever() {
                asked.store(true, Ordering::Relaxed);
                if first.get_or_insert_with(Instant::now).elapsed() > ONE_WISH {
                    std::process::exit(i32::from(Exit::Interrupted.code()));
                }
            }
        })?;
        Ok(())
    }

    #[cfg(not(unix))]
    fn install(&self) -> std::io::Result<()> {
        use signal_hook::flag;
        for signal in SIGNALS {
            // In this order: the first signal finds the flag down and raises it, the second finds it up.
            flag::register_conditional_shutdown(
                signal,
                i32::from(Exit::Interrupted.code()),
                Arc::clone(&self.asked),
            )?;
            flag::register(signal, Arc::clone(&self.asked))?;
        }
        Ok(())
    }

    /// Whether a signal has come.
    pub fn asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}
