//! Long computations: off the interpreter's lock, on as many threads as asked for, stopped by Ctrl-C.

use crate::errors::{invalid, raised};
use gonio::cancel::{Cancel, run};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// How often Python is asked whether Ctrl-C was pressed.
const LOOK: Duration = Duration::from_millis(50);
/// Most threads that are accepted, as by the program.
const MOST_THREADS: usize = 1024;

/// Threads that a call computes with: its argument, else `GONIO_THREADS`, else what rayon takes
/// (`RAYON_NUM_THREADS`, or all cores).
#[pyfunction]
#[pyo3(signature = (threads=None))]
pub fn threads(threads: Option<usize>) -> PyResult<usize> {
    let accepted = "a whole number from 1 to 1024 is accepted";
    match threads {
        Some(count) if (1..=MOST_THREADS).contains(&count) => Ok(count),
        Some(count) => Err(invalid("threads", count, accepted)),
        None => match std::env::var("GONIO_THREADS") {
            Ok(text) => match text.trim().parse() {
                Ok(count) if (1..=MOST_THREADS).contains(&count) => Ok(count),
                _ => Err(invalid("GONIO_THREADS", text, accepted)),
            },
            Err(_) => Ok(usual_threads()),
        },
    }
}

/// As rayon decides, but without starting the threads that it keeps for all.
fn usual_threads() -> usize {
    let told = std::env::var("RAYON_NUM_THREADS").ok().and_then(|text| text.parse().ok());
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    told.filter(|&count| count > 0).unwrap_or_else(cores)
}

/// Do `work` on threads of its own, which are gone when this returns. `work` may send messages; each is handed
/// to `hear` on this thread, with Python at hand. An exception there, or Ctrl-C, stops the work.
pub fn long<M: Send, T: Send>(
    py: Python<'_>,
    threads: usize,
    work: impl FnOnce(&Sender<M>) -> T + Send,
    mut hear: impl FnMut(Python<'_>, M) -> PyResult<()>,
) -> PyResult<T> {
    let cancel = Cancel::new();
    std::thread::scope(|scope| {
        let (sender, mut messages) = channel();
        let token = &cancel;
        let worker = scope.spawn(move || run(token, threads, move || work(&sender)));
        let mut stopped = None;
        loop {
            let (next, back) = py.detach(move || (messages.recv_timeout(LOOK), messages));
            messages = back;
            let outcome = match next {
                Ok(message) => hear(py, message).and_then(|()| py.check_signals()),
                Err(RecvTimeoutError::Timeout) => py.check_signals(),
                Err(RecvTimeoutError::Disconnected) => break,
            };
            if let Err(error) = outcome {
                cancel.cancel();
                stopped = Some(error);
                break;
            }
        }
        // What was still to be heard is dropped, so that nothing waits for it.
        drop(messages);
        let result = py.detach(|| worker.join());
        match (stopped, result) {
            (Some(error), _) => Err(error),
            (None, Ok(Ok(value))) => Ok(value),
            (None, Ok(Err(error))) => Err(raised(&error)),
            (None, Err(_)) => Err(PyRuntimeError::new_err("the computation broke off")),
        }
    })
}

/// [`long`] work in parts: it calls what it is given whenever a part is done, and `progress` hears how many are.
pub fn in_parts<T: Send>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&(dyn Fn() + Sync)) -> T + Send,
) -> PyResult<T> {
    let work = |done: &Sender<()>| {
        let done = Mutex::new(done.clone());
        work(&|| {
            if let Ok(done) = done.lock() {
                // Where nobody listens any more the work is being stopped.
                let _ = done.send(());
            }
        })
    };
    let mut count = 0usize;
    let hear = |py: Python<'_>, ()| {
        count += 1;
        progress.map_or(Ok(()), |progress| progress.call1(py, (count,)).map(|_| ()))
    };
    long(py, threads, work, hear)
}
