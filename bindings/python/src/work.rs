//! Long work beside the Python interpreter: without its lock, with Ctrl-C, and without a panic that
//! crosses into Python.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use pyo3::prelude::*;

/// Text of an error, as the command prints it.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Marks work that Ctrl-C ended.
struct Stopped;

/// How often Ctrl-C is looked for.
const PAUSE: Duration = Duration::from_millis(100);

/// A `nearwall.Error` with this text.
pub fn error(py: Python<'_>, text: &str) -> PyErr {
    let class = py.import("nearwall.library").and_then(|module| module.getattr("Error"));
    match class.and_then(|class| class.call1((py.None(), text))) {
        Ok(value) => PyErr::from_value(value),
        Err(error) => error,
    }
}

/// Runs `work` on a thread of its own. It must call its argument often: after Ctrl-C that call does not return.
///
/// # Errors
/// `nearwall.Error` with the text of the failure; `KeyboardInterrupt`.
pub fn run<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&(dyn Fn() + Sync)) -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let stopped = AtomicBool::new(false);
    let tick = || {
        if stopped.load(Ordering::Relaxed) {
            // Unwinds the threads of the work without the message of a panic.
            resume_unwind(Box::new(Stopped));
        }
    };
    let (done, interrupt) = py.detach(|| {
        let (sender, receiver) = channel::<()>();
        std::thread::scope(|scope| {
            let worker = scope.spawn(|| {
                let _done_when_dropped = sender;
                work(&tick).map_err(|failure| failure.to_string())
            });
            let mut interrupt = None;
            while receiver.recv_timeout(PAUSE) == Err(RecvTimeoutError::Timeout) {
                if interrupt.is_none() {
                    interrupt = Python::attach(|py| py.check_signals()).err();
                    stopped.store(interrupt.is_some(), Ordering::Relaxed);
                }
            }
            (worker.join(), interrupt)
        })
    });
    if let Some(interrupt) = interrupt {
        return Err(interrupt);
    }
    match done {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(text)) => Err(error(py, &text)),
        Err(_) => {
            Err(error(py, "internal error in nearwall (its text is on standard error); please report it"))
        }
    }
}
