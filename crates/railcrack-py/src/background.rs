//! Computations in background threads, while the interpreter handles signals and reports progress.

use crate::errors::bad_input;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use railcrack::growth::{Observer, StepRecord};
use railcrack_cli::{MOST_THREADS, thread_count};
use railcrack_run::simulation::{RunObserver, StudyObserver};
use railcrack_run::study::PlannedRun;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Progress event of a computation.
#[derive(Debug)]
pub enum Event {
    /// The run starts this growth step.
    Begins(usize),
    /// Finished fraction of the growth step.
    Fraction(f64),
    /// A growth step is finished: its number.
    Finished(usize),
    /// Text: a stage before the first step, or a finished run of a study.
    Said(String),
}

/// A computation seen from both sides.
#[derive(Debug)]
pub struct Watch {
    events: Sender<Event>,
    interrupted: AtomicBool,
    /// Hundredths of the current step reported so far.
    told: AtomicUsize,
    /// Exception raised by a user-defined function.
    failure: Mutex<Option<PyErr>>,
}

impl Watch {
    /// A watch, and the receiver of its events.
    pub fn new() -> (Arc<Self>, Receiver<Event>) {
        let (events, told) = channel();
        let watch = Self {
            events,
            interrupted: AtomicBool::new(false),
            told: AtomicUsize::new(0),
            failure: Mutex::new(None),
        };
        (Arc::new(watch), told)
    }

    /// Ends the computation because a user-defined function raised `error`.
    pub fn fail(&self, error: PyErr) {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        self.interrupted.store(true, Ordering::Relaxed);
    }

    /// Whether to stop.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    /// Sends an event; a receiver that no longer exists is ignored.
    fn tell(&self, event: Event) {
        let _ = self.events.send(event);
    }
}

impl RunObserver for Watch {
    fn begins(&self, first: usize) {
        self.tell(Event::Begins(first));
    }

    fn fraction(&self, fraction: f64) {
        let hundredths = (100.0 * fraction) as usize;
        if self.told.swap(hundredths, Ordering::Relaxed) != hundredths {
            self.tell(Event::Fraction(fraction));
        }
    }

    fn finished(&self, record: &StepRecord) {
        self.tell(Event::Finished(record.step));
    }

    fn stage(&self, text: &str) {
        self.tell(Event::Said(text.to_owned()));
    }

    fn note(&self, text: &str) {
        self.tell(Event::Said(text.to_owned()));
    }

    fn interrupted(&self) -> bool {
        self.is_interrupted()
    }
}

impl Observer for Watch {
    fn progress(&self, fraction: f64) {
        self.fraction(fraction);
    }

    fn interrupted(&self) -> bool {
        self.is_interrupted()
    }
}

/// A run of a study, observed only for interruption.
struct WatchedRun<'a>(&'a Watch);

impl RunObserver for WatchedRun<'_> {
    fn interrupted(&self) -> bool {
        self.0.is_interrupted()
    }
}

impl StudyObserver for Watch {
    fn of_run(&self, _: usize) -> Box<dyn RunObserver + '_> {
        Box::new(WatchedRun(self))
    }

    fn over(&self, _: &PlannedRun, text: &str) {
        self.tell(Event::Said(text.to_owned()));
    }

    fn interrupted(&self) -> bool {
        self.is_interrupted()
    }
}

/// Interval at which Python checks for signals while it waits for the next event.
const LISTEN: Duration = Duration::from_millis(50);

/// A finished computation.
pub struct Over<T> {
    /// Its result.
    pub result: T,
    /// The exception of a signal (Ctrl-C).
    pub signal: Option<PyErr>,
}

/// Errors: an invalid number of threads.
pub fn check_threads(py: Python<'_>, threads: Option<usize>) -> PyResult<()> {
    match threads {
        Some(count) if !(1..=MOST_THREADS).contains(&count) => {
            Err(bad_input(py, format!("threads = {count}: must be from 1 to {MOST_THREADS}, or None")))
        }
        _ => Ok(()),
    }
}

/// Executes `work` without holding the interpreter lock, on threads of its own: those that the
/// process had before it was forked are gone.
///
/// Errors: the system refuses threads.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = pool(py, None)?;
    Ok(py.detach(|| pool.install(work)))
}

/// A pool of `threads` threads, by default one per processor.
///
/// Errors: an invalid number in the environment; the system refuses threads.
fn pool(py: Python<'_>, threads: Option<usize>) -> PyResult<rayon::ThreadPool> {
    let count = thread_count(threads.and_then(NonZeroUsize::new)).map_err(|says| bad_input(py, says))?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool.map_err(|reason| PyRuntimeError::new_err(format!("cannot start threads: {reason}")))
}

/// Executes `work` on a pool of `threads` threads (none: one per processor) without holding the
/// interpreter lock; `tell(kind, value)` is called for every event that `told` receives.
///
/// Errors: an invalid number of threads; the system refuses them; `tell` or a user-defined function
/// raises an exception.
pub fn compute<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<usize>,
    (watch, told): (Arc<Watch>, Receiver<Event>),
    tell: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<Over<T>> {
    check_threads(py, threads)?;
    let pool = pool(py, threads)?;
    let (over, ends) = channel::<()>();
    let working = std::thread::Builder::new().name("railcrack".into()).spawn(move || {
        // Dropped at the end of the work, including a panic.
        let _over = over;
        pool.install(work)
    });
    let working =
        working.map_err(|reason| PyRuntimeError::new_err(format!("cannot start threads: {reason}")))?;
    let (mut told, mut ends, mut signal) = (told, ends, None);
    loop {
        let (events, is_over);
        (told, ends, events, is_over) = py.detach(move || wait(told, ends));
        if let Some(tell) = tell {
            for event in events {
                match tell_event(tell, event) {
                    // Python can raise it in any of its own code.
                    Err(error) if error.is_instance_of::<PyKeyboardInterrupt>(py) => {
                        watch.interrupted.store(true, Ordering::Relaxed);
                        signal.get_or_insert(error);
                    }
                    Err(error) => watch.fail(error),
                    Ok(()) => {}
                }
            }
        }
        if let Err(error) = py.check_signals() {
            watch.interrupted.store(true, Ordering::Relaxed);
            signal.get_or_insert(error);
        }
        if is_over {
            break;
        }
    }
    let result = py.detach(|| working.join()).map_err(|_| {
        PyRuntimeError::new_err("internal error in railcrack: a computation ended without a result")
    })?;
    match watch.failure.lock().unwrap_or_else(PoisonError::into_inner).take() {
        Some(error) => Err(error),
        None => Ok(Over { result, signal }),
    }
}

/// Waits for events, and returns them with whether the work is finished.
fn wait(told: Receiver<Event>, ends: Receiver<()>) -> (Receiver<Event>, Receiver<()>, Vec<Event>, bool) {
    let is_over = matches!(ends.recv_timeout(LISTEN), Err(RecvTimeoutError::Disconnected));
    let events = told.try_iter().collect();
    (told, ends, events, is_over)
}

fn tell_event(tell: &Bound<'_, PyAny>, event: Event) -> PyResult<()> {
    match event {
        Event::Begins(step) => tell.call1(("begins", step)),
        Event::Fraction(fraction) => tell.call1(("fraction", fraction)),
        Event::Finished(step) => tell.call1(("finished", step)),
        Event::Said(text) => tell.call1(("said", text)),
    }
    .map(drop)
}
